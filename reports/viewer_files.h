/// The fixed parts of the page that plays films: the files of `reports/viewer`.
#pragma once

#include <string_view>

namespace tenku {

/// HTML with the places @TITLE@, @SCRIPT@ and @FACTS@.
std::string_view viewer_page_text();
std::string_view viewer_script();

}  // namespace tenku
