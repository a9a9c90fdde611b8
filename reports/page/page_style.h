// The page's style sheet, page.css, as the build embeds it.
#pragma once

#include <string_view>

namespace umbrameter {

std::string_view page_style();

/// The SHA-256 of its bytes, as 64 hexadecimal digits.
std::string_view page_style_hash();

}  // namespace umbrameter
