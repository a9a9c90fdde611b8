#include "tests/agreement/bias_agreement.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "raytrace/surface_judge.h"
#include "raytrace/tracer.h"
#include "techniques/shadow/cascades.h"
#include "tests/support/reference/unresolved_taps.h"

namespace umbrameter::test {
namespace {

NamedFilter filter(std::string name, ShadowFilter kind, int size, FilterTaps taps = FilterTaps::nearest) {
  NamedFilter named{std::move(name), {}};
  named.params.pcf.filter = kind;
  named.params.pcf.size = size;
  named.params.pcf.taps = taps;
  return named;
}

// Mean |raster − truth| of the counted pixels, from the images alone.
double mean_error(const Image<float>& raster, const Image<float>& truth, const CountedPixels& counted) {
  double error = 0.0;
  std::uint64_t pixels = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (counted.exclusion[i] != PixelExclusion::none) continue;
    ++pixels;
    error += std::abs(static_cast<double>(raster[i]) - static_cast<double>(truth[i]));
  }
  return pixels > 0 ? error / static_cast<double>(pixels) : 0.0;
}

bool has_wrong(const VisibilitySums& sums) {
  return std::any_of(sums.wrong.begin(), sums.wrong.end(), [](std::uint64_t weight) { return weight > 0; });
}

auto fields_of(const UnresolvedTap& t) {
  return std::tie(t.pixel, t.texel, t.view, t.weight, t.critical_bias, t.slope, t.bias_unit, t.instance, t.triangle);
}

bool comes_before(const UnresolvedTap& a, const UnresolvedTap& b) { return fields_of(a) < fields_of(b); }

// In one order, whatever order they were found in.
std::vector<UnresolvedTap> listed(const gl::Context& context, const ShadowLookup& lookup, const BiasAxes& axes) {
  std::vector<UnresolvedTap> all;
  list_unresolved_taps(context, lookup, axes, true,
                       [&](std::span<const UnresolvedTap> taps) { all.insert(all.end(), taps.begin(), taps.end()); });
  std::sort(all.begin(), all.end(), comes_before);
  return all;
}

}  // namespace

std::vector<NamedFilter> usual_filters() {
  return {filter("nearest", ShadowFilter::nearest, 1),
          filter("bilinear", ShadowFilter::bilinear, 1),
          filter("3×3 box", ShadowFilter::box, 3),
          filter("5×5 Gaussian", ShadowFilter::gaussian, 5),
          filter("16 Poisson", ShadowFilter::poisson, 1),
          filter("3×3 box of linear taps", ShadowFilter::box, 3, FilterTaps::linear),
          filter("5×5 tent of linear taps", ShadowFilter::tent, 5, FilterTaps::linear)};
}

std::vector<Light> lights_of_every_kind(const Scene& scene) {
  Light sun;
  for (const Light& light : scene.lights) {
    if (std::holds_alternative<DirectionalLight>(light.shape)) sun = light;
  }
  const Bounds bounds = bounds_of(scene);
  Light spot = sun;
  spot.world_from_light[3] = dvec4(bounds.center() - 2.0 * bounds.radius() * sun.axis(), 1.0);
  spot.shape = SpotLight{0.0, 0.0, 0.5};
  Light point = spot;
  point.shape = PointLight{};
  return {sun, spot, point};
}

