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

/// A method that knows nothing of panes, dimmed by those of the mesh: each form factor times the
/// mean transmittance toward 16 parts of the element, whether they are seen or not.
///
/// Error  where the edge of a pane crosses an element, or a part of it is hidden.
std::unique_ptr<FormFactorMethod> dimmed_by_panes(std::unique_ptr<FormFactorMethod> method,
                                                  const ElementMesh& mesh);

}  // namespace tenku
