// umbrameter_ao_invariants: what each method of ambient occlusion depends on and should not, as the page
// docs/ambient-occlusion/invariants.md.
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "ao_invariants.h"
#include "core/error.h"
#include "raytrace/tracer.h"
#include "scenes/builtin.h"

namespace umbrameter {
namespace {

struct Row {
  std::string name;
  std::vector<std::pair<std::string, std::string>> settings;
};

const std::vector<Row>& rows() {
  static const std::vector<Row> all = {
      {"SSAO", {}},
      {"SSAO, bias 0", {{"ao.bias", "0"}}},
      {"full-sphere SSAO", {{"ao.technique", "crytek"}}},
      {"HBAO", {{"ao.technique", "hbao"}}},
      {"HBAO, tangent bias 0", {{"ao.technique", "hbao"}, {"ao.hbao-tangent-bias", "0"}}},
      {"SAO", {{"ao.technique", "alchemy"}}},
      {"SAO, mip chain", {{"ao.technique", "alchemy"}, {"ao.alchemy-mip-chain", "true"}}},
      {"GTAO, slices even in the image", {{"ao.technique", "gtao"}}},
      {"GTAO, slices even in angle", {{"ao.technique", "gtao"}, {"ao.slice-spacing", "angle"}}},
      {"GTAO, power 1", {{"ao.technique", "gtao"}, {"ao.gtao-power", "1"}}},
      {"bitmask, rounded up", {{"ao.technique", "bitmask"}}},
      {"bitmask, rounded to nearest", {{"ao.technique", "bitmask"}, {"ao.bitmask-rounding", "nearest"}}},
      {"bitmask, cosine, nearest",
       {{"ao.technique", "bitmask"}, {"ao.bitmask-weight", "cosine"}, {"ao.bitmask-rounding", "nearest"}}},
      {"ray-marched SSAO", {{"ao.technique", "ray-marched"}}},
  };
  return all;
}

AoParams params_of(const Row& row) {
  AoParams params;
  params.sampling.radius = 0.5;
  params.bias.depth = 0.025;
  params.blur.kind = AoBlur::box;  // its mean is that of the noise tile
  const Parameters all = describe(params);
  for (const auto& [key, value] : row.settings) require(all, key).set_text(value);
  return params;
}

void print_planes(const gl::Context& context) {
  fmt::print(
      "## Open plane\n\n"
      "1 − AO of an endless plane, in thousandths: mean / worst pixel, after a 4×4 box blur. The angle is "
      "that\n"
      "between the camera's axis and the plane's normal. Axis: the 32² pixels in the centre of the image; edge: those "
      "about the\nray 24° to the side, in a field of view of 50°. The camera is 3 m from the plane, R = 0.5 m, bias 25 "
      "mm. R\nspans 86 pixels on the axis. 0 is right; full-sphere SSAO gives 500 by design.\n\n"
      "| method | 10° axis | edge | 30° axis | edge | 60° axis | edge | 85° axis | edge |\n| --- |");
  for (int i = 0; i < 8; ++i) fmt::print(" --- |");
  for (const Row& row : rows()) {
    fmt::print("\n| {} |", row.name);
    for (const double angle : {10.0, 30.0, 60.0, 85.0}) {
      for (const bool at_edge : {false, true}) {
        const Darkening d = open_plane_darkening(context, params_of(row), {angle, at_edge});
        fmt::print(" {:.0f} / {:.0f} |", 1000.0 * d.mean + 0.0, 1000.0 * d.worst);
      }
    }
    std::fflush(stdout);
  }
  fmt::print("\n");
}

void print_plane_sizes(const gl::Context& context) {
  constexpr std::array heights{40, 80, 160, 320};
  constexpr int seeds = 8;
  fmt::print(
      "\n### Against the radius in pixels\n\n"
      "The same means on the axis, for images of {} to {} pixels in height and {} tiles of noise. r is the radius "
      "across "
      "the\nscreen in pixels, and the only thing by which the size of an image matters: a tap is rounded to a pixel, "
      "whose "
      "centre lies up\nto half a pixel beside the direction searched, so that near taps see the plane too high.\n\n"
      "- HBAO: steps are even, and the tangent bias lets only taps within a fixed number of pixels count, a share of "
      "1/r. "
      "Twice the\n  radius in pixels halves the darkening. Without tangent bias all taps count by 1/distance: (ln "
      "r)/r.\n"
      "- GTAO and the bitmask: distances are squares, and the share of near taps falls as 1/√r.\n\n| method |",
      heights.front(), heights.back(), seeds);
  for (const double angle : {30.0, 60.0, 85.0}) {
    for (const int height : heights)
      fmt::print(" {:.0f}°, r = {:.0f} |", angle, radius_in_pixels(params_of({}), height));
  }
  fmt::print("\n| --- |");
  for (std::size_t i = 0; i < 3 * heights.size(); ++i) fmt::print(" --- |");
  for (const Row& row : rows()) {
    fmt::print("\n| {} |", row.name);
    for (const double angle : {30.0, 60.0, 85.0}) {
      for (const int height : heights) {
        fmt::print(" {:.1f} |",
                   1000.0 * open_plane_darkening(context, params_of(row), {angle, false, height, seeds}).mean + 0.0);
      }
    }
    std::fflush(stdout);
  }
  fmt::print("\n");
}

void print_variations(const gl::Context& context) {
  constexpr int seeds = 8;
  const Scene scene = load_scene("courtyard");
  const UploadedScene uploaded = upload(context, scene);
  const View view{320, 180, scene.cameras.front()};
  fmt::print(
      "\n## Rotation, resolution, inputs and noise\n\n"
      "`courtyard`, first camera, 320×180 pixels, R = 0.5 m, in thousandths: root mean squares over all surfels, "
      "without blur\nexcept in one column. All but the noise are differences of means over {} seeds: where the noise "
      "of both differs, it adds\nabout half of the noise without blur.\n\n"
      "- Rotation: the image of a camera rotated by 90° about its axis, rotated back, less the image.\n"
      "- Half view: the image of a view of half the resolution less the mean of 2×2 pixels.\n"
      "- `half`: `--ao.resolution half`, upsampled, less the image ([resolution](resolution.md)).\n"
      "- `rgb8`, `depth`: the image with these `ao.normals` less that with exact ones ([inputs](inputs.md)).\n"
      "- Noise: the standard deviation of a pixel over the seeds, after the 4×4 box blur, and without blur.\n"
      "- Period: the part of this noise that repeats with the tile of 4×4 pixels, likewise: each pixel's deviation "
      "from the "
      "mean of\n  the seeds, less the mean deviation of the 4×4 pixels about it, as far as it agrees with that of the "
      "pixel "
      "one tile further.\n\n"
      "| method | rotation | half view | `half` | `rgb8` | `depth` | noise | noise without blur | period | period "
      "without blur |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
      seeds);
  for (const Row& row : rows()) {
    AoParams params = params_of(row);
    const AoVariation blurred = measure_variation(context, uploaded, view, params, seeds);
    const double period = measure_period(context, uploaded, view, params, seeds);
    params.blur.kind = AoBlur::none;
    const AoVariation raw = measure_variation(context, uploaded, view, params, seeds);
    const std::vector<double> changes =
        measure_changes(context, uploaded, view, params, seeds,
                        {{"ao.resolution", "half"}, {"ao.normals", "rgb8"}, {"ao.normals", "depth"}});
    fmt::print("| {} | {:.0f} | {:.0f} | {:.0f} | {:.1f} | {:.0f} | {:.0f} | {:.0f} | {:.1f} | {:.0f} |\n", row.name,
               1000.0 * raw.rotation, 1000.0 * raw.half, 1000.0 * changes[0], 1000.0 * changes[1], 1000.0 * changes[2],
               1000.0 * blurred.noise, 1000.0 * raw.noise, 1000.0 * period,
               1000.0 * measure_period(context, uploaded, view, params, seeds));
    std::fflush(stdout);
  }
}

void print_bent_normals(const gl::Context& context) {
  constexpr int seeds = 8;
  constexpr int spp = 256;
  const Scene scene = load_scene("courtyard");
  const View view{320, 180, scene.cameras.front()};
  const GpuGBuffer gbuffer = draw_gbuffer(context, upload(context, scene), view);
  TruthParams truth;
  truth.spp = spp;
  truth.ao_distance = 0.5;
  truth.ao_layers = AoLayers::bent_normal;
  const TracedAo traced = trace_ao(Tracer(scene), read_back(context, gbuffer), truth, 1);
  fmt::print(
      "\n## Bent normals\n\n"
      "Mean angle in degrees to the bent normal of the reference, the cosine-weighted mean of the open directions "
      "within R\n"
      "({} rays per pixel), in the same view, without blur, mean of {} seeds. Normal: the same of the geometric "
      "normal, "
      "the\nangle that a method has to improve on. Other methods yield no bent normal.\n\n"
      "| method | bent normal | normal |\n| --- | --- | --- |\n",
      spp, seeds);
  for (const Row& row : rows()) {
    const auto error = measure_bent_normals(context, gbuffer, view, params_of(row), seeds, traced.bent_normal);
    if (error) fmt::print("| {} | {:.1f} | {:.1f} |\n", row.name, error->method, error->normal);
  }
}

int run() {
  const gl::Context context = gl::Context::make();
  fmt::print(
      "# What the methods should not depend on\n\n"
      "Made by `umbrameter_ao_invariants` with llvmpipe. All parameters but those in a row's name and the blur "
      "are the\ndefaults.\n\n");
  print_planes(context);
  print_plane_sizes(context);
  print_variations(context);
  print_bent_normals(context);
  fmt::print(
      "\n"
      "## Choices behind the numbers\n"
      "\n"
      "- SSAO compares depths at a pixel's centre with a point beside it: the bias has to cover the slope within a "
      "pixel.\n"
      "- HBAO takes the tangent's elevation from the normal and the direction to the viewer, not from the image plane: "
      "the edge\n"
      "  of the image differs little from its centre.\n"
      "- GTAO's slices are even in the image by default, as in XeGTAO: 0.007 too dark at 10° on the edge;\n"
      "  `ao.slice-spacing angle` leaves 0.001.\n"
      "- The bitmask rounds up to whole sectors by default, as in the authors' code: 0.05 to 0.06 too dark at every "
      "angle.\n"
      "  `ao.bitmask-rounding nearest` removes most of this. The rest falls with the radius in pixels, to what the "
      "weight "
      "by angle\n  leaves at 85°.\n"
      "- Normals rebuilt from depth are wrong where faces are about as narrow as a pixel ([inputs](inputs.md)). "
      "Full-sphere SSAO\n  reads no normals.\n"
      "- A period of 0 means a covariance of 0 or less between pixels one tile apart: after a box blur of the tile's "
      "size "
      "nothing\n  repeats. Other blurs leave some ([blur](blur.md)).\n"
      "- SAO and ray marching measure heights above the tangent plane: exactly open at every angle.\n"
      "  With the mip chain, far samples of SAO take the depth of another pixel and leave the plane\n"
      "  ([mip chain](alchemy.md#mip-chain)).\n");
  return 0;
}

}  // namespace
}  // namespace umbrameter

int main() {
  try {
    return umbrameter::run();
  } catch (const umbrameter::Error& error) {
    fmt::print(stderr, "umbrameter_ao_invariants: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
