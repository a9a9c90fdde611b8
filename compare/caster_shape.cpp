#include "compare/caster_shape.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <optional>

namespace umbrameter {
namespace {

constexpr double contact_pixels = 1.5;
constexpr double step_pixels = 0.5;

// Where world positions fall on the image.
class ImagePlane {
 public:
  explicit ImagePlane(const View& view)
      : clip_from_world_(clip_from_view(view) * view_from_world(view)),
        half_size_(0.5 * view.width, 0.5 * view.height) {}

  /// Pixels from the upper left corner; none behind the camera.
  std::optional<dvec2> place(const dvec3& world) const {
    const dvec4 clip = clip_from_world_ * dvec4(world, 1.0);
    if (!(clip.w > 0.0)) return {};
    return dvec2(1.0 + clip.x / clip.w, 1.0 - clip.y / clip.w) * half_size_;
  }
  /// Pixels a metre that a step along a unit direction covers.
  double scale(const dvec3& world, const dvec3& direction) const {
    const dvec4 clip = clip_from_world_ * dvec4(world, 1.0);
    const dvec4 change = clip_from_world_ * dvec4(direction, 0.0);
    if (!(clip.w > 0.0)) return 0.0;
    return glm::length((dvec2(change) - dvec2(clip) * (change.w / clip.w)) / clip.w * half_size_);
  }

