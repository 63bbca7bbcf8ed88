/// The position of the sun by another, older way: a check on `sun_at`, and what others print.
#pragma once

#include "site/sun_position.h"

namespace tenku {

/// Position of the sun by the NREL solar position algorithm, step by step as published.
///
/// Shares nothing with `sun_at` but the refraction formula and the air. Its printed example comes
/// out to its printed digits; where the two differ, `sun_at` is closer to the sun.
/// Source   I. Reda and A. Andreas, NREL/TP-560-34302, revised 2008, section 3.
/// Valid    years -2000 to 6000.
/// Error    0.0003 degrees, as published; 0.0002 against the reference of docs/validation.md.
/// @throws InputError as `sun_at`
Sun sun_at_by_nrel(const Location& site, Instant instant, const SunOptions& options = {});

}  // namespace tenku
