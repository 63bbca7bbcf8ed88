/// Text for web pages.
#pragma once

#include <string>
#include <string_view>

namespace tenku {

/// `text` made safe for HTML and SVG, inside elements and quoted attributes: `& < > " '` as
/// references, control characters and bytes that are not UTF-8 as U+FFFD.
std::string escaped(std::string_view text);

/// Bytes as text for a `data:` address.
///
/// Source   RFC 4648, section 4.
std::string base64(std::string_view bytes);

/// Number for SVG coordinates: at most two decimals.
std::string coordinate(double value);

}  // namespace tenku
