#include "raster/ao/ssao_pass.h"

#include <algorithm>
#include <array>
#include <span>

#include "raster/gbuffer/view_block.h"
#include "raster/gl/pass.h"
#include "raster/shader_interface.h"
#include "techniques/ao/technique.h"

namespace umbrameter {
namespace {

// Samples of the rows that one run lists.
constexpr std::size_t max_samples_at_once = std::size_t{1} << 23;

static_assert(sizeof(OccludingSample) == 2 * sizeof(std::uint32_t));

gl::Pass ssao_pass(const gl::Context& context, const AoInputs& inputs, const Ssao& ssao, const char* shader) {
  std::array<vec4, constant("MAX_SAMPLES")> kernel{};
  std::ranges::copy(kernel_of(ssao, inputs.seed), kernel.begin());
  const std::vector<vec4> rotations = noise_of(ssao, inputs.seed);
  SsaoParams params = ssao.params;
  gl::Pass pass(context, {{shader}, shader_defines(describe(params)) + resolution_defines(inputs.resolution)});
  bind(pass, inputs)
      .block("View", make_view_block(inputs.view))
      .block("Kernel", kernel)
      .buffer("Rotations", gl::make_buffer("ao rotations", std::span<const vec4>(rotations)))
      .value("samples", ssao.sampling.samples)
      .value("noise_size", ssao.noise.size)
      .value("radius", static_cast<float>(ssao.sampling.radius.number));
  return pass;
}

}  // namespace

gl::Texture draw(const gl::Context& context, const AoInputs& inputs, const Ssao& ssao) {
  gl::Texture ao = make_ao_image("ao", inputs);
  const ivec2 size = ao_image_size(inputs);
  ssao_pass(context, inputs, ssao, "ssao.comp")
      .value("bias", static_cast<float>(ssao.bias.depth.number))
      .value("share", share_of_sample(ssao.sampling.samples))
      .image("ao_image", ao, gl::Format::r32f)
      .dispatch(size.x, size.y);
  return ao;
}

void list_occluding_samples(const gl::Context& context, const AoInputs& inputs, Ssao ssao, const AoAxes& axes,
                            const AoResponseSink& sink) {
  const auto width = static_cast<std::size_t>(inputs.gbuffer.width);
  const int height = inputs.gbuffer.height;
  ssao.sampling.samples = axes.samples.back();
  const auto samples = static_cast<std::size_t>(ssao.sampling.samples);
  const int rows_at_once = std::clamp(static_cast<int>(max_samples_at_once / (width * samples)), 1, height);
  const std::size_t pixels_at_once = width * static_cast<std::size_t>(rows_at_once);

  std::vector<std::uint32_t> counts(pixels_at_once);
  std::vector<OccludingSample> occluding(pixels_at_once * samples);
  const gl::Buffer gpu_counts = gl::make_empty_buffer("ao response counts", counts.size() * sizeof(counts[0]));
  const gl::Buffer gpu_occluding = gl::make_empty_buffer("ao response", occluding.size() * sizeof(occluding[0]));
  gl::Pass pass = ssao_pass(context, inputs, ssao, "ssao_response.comp");
  pass.buffer("Biases", gl::make_buffer("ao biases", std::span<const float>(axes.biases)))
      .value("bias_count", static_cast<int>(axes.biases.size()))
      .value("first_bias", axes.biases.front())
      .value("last_bias", axes.biases.back())
      .buffer("Counts", gpu_counts)
      .buffer("Occluding", gpu_occluding);
  for (int first = 0; first < height; first += rows_at_once) {
    const int end = std::min(first + rows_at_once, height);
    pass.value("first_row", first).value("end_row", end).dispatch(inputs.gbuffer.width, end - first);
    gl::read_buffer(gpu_counts, std::as_writable_bytes(std::span(counts)));
    gl::read_buffer(gpu_occluding, std::as_writable_bytes(std::span(occluding)));
    std::vector<AoResponseRow> rows;
    for (int y = first; y < end; ++y) {
      const std::size_t at = width * static_cast<std::size_t>(y - first);
      rows.push_back({y, ssao.sampling.samples, std::span(counts).subspan(at, width),
                      std::span(occluding).subspan(at * samples, width * samples)});
    }
    sink(rows);
  }
}

}  // namespace umbrameter
