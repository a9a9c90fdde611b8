#include "compare/unresolved_taps.h"

#include <cassert>

#include "core/error.h"
#include "core/lists.h"
#include "techniques/shadow/reference/facet.h"
#include "techniques/shadow/reference/ordered.h"

namespace umbrameter {
namespace {

constexpr auto acne = static_cast<std::size_t>(Cause::acne);
constexpr auto false_occlusion = static_cast<std::size_t>(Cause::false_occlusion);

ivec2 unpacked(std::uint32_t pair) { return {static_cast<int>(pair & 0xffffu), static_cast<int>(pair >> 16u)}; }

double share(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

// One GPU pass counts wrong taps and another lists them. A listed tap that the counts do not contain shows that the GPU
// and the CPU round differently.
template <class Weight>
void turn_to_acne(Weight& occluded, Weight& shadowed, std::uint32_t weight) {
  if (occluded < weight) {
    throw Error(ExitCode::no_backend, "exact classes",
                "the OpenGL device rounds differently from the CPU: a tested tap is not among the counted ones",
                "use --classes fast or choose another device with --gl-device");
  }
  occluded -= weight;
  shadowed += weight;
}

}  // namespace

double share_of_unresolved(const ClassAgreement& agreement) {
  return share(agreement.reclassified, agreement.unresolved);
}
double share_of_wrong(const ClassAgreement& agreement) { return share(agreement.reclassified, agreement.wrong); }
double share_on_own_layer(const ClassAgreement& agreement) {
  return share(agreement.on_own_layer, agreement.peter_panning);
}

std::size_t pixel_of(const UnresolvedTap& tap, const GBuffer& gbuffer) {
  const ivec2 at = unpacked(tap.pixel);
  return gbuffer.instance.index(at.x, gbuffer.height - 1 - at.y);
}

TapSurfaces surfaces_of(const Scene& scene, const MapLayout& layout, const GBuffer& gbuffer, const UnresolvedTap& tap) {
  const std::size_t pixel = pixel_of(tap, gbuffer);
  TapSurfaces surfaces;
  surfaces.receiver = {{}, gbuffer.instance[pixel], gbuffer.triangle[pixel]};
  surfaces.sample = {{}, tap.instance, tap.triangle};
  const Facet receiver = facet_of(scene, layout, surfaces.receiver.instance, surfaces.receiver.triangle);
  const Facet sample = facet_of(scene, layout, tap.instance, tap.triangle);
  surfaces.receiver.in_light =
      foot_on(receiver, transform_point(layout.light_from_world, dvec3(gbuffer.position[pixel])));
  surfaces.sample.in_light = sample_on(sample, texel_ray(layout, unpacked(tap.texel), static_cast<int>(tap.view)));
  return surfaces;
}

std::vector<TapSurfaces> surfaces_of(const Scene& scene, const MapLayout& layout, const GBuffer& gbuffer,
                                     std::span<const UnresolvedTap> taps) {
  return mapped(taps, [&](const UnresolvedTap& tap) { return surfaces_of(scene, layout, gbuffer, tap); });
}

void reclassify(WrongTaps& wrong, const GBuffer& gbuffer, std::span<const UnresolvedTap> taps,
                std::span<const std::uint8_t> is_same_surface) {
  assert(taps.size() == is_same_surface.size());
  for (std::size_t i = 0; i < taps.size(); ++i) {
    if (is_same_surface[i] == 0) continue;
    uvec4& weights = wrong.weights[pixel_of(taps[i], gbuffer)];
    turn_to_acne(weights[static_cast<int>(false_occlusion)], weights[static_cast<int>(acne)], taps[i].weight);
  }
}

void reclassify(BiasHistogram& histogram, std::span<const UnresolvedTap> taps,
                std::span<const std::uint8_t> is_same_surface) {
  assert(taps.size() == is_same_surface.size());
  for (std::size_t s = 0; s < histogram.axes.slope.size(); ++s) {
    for (std::size_t i = 0; i < taps.size(); ++i) {
      if (is_same_surface[i] == 0) continue;
      const std::size_t bin = bias_bin(
          histogram.axes, flip_bias(taps[i].critical_bias, taps[i].slope, histogram.axes.slope[s]), taps[i].bias_unit);
      if (bin == 0) continue;  // lit at every bias, so never wrong
      std::array<std::uint64_t, cause_count>& weights = histogram.by_slope[s][bin].weights;
      turn_to_acne(weights[false_occlusion], weights[acne], taps[i].weight);
    }
  }
}

void add_reclassified(ClassAgreement& agreement, std::span<const UnresolvedTap> taps,
                      std::span<const std::uint8_t> is_same_surface) {
  assert(taps.size() == is_same_surface.size());
  for (std::size_t i = 0; i < taps.size(); ++i) {
    ++agreement.taps;
    agreement.unresolved += taps[i].weight;
    if (is_same_surface[i] != 0) agreement.reclassified += taps[i].weight;
  }
}

void add_blocked(ClassAgreement& agreement, std::span<const UnresolvedTap> taps,
                 std::span<const std::uint8_t> is_own_layer) {
  assert(taps.size() == is_own_layer.size());
  for (std::size_t i = 0; i < taps.size(); ++i) {
    agreement.peter_panning += taps[i].weight;
    if (is_own_layer[i] != 0) agreement.on_own_layer += taps[i].weight;
  }
}

}  // namespace umbrameter
