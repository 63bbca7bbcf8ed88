/// The makers of the methods behind `form_factor_method`, one a file.
#pragma once

#include <memory>

#include "radiosity/form_factor.h"

namespace tenku {

/// @param mesh  kept by reference
using FormFactorMaker = std::unique_ptr<FormFactorMethod>(const ElementMesh& mesh,
                                                          const FormFactorOptions& options);

FormFactorMaker make_hemisphere_rays;

}  // namespace tenku
