/// What is in a point store. Private to this module.
#pragma once

#include <string>

#include "cli/command.h"

namespace tenku {

/// Whether a file is a point store by its name: `.tkpts`, or `.tkpts.part` of one that is being
/// written or was cut off.
bool is_store_name(const std::string& file);

/// Prints it as text, or with `--json` as JSON.
/// @return the exit code
/// @throws InputError, ResourceError as `PointStore`
int inspect_store(const std::string& file, const CommonOptions& options);

}  // namespace tenku
