#include "experiments/engine/frame_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include "compare/metrics/color_space.h"
#include "core/error.h"
#include "reports/files/image_file.h"
#include "reports/files/text_layout.h"

namespace umbrameter {
namespace {

enum class Content { light, data };
using Notes = std::vector<std::string>;

Image<vec3> read(const std::string& text, const FrameParams& params, const View& view, Content content, Notes& notes) {
  const auto [path, layer] = parse_frame_path(text);
  const ImageFile file(path);
  if (file.width() != view.width || file.height() != view.height) {
    throw Error(
        ExitCode::usage, path.string(),
        fmt::format("it has {}x{} pixels, the view {}x{}", file.width(), file.height(), view.width, view.height),
        fmt::format("add --size {}x{}", file.width(), file.height()));
  }
  ColorImage decoded = file.decode(layer);
  if (decoded.has_other_layers) {
    notes.push_back(fmt::format("{0}: its channels R, G and B are read; {0}:LAYER reads another layer", text));
  }
  Image<vec3>& image = decoded.linear;
  if (content == Content::data && decoded.is_display) {
    for (vec3& pixel : image.pixels) {
      for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(srgb_from_linear(static_cast<double>(pixel[c])));
    }
  }
  if (params.rows == FrameRows::top) return std::move(image);
  Image<vec3> flipped = image;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) flipped.at(x, y) = image.at(x, image.height - 1 - y);
  }
  return flipped;
}

// A mask is one channel. A picture in its place would be measured as if it were one.
Image<float> read_share(const std::string& text, const FrameParams& params, const View& view, Notes& notes) {
  constexpr float code_value = 1.0f / 255.0f;
  const Image<vec3> image = read(text, params, view, Content::data, notes);
  const auto is_colored = [](const vec3& pixel) {
    return std::abs(pixel.x - pixel.y) > code_value || std::abs(pixel.x - pixel.z) > code_value;
  };
  const auto colored = std::ranges::count_if(image.pixels, is_colored);
  if (colored > 0) {
    notes.push_back(fmt::format("{}: R alone is read; G or B differ from it in {} of {} pixels", text,
                                grouped(static_cast<std::uint64_t>(colored)), grouped(image.size())));
  }
  return share_of(image, text);
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
  const auto notes = std::make_shared<Notes>();
  source.take_warnings = [notes] { return std::exchange(*notes, {}); };
  source.surfaces = [params, axes, origin, notes](const FramedView& framed) -> std::optional<FrameSurfaces> {
    FrameSurfaces surfaces;
    surfaces.convention = params.depth_kind;
    surfaces.near_plane = params.near_plane;
    surfaces.far_plane = params.far_plane;
    if (!params.position.empty()) {
      surfaces.position = read(params.position, params, framed.view, Content::light, *notes);
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
    const Image<vec3> depth = read(params.depth, params, framed.view, Content::data, *notes);
    const bool is_length = params.depth_kind == DepthConvention::axis || params.depth_kind == DepthConvention::ray;
    const double unit = is_length ? params.unit : 1.0;
    surfaces.depth = Image<float>(depth.width, depth.height, 0.0f);
    for (std::size_t i = 0; i < depth.size(); ++i) {
      surfaces.depth[i] = static_cast<float>(unit * static_cast<double>(depth[i].x));
    }
    return surfaces;
  };
  const auto shares = [params, notes](const std::string& whole, const std::string& with, const std::string& without,
                                      const FramedView& framed, std::size_t count) {
    const Image<float> image = whole.empty() ? ratio_of(read(with, params, framed.view, Content::light, *notes),
                                                        read(without, params, framed.view, Content::light, *notes))
                                             : read_share(whole, params, framed.view, *notes);
    return std::vector<FrameShare>(count, FrameShare{image});
  };
  source.visibility = [params, shares](const FramedView& framed, std::span<const EngineParams> frames) {
    return shares(params.visibility, params.lit, params.unshadowed, framed, frames.size());
  };
  if (!params.unshadowed.empty()) {
    source.unlit = [params, notes](const FramedView& framed) {
      return unlit_of(read(params.unshadowed, params, framed.view, Content::light, *notes));
    };
  }
  source.ao = [params, shares](const FramedView& framed, std::span<const EngineParams> frames) {
    return shares(params.ao, params.occluded, params.open, framed, frames.size());
  };
  return source;
}

}  // namespace umbrameter
