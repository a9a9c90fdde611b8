// Figures as the page shows them: inlined, so that the page needs no other file.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace umbrameter {

/// An SVG document as an element of an HTML page: without its prologue, each id and each reference to one prefixed, so
/// that the ids of several figures stay apart. Empty when the text is no SVG or holds scripts.
std::string inline_svg(std::string_view document, std::string_view id_prefix);

/// The files of a figure, for links: a list of its SVG, PDF and PNG in DIR/figures. `folder` is DIR. Empty for a stem
/// that would lead out of DIR/figures.
nlohmann::ordered_json figure_files(const std::filesystem::path& folder, const std::string& stem);

/// Adds the picture to a figure of page_data(): as "drawing", an SVG element, or as "pixels", a data URI; "missing" is
/// true when there is neither.
void add_picture(nlohmann::ordered_json& figure, const std::filesystem::path& folder);

/// The element with its embedded PNGs reduced to 640 to 1279 columns: each pixel is the mean of n × n. A page at full
/// width gives a figure about as many.
std::string with_reduced_images(std::string_view drawing);

}  // namespace umbrameter
