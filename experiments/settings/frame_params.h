// A frame that another renderer wrote to files, which takes the place of our own techniques: its files, and how they
// are to be read.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/parameters.h"
#include "scenes/depth_convention.h"
#include "scenes/scene.h"

namespace umbrameter {

enum class FrameRows : int { top, bottom };

/// The frame.* parameters. Paths are those of EXR, PFM, PNG and Radiance files; of an EXR file ":LAYER" may follow.
struct FrameParams {
  std::string visibility;
  std::string lit, unshadowed;
  std::string ao;
  std::string occluded, open;
  std::string position;
  std::string depth;
  DepthConvention depth_kind = DepthConvention::window;
  FrameRows rows = FrameRows::top;
  std::string axes = "x,y,z";  ///< which of the frame's coordinates are our x, y and z, with signs
  double unit = 1.0;           ///< metres per unit of the frame
  std::string camera;          ///< 16 numbers, world from camera, by columns; empty: a camera of the scene
  double vertical_fov = 45.0;  ///< of `camera`, degrees
  double near_plane = 0.0;     ///< metres; 0: the camera's
  double far_plane = 0.0;      ///< metres; 0: the camera's
};
Parameters describe(FrameParams& params);

/// Those that name a file, from frame.visibility to frame.depth.
Parameters file_parameters(FrameParams& params);

/// A file, and the layer of it that is named behind a colon: "mask.exr:layer", unless there is a file of that name.
struct FramePath {
  std::filesystem::path file;
  std::string layer;  ///< empty: its only one
};
FramePath parse_frame_path(const std::string& text);

/// Whether the files show shadows, ambient occlusion, or one of both.
bool shows_shadows(const FrameParams& params);
bool shows_ao(const FrameParams& params);
inline bool has_files(const FrameParams& params) { return shows_shadows(params) || shows_ao(params); }

/// For titles: "frame of mask.exr"; empty without files.
std::string title_of(const FrameParams& params);

/// How the files of a renderer are usually to be read.
struct FrameConvention {
  std::string_view name;
  DepthConvention depth_kind;
  FrameRows rows;
  std::string_view axes;
};
/// Of --convention. Blender's positions have Z up; its depth and the others' are those of their buffers.
inline constexpr std::array<FrameConvention, 5> frame_conventions = {{
    {"opengl", DepthConvention::window, FrameRows::bottom, "x,y,z"},
    {"direct3d", DepthConvention::window, FrameRows::top, "x,y,z"},
    {"vulkan", DepthConvention::window, FrameRows::top, "x,y,z"},
    {"reversed-z", DepthConvention::reversed_infinite, FrameRows::top, "x,y,z"},
    {"blender", DepthConvention::axis, FrameRows::top, "x,z,-y"},
}};

struct FrameAxes {
  std::array<int, 3> index{0, 1, 2};
  std::array<double, 3> sign{1.0, 1.0, 1.0};
};
/// Throws Error (usage) unless the text names each of x, y and z once: "x,z,-y".
FrameAxes parse_axes_of(const FrameParams& params);

/// Adds the frame's camera to the scene, as its last one, and returns its index as text, or returns `camera` where the
/// frame has none. Throws Error (usage) for what is no rigid matrix.
std::string add_frame_camera(Scene& scene, const FrameParams& params, const std::string& camera);

}  // namespace umbrameter
