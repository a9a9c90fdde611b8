#include "compare/map_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "techniques/shadow/reference/lookup.h"

namespace umbrameter {
namespace {

Receiver receiver_at(const GBuffer& gbuffer, const MapLayout& layout, std::size_t pixel, double dither) {
  return project_to_map(layout, dvec3(gbuffer.position[pixel]), dither);
}

double pixel_dither(const GBuffer& gbuffer, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(gbuffer.width);
  return dither_at(static_cast<std::uint32_t>(pixel % width), static_cast<std::uint32_t>(pixel / width));
}

// Within the margin of a cascade, or on the last.
bool holds(const MapLayout& layout, std::size_t view, const dvec3& local) {
  const MapView& area = layout.views[view];
  const bool is_last = view + 1 == layout.views.size();
  const double reach = area.half_extent * (is_last ? 1.0 : 1.0 - 2.0 * map_view_margin / layout.resolution);
  const dvec2 offset = glm::abs(dvec2(local) - area.center);
  return offset.x <= reach && offset.y <= reach;
}

bool is_at_seam(const GBuffer& gbuffer, const MapLayout& layout, std::size_t pixel) {
  const Receiver receiver = receiver_at(gbuffer, layout, pixel, 0.0);
  if (layout.kind == MapKind::cube) {
    const dvec2 inner = glm::min(receiver.texels, static_cast<double>(layout.resolution) - receiver.texels);
    return std::min(inner.x, inner.y) < 1.0;
  }
  if (layout.kind == MapKind::paraboloid) {
    const double radius = glm::length(2.0 * receiver.texels / static_cast<double>(layout.resolution) - 1.0);
    return (1.0 - radius) * layout.resolution < 2.0;
  }
  const auto view = static_cast<std::size_t>(receiver.view);
  return view + 1 < layout.views.size() && !is_in_cascade(layout, view, receiver.in_light, seam_zone) &&
         holds(layout, view + 1, receiver.in_light);
}

}  // namespace

std::vector<ViewStatistics> analyze_views(const ShapeInput& input, const Image<float>& drawn, const WrongTaps* wrong) {
  assert(drawn.size() == input.truth.size());
  std::vector<ViewStatistics> views(input.layout.views.size());
  for (std::size_t v = 0; v < views.size(); ++v) views[v].view = v;
  std::uint64_t counted = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (input.counted.exclusion[i] != PixelExclusion::none) continue;
    const Receiver receiver = receiver_at(input.gbuffer, input.layout, i, pixel_dither(input.gbuffer, i));
    const double extent = input.layout.views[static_cast<std::size_t>(receiver.view)].half_extent;
    const double error = static_cast<double>(drawn[i]) - static_cast<double>(input.truth[i]);
    ViewStatistics& view = views[static_cast<std::size_t>(receiver.view)];
    ++counted;
    ++view.pixels;
    view.mean_texel += 2.0 * extent / input.layout.resolution *
                       (input.layout.kind == MapKind::orthographic ? 1.0 : receiver.axis_depth);
    view.mae += std::abs(error);
    view.mean_error += error;
    for (std::size_t c = 0; wrong != nullptr && c < cause_count; ++c) {
      view.causes[c] += static_cast<double>(wrong->weights[i][static_cast<int>(c)]) / wrong->weight_sum;
    }
  }
  for (ViewStatistics& view : views) {
    if (wrong == nullptr) view.causes.fill(std::numeric_limits<double>::quiet_NaN());
    if (view.pixels == 0) continue;
    const auto pixels = static_cast<double>(view.pixels);
    view.share = pixels / static_cast<double>(counted);
    for (double* sum : {&view.mean_texel, &view.mae, &view.mean_error}) *sum /= pixels;
    for (double& sum : view.causes) sum /= pixels;
  }
  return views;
}

Image<std::uint8_t> find_seams(const GBuffer& gbuffer, const MapLayout& layout, const CountedPixels& counted) {
  Image<std::uint8_t> seams(gbuffer.width, gbuffer.height, std::uint8_t{0});
  if (layout.views.size() < 2) return seams;
  for (std::size_t i = 0; i < seams.size(); ++i) {
    if (counted.exclusion[i] == PixelExclusion::none && is_at_seam(gbuffer, layout, i)) seams[i] = 1;
  }
  return seams;
}

SeamStatistics analyze_seams(const Image<std::uint8_t>& seams, const Image<float>& own, const Image<float>& neighbour,
                             const CountedPixels& counted) {
  assert(seams.size() == own.size() && own.size() == neighbour.size());
  SeamStatistics statistics;
  for (std::size_t i = 0; i < seams.size(); ++i) {
    if (seams[i] == 0) continue;
    const double difference = std::abs(static_cast<double>(neighbour[i]) - static_cast<double>(own[i]));
    ++statistics.pixels;
    statistics.mean_difference += difference;
    statistics.largest_difference = std::max(statistics.largest_difference, difference);
  }
  if (statistics.pixels == 0) return statistics;
  const auto all = static_cast<double>(counted.totals[static_cast<std::size_t>(PixelExclusion::none)]);
  statistics.share = static_cast<double>(statistics.pixels) / all;
  statistics.mean_difference /= static_cast<double>(statistics.pixels);
  return statistics;
}

Statistics describe(ViewStatistics& s) {
  StatisticsDescription description;
  description.field("view", s.view, "", "index of the cascade or cube face, from 0")
      .field("pixels", s.pixels, "px", "counted pixels that look up this view")
      .field("share", s.share, "1", "share of all counted pixels")
      .field("mean_texel", s.mean_texel, "m", "mean size of its texels at these pixels")
      .field("mae", s.mae, "1", "mean absolute error of visibility")
      .field("mean_error", s.mean_error, "1", "mean signed error, technique − reference");
  for (std::size_t c = 0; c < cause_count; ++c) {
    description.field(cause_names[c].data(), s.causes[c], "1", std::string(cause_meaning(static_cast<Cause>(c))));
  }
  return description.take();
}

Statistics describe(SeamStatistics& s) {
  return StatisticsDescription()
      .field(
          "pixels", s.pixels, "px",
          fmt::format(
              "counted pixels near a seam, looked up in the views on its two sides: with cascades, those in the outer "
              "{:g} % of one that also lie in the next; with cube faces or paraboloids, those within a texel of an "
              "edge",
              100.0 * seam_zone))
      .field("share", s.share, "1", "share of all counted pixels")
      .field("mean_difference", s.mean_difference, "1", "mean |difference of visibility| between the two views")
      .field("largest_difference", s.largest_difference, "1", "largest of these differences")
      .take();
}

Statistics describe(FitShimmer& s) {
  return StatisticsDescription()
      .field("step", s.step, "m",
             "length of each move of the camera, a few texels of the finest view: right, up and forward")
      .field("pixels", s.pixels, "px", "compared pixels, over all moves")
      .field("mean_change", s.mean_change, "1", "mean |change of visibility| at the same surfels")
      .field("largest_change", s.largest_change, "1", "mean |change| of the worst move")
      .take();
}

}  // namespace umbrameter
