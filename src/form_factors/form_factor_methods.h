/// The makers of the methods behind `form_factor_method`, one a file.
#pragma once

#include <memory>

#include "form_factors/form_factor.h"

namespace tenku {

/// @param mesh  kept by reference
using FormFactorMaker = std::unique_ptr<FormFactorMethod>(const ElementMesh& mesh,
                                                          const FormFactorOptions& options);

FormFactorMaker make_hemisphere_scanline;
FormFactorMaker make_hemisphere_zbuffer;
FormFactorMaker make_hemisphere_rays;
FormFactorMaker make_hemicube;
FormFactorMaker make_analytic_form_factors;

}  // namespace tenku
