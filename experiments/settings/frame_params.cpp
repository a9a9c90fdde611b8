#include "experiments/settings/frame_params.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.h"

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 2> row_names = {"top", "bottom"};

}  // namespace

Parameters describe(FrameParams& params) {
  return Description("frame")
      .field("visibility", params.visibility, {"", "file of the engine's visibility: the share of light that arrives"})
      .field("lit", params.lit,
             {"", "file of a frame with shadows; needs frame.unshadowed, takes the place of frame.visibility"})
      .field("unshadowed", params.unshadowed, {"", "file of the same frame without shadows"})
      .field("ao", params.ao, {"", "file of the engine's ambient occlusion, 1 where open"})
      .field("occluded", params.occluded,
             {"", "file of a frame with ambient occlusion; needs frame.open, takes the place of frame.ao"})
      .field("open", params.open, {"", "file of the same frame without ambient occlusion"})
      .field("position", params.position, {"", "file of world positions at the pixels' centres"})
      .field("depth", params.depth, {"", "file of depths at the pixels' centres, instead of positions"})
      .choice("depth-kind", params.depth_kind, depth_conventions,
              {"", "what the depths are; window is that of OpenGL, Direct3D and Vulkan"})
      .choice("rows", params.rows, row_names, {"", "the row that comes first in the files"})
      .field("axes", params.axes, {"", "which of the frame's coordinates are our x, y and z: x,z,-y where Z points up"})
      .field("unit", params.unit,
             {.unit = "m",
              .meaning = "length of one unit of positions, and of depths along the axis or ray",
              .min = 1e-9,
              .max = 1e9})
      .field("camera", params.camera, {"", "the frame's camera as a matrix, world from camera: 16 numbers by columns"})
      .field("vertical-fov", params.vertical_fov,
             {.unit = "degrees", .meaning = "vertical field of view of frame.camera", .min = 0.01, .max = 179.0})
      .field("near", params.near_plane,
             {.unit = "m", .meaning = "near plane of the frame's depths; 0: the camera's", .min = 0.0})
      .field("far", params.far_plane,
             {.unit = "m", .meaning = "far plane of the frame's depths; 0: the camera's", .min = 0.0})
      .take();
}

Parameters file_parameters(FrameParams& params) {
  Parameters all = describe(params);
  const auto is_last = [](const Parameter& each) { return each.key == "frame.depth"; };
  all.erase(std::ranges::find_if(all, is_last) + 1, all.end());
  return all;
}

FramePath parse_frame_path(const std::string& text) {
  std::error_code ignored;
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || std::filesystem::exists(text, ignored)) return {text, {}};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

bool shows_shadows(const FrameParams& params) { return !params.visibility.empty() || !params.lit.empty(); }

bool shows_ao(const FrameParams& params) { return !params.ao.empty() || !params.occluded.empty(); }

std::string title_of(const FrameParams& params) {
  const auto name_of = [](const std::string& first, const std::string& second) {
    return std::filesystem::path(first.empty() ? second : first).filename().string();
  };
  const std::string shadow = name_of(params.visibility, params.lit);
  const std::string ao = name_of(params.ao, params.occluded);
  if (shadow.empty() && ao.empty()) return {};
  return shadow.empty() || ao.empty() ? "frame of " + shadow + ao : "frames of " + shadow + " and " + ao;
}

FrameAxes parse_axes_of(const FrameParams& params) {
  FrameAxes axes;
  std::array<bool, 3> is_named{};
  std::istringstream text(params.axes);
  std::string word;
  std::size_t count = 0;
  const auto refuse = [&] {
    throw Error(ExitCode::usage, "--frame.axes " + params.axes, "it must name x, y and z once each",
                "write it like x,z,-y");
  };
  while (std::getline(text, word, ',')) {
    if (count == 3) refuse();
    const bool is_negative = word.starts_with('-');
    if (is_negative) word.erase(0, 1);
    if (word.size() != 1 || word[0] < 'x' || word[0] > 'z') refuse();
    const int index = word[0] - 'x';
    if (std::exchange(is_named[static_cast<std::size_t>(index)], true)) refuse();
    axes.index[count] = index;
    axes.sign[count++] = is_negative ? -1.0 : 1.0;
  }
  if (count != 3) refuse();
  return axes;
}

std::string add_frame_camera(Scene& scene, const FrameParams& params, const std::string& camera) {
  if (params.camera.empty()) return camera;
  const auto refuse = [](const std::string& why) {
    throw Error(ExitCode::usage, "--frame.camera", why, "give the matrix from camera to world, by columns");
  };
  std::string text = params.camera;
  for (char& c : text) c = c == ',' || c == '[' || c == ']' ? ' ' : c;
  std::istringstream numbers(text);
  dmat4 matrix(1.0);
  for (int i = 0; i < 16; ++i) {
    if (!(numbers >> matrix[i / 4][i % 4])) refuse("it is not 16 numbers");
  }
  std::string rest;
  if (numbers >> rest) refuse("it has more than 16 numbers");
  const dmat3 axes(matrix);
  const dmat3 square = glm::transpose(axes) * axes;
  for (int i = 0; i < 9; ++i) {
    const bool is_rigid = std::abs(square[i / 3][i % 3] - (i / 3 == i % 3 ? 1.0 : 0.0)) < 1e-3;
    if (!is_rigid) refuse("its axes are not of unit length and perpendicular");
  }
  if (!(glm::determinant(axes) > 0.0)) refuse("its axes are left-handed: negate one column");
  const dmat4 row(matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3], 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);
  if (row[0] != dvec4(0, 0, 0, 1)) refuse("its last row is not 0, 0, 0, 1: its rows may be given as columns");
  // The scene may have been moved to its middle.
  matrix[3] -= dvec4(scene.origin, 0.0);
  PerspectiveProjection lens;
  lens.vertical_fov = params.vertical_fov * pi / 180.0;
  scene.cameras.push_back({"frame", matrix, lens});
  return std::to_string(scene.cameras.size() - 1);
}

}  // namespace umbrameter
