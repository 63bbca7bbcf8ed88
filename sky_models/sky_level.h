/// How bright a sky is where nobody says.
#pragma once

#include "core/units.h"

namespace tenku {

/// Horizontal illuminance from an overcast sky.
///
/// Source   J. Krochmann and M. Seidl, "Quantitative data on daylight for illuminating
///          engineering", Lighting Research and Technology 6(3), 1974: 300 + 21000 sin altitude.
/// @param sun  altitude of the sun; the result is zero where it is not above the horizon
Illuminance overcast_illuminance(Angle sun);

/// Level of one of the 15 CIE standard skies, under its typical cloud or turbidity.
struct CieSkyLevel {
  Illuminance horizontal_diffuse;
  Illuminance sun_normal;  ///< from the sun alone on a plane facing it; 0 for types 1 to 6
};

/// Types 1 to 6 by the typical ratio of diffuse to extraterrestrial illuminance. Types 7 to 15 by
/// the zenith luminance under the typical luminous turbidity, which also dims the sun.
///
/// Source   S. Darula and R. Kittler, "CIE General Sky Standard Defining Luminance
///          Distributions", eSim 2002, section 4 and table 2 (after R. Kittler, R. Perez and S.
///          Darula, "A set of standard skies", 1998); luminous solar constant 133.8 klx (S. Darula,
///          R. Kittler and C. Gueymard, Solar Energy 79, 2005). The table is checked against two
///          transcriptions by others (`tests/reference/sky/cie_levels.csv`), which agree but for D
///          of type 7, 0.64 or 0.63: 0.8 % of the zenith luminance at 75 degrees.
/// Valid    sun above the horizon. The formula for the zenith diverges as the sun nears it: above
///          75 degrees the ratio of diffuse to extraterrestrial illuminance stays as it is there.
/// Error    a typical level; real skies of one type differ by a factor of two.
/// @param type  1 to 15
CieSkyLevel cie_sky_level(int type, Angle sun);

}  // namespace tenku
