// Text that goes into SVG and HTML.
#pragma once

#include <string>
#include <string_view>

namespace umbrameter {

/// Text as it may stand between tags or in quotes: & < > " ' become entities, control characters blanks, and bytes
/// that are not UTF-8 the replacement character.
std::string escape_markup(std::string_view text);

/// RFC 4648, section 4.
std::string to_base64(std::string_view bytes);

/// "data:image/png;base64,…" of bytes of that media type.
std::string data_uri(std::string_view media_type, std::string_view bytes);

/// Number of characters (code points) of a UTF-8 text.
std::size_t count_characters(std::string_view text);

}  // namespace umbrameter
