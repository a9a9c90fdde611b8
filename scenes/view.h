// Which camera sees the scene, at which size, and how pixels map to rays.
#pragma once

#include <string>

#include "core/parameters.h"
#include "scenes/scene.h"

namespace umbrameter {

enum class SurfelSource : int { raster, traced };

/// The view.* parameters.
struct ViewParams {
  Size size;
  std::string scene;   ///< which of several scenes in a file, by name or index; empty: the file's default
  std::string camera;  ///< name or index; empty is the first of the scene
  std::string light;   ///< name or index; empty: every light, or the first where one is swept
  SurfelSource surfels = SurfelSource::raster;
};
Parameters describe(ViewParams& params);

/// A camera at an image size.
struct View {
  int width = 0;
  int height = 0;
  Camera camera;
};

/// Right-handed view space (−Z forward) from world.
dmat4 view_from_world(const View& view);

/// Clip space with depth 0 at the far plane and 1 at the near plane (reversed, for float depth), y up.
/// An infinite far plane is allowed.
dmat4 clip_from_view(const View& view);

struct Ray {
  dvec3 origin;     ///< on the near plane
  dvec3 direction;  ///< unit
};

/// The ray through the centre of pixel (x, y); row 0 is the top row.
Ray pixel_ray(const View& view, int x, int y);

/// Unit vector from a world position to the viewer: to the eye, or against an orthographic camera's axis.
dvec3 to_viewer(const View& view, const dvec3& position);

/// The camera that the name or index selects; the first when empty; a fitted one (fitted_camera.h), with a note, when
/// the scene has none. A note, too, for a camera that is inside an object. Throws Error (usage) listing the cameras
/// when there is no such one.
Camera select_camera(const Scene& scene, const std::string& name_or_index, double aspect,
                     std::vector<std::string>& notes);

/// Gives a scene without a light a sun named "sun", with a note.
void add_missing_light(Scene& scene, std::vector<std::string>& notes);

/// Indices of the lights that the name or index selects (selection.h); all of them when empty.
/// Throws Error (usage) listing the lights when there is no such one.
std::vector<std::uint32_t> select_lights(const Scene& scene, const std::string& name_or_index);

/// Layer names for the lights of a scene, one each and all different: the first 64 characters of the name with all but
/// letters and digits made '_', or the index where there is none; a repeated name gets its index appended.
std::vector<std::string> layer_names(const std::vector<Light>& lights);

}  // namespace umbrameter
