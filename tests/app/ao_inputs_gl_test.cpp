// Ambient occlusion computed outside the program, from the files of --write-ao-inputs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/math.h"
#include "tests/app/gl_run.h"

namespace umbrameter {
namespace {

using Json = nlohmann::json;

struct AoInputsRun : GlRun {};

dvec3 vector_of(const Json& numbers) {
  return {numbers[0].get<double>(), numbers[1].get<double>(), numbers.size() > 2 ? numbers[2].get<double>() : 0.0};
}

dmat4 matrix_of(const Json& rows) {
  dmat4 matrix(0.0);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      matrix[column][row] = rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)].get<double>();
    }
  }
  return matrix;
}

// Hemisphere SSAO as docs/ambient-occlusion/files.md describes it, in double precision.
Image<double> ssao(const LayeredImage& image, const Json& values) {
  const Image<float>& depth = channel(image, "depth.Y");
  const Image<dvec3> positions = vectors(image, "position");
  const Image<dvec3> normals = vectors(image, "normal");
  const dmat4 clip_from_view = matrix_of(values["clip_from_view"]);
  const auto radius = values["parameters"]["ao.radius"].get<double>();
  const auto bias = values["parameters"]["ao.bias"].get<double>();
  const int tile = values["noise_size"].get<int>();
  Image<double> ao(depth.width, depth.height, 1.0);
  for (std::size_t i = 0; i < ao.size(); ++i) {
    if (std::isinf(depth[i])) continue;
    const int x = static_cast<int>(i) % depth.width;
    const int y = static_cast<int>(i) / depth.width;
    const int in_tile = y % tile * tile + x % tile;
    const dvec3 rotation = vector_of(values["noise"][static_cast<std::size_t>(in_tile)]);
    const dvec3 normal = normals[i];
    const dvec3 tangent = glm::normalize(rotation - normal * glm::dot(rotation, normal));
    const dvec3 bitangent = glm::cross(normal, tangent);
    double occlusion = 0.0;
    for (const Json& numbers : values["kernel"]) {
      const dvec3 k = vector_of(numbers);
      const dvec3 point = positions[i] + radius * (k.x * tangent + k.y * bitangent + k.z * normal);
      const dvec4 clip = clip_from_view * dvec4(point, 1.0);
      if (clip.w <= 0.0) continue;
      const double right = (0.5 * clip.x / clip.w + 0.5) * depth.width;
      const double down = (0.5 - 0.5 * clip.y / clip.w) * depth.height;
      const int column = std::clamp(static_cast<int>(std::floor(right)), 0, depth.width - 1);
      const int row = std::clamp(static_cast<int>(std::ceil(down)) - 1, 0, depth.height - 1);
      const double seen = -static_cast<double>(depth.at(column, row));
      if (seen < point.z + bias) continue;
      const double share = std::min(radius / std::max(std::abs(positions[i].z - seen), 1e-20), 1.0);
      occlusion += share * share * (3.0 - 2.0 * share);
    }
    ao[i] = 1.0 - occlusion / static_cast<double>(values["kernel"].size());
  }
  return ao;
}

TEST_F(AoInputsRun, Hemisphere_SSAO_can_be_recomputed_from_its_files_alone) {
  const ProgramResult result =
      run_program({"raster", "corner", "-o", folder_ / "out", "--size", "96x54", "--light", "sun", "--ao.blur", "none",
                   "--ao.normals", "depth", "--write-ao-inputs", "--no-figures", "--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(Json::parse(result.out)["files"].dump().find("ao_inputs.json"), std::string::npos);
  std::ifstream file(folder_ / "out/ao_inputs.json");
  const Json values = Json::parse(file);
  const Image<double> expected = ssao(read_exr(folder_ / "out/ao_inputs.exr"), values);
  const LayeredImage images = read_exr(folder_ / "out/images.exr");
  const Image<float>& drawn = channel(images, "raster_ao.Y");
  ASSERT_EQ(drawn.size(), expected.size());

  const double one_sample = 1.0 / values["parameters"]["ao.samples"].get<double>();
  double occlusion = 0.0;
  std::size_t rounded = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double difference = std::abs(static_cast<double>(drawn[i]) - expected[i]);
    occlusion += 1.0 - expected[i];
    // A pixel adds 64 numbers in single precision. Where a sample's point lies on a pixel's border or at the bias, one
    // of the two rounds to the other side, and the pixel differs by one sample.
    EXPECT_LE(difference, one_sample + 1e-5) << i;
    rounded += difference > 1e-5 ? 1 : 0;
  }
  EXPECT_GT(occlusion, 100.0) << "nothing is occluded";
  EXPECT_LE(rounded, expected.size() / 200);
}

TEST_F(AoInputsRun, Are_written_on_request_only_and_not_by_a_sweep) {
  const ProgramResult plain = run_program(
      {"raster", "corner", "-o", folder_ / "plain", "--size", "32x18", "--light", "sun", "--no-figures", "--quiet"});
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "plain/ao_inputs.json"));
  const ProgramResult sweep =
      run_program({"sweep", "corner", "-o", folder_ / "sweep", "--vary", "ao.bias=0,0.1", "--write-ao-inputs"});
  EXPECT_EQ(sweep.exit_code, 2);
  EXPECT_NE(sweep.err.find("--write-ao-inputs"), std::string::npos) << sweep.err;
}

}  // namespace
}  // namespace umbrameter
