// Materials, and alpha masks whose holes are known from their texels.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "tests/support/gltf_constructs.h"

namespace umbrameter::test {
namespace {

// A mask of 4×4 texels; no rotation or mirroring maps it to itself.
constexpr int side = 4;
constexpr std::array<std::string_view, side> mask_rows = {"##..", "#...", "..#.", "#..."};
bool is_opaque(int column, int row) {
  return mask_rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] == '#';
}

Bytes mask_png() {
  Bytes rgba;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const unsigned char alpha = is_opaque(column, row) ? 255 : 0;
      rgba.insert(rgba.end(), {255, 128, 64, alpha});
    }
  }
  return png(side, side, rgba);
}

// IEC 61966-2-1, above its linear part.
double linear(int byte) { return std::pow((byte / 255.0 + 0.055) / 1.055, 2.4); }

/// A rectangle of 4 × 2 m, turned and moved, whose texture coordinates run from `low` to `high`, v downwards.
struct Sheet {
  dvec2 low{0.0};
  dvec2 high{1.0};

  dvec3 point(const dvec2& texcoord) const {
    const dvec2 part = (texcoord - low) / (high - low);
    return dvec3(0.5, 2.0, -0.25) + part.x * dvec3(3.2, 0.0, 2.4) + part.y * dvec3(0.0, -2.0, 0.0);
  }
  std::vector<dvec3> corners() const {
    return {point(low), point({low.x, high.y}), point(high), point({high.x, low.y})};
  }
  std::vector<dvec2> texcoords() const { return {low, {low.x, high.y}, high, {high.x, low.y}}; }
  Solid solid() const { return {corners(), {{0, 1, 2}, {0, 2, 3}}}; }
};

std::vector<float> floats_of(const std::vector<dvec2>& values) {
  std::vector<float> all;
  for (const dvec2& value : values) {
    all.push_back(static_cast<float>(value.x));
    all.push_back(static_cast<float>(value.y));
  }
  return all;
}

std::string masked(const std::string& base_color_texture, const std::string& more = "") {
  return R"({"alphaMode":"MASK","doubleSided":true,"pbrMetallicRoughness":{"baseColorTexture":)" + base_color_texture +
         "}" + more + "}";
}

void add_texture(GltfBuilder& builder, const Bytes& image, const std::string& type, const std::string& more = "") {
  add(builder, "images",
      R"({"mimeType":"image/)" + type + R"(","bufferView":)" + std::to_string(add_view(builder, image)) + "}");
  add(builder, "textures", R"({"source":0)" + more + "}");
}

int add_sheet(GltfBuilder& builder, const Sheet& sheet, const std::string& texcoords) {
  const int positions = add_values(builder, "VEC3", floats(sheet.corners()));
  const int indices = add_values<std::uint8_t>(builder, "SCALAR", {0, 1, 2, 0, 2, 3});
  return add_mesh(builder, "\"POSITION\":" + std::to_string(positions) + "," + texcoords, indices, ",\"material\":0");
}

std::string texcoord(int set, int accessor) {
  return "\"TEXCOORD_" + std::to_string(set) + "\":" + std::to_string(accessor);
}

/// Probes of a sheet at the texel centres that its coordinates reach. `texel_from_texcoord` is in units of the image.
std::vector<MaskProbe> probes_of(const Sheet& sheet, const dmat3& texel_from_texcoord,
                                 const std::function<int(int)>& wrap_u, const std::function<int(int)>& wrap_v) {
  std::vector<MaskProbe> probes;
  const dmat3 back = glm::inverse(texel_from_texcoord);
  for (int row = -3 * side; row < 3 * side; ++row) {
    for (int column = -3 * side; column < 3 * side; ++column) {
      const dvec2 at(back * dvec3((column + 0.5) / side, (row + 0.5) / side, 1.0));
      const dvec2 part = (at - sheet.low) / (sheet.high - sheet.low);
      if (part.x < 0.01 || part.y < 0.01 || part.x > 0.99 || part.y > 0.99) continue;
      if (std::abs(part.x - part.y) < 0.01) continue;  // on the edge between the two triangles
      probes.push_back({sheet.point(at), is_opaque(wrap_u(column), wrap_v(row))});
    }
  }
  return probes;
}

