// Lines for a terminal: numbers as people read them, columns, wrapped paragraphs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace umbrameter {

/// "1,234,567".
std::string grouped(std::uint64_t number);

/// "512 B", "4.19 MB": three significant digits, decimal units.
std::string bytes_text(std::uint64_t bytes);

/// "90 s", "12 min", "3.5 h".
std::string time_text(double seconds);

/// "[0.5, 2, -1]": six significant digits.
std::string vector_text(double x, double y, double z);

/// The first characters of a text, the last one "…" where it is longer than that. Bytes that are no UTF-8 and control
/// characters are replaced, so that a name from a file cannot steer a terminal.
std::string shortened(std::string_view text, std::size_t characters);

/// Lines of at most `characters`, broken at blanks and line ends; a longer word is a line by itself. All but the first
/// begin with as many blanks as `hanging`.
std::vector<std::string> wrap_lines(std::string_view text, std::size_t characters, std::size_t hanging = 0);

/// Rows of cells as lines with aligned columns, two blanks between them.
std::vector<std::string> aligned(const std::vector<std::vector<std::string>>& rows);

}  // namespace umbrameter