Agreement compare_ways(const gl::Context& context, const Scene& scene, const View& view, const Light& light,
                       const BiasGrid& grid) {
  Agreement agreement;
  const UploadedScene uploaded = upload(context, scene);
  const GpuGBuffer surfels = draw_gbuffer(context, uploaded, view);
  const GBuffer gbuffer = read_back(context, surfels);
  const Tracer tracer(scene);
  const Image<float> visibility = trace_visibility(tracer, gbuffer, light).visibility;
  for (const int resolution : grid.resolutions) {
    const MapLayout layout =
        with_point_map(fit_map(light, bounds_of(scene), {resolution, grid.cascades}, {gbuffer, view}, grid.fit),
                       grid.map_depth.point_map);
    agreement.views = layout.views.size();
    const CountedPixels counted = count_pixels(gbuffer, light, layout);
    const TruthCounts counts = count_truth(visibility, counted);
    const gl::Texture truth = upload_truth(context, visibility, counted.exclusion);
    const ShadowMap map = draw_shadow_map(context, uploaded, light, layout, grid.map_depth);
    const ShadowMapImages images = read_back(context, map);
    const auto judged = [&](const std::vector<UnresolvedTap>& taps) {
      return test_same_surface(tracer, layout, surfaces_of(scene, layout, gbuffer, taps), Continuity::seen);
    };
    for (const NamedFilter& filter : grid.filters) {
      const bool is_judged = static_cast<std::size_t>(&filter - grid.filters.data()) < grid.judged_filters;
      for (const double normal_offset : grid.normal_offsets) {
        ShadowParams params = filter.params;
        params.bias.normal_offset.texels = normal_offset;
        ShadowLookup lookup{uploaded, surfels, map, light, params.bias, make_technique(params), &truth};
        const BiasHistogram drawn = draw_bias_response(context, lookup, grid.axes);
        const FilterKernel kernel = make_filter(params.pcf);
        const MapLookup on_processor{gbuffer, map.layout, light, images, kernel, params.bias};
        const BiasHistogram computed =
            count_bias_response(scene, on_processor, visibility, counted.exclusion, grid.axes);
        const std::string where =
            filter.name + ", " + std::to_string(resolution) + " texels, normal offset " + std::to_string(normal_offset);
        if (drawn.by_slope != computed.by_slope) {
          agreement.disagreements.push_back(where + ": device and processor differ");
        }
        const std::vector<UnresolvedTap> unresolved =
            is_judged ? listed(context, lookup, grid.axes) : std::vector<UnresolvedTap>{};
        std::vector<UnresolvedTap> found =
            find_unresolved_taps(scene, on_processor, visibility, counted.exclusion, grid.axes);
        std::sort(found.begin(), found.end(), comes_before);
        const auto is_equal = [](const UnresolvedTap& a, const UnresolvedTap& b) {
          return fields_of(a) == fields_of(b);
        };
        if (is_judged && !std::equal(unresolved.begin(), unresolved.end(), found.begin(), found.end(), is_equal)) {
          agreement.disagreements.push_back(where + ": device and processor list different unresolved taps");
        }
        const std::vector<std::uint8_t> own = judged(unresolved);
        BiasHistogram exact = drawn;
        reclassify(exact, unresolved, own);
        agreement.tested_taps += own.size();
        agreement.own_taps += static_cast<std::size_t>(std::count(own.begin(), own.end(), 1));
        for (std::size_t s = 0; s < grid.axes.slope.size(); ++s) {
          const std::vector<VisibilitySums> at = sums_at_biases(drawn, s);
          const std::vector<VisibilitySums> exact_at = sums_at_biases(exact, s);
          for (std::size_t k = 0; k < at.size(); ++k) {
            lookup.bias.constant = Length{static_cast<double>(grid.axes.constant[k]), grid.axes.unit};
            lookup.bias.slope = static_cast<double>(grid.axes.slope[s]);
            RasterVisibility cell = draw_visibility(context, lookup);
            const VisibilitySums sums = sum_wrong_taps(cell.wrong, counted);
            ++agreement.cells;
            if (has_wrong(sums)) ++agreement.wrong_cells;
            if (!(sums == at[k])) {
              agreement.disagreements.push_back(where + ": one pass and the cell differ at bias " +
                                                to_string(params.bias.constant) + ", slope " +
                                                std::to_string(params.bias.slope));
            }
            agreement.identity_gap =
                std::max(agreement.identity_gap,
                         std::abs(mean_error(cell.visibility, visibility, counted) - to_statistics(sums, counts).mae));
            if (!is_judged) continue;
            const std::vector<UnresolvedTap> of_cell =
                listed(context, lookup, {{grid.axes.constant[k]}, {grid.axes.slope[s]}, grid.axes.unit});
            reclassify(cell.wrong, gbuffer, of_cell, judged(of_cell));
            if (!(sum_wrong_taps(cell.wrong, counted) == exact_at[k])) {
              agreement.disagreements.push_back(where + ": by the judge one pass and the cell differ at bias " +
                                                to_string(params.bias.constant) + ", slope " +
                                                std::to_string(params.bias.slope));
            }
          }
        }
      }
    }
  }
  return agreement;
}

}  // namespace umbrameter::test
