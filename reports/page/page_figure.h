// Figures as they stand in the page: inlined, so that the page needs no other file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace umbrameter {

/// An SVG document as an element of an HTML page: without its prologue, each id and each reference to one prefixed, so
/// that the ids of several figures stay apart. Empty when the text is no SVG or holds scripts.
std::string inline_svg(std::string_view document, std::string_view id_prefix);

struct PageFigure {
  std::string stem;   ///< of the files in DIR/figures
  std::string title;  ///< the picture shows it already: repeated for readers who cannot see the picture
  std::string caption;
  std::size_t number = 0;  ///< "Figure 3"
};

/// A <figure> with the picture, its caption and links to its files. `folder` is DIR; a figure that is not there, or
/// whose stem would lead out of DIR/figures, is said to be missing.
std::string figure_markup(const std::filesystem::path& folder, const PageFigure& figure, std::string_view id_prefix);

}  // namespace umbrameter
