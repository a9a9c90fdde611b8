// The same input gives the same bits: twice in one process, and at any number of the software rasteriser's threads.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>

#include "core/error.h"
#include "test_scenes.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

// FNV-1a, 64 bits.
template <class T>
std::uint64_t digest(std::uint64_t hash, const std::vector<T>& values) {
  std::vector<unsigned char> bytes(values.size() * sizeof(T));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211ull;
  return hash;
}

std::uint64_t render_everything(const gl::Context& context) {
  Scene scene;
  add_mesh(scene, quad({-6, 0, 6}, {6, 0, 6}, {6, 0, -6}, {-6, 0, -6}));
  add_mesh(scene, box({-1, 0.1f, -1}, {0, 1.5f, 0}));
  add_mesh(scene, box({1, 0, 0}, {1.1f, 2, 2}));
  const UploadedScene uploaded = upload(context, scene);
  const View view = perspective_view(200, 120, {4, 5, 6}, {0, 0.5, 0});
  const GpuGBuffer surfels = draw_gbuffer(context, uploaded, view);
  const GBuffer gbuffer = read_back(context, surfels);
  std::uint64_t hash = 14695981039346656037ull;
  hash = digest(hash, gbuffer.position.pixels);
  hash = digest(hash, gbuffer.geometric_normal.pixels);
  hash = digest(hash, gbuffer.shading_normal.pixels);
  hash = digest(hash, gbuffer.depth.pixels);
  hash = digest(hash, gbuffer.triangle.pixels);
  const gl::Texture truth = upload(context, Image<float>(200, 120, 1.0f));
  for (const Light& light :
       {directional_light({1.5, 2, 1}), spot_light({2, 5, 2}, {0, 0, 0}, 0.7), point_light({2, 3, 2.5})}) {
    const ShadowMap map = draw_shadow_map(context, uploaded, light, fit_light(light, bounds_of(scene), 256));
    const ShadowMapImages images = read_back(context, map);
    for (const Image<float>& face : images.depth) hash = digest(hash, face.pixels);
    for (const Image<std::uint32_t>& face : images.triangle) hash = digest(hash, face.pixels);
    ShadowParams params;
    params.pcf.filter = ShadowFilter::box;
    params.bias.constant = 0.003;
    const RasterVisibility found =
        draw_visibility(context, {uploaded, surfels, map, light, params.bias, make_technique(params), &truth});
    hash = digest(hash, found.visibility.pixels);
    hash = digest(hash, found.wrong.weights.pixels);
  }
  AoParams ao;
  ao.sampling.radius = 0.5;
  ao.bias.depth = 0.025;
  return digest(hash, draw_ao(context, surfels, view, ao, 3).pixels);
}

// The number of threads is fixed when the driver starts, so that each number needs a process of its own, whose first
// call makes the context.
constexpr const char* threads_variable = "UMBRAMETER_TEST_THREADS";

TEST(DeterminismGl, Two_runs_give_the_same_bits) {
  const char* threads = std::getenv(threads_variable);
  std::optional<gl::Context> made;
  try {
    made = gl::Context::make({.device = {}, .threads = threads != nullptr ? std::atoi(threads) : 0});
  } catch (const Error&) {
    GTEST_SKIP() << "no driver";
  }
  const gl::Context& context = *made;
  const std::uint64_t first = render_everything(context);
  EXPECT_EQ(render_everything(context), first);
  std::printf("digest %016llx\n", static_cast<unsigned long long>(first));
}

// What the test above prints, run again with that many threads.
std::string digest_with_threads(int threads) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command = std::string("env -u GTEST_TOTAL_SHARDS -u GTEST_SHARD_INDEX ") + threads_variable + "=" +
                              std::to_string(threads) + " '" + program +
                              "' --gtest_filter=DeterminismGl.Two_runs_give_the_same_bits 2>/dev/null";
  const auto close = [](FILE* file) { pclose(file); };
  const std::unique_ptr<FILE, decltype(close)> pipe(popen(command.c_str(), "r"), close);
  std::string output;
  std::array<char, 256> buffer{};
  while (pipe && std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe.get()) != nullptr) {
    output += buffer.data();
  }
  const auto at = output.find("digest ");
  return at == std::string::npos ? output : output.substr(at, output.find('\n', at) - at);
}

TEST(DeterminismGl, One_and_two_threads_give_the_same_bits) {
  const std::string one = digest_with_threads(1);
  if (one.find("no driver") != std::string::npos) GTEST_SKIP() << "no driver";
  EXPECT_EQ(one.substr(0, 7), "digest ") << one;
  EXPECT_EQ(one, digest_with_threads(2));
}

}  // namespace
}  // namespace umbrameter