// glTF 2.0, section 3.8.4.5, and the OpenGL specification that it names: of texels rather than coordinates.
int repeat(int texel) { return ((texel % side) + side) % side; }
int clamp(int texel) { return std::min(std::max(texel, 0), side - 1); }
int mirror(int texel) {
  const int turn = ((texel % (2 * side)) + 2 * side) % (2 * side);
  return turn < side ? turn : 2 * side - 1 - turn;
}

Construct wrapped(const std::string& name, const std::string& sampler, const std::function<int(int)>& wrap_u,
                  const std::function<int(int)>& wrap_v) {
  GltfBuilder builder;
  const Sheet sheet{{-1.25, -0.5}, {1.75, 1.5}};
  add_texture(builder, mask_png(), "png", sampler.empty() ? "" : ",\"sampler\":0");
  if (!sampler.empty()) add(builder, "samplers", sampler);
  add(builder, "materials", masked(R"({"index":0})"));
  add_sheet(builder, sheet, texcoord(0, add_values(builder, "VEC2", floats_of(sheet.texcoords()))));
  Construct construct = finished(name, builder, placed(sheet.solid()));
  construct.probes = probes_of(sheet, dmat3(1.0), wrap_u, wrap_v);
  return construct;
}

/// Columns of the affine map of KHR_texture_transform, "Overview": scaled, then turned, then moved. Its sense of
/// rotation is that of the extension's own example: offset (0,1), a quarter turn and scale 1/2 use the lower left
/// quadrant of the image, so (u, v) goes to (v/2, 1 - u/2).
dmat3 texture_transform(const dvec2& offset, double angle, const dvec2& scale) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {dvec3(c * scale.x, -s * scale.x, 0), dvec3(s * scale.y, c * scale.y, 0), dvec3(offset, 1)};
}

Construct transformed(const std::string& name, const dvec2& offset, double angle, const dvec2& scale) {
  GltfBuilder builder;
  use(builder, "KHR_texture_transform");
  const Sheet sheet;
  add_texture(builder, mask_png(), "png");
  add(builder, "materials",
      masked(R"({"index":0,"extensions":{"KHR_texture_transform":{"offset":)" + list_of({offset.x, offset.y}) +
             R"(,"rotation":)" + text_of(angle) + R"(,"scale":)" + list_of({scale.x, scale.y}) + "}}}"));
  add_sheet(builder, sheet, texcoord(0, add_values(builder, "VEC2", floats_of(sheet.texcoords()))));
  Construct construct = finished(name, builder, placed(sheet.solid()));
  construct.probes = probes_of(sheet, texture_transform(offset, angle, scale), repeat, repeat);
  return construct;
}

// Set 0 shows one corner texel everywhere, set 1 the whole image.
Construct second_set(const std::string& name, const std::string& reference, const std::string& extension) {
  GltfBuilder builder;
  if (!extension.empty()) use(builder, extension);
  const Sheet sheet;
  add_texture(builder, mask_png(), "png");
  add(builder, "materials", masked(reference));
  const int still = add_values(builder, "VEC2", floats_of(std::vector<dvec2>(4, dvec2(0.125))));
  const int moving = add_values(builder, "VEC2", floats_of(sheet.texcoords()));
  add_sheet(builder, sheet, texcoord(0, still) + "," + texcoord(1, moving));
  Construct construct = finished(name, builder, placed(sheet.solid()));
  construct.probes = probes_of(sheet, dmat3(1.0), repeat, repeat);
  return construct;
}

