// What images take in memory: how much is claimed and held, which are decoded, and the limit that the user sets.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "scenes/gltf.h"
#include "tests/support/gltf_constructs.h"

namespace umbrameter::test {
namespace {

constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20;

/// The most memory that the process has held, bytes.
std::uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) << 10u;
}

Bytes grey_square(int side) {
  const int blocks = side / 8;
  return grey_jpeg(blocks, blocks, Bytes(static_cast<std::size_t>(blocks) * static_cast<std::size_t>(blocks), 128));
}

/// The solid once for each image, each with a material of its own, and the other members of these materials.
Bytes with_images(const std::vector<Bytes>& images, const std::string& material = "") {
  GltfBuilder builder;
  std::vector<std::string> nodes;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::string number = std::to_string(i);
    add(builder, "images", R"({"bufferView":)" + std::to_string(add_view(builder, images[i])) + "}");
    add(builder, "textures", R"({"source":)" + number + "}");
    add(builder, "materials",
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":)" + number + "}}" + material + "}");
    add_solid(builder, ",\"material\":" + number);
    add(builder, "nodes", R"({"mesh":)" + number + "}");
  }
  return to_binary_gltf(builder);
}

Scene read(const Bytes& bytes, const LoadOptions& options = {}) { return read_gltf(bytes, "test.glb", "", options); }

std::string refusal_of(const Bytes& bytes, const LoadOptions& options = {}) {
  try {
    read(bytes, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unreadable_input);
    return error.what();
  }
  return "";
}

TEST(GltfImageMemory, Six_images_of_4096_are_read_by_default) {
  const Scene scene = read(with_images(std::vector<Bytes>(6, grey_square(4096))));
  ASSERT_EQ(scene.textures.size(), 6u);
  for (const Texture& texture : scene.textures) EXPECT_EQ(texture.texels.width, 4096);
}

TEST(GltfImageMemory, An_image_of_8192_is_read_by_default_and_takes_eight_bytes_a_texel_at_its_peak) {
  const Bytes file = with_images({grey_square(8192)});
  const std::uint64_t before = peak_memory();
  const Scene scene = read(file);
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].texels.at(8191, 8191), glm::u8vec4(128, 128, 128, 255));
  EXPECT_LT(peak_memory() - std::min(before, peak_memory()), (4 + 4) * 64 * mebibyte + 64 * mebibyte);
}

TEST(GltfImageMemory, The_limit_of_the_user_is_the_limit_and_the_refusal_names_the_flag) {
  const Bytes file = with_images(std::vector<Bytes>(2, grey_square(1024)));
  // 4 MiB are kept of each, 4 MiB more are held while one is decoded, and the text takes some kilobytes.
  EXPECT_EQ(read(file, {.memory = 13 * mebibyte}).textures.size(), 2u);
  const std::string refusal = refusal_of(file, {.memory = 11 * mebibyte});
  EXPECT_NE(refusal.find("1024x1024"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("limit of 11 MiB that --memory sets"), std::string::npos) << refusal;
}

TEST(GltfImageMemory, Only_images_of_base_colours_that_are_shown_are_decoded) {
  GltfBuilder builder;
  const Bytes damaged = {0x89, 'P', 'N', 'G', 13, 10, 26, 10, 0};
  const Bytes whole = png(2, 2, Bytes(16, 200));
  for (const Bytes& image : {damaged, whole}) {
    const int number = add(builder, "images", R"({"bufferView":)" + std::to_string(add_view(builder, image)) + "}");
    add(builder, "textures", R"({"source":)" + std::to_string(number) + "}");
  }
  add(builder, "materials",
      R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":1},"metallicRoughnessTexture":{"index":0}},)"
      R"("normalTexture":{"index":0,"scale":2},"occlusionTexture":{"index":0},"emissiveTexture":{"index":0}})");
  add(builder, "materials", R"({"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
  add_solid(builder, ",\"material\":0");
  add(builder, "nodes", R"({"mesh":0})");
  const Scene scene = read(to_binary_gltf(builder));
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].texels.width, 2);
  EXPECT_EQ(scene.materials[0].base_color_texture, 0u);
  EXPECT_FALSE(scene.materials[1].base_color_texture.has_value());
  EXPECT_TRUE(scene.notes.empty());
}

