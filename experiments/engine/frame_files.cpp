#include "experiments/engine/frame_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "compare/metrics/color_space.h"
#include "core/error.h"
#include "reports/files/image_file.h"

namespace umbrameter {
namespace {

enum class Content { light, data };

Image<vec3> read(const std::string& text, const FrameParams& params, const View& view, Content content) {
  const auto [path, layer] = parse_frame_path(text);
  const ImageFile file(path);
  if (file.width() != view.width || file.height() != view.height) {
    throw Error(
        ExitCode::usage, path.string(),
        fmt::format("it has {}x{} pixels, the view {}x{}", file.width(), file.height(), view.width, view.height),
        fmt::format("add --size {}x{}", file.width(), file.height()));
  }
  ColorImage decoded = file.decode(layer);
  Image<vec3>& image = decoded.linear;
  if (content == Content::data && decoded.is_display) {
    for (vec3& pixel : image.pixels) pixel = vec3(static_cast<float>(srgb_from_linear(static_cast<double>(pixel.x))));
  }
  if (params.rows == FrameRows::top) return std::move(image);
  Image<vec3> flipped = image;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) flipped.at(x, y) = image.at(x, image.height - 1 - y);
  }
  return flipped;
}

void require_pair(const std::string& first, const char* first_name, const std::string& second, const char* second_name,
                  const std::string& whole, const char* whole_name) {
  if (first.empty() != second.empty()) {
    throw Error(ExitCode::usage, std::string("--frame.") + (first.empty() ? second_name : first_name),
                std::string("it needs --frame.") + (first.empty() ? first_name : second_name), "give both frames");
  }
  if (first.empty() || whole.empty()) return;
  throw Error(ExitCode::usage, std::string("--frame.") + whole_name,
              std::string("--frame.") + first_name + " says the same in another way", "give one of them");
}

}  // namespace

FrameSource frames_of(const FrameParams& params, const dvec3& origin) {
  require_pair(params.lit, "lit", params.unshadowed, "unshadowed", params.visibility, "visibility");
  require_pair(params.occluded, "occluded", params.open, "open", params.ao, "ao");
  if (!params.position.empty() && !params.depth.empty()) {
    throw Error(ExitCode::usage, "--frame.depth", "--frame.position says the same in another way", "give one of them");
  }
  const FrameAxes axes = parse_axes_of(params);
  FrameSource source;
  source.title = title_of(params);
  source.has_shadows = shows_shadows(params);
  source.has_ao = shows_ao(params);
  source.surfaces = [params, axes, origin](const FramedView& framed) -> std::optional<FrameSurfaces> {
    FrameSurfaces surfaces;
    surfaces.convention = params.depth_kind;
    surfaces.near_plane = params.near_plane;
    surfaces.far_plane = params.far_plane;
    if (!params.position.empty()) {
      surfaces.position = read(params.position, params, framed.view, Content::light);
      for (vec3& position : surfaces.position.pixels) {
        dvec3 ours;
        for (std::size_t c = 0; c < 3; ++c) {
          const auto own = static_cast<int>(c);
          ours[own] = params.unit * axes.sign[c] * static_cast<double>(position[axes.index[c]]) - origin[own];
        }
        position = vec3(ours);
      }
      return surfaces;
    }
    if (params.depth.empty()) return std::nullopt;
    const Image<vec3> depth = read(params.depth, params, framed.view, Content::data);
    const bool is_length = params.depth_kind == DepthConvention::axis || params.depth_kind == DepthConvention::ray;
    const double unit = is_length ? params.unit : 1.0;
    surfaces.depth = Image<float>(depth.width, depth.height, 0.0f);
    for (std::size_t i = 0; i < depth.size(); ++i) {
      surfaces.depth[i] = static_cast<float>(unit * static_cast<double>(depth[i].x));
    }
    return surfaces;
  };
  const auto shares = [params](const std::string& whole, const std::string& with, const std::string& without,
                               const FramedView& framed, std::size_t count) {
    const Image<float> image = whole.empty() ? ratio_of(read(with, params, framed.view, Content::light),
                                                        read(without, params, framed.view, Content::light))
                                             : share_of(read(whole, params, framed.view, Content::data), whole);
    return std::vector<FrameShare>(count, FrameShare{image});
  };
  source.visibility = [params, shares](const FramedView& framed, std::span<const EngineParams> frames) {
    return shares(params.visibility, params.lit, params.unshadowed, framed, frames.size());
  };
  if (!params.unshadowed.empty()) {
    source.unlit = [params](const FramedView& framed) {
      return unlit_of(read(params.unshadowed, params, framed.view, Content::light));
    };
  }
  source.ao = [params, shares](const FramedView& framed, std::span<const EngineParams> frames) {
    return shares(params.ao, params.occluded, params.open, framed, frames.size());
  };
  return source;
}

}  // namespace umbrameter
