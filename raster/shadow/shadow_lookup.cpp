#include "raster/shadow/shadow_lookup.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <string>

#include "core/error.h"
#include "core/lists.h"
#include "raster/shader_interface.h"
#include "raster/shadow/light_block.h"
#include "raster/texture_image.h"

namespace umbrameter {
namespace {

// A desktop ends a dispatch that holds the device for some seconds. So many steps are a fraction of a second on a slow
// GPU, even where each classifies a tap: some 600 operations in double precision, of which it does 10^11 a second.
constexpr std::size_t max_steps_at_once = std::size_t{1} << 26;

// Fewer pixels would leave most of a GPU idle.
constexpr std::size_t min_at_once = 4096;

// OpenGL promises no more than 65535 work groups (GL_MAX_COMPUTE_WORK_GROUP_COUNT).
constexpr std::size_t max_at_once = std::size_t{65535} * constant("LIST_GROUP_SIZE");

std::string list_of(const std::vector<vec2>& values) {
  return joined(values, ", ", [](const vec2& v) { return fmt::format("vec2({:.9e}, {:.9e})", v.x, v.y); });
}

// What shaders/shadow_filter.glsl needs of a kernel. The radius is a uniform and not included.
std::string filter_defines(const FilterKernel& filter) {
  std::string text = define("FILTER_IS_GRID", filter.is_grid() ? 1 : 0) +
                     fmt::format("#define FILTER_WEIGHT_SUM {}u\n", filter.weight_sum()) +
                     define("FILTER_TAPS", static_cast<unsigned>(filter.tap_count()));
  if (filter.is_grid()) {
    text += define("FILTER_KERNEL_SIZE", static_cast<unsigned>(filter.kernel.size())) +
            define("FILTER_LINEAR", filter.linear_taps ? 1 : 0) +
            define("FILTER_AREA_SUM", filter.is_area_tent ? FilterKernel::area_sum : 0) +
            define("FILTER_PARTS", FilterKernel::texel_parts) +
            fmt::format("#define FILTER_DIVISOR {}u\n#define FILTER_KERNEL_SUMS {}u\n", filter.divisor,
                        fmt::join(running_sums(filter.kernel), "u, "));
    return text;
  }
  text += define("FILTER_ROTATION", static_cast<unsigned>(filter.rotation)) +
          define("FILTER_SEARCH", filter.search ? static_cast<unsigned>(filter.search->points.size()) : 0);
  text += define("FILTER_HARDENS", filter.hardening ? 1 : 0);
  if (filter.search) text += "#define FILTER_SEARCH_LIST " + list_of(filter.search->points) + "\n";
  return text + define("FILTER_ROTATIONS", static_cast<unsigned>(filter.rotations.size())) +
         "#define FILTER_POINT_LIST " + list_of(filter.points) + "\n#define FILTER_ROTATION_LIST " +
         list_of(filter.rotations) + "\n";
}

}  // namespace

gl::Texture upload(const gl::Context& context, const Image<float>& image) {
  gl::Texture texture = upload_image("scalar image", gl::Format::r32f, image);
  context.check("image upload");
  return texture;
}

gl::Texture upload_truth(const gl::Context& context, const Image<float>& visibility,
                         const Image<PixelExclusion>& exclusion) {
  Image<float> truth = visibility;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (exclusion[i] != PixelExclusion::none) truth[i] = -1.0f;
  }
  return upload(context, truth);
}

const FilterKernel& kernel_of(const ShadowLookup& lookup) {
  const FilterKernel* kernel = kernel_of(lookup.technique);
  assert(kernel != nullptr);
  return *kernel;
}