template <class T>
Construct quantized_texcoords(const std::string& name, bool is_normalized) {
  GltfBuilder builder;
  use(builder, "KHR_mesh_quantization", true);
  use(builder, "KHR_texture_transform");
  const Sheet sheet;
  add_texture(builder, mask_png(), "png");
  // Plain integers from 0 to 100, which the texture transform brings to 0 to 1.
  const double most = is_normalized ? static_cast<double>(std::numeric_limits<T>::max()) : 100.0;
  const std::string moved = is_normalized ? "" : R"(,"extensions":{"KHR_texture_transform":{"scale":[0.01,0.01]}})";
  add(builder, "materials", masked(R"({"index":0)" + moved + "}"));
  std::vector<T> values;
  for (const dvec2& at : sheet.texcoords()) {
    values.push_back(static_cast<T>(at.x * most));
    values.push_back(static_cast<T>(at.y * most));
  }
  add_sheet(builder, sheet,
            texcoord(0, add_values(builder, "VEC2", values, is_normalized ? ",\"normalized\":true" : "")));
  Construct construct = finished(name, builder, placed(sheet.solid()));
  construct.probes = probes_of(sheet, dmat3(1.0), repeat, repeat);
  return construct;
}

// The factor of 0.4 is below the cutoff of 0.5 all over: nothing exists. Below 0.3 all that is opaque does.
Construct faded(const std::string& name, const std::string& cutoff, bool exists) {
  GltfBuilder builder;
  add(builder, "materials",
      R"({"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.4]})" + cutoff + "}");
  add_solid(builder, ",\"material\":0");
  Construct construct = finished(name, builder, placed(solid()));
  construct.probes = {{{3, 1, 0.25}, exists}};
  return construct;
}

Construct specular_glossiness_mask() {
  GltfBuilder builder;
  use(builder, "KHR_materials_pbrSpecularGlossiness");
  const Sheet sheet;
  add_texture(builder, mask_png(), "png");
  add(builder, "materials",
      R"({"alphaMode":"MASK","alphaCutoff":0.4,"doubleSided":true,"extensions":{"KHR_materials_pbrSpecularGlossiness":)"
      R"({"diffuseTexture":{"index":0},"diffuseFactor":[0.5,1,1,0.7],"specularFactor":[0.2,0.1,0.05]}}})");
  add_sheet(builder, sheet, texcoord(0, add_values(builder, "VEC2", floats_of(sheet.texcoords()))));
  Construct construct = finished("a mask in a diffuse texture", builder, placed(sheet.solid()));
  construct.probes = probes_of(sheet, dmat3(1.0), repeat, repeat);
  construct.f0 = dvec3(0.2, 0.1, 0.05);
  return construct;
}

Construct jpeg_texture(const std::string& name, const Bytes& behind_its_end) {
  GltfBuilder builder;
  const Sheet sheet;
  Bytes image = grey_jpeg(2, 1, {200, 200});
  image.insert(image.end(), behind_its_end.begin(), behind_its_end.end());
  add_texture(builder, image, "jpeg");
  add(builder, "materials", masked(R"({"index":0})"));
  add_sheet(builder, sheet, texcoord(0, add_values(builder, "VEC2", floats_of(sheet.texcoords()))));
  Construct construct = finished(name, builder, placed(sheet.solid()));
  construct.base_color = dvec4(dvec3(linear(200)), 1.0);
  construct.probes = {{sheet.point({0.3, 0.6}), true}};
  return construct;
}

Construct png_data_uri() {
  GltfBuilder builder;
  const Sheet sheet;
  add(builder, "images", R"({"uri":")" + data_uri("image/png", mask_png()) + "\"}");
  add(builder, "textures", R"({"source":0})");
  add(builder, "materials", masked(R"({"index":0})"));
  add_sheet(builder, sheet, texcoord(0, add_values(builder, "VEC2", floats_of(sheet.texcoords()))));
  Construct construct = finished("a PNG in a data URI", builder, placed(sheet.solid()));
  construct.probes = probes_of(sheet, dmat3(1.0), repeat, repeat);
  return construct;
}

Construct coloured(const std::string& name, const std::string& extension, const std::string& material,
                   const dvec4& color, const dvec3& f0) {
  GltfBuilder builder;
  use(builder, extension);
  add(builder, "materials", material);
  add_solid(builder, ",\"material\":0");
  Construct construct = finished(name, builder, placed(solid()));
  construct.base_color = color;
  construct.f0 = f0;
  return construct;
}

