// Text that goes into SVG, HTML and terminals.
#pragma once

#include <string>
#include <string_view>

namespace umbrameter {

/// Text without control characters (each becomes a blank), bytes that are no UTF-8, invisible characters and those that
/// turn the direction of writing (each becomes the replacement character): it breaks no document, steers no terminal.
std::string plain_text(std::string_view text);

/// Whether all bytes are UTF-8 (RFC 3629).
bool is_utf8(std::string_view text);

/// The text with all occurrences replaced, from the first to the last.
std::string replace_all(std::string text, std::string_view what, std::string_view with);

/// Text as it may stand between tags or in quotes: plain_text() in which & < > " '
/// become entities.
std::string escape_markup(std::string_view text);

/// RFC 4648, section 4.
std::string to_base64(std::string_view bytes);
std::string from_base64(const std::string& text);

/// "data:image/png;base64,…" of bytes of that media type.
std::string data_uri(std::string_view media_type, std::string_view bytes);

/// Number of characters (code points) of a UTF-8 text.
std::size_t count_characters(std::string_view text);

/// Width in DejaVu Sans as a multiple of the font size: near enough to choose sizes and line breaks, seldom too small.
double text_width(std::string_view text);

}  // namespace umbrameter
