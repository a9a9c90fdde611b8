#include "scenes/view_content.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace umbrameter {
namespace {

constexpr double pixels = 2000.0;
// Two surfaces nearer to each other than this share of their distance are one.
constexpr double same_depth = 1e-3;

/// A projected corner. Nearness is linear over the image and grows towards the camera: 1 / distance, or − distance for
/// an orthographic camera.
struct Corner {
  double x, y, nearness;
};

struct Pixel {
  double any = -std::numeric_limits<double>::infinity();
  double shown = -std::numeric_limits<double>::infinity();
  std::uint64_t surface = 0;
  bool is_front = false;
  bool faces_light = false;  ///< the side of the surface that is shown
  bool is_hidden = false;    ///< the nearest triangle is a back face
  bool is_cut = false;
};

class Canvas {
 public:
  Canvas(const Camera& camera, double aspect, const TriangleSample& sample)
      : lens_(std::get_if<PerspectiveProjection>(&camera.projection)),
        height_(std::clamp(static_cast<int>(std::lround(std::sqrt(pixels / aspect))), 4, 500)),
        width_(std::clamp(static_cast<int>(std::lround(std::sqrt(pixels * aspect))), 4, 500)),
        image_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {
    const double radius = sample.radius();
    camera_from_world_ = glm::transpose(dmat3(camera.world_from_camera));
    eye_ = (dvec3(camera.world_from_camera[3]) - sample.center()) / radius;
    if (lens_ != nullptr) {
      half_height_ = std::tan(0.5 * lens_->vertical_fov);
      near_ = lens_->near_plane / radius;
      clip_ = std::max(1e-6, 1e-3 * near_);
    } else {
      const auto& parallel = std::get<OrthographicProjection>(camera.projection);
      half_height_ = parallel.half_height / radius;
      near_ = clip_ = parallel.near_plane / radius;
    }
    half_width_ = half_height_ * aspect;
  }

  void draw(const SampledTriangle& triangle) {
    std::array<dvec3, 3> at;
    for (std::size_t i = 0; i < 3; ++i) at[i] = camera_from_world_ * (dvec3(triangle.corners[i]) - eye_);
    const dvec3 area = glm::cross(at[1] - at[0], at[2] - at[0]);
    const double towards = lens_ != nullptr ? -glm::dot(area, at[0]) : area.z;
    if (towards == 0.0) return;
    std::array<Corner, 4> polygon{};
    int corners = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const dvec3& a = at[i];
      const dvec3& b = at[(i + 1) % 3];
      const bool is_a_before = -a.z >= clip_;
      if (is_a_before) polygon[static_cast<std::size_t>(corners++)] = project(a);
      if (is_a_before == (-b.z >= clip_)) continue;
      const double t = (-clip_ - a.z) / (b.z - a.z);
      polygon[static_cast<std::size_t>(corners++)] = project({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), -clip_});
    }
    for (int i = 2; i < corners; ++i) {
      fill(polygon[0], polygon[static_cast<std::size_t>(i) - 1], polygon[static_cast<std::size_t>(i)], triangle,
           towards > 0.0);
    }
  }

  ViewContent content() const {
    ViewContent content;
    std::vector<std::uint64_t> surfaces;
    const double share = 1.0 / static_cast<double>(image_.size());
    for (const Pixel& pixel : image_) {
      const bool is_shown = std::isfinite(pixel.shown);
      if (is_shown) surfaces.push_back(pixel.surface);
      const double tolerance = lens_ != nullptr ? same_depth * pixel.any : same_depth;
      content.seen += is_shown ? share : 0.0;
      content.lit += is_shown && pixel.faces_light ? share : 0.0;
      content.behind += pixel.is_hidden && !(pixel.shown >= pixel.any - tolerance) ? share : 0.0;
      content.front += pixel.is_front ? share : 0.0;
      content.cut += pixel.is_cut ? share : 0.0;
      content.covered += std::isfinite(pixel.any) ? share : 0.0;
    }
    std::ranges::sort(surfaces);
    const auto all = static_cast<double>(surfaces.size());
    for (auto begin = surfaces.begin(); begin != surfaces.end();) {
      const auto end = std::upper_bound(begin, surfaces.end(), *begin);
      const double part = static_cast<double>(end - begin) / all;
      content.variety -= part * std::log(part);
      begin = end;
    }
    return content;
  }

 private:
  Corner project(const dvec3& p) const {
    const double distance = -p.z;
    const double scale = lens_ != nullptr ? 1.0 / distance : 1.0;
    return {0.5 * width_ * (1.0 + p.x * scale / half_width_), 0.5 * height_ * (1.0 - p.y * scale / half_height_),
            lens_ != nullptr ? scale : -distance};
  }

  void fill(const Corner& a, const Corner& b, const Corner& c, const SampledTriangle& triangle, bool is_front) {
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0.0 || !std::isfinite(area)) return;
    // The pixels whose centres lie between the corners' extremes.
    const auto first = [](double min, int size) {
      return static_cast<int>(std::clamp(std::ceil(min - 0.5), 0.0, static_cast<double>(size)));
    };
    const auto last = [](double max, int size) {
      return static_cast<int>(std::clamp(std::floor(max - 0.5), -1.0, static_cast<double>(size - 1)));
    };
    const int right = last(std::max({a.x, b.x, c.x}), width_);
    const int bottom = last(std::max({a.y, b.y, c.y}), height_);
    for (int y = first(std::min({a.y, b.y, c.y}), height_); y <= bottom; ++y) {
      for (int x = first(std::min({a.x, b.x, c.x}), width_); x <= right; ++x) {
        const double px = x + 0.5;
        const double py = y + 0.5;
        const double u = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) / area;
        const double v = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
        if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
        const double nearness = a.nearness + u * (b.nearness - a.nearness) + v * (c.nearness - a.nearness);
        put(image_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)],
            nearness, triangle, is_front);
      }
    }
  }

  void put(Pixel& pixel, double nearness, const SampledTriangle& triangle, bool is_front) const {
    const bool is_shown = is_front || triangle.is_double_sided;
    if (lens_ != nullptr && nearness * near_ > 1.0) {
      // What stands for many is larger than it is.
      pixel.is_cut |= triangle.weight == 1.0f;
      return;
    }
    if (nearness > pixel.any) {
      pixel.any = nearness;
      pixel.is_front = is_front;
      pixel.is_hidden = !is_shown;
    }
    if (is_shown && nearness > pixel.shown) {
      pixel.shown = nearness;
      pixel.surface = triangle.surface;
      pixel.faces_light = is_front ? triangle.front_faces_light : triangle.back_faces_light;
    }
  }

  const PerspectiveProjection* lens_;
  int height_;
  int width_;
  std::vector<Pixel> image_;
  dmat3 camera_from_world_{1.0};
  dvec3 eye_{0.0};
  double half_width_ = 1.0;
  double half_height_ = 1.0;
  double near_ = 0.0;
  double clip_ = 0.0;
};

}  // namespace

ViewContent look(const TriangleSample& sample, const Camera& camera, double aspect) {
  Canvas canvas(camera, aspect, sample);
  for (const SampledTriangle& triangle : sample.triangles) canvas.draw(triangle);
  return canvas.content();
}

}  // namespace umbrameter