// No two channels of the image are alike, so that a texture read from the wrong one is seen.
Construct material_textures() {
  GltfBuilder builder;
  const Sheet sheet;
  Bytes rgba;
  for (int i = 0; i < 24; ++i) rgba.push_back(static_cast<unsigned char>(37 + (i * 83) % 211));
  add_texture(builder, png(3, 2, rgba), "png");
  use(builder, "KHR_materials_specular");
  add(builder, "materials",
      R"({"pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,0.75,1],"metallicRoughnessTexture":{"index":0}},)"
      R"("extensions":{"KHR_materials_specular":{"specularTexture":{"index":0},"specularColorTexture":{"index":0}}}})");
  add_sheet(builder, sheet, texcoord(0, add_values(builder, "VEC2", floats_of(sheet.texcoords()))));
  Construct construct = finished("textures of metal, roughness and specular", builder, placed(sheet.solid()));
  construct.options.materials = true;
  construct.base_color = dvec4(0.25, 0.5, 0.75, 1);
  construct.f0 = dvec3(0.04);
  return construct;
}

}  // namespace

std::vector<Construct> material_constructs() {
  // KHR_materials_specular: F0 = min(0.04 · colour, 1) · factor.
  return {coloured("specular", "KHR_materials_specular",
                   R"({"pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,0.75,1]},"extensions":{)"
                   R"("KHR_materials_specular":{"specularFactor":0.5,"specularColorFactor":[1,0.5,2]}}})",
                   {0.25, 0.5, 0.75, 1}, {0.02, 0.01, 0.04}),
          coloured("specular glossiness", "KHR_materials_pbrSpecularGlossiness",
                   R"({"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1]},"extensions":{)"
                   R"("KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[0.5,0.25,0.125,1],)"
                   R"("specularFactor":[0.5,0.25,0.125],"glossinessFactor":0.75}}})",
                   {0.5, 0.25, 0.125, 1}, {0.5, 0.25, 0.125}),
          jpeg_texture("a JPEG texture is opaque", {}),
          // What would be a table of 4080 codes, were it part of the image.
          jpeg_texture("bytes behind the end of a JPEG", huffman_table(0xff)), png_data_uri(), material_textures()};
}

std::vector<Construct> mask_constructs() {
  std::vector<Construct> all;
  all.push_back(wrapped("a mask that repeats by default", "", repeat, repeat));
  all.push_back(wrapped("a mask that repeats and is clamped", R"({"wrapS":10497,"wrapT":33071})", repeat, clamp));
  all.push_back(wrapped("a mask that is mirrored", R"({"wrapS":33648,"wrapT":33648})", mirror, mirror));
  all.push_back(wrapped("a mask that is clamped and mirrored", R"({"wrapS":33071,"wrapT":33648})", clamp, mirror));
  all.push_back(transformed("a moved mask", {0.25, 0.5}, 0.0, {1, 1}));
  all.push_back(transformed("a scaled mask", {0, 0}, 0.0, {2, 0.5}));
  all.push_back(transformed("a turned mask", {0, 1}, 0.5 * pi, {1, 1}));
  all.push_back(transformed("a mask moved, turned and scaled", {0.3, -0.2}, 0.4, {1.5, -0.75}));
  all.push_back(second_set("the second texture coordinates", R"({"index":0,"texCoord":1})", ""));
  all.push_back(second_set("texture coordinates that the transform overrides",
                           R"({"index":0,"texCoord":0,"extensions":{"KHR_texture_transform":{"texCoord":1}}})",
                           "KHR_texture_transform"));
  all.push_back(quantized_texcoords<std::uint8_t>("texture coordinates of normalised bytes", true));
  all.push_back(quantized_texcoords<std::uint16_t>("texture coordinates of normalised shorts", true));
  all.push_back(quantized_texcoords<std::int8_t>("texture coordinates of signed bytes", false));
  all.push_back(quantized_texcoords<std::int16_t>("texture coordinates of normalised signed shorts", true));
  all.push_back(quantized_texcoords<std::uint16_t>("texture coordinates of shorts", false));
  all.push_back(faded("a mask that hides all", "", false));
  all.push_back(faded("a mask with a low cutoff", R"(,"alphaCutoff":0.3)", true));
  all.push_back(specular_glossiness_mask());
  return all;
}

}  // namespace umbrameter::test
