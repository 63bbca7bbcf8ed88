/// From a study file to what it asks for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/study.h"

namespace tenku {

/// What the command line puts in place of the file's words. Empty: the file's.
struct StudyOverrides {
  std::filesystem::path scene;  ///< relative to the working folder, not to the study file
  std::string time;             ///< without an offset the file's `zone` holds
};

/// Reads a study, TOML as `docs/study.md` describes it. Every value is checked for type and range;
/// names of skies, zones and engines are left to those who know them.
///
/// With `overrides.scene` what belongs to the file's own scene is refused, not guessed at: a view
/// placed by `eye`, a `ground` height, `site`, `crs`.
///
/// @throws InputError  naming file and line: no such file, no TOML, a key that is not known (with
/// the
///                     nearest that is), missing, of the wrong type or out of range
Study read_study(const std::filesystem::path& path, const StudyOverrides& overrides = {});

/// Every key that may stand in a study, as `table.key`, in the order of the documentation.
std::vector<std::string> study_keys();

}  // namespace tenku
