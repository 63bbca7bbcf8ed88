/// The names of the skies, as users write them.
#pragma once

#include <string>
#include <string_view>

#include "core/units.h"

namespace tenku {

enum class SkyKind { None, Uniform, CieOvercast, CieGeneral, Perez, Weather, Image };

/// A sky's name, taken apart.
struct SkyName {
  SkyKind kind = SkyKind::None;
  int cie_type = 0;                              ///< 1 to 15, of CieGeneral
  Irradiance direct_normal, diffuse_horizontal;  ///< of Perez
  std::string file;                              ///< of Weather and Image
};

/// @throws InputError if the name is not one of them; the message suggests the nearest
SkyName parse_sky_name(std::string_view text);

}  // namespace tenku
