/// Which of a map's two axes the registry names first.
#pragma once

#include <string>

namespace tenku {

/// True if latitude or northing comes before the other coordinate in the definition of the CRS.
/// @param crs  as `Crs::parse` takes it
/// @throws InputError as `Crs::parse`
bool is_northing_first(const std::string& crs);

}  // namespace tenku