gl::Pass lookup_pass(const gl::Context& context, const ShadowLookup& lookup, LengthUnit bias_unit,
                     const gl::ProgramSource& source) {
  require_bias_unit(lookup.map.layout, bias_unit);
  LightBlock block = make_light_block(lookup.light, lookup.map.layout);
  block.constant_bias = static_cast<float>(lookup.bias.constant.number);
  block.slope_bias = static_cast<float>(lookup.bias.slope);
  const NormalOffset offset = placed_offset(lookup.map.layout, lookup.bias.normal_offset, lookup.bias.offset_texel);
  block.normal_offset = static_cast<float>(offset.texels);
  block.offset_metres = offset.metres;
  block.offset_profile = static_cast<int>(offset.profile);
  block.offset_is_across = lookup.bias.offset_direction == OffsetDirection::across ? 1 : 0;
  block.offset_is_of_front = lookup.bias.offset_facing == OffsetFacing::front ? 1 : 0;
  block.cone_bias = static_cast<float>(lookup.bias.cone);
  block.bias_unit = static_cast<int>(bias_unit);
  for (std::size_t v = 0; v < lookup.map.layout.views.size(); ++v) {
    block.bias_factors[v / 4][static_cast<int>(v % 4)] =
        static_cast<float>(bias_factor(lookup.map.layout.views[v], bias_unit));
  }
  std::string defines = map_defines(lookup.map.layout) + source.defines +
                        define("RECEIVER_PLANE", lookup.bias.receiver_plane ? 1 : 0) +
                        define("CONE_BIAS", lookup.bias.cone > 0.0 ? 1 : 0) +
                        define("COMPARES_ENCODED", compares_encoded(lookup.map.layout, bias_unit) ? 1 : 0);
  if (const FilterKernel* kernel = kernel_of(lookup.technique)) {
    block.tap_count = kernel->tap_count();
    block.filter_radius = kernel->radius;
    if (kernel->search) {
      block.search_extent = kernel->search->extent;
      block.max_radius = kernel->search->max_radius;
      block.min_radius = kernel->search->min_radius;
      block.search_count = static_cast<int>(kernel->search->points.size());
      block.search_in_cone = kernel->search->is_in_cone ? 1 : 0;
    }
    if (kernel->hardening) {
      block.search_extent = kernel->hardening->extent;
      block.max_radius = kernel->hardening->max_radius;
    }
    defines += filter_defines(*kernel);
  }
  gl::Pass pass(context, {source.files, defines});
  bind_triangles(bind(pass, lookup.gbuffer), lookup.scene)
      .block("LightBlock", block)
      .texture("shadow_depth", lookup.map.depth)
      .texture("shadow_ids", lookup.map.ids);
  if (lookup.truth != nullptr) pass.texture("truth_image", *lookup.truth);
  return pass;
}

gl::Buffer make_pixel_list(const gl::Context& context, const GpuGBuffer& gbuffer) {
  const std::size_t pixels = static_cast<std::size_t>(gbuffer.width) * static_cast<std::size_t>(gbuffer.height);
  const std::size_t bytes = (1 + pixels) * sizeof(std::uint32_t);
  if (bytes > context.max_storage_bytes()) {
    throw Error(ExitCode::usage, "view.size",
                "'" + std::to_string(gbuffer.width) + "x" + std::to_string(gbuffer.height) +
                    "' has more pixels than a list on " + context.device().renderer + " can hold",
                "at most " + std::to_string(context.max_storage_bytes() / sizeof(std::uint32_t) - 1) + " pixels");
  }
  gl::Buffer list = gl::make_empty_buffer("pixel list", bytes);
  const std::uint32_t none[] = {0};
  gl::write_buffer(list, 0, std::as_bytes(std::span(none)));
  return list;
}

std::uint32_t count_listed(const gl::Context& context, const gl::Buffer& pixel_list) {
  std::array<std::uint32_t, 1> count{};
  gl::read_buffer(pixel_list, std::as_writable_bytes(std::span(count)));
  context.check("pixel list");
  return count[0];
}

void dispatch_list(gl::Pass& pass, const ListedPixels& pixels) {
  assert(pixels.end >= pixels.first && pixels.end - pixels.first <= max_at_once);
  pass.value("first_pixel", pixels.first)
      .value("end_pixel", pixels.end)
      .dispatch_groups((pixels.end - pixels.first + constant("LIST_GROUP_SIZE") - 1) / constant("LIST_GROUP_SIZE"));
}

void dispatch_whole_list(const gl::Context& context, gl::Pass& pass, const gl::Buffer& pixel_list, std::size_t steps) {
  const std::uint32_t pixels = count_listed(context, pixel_list);
  const auto at_once = static_cast<std::uint32_t>(
      std::clamp<std::size_t>(max_steps_at_once / std::max<std::size_t>(steps, 1), min_at_once, max_at_once));
  for (std::uint32_t first = 0; first < pixels; first += std::min(at_once, pixels - first)) {
    dispatch_list(pass, {first, first + std::min(at_once, pixels - first)});
    if (at_once < pixels) context.flush();
  }
}

}  // namespace umbrameter
