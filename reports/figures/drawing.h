// A drawing in SVG as the file that its name asks for.
#pragma once

#include <filesystem>
#include <string>

#include "reports/files/process.h"

namespace umbrameter {

/// The program that turns the drawing into "pdf" or "png"; zoom is in pixels of a PNG for each of the drawing's.
Filter conversion(const std::string& svg, const char* format, const char* zoom);

/// The problem of a program that could not be run, with the package that holds it.
std::string with_package(const std::string& problem, const char* program, const char* package);

/// Throws Error (usage) unless the name ends in .svg, .png or .pdf.
void require_drawing_name(const std::filesystem::path& path);

/// Writes the drawing as SVG, PNG (one pixel a unit) or PDF, by the name's end; whole or not at all.
/// Throws Error (partial) when rsvg-convert is missing or fails.
void write_drawing(const std::filesystem::path& path, const std::string& svg);

}  // namespace umbrameter
