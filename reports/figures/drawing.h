// A drawing in SVG as the file that its name asks for.
#pragma once

#include <filesystem>
#include <string>

namespace umbrameter {

/// Throws Error (usage) unless the name ends in .svg, .png or .pdf.
void require_drawing_name(const std::filesystem::path& path);

/// Writes the drawing as SVG, PNG (one pixel a unit) or PDF, by the name's end; whole or not at all.
/// Throws Error (partial) when it cannot be drawn.
void write_drawing(const std::filesystem::path& path, const std::string& svg);

}  // namespace umbrameter