 private:
  dmat4 clip_from_world_;
  dvec2 half_size_;
};

struct Samples {
  std::vector<ReceiverLength> gaps;
  std::uint64_t lost = 0;
  std::vector<ReceiverLength> insets;
  std::uint64_t unmatched = 0;
};

ReceiverLength median_of(const std::vector<ReceiverLength>& lengths) {
  const auto middle = [&](double ReceiverLength::*unit) {
    std::vector<double> values;
    values.reserve(lengths.size());
    for (const ReceiverLength& length : lengths) values.push_back(length.*unit);
    const auto place = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  if (lengths.empty()) return {};
  return {middle(&ReceiverLength::metres), middle(&ReceiverLength::texels), middle(&ReceiverLength::pixels)};
}

ReceiverLength largest_of(const std::vector<ReceiverLength>& lengths) {
  ReceiverLength largest;
  for (const ReceiverLength& length : lengths) {
    largest.metres = std::max(largest.metres, length.metres);
    largest.texels = std::max(largest.texels, length.texels);
    largest.pixels = std::max(largest.pixels, length.pixels);
  }
  return largest;
}

class Casters {
 public:
  explicit Casters(const CasterInput& input) : input_(input), gbuffer_(input.shape.gbuffer), image_(input.view) {}

  CasterShapes measure() {
    for (std::size_t i = 0; i < input_.shape.truth.size(); ++i) add_contact(i);
    add_insets();
    std::vector<CasterShape> shapes;
    for (const auto& [object, samples] : by_object_) {
      CasterShape shape;
      shape.object = object;
      shape.contacts = samples.gaps.size();
      shape.lost = samples.lost;
      shape.gap_median = median_of(samples.gaps);
      shape.gap_largest = largest_of(samples.gaps);
      shape.edges = samples.insets.size();
      shape.unmatched = samples.unmatched;
      shape.inset_median = median_of(samples.insets);
      shapes.push_back(shape);
    }
    return {std::move(shapes), search_};
  }

 private:
  std::uint32_t object_of(std::uint32_t instance) const {
    return instance == no_id ? no_id : input_.scene.instances[instance].object;
  }
  // The object whose true shadow a pixel lies in.
  std::uint32_t caster_of(std::size_t pixel) const {
    const bool is_blocked = input_.shape.counted.exclusion[pixel] == PixelExclusion::none &&
                            gbuffer_.is_surface(pixel) && input_.shape.truth[pixel] < 0.5f;
    return is_blocked ? object_of(input_.caster[pixel]) : no_id;
  }

  void add_contact(std::size_t pixel) {
    const std::uint32_t object = caster_of(pixel);
    if (object == no_id) return;
    ++search_.shadowed;
    ++(search_.*contact_of(pixel, object));
  }

  // Adds the pixel's gap where it is a contact. What became of it.
  std::uint64_t ContactSearch::*contact_of(std::size_t pixel, std::uint32_t object) {
    if (object == object_of(gbuffer_.instance[pixel])) return &ContactSearch::own_object;
    const dvec3 start(gbuffer_.position[pixel]);
    const dvec3 normal(gbuffer_.geometric_normal[pixel]);
    const dvec3 light = to_light(input_.shape.light, start);
    const double cosine = glm::dot(normal, light);
    const dvec3 along = cosine * normal - light;
    const double sine = glm::length(along);
    const double texel = texel_at(input_.shape.layout, start);
    const double distance = input_.distance[pixel];
    if (!(sine > 1e-6) || !(texel > 0.0)) return &ContactSearch::head_on;
    const dvec3 away = along / sine;
    const double scale = image_.scale(start, away);
    if (!(scale > 0.0)) return &ContactSearch::hidden;
    // Where texels are finer than pixels, no pixel's centre may lie within a texel of the foot.
    const double pixels_long = contact_pixels / scale;
    const double from_foot = distance * sine;
    if (distance > std::max(texel, pixels_long) || from_foot > pixels_long) return &ContactSearch::distant;
    const std::optional<Strip> strip = walk(pixel, object, away);
    if (!strip) return &ContactSearch::hidden;
    const double metres = strip->length > 0.0 ? from_foot + strip->length : 0.0;
    Samples& samples = by_object_[object];
    samples.gaps.push_back({metres, metres * cosine / texel, metres * scale});
    if (strip->is_lost) ++samples.lost;
    return &ContactSearch::measured;
  }

  struct Strip {
    double length = 0.0;  // metres from the first pixel
    bool is_lost = false;
  };

  // From pixel to pixel away from the light, until the raster shadow begins or the true one ends.
  std::optional<Strip> walk(std::size_t first, std::uint32_t object, const dvec3& away) const {
    if (input_.raster[first] < 0.5f) return Strip{};
    const dvec3 start(gbuffer_.position[first]);
    const dvec3 normal(gbuffer_.geometric_normal[first]);
    double lit = 0.0;
    double way = 0.0;
    std::size_t last = first;
    // A step is chosen by the scale where it starts. In perspective it covers 0.5 / (1 + 0.5 / v) pixels, v pixels
    // before its vanishing point: at least a quarter of a pixel until that is half a pixel away. A straight way across
    // the image is shorter than its width and height together.
    const int max_steps = 4 * (gbuffer_.width + gbuffer_.height);
    for (int step = 0; step < max_steps; ++step) {
      const double scale = image_.scale(start + way * away, away);
      if (!(scale > 0.0)) return {};
      way += step_pixels / scale;
      const std::optional<dvec2> place = image_.place(start + way * away);
      if (!place || !(place->x >= 0.0 && place->y >= 0.0 && place->x < gbuffer_.width && place->y < gbuffer_.height)) {
        return {};
      }
      const std::size_t pixel = gbuffer_.instance.index(static_cast<int>(place->x), static_cast<int>(place->y));
      if (pixel == last) continue;
      last = pixel;
      if (!gbuffer_.is_surface(pixel) || object_of(gbuffer_.instance[pixel]) != object_of(gbuffer_.instance[first])) {
        return {};
      }
      const dvec3 moved = dvec3(gbuffer_.position[pixel]) - start;
      const double here = glm::dot(moved, away);
      // A pixel that sees anything but the same plane: the way is hidden, or the receiver bends.
      if (std::abs(glm::dot(moved, normal)) > 0.25 * std::max(std::abs(here), 1.0 / scale)) return {};
      if (caster_of(pixel) != object) return Strip{0.5 * (lit + here), true};
      if (input_.raster[pixel] < 0.5f) return Strip{0.5 * (lit + here), false};
      lit = here;
    }
    return {};
  }

  void add_insets() {
    const ShapeInput& shape = input_.shape;
    Image<float> without_acne = input_.raster;
    for (std::size_t i = 0; i < without_acne.size(); ++i) {
      without_acne[i] += static_cast<float>(input_.wrong.weights[i].x) / static_cast<float>(input_.wrong.weight_sum);
    }
    const ShadowEdges truth = find_shadow_edges(shape.truth, gbuffer_, shape.counted);
    const NearestEdges raster = nearest_edges(find_shadow_edges(without_acne, gbuffer_, shape.counted));
    for (std::size_t pixel = 0; pixel < truth.bits.size(); ++pixel) {
      for (EdgeId bit = 0; bit < 2; ++bit) {
        if ((truth.bits[pixel] >> bit & 1) != 0) add_inset(static_cast<EdgeId>(2 * pixel) + bit, raster);
      }
    }
  }

  void add_inset(EdgeId edge, const NearestEdges& raster) {
    const EdgePixels pixels = pixels_of(edge, gbuffer_.width);
    const bool is_first_blocked = input_.shape.truth[pixels.first] < 0.5f;
    const std::uint32_t object = caster_of(is_first_blocked ? pixels.first : pixels.second);
    if (object == no_id) return;
    Samples& samples = by_object_[object];
    const EdgeId one = raster.edge[pixels.first];
    const EdgeId other = raster.edge[pixels.second];
    if (one == no_id) {
      ++samples.unmatched;
      return;
    }
    const dvec2 place = place_of(edge);
    const EdgeId found = glm::distance(place, place_of(other)) < glm::distance(place, place_of(one)) ? other : one;
    const EdgePixels at = pixels_of(found, gbuffer_.width);
    const bool is_in_shadow = input_.shape.truth[at.first] < 0.5f;
    if (is_in_shadow != (input_.shape.truth[at.second] < 0.5f)) {
      samples.insets.push_back({});
      return;
    }
    if (is_in_shadow && caster_of(at.first) != object && caster_of(at.second) != object) {
      ++samples.unmatched;
      return;
    }
    const dvec3 true_place = position_of(edge, gbuffer_);
    const dvec3 way = position_of(found, gbuffer_) - true_place;
    const dvec3 light = to_light(input_.shape.light, true_place);
    const double texel = texel_at(input_.shape.layout, true_place);
    const double across = glm::length(way - glm::dot(way, light) * light);
    const double sign = is_in_shadow ? 1.0 : -1.0;
    samples.insets.push_back({sign * glm::length(way), texel > 0.0 ? sign * across / texel : 0.0,
                              sign * glm::distance(place, place_of(found))});
  }

  dvec2 place_of(EdgeId edge) const {
    const std::size_t pixel = edge / 2;
    const auto width = static_cast<std::size_t>(gbuffer_.width);
    const std::size_t row = pixel / width;
    return dvec2(static_cast<double>(pixel % width), static_cast<double>(row)) +
           (edge % 2 == 0 ? dvec2(0.5, 0.0) : dvec2(0.0, 0.5));
  }

  const CasterInput& input_;
  const GBuffer& gbuffer_;
  ImagePlane image_;
  std::map<std::uint32_t, Samples> by_object_;
  ContactSearch search_;
};

}  // namespace

CasterShapes analyze_casters(const CasterInput& input) {
  assert(input.raster.size() == input.shape.truth.size() && input.caster.size() == input.shape.truth.size());
  return Casters(input).measure();
}

}  // namespace umbrameter
