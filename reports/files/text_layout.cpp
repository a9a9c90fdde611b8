#include "reports/files/text_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "reports/files/markup.h"

namespace umbrameter {

std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t place = text.size(); place > 3;) text.insert(place -= 3, 1, ',');
  return text;
}

std::string bytes_text(std::uint64_t bytes) {
  static constexpr std::array<const char*, 5> units{"B", "kB", "MB", "GB", "TB"};
  if (bytes < 1000) return fmt::format("{} B", bytes);
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  // 999.5 would be written as 1e+03.
  while (value >= 999.5 && unit + 1 < units.size()) {
    value /= 1000.0;
    ++unit;
  }
  return fmt::format("{:.3g} {}", value, units[unit]);
}

std::string time_text(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  return seconds < 5400.0 ? fmt::format("{:.0f} min", seconds / 60.0) : fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string vector_text(double x, double y, double z) {
  // A rounded rotation leaves -0 and 1e-17 behind, which say nothing.
  const double least = 1e-9 * std::max({std::abs(x), std::abs(y), std::abs(z)});
  const auto clean = [&](double value) { return std::abs(value) <= least ? 0.0 : value; };
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", clean(x), clean(y), clean(z));
}

std::string shortened(std::string_view text, std::size_t characters) {
  std::string plain = plain_text(text);
  if (count_characters(plain) <= characters) return plain;
  std::size_t kept = 0;
  std::size_t seen = 0;
  while (kept < plain.size()) {
    const bool starts_character = (static_cast<unsigned char>(plain[kept]) & 0xC0u) != 0x80u;
    if (starts_character && seen++ == characters - 1) break;
    ++kept;
  }
  return plain.substr(0, kept) + "…";
}

std::vector<std::string> wrap_lines(std::string_view text, std::size_t characters, std::size_t hanging) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t blank = text.find_first_of(" \n");
    const std::string_view word = text.substr(0, blank);
    text.remove_prefix(blank == std::string_view::npos ? text.size() : blank + 1);
    if (word.empty()) continue;
    if (lines.empty()) {
      lines.emplace_back(word);
    } else if (count_characters(lines.back()) + 1 + count_characters(word) > characters) {
      lines.emplace_back(hanging, ' ').append(word);
    } else {
      lines.back().append(" ").append(word);
    }
  }
  return lines;
}

std::vector<std::string> aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], count_characters(row[c]));
  }
  std::vector<std::string> lines;
  for (const auto& row : rows) {
    std::string& line = lines.emplace_back();
    for (std::size_t c = 0; c < row.size(); ++c) {
      line += row[c];
      if (c + 1 < row.size()) line.append(widths[c] - count_characters(row[c]) + 2, ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
  }
  return lines;
}

}  // namespace umbrameter
