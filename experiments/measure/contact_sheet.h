// A sheet of small pictures of scenes, each with its name and purpose: for docs/ and for paper.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "core/math.h"
#include "core/parallel.h"
#include "core/parameters.h"
#include "scenes/scene.h"

namespace umbrameter {

struct SheetTile {
  std::string name;
  std::string facts;    ///< short, beside the name: "1,234 triangles"
  std::string purpose;  ///< wrapped beneath
  Image<glm::u8vec3> picture;
};

/// The scene from the first of its perspective cameras that sees more than one plane: traced shadows of its first sun
/// and of all its lamps, and traced ambient occlusion, on diffuse surfaces (scenes/shading.h); nine samples a pixel,
/// averaged before tone mapping. The occlusion reaches a quarter of the median distance to what is seen. One rule of
/// exposure for all: the mean luminance of the surfaces becomes 0.3, or less where more than 2 % of them would be
/// white. Where nothing is seen the tile is light grey. Throws Error (unreadable_input) for a scene without triangles.
Image<glm::u8vec3> draw_tile(Scene scene, Size size, const Progress& progress = {});

/// An SVG document: the tiles in reading order on white, in as many columns as bring the sheet nearest to the shape of
/// upright A4. Deterministic. All pictures have the size of the first.
std::string draw_sheet(const std::string& title, const std::vector<SheetTile>& tiles);

}  // namespace umbrameter