// One material whose base colour is texture 0, and the other members of its pbrMetallicRoughness.
Bytes with_material_images(const std::vector<Bytes>& images, const std::string& surface, const std::string& more = "") {
  GltfBuilder builder;
  for (const Bytes& image : images) {
    const int number = add(builder, "images", R"({"bufferView":)" + std::to_string(add_view(builder, image)) + "}");
    add(builder, "textures", R"({"source":)" + std::to_string(number) + "}");
  }
  add(builder, "materials", R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},)" + surface + "}" + more + "}");
  add_solid(builder, ",\"material\":0");
  add(builder, "nodes", R"({"mesh":0})");
  return to_binary_gltf(builder);
}

TEST(GltfImageMemory, Textures_of_metal_and_specular_are_decoded_only_on_demand) {
  const Bytes file = with_material_images(
      {png(2, 2, Bytes(16, 200)), png(3, 3, Bytes(36, 100)), png(4, 4, Bytes(64, 50))},
      R"("metallicFactor":0.5,"roughnessFactor":0.25,"metallicRoughnessTexture":{"index":1})",
      R"(,"extensions":{"KHR_materials_specular":{"specularTexture":{"index":2},"specularColorTexture":{"index":1}}})");
  const Scene plain = read(file);
  EXPECT_EQ(plain.textures.size(), 1u);
  EXPECT_EQ(plain.materials[0].metallic, 0.5f);
  EXPECT_EQ(plain.materials[0].roughness, 0.25f);
  EXPECT_FALSE(plain.materials[0].metallic_roughness_texture.has_value());
  const Scene scene = read(file, {.materials = true});
  ASSERT_EQ(scene.textures.size(), 3u);
  EXPECT_EQ(scene.materials[0].base_color_texture, 0u);
  EXPECT_EQ(scene.materials[0].metallic_roughness_texture, 1u);
  EXPECT_EQ(scene.materials[0].specular_texture, 2u);
  EXPECT_EQ(scene.materials[0].specular_color_texture, 1u);
  EXPECT_EQ(scene.textures[1].texels.width, 3);
  EXPECT_TRUE(scene.notes.empty());
}

TEST(GltfImageMemory, A_texture_of_metal_that_cannot_be_used_is_left_out_with_a_note) {
  const Bytes other = {'G', 'I', 'F', '8', '9', 'a'};
  const Bytes whole = png(2, 2, Bytes(16, 200));
  const std::string first_set = R"("metallicRoughnessTexture":{"index":1})";
  const std::string second_set = R"("metallicRoughnessTexture":{"index":1,"texCoord":1})";
  for (const auto& [file, reason] : {std::pair(with_material_images({whole, other}, first_set), "neither PNG nor JPEG"),
                                     {with_material_images({whole, whole}, second_set), "not those of the material"}}) {
    EXPECT_TRUE(read(file).notes.empty());
    const Scene scene = read(file, {.materials = true});
    EXPECT_EQ(scene.materials[0].base_color_texture, 0u);
    EXPECT_FALSE(scene.materials[0].metallic_roughness_texture.has_value());
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_NE(scene.notes[0].find("texture 1 left out"), std::string::npos) << scene.notes[0];
    EXPECT_NE(scene.notes[0].find(reason), std::string::npos) << scene.notes[0];
  }
}

TEST(GltfImageMemory, A_blended_material_needs_its_image_only_where_blending_makes_holes) {
  const Bytes other = {'G', 'I', 'F', '8', '9', 'a'};
  const Bytes file = with_images({other}, R"(,"alphaMode":"BLEND")");
  const Scene scene = read(file);
  EXPECT_TRUE(scene.textures.empty());
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_NE(scene.notes[0].find("neither PNG nor JPEG"), std::string::npos) << scene.notes[0];
  EXPECT_NE(refusal_of(file, {.memory = std::nullopt, .blend_makes_holes = true}).find("the alpha of material 0"),
            std::string::npos);
}

}  // namespace
}  // namespace umbrameter::test
