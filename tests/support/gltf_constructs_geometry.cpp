// Primitive modes, indices, accessors and quantised attributes.
#include <cmath>
#include <limits>

#include "tests/support/gltf_constructs.h"

namespace umbrameter::test {
namespace {

std::string position_of(int accessor) { return "\"POSITION\":" + std::to_string(accessor); }

// Five points of a bent ribbon, and five on an arc about the first.
const std::vector<dvec3>& ribbon() {
  static const std::vector<dvec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1.25, 1, 0.25}, {0, 2, 0.5}};
  return points;
}
const std::vector<dvec3>& arc() {
  static const std::vector<dvec3> points = {{0, 0, 0.5}, {2, 0, 0}, {1.5, 1, 0}, {0, 1.25, 0}, {-1, 0.5, 0.25}};
  return points;
}

std::vector<Triangle> facets(const std::vector<dvec3>& points, const std::vector<uvec3>& triangles) {
  return placed({points, triangles});
}

// glTF 2.0, section 3.7.2.1: {v_i, v_(i+1+i%2), v_(i+2-i%2)} and {v_(i+1), v_(i+2), v_0}.
const std::vector<uvec3> strip_triangles = {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}};
const std::vector<uvec3> fan_triangles = {{1, 2, 0}, {2, 3, 0}, {3, 4, 0}};

Construct one_mode(const std::string& name, const std::vector<dvec3>& points, int mode, bool has_indices,
                   std::vector<Triangle> triangles) {
  GltfBuilder builder;
  const int positions = add_values(builder, "VEC3", floats(points));
  int indices = -1;
  if (has_indices) {
    std::vector<std::uint8_t> all;
    for (std::size_t i = 0; i < points.size(); ++i) all.push_back(static_cast<std::uint8_t>(i));
    indices = add_values(builder, "SCALAR", all);
  }
  add_mesh(builder, position_of(positions), indices, ",\"mode\":" + std::to_string(mode));
  return finished(name, builder, std::move(triangles));
}

template <class Index>
Construct indexed(const std::string& name) {
  GltfBuilder builder;
  const int positions = add_values(builder, "VEC3", floats(solid().corners));
  add_mesh(builder, position_of(positions), add_values(builder, "SCALAR", indices_of<Index>(solid())));
  return finished(name, builder, placed(solid()));
}

// A file of both: what cannot be seen is counted, the rest is read.
Construct with_unseen_mode(const std::string& name, int mode) {
  GltfBuilder builder;
  add_solid(builder);
  const int points = add_values(builder, "VEC3", floats(ribbon()));
  add_mesh(builder, position_of(points), -1, ",\"mode\":" + std::to_string(mode));
  add(builder, "nodes", R"({"mesh":0,"children":[1]})");
  add(builder, "nodes", R"({"mesh":1})");
  Construct construct = finished(name, builder, placed(solid()));
  construct.notes = {"1 primitives of points or lines"};
  return construct;
}

std::string sparse(int indices_view, std::string_view indices_type, int values_view, std::size_t count) {
  return R"(,"sparse":{"count":)" + std::to_string(count) + R"(,"indices":{"bufferView":)" +
         std::to_string(indices_view) + R"(,"componentType":)" + std::to_string(component_type(indices_type)) +
         R"(},"values":{"bufferView":)" + std::to_string(values_view) + "}}";
}

/// The solid with its corners 1 and 6 moved.
Solid moved_solid() {
  Solid moved = solid();
  moved.corners[1] = {2.25, 0.25, 0};
  moved.corners[6] = {3.5, 2, 0.5};
  return moved;
}

Construct sparse_positions() {
  GltfBuilder builder;
  const int base = add_view(builder, raw_bytes(floats(solid().corners)));
  const int where = add_view(builder, raw_bytes<std::uint8_t>({1, 6}));
  const int values = add_view(builder, raw_bytes(floats({moved_solid().corners[1], moved_solid().corners[6]})));
  const int positions = add_accessor(builder, base, "f32", "VEC3", 8, sparse(where, "u8", values, 2));
  add_mesh(builder, position_of(positions), add_values(builder, "SCALAR", indices_of<std::uint16_t>(solid())));
  return finished("sparse positions over a buffer view", builder, placed(moved_solid()));
}

// Without a view the base is zero: corner 0 of the solid is the origin, all others are given.
Construct sparse_positions_alone() {
  GltfBuilder builder;
  const int where = add_view(builder, raw_bytes<std::uint16_t>({1, 2, 3, 4, 5, 6, 7}));
  const std::vector<dvec3> all = solid().corners;
  const int values = add_view(builder, raw_bytes(floats({all.begin() + 1, all.end()})));
  const int positions = add_accessor(builder, -1, "f32", "VEC3", 8, sparse(where, "u16", values, 7));
  add_mesh(builder, position_of(positions), add_values(builder, "SCALAR", indices_of<std::uint16_t>(solid())));
  return finished("sparse positions over zeros", builder, placed(solid()));
}

Construct sparse_indices(bool has_base) {
  GltfBuilder builder;
  const int positions = add_values(builder, "VEC3", floats(solid().corners));
  std::vector<std::uint16_t> all = indices_of<std::uint16_t>(solid());
  // The fourth triangle, 1 2 3, is wrong in the base, and right in what replaces it.
  const int where = add_view(builder, raw_bytes<std::uint32_t>({9, 10, 11}));
  const int values = add_view(builder, raw_bytes<std::uint16_t>({1, 2, 3}));
  int indices = -1;
  if (has_base) {
    for (const std::size_t i : {9u, 10u, 11u}) all[i] = 7;
    indices = add_accessor(builder, add_view(builder, raw_bytes(all)), "u16", "SCALAR", all.size(),
                           sparse(where, "u32", values, 3));
  } else {
    indices = add_accessor(builder, -1, "u16", "SCALAR", 12, sparse(where, "u32", values, 3));
  }
  add_mesh(builder, position_of(positions), indices);
  if (has_base) return finished("sparse indices over a buffer view", builder, placed(solid()));
  // All other corners are corner 0: triangles without area, which are counted.
  Construct construct = finished("sparse indices over zeros", builder, facets(solid().corners, {{1, 2, 3}}));
  construct.notes = {"3 triangles without area"};
  return construct;
}

Construct zero_normals() {
  GltfBuilder builder;
  const Solid split = split_solid();
  const int positions = add_values(builder, "VEC3", floats(split.corners));
  const int normals = add_accessor(builder, -1, "f32", "VEC3", split.corners.size());
  add_mesh(builder, position_of(positions) + ",\"NORMAL\":" + std::to_string(normals));
  Construct construct = finished("an accessor without a buffer view", builder, placed(split));
  construct.flat_normals = true;
  construct.notes = {"18 vertex normals"};
  return construct;
}

// Position, then normal, then four bytes of nothing: 28 bytes a vertex, both accessors over one view.
Construct interleaved() {
  GltfBuilder builder;
  const Solid split = split_solid();
  const std::vector<dvec3> normals = flat_normals(split);
  std::vector<float> values;
  for (std::size_t i = 0; i < split.corners.size(); ++i) {
    for (const float value : floats({split.corners[i], normals[i]})) values.push_back(value);
    values.push_back(std::numeric_limits<float>::quiet_NaN());
  }
  const int view = add_view(builder, raw_bytes(values), ",\"byteStride\":28");
  const int first = add_accessor(builder, view, "f32", "VEC3", split.corners.size());
  const int second = add_accessor(builder, view, "f32", "VEC3", split.corners.size(), ",\"byteOffset\":12");
  add_mesh(builder, position_of(first) + ",\"NORMAL\":" + std::to_string(second));
  Construct construct = finished("interleaved attributes", builder, placed(split));
  construct.flat_normals = true;
  return construct;
}

Construct offset_accessor() {
  GltfBuilder builder;
  std::vector<float> values(9, 77.0f);
  for (const float value : floats(solid().corners)) values.push_back(value);
  std::vector<std::uint16_t> corners = {0xffff, 0xffff};
  for (const std::uint16_t index : indices_of<std::uint16_t>(solid())) corners.push_back(index);
  const int view = add_view(builder, raw_bytes(values));
  const int positions = add_accessor(builder, view, "f32", "VEC3", 8, ",\"byteOffset\":36");
  const int indices =
      add_accessor(builder, add_view(builder, raw_bytes(corners)), "u16", "SCALAR", 18, ",\"byteOffset\":4");
  add_mesh(builder, position_of(positions), indices);
  return finished("offsets into buffer views", builder, placed(solid()));
}

/// Positions as integers c; a node undoes it. The factor of glTF 2.0, section 3.6.2.2, is 1/max for normalised ones.
template <class T>
Construct quantized(const std::string& name, bool is_normalized, bool has_normals) {
  GltfBuilder builder;
  use(builder, "KHR_mesh_quantization", true);
  const Solid split = split_solid();
  constexpr double shift = std::is_signed_v<T> ? -7.0 : 0.0;
  constexpr double unit = sizeof(T) == 1 ? 1.0 : 1000.0;
  std::vector<T> values;
  for (const dvec3& corner : split.corners) {
    for (int i = 0; i < 3; ++i) values.push_back(static_cast<T>(std::lround(unit * (4.0 * corner[i] + shift))));
  }
  const std::string normalized = is_normalized ? ",\"normalized\":true" : "";
  std::string attributes = position_of(add_values(builder, "VEC3", values, normalized));
  if (has_normals) {
    using S = std::make_signed_t<T>;
    std::vector<S> normals;
    for (const dvec3& normal : flat_normals(split)) {
      for (int i = 0; i < 3; ++i)
        normals.push_back(static_cast<S>(std::lround(normal[i] * std::numeric_limits<S>::max())));
    }
    attributes += ",\"NORMAL\":" + std::to_string(add_values(builder, "VEC3", normals, ",\"normalized\":true"));
  }
  add_mesh(builder, attributes);
  // value = (4 corner + shift) unit [/ max], so corner = value [max] / (4 unit) - shift / 4.
  const double scale = (is_normalized ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0) / (4.0 * unit);
  const double back = -shift / 4.0;
  add(builder, "nodes",
      R"({"mesh":0,"translation":)" + list_of({back, back, back}) + R"(,"scale":)" + list_of({scale, scale, scale}) +
          "}");
  Construct construct = finished(name, builder, placed(split));
  construct.flat_normals = has_normals;
  construct.normal_tolerance = sizeof(T) == 1 ? 0.02 : 1e-3;
  return construct;
}

// Integer matrices of nothing else: -128 is -1 as -127 is (section 3.6.2.2).
Construct most_negative() {
  GltfBuilder builder;
  use(builder, "KHR_mesh_quantization", true);
  const int positions = add_values<std::int8_t>(builder, "VEC3", {-128, 0, 0, 127, 0, 0, 0, 127, 0, -127, 0, 127},
                                                ",\"normalized\":true");
  add_mesh(builder, position_of(positions), add_values<std::uint8_t>(builder, "SCALAR", {0, 1, 2, 0, 2, 3}));
  return finished("the most negative normalised integer", builder,
                  facets({{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 1}}, {{0, 1, 2}, {0, 2, 3}}));
}

}  // namespace

std::vector<Construct> topology_constructs() {
  std::vector<Construct> all;
  all.push_back(with_unseen_mode("points", 0));
  all.push_back(with_unseen_mode("lines", 1));
  all.push_back(with_unseen_mode("line loop", 2));
  all.push_back(with_unseen_mode("line strip", 3));
  all.push_back(one_mode("triangles without indices", split_solid().corners, 4, false, placed(solid())));
  all.push_back(one_mode("triangle strip without indices", ribbon(), 5, false, facets(ribbon(), strip_triangles)));
  all.push_back(one_mode("triangle strip", ribbon(), 5, true, facets(ribbon(), strip_triangles)));
  all.push_back(one_mode("triangle fan without indices", arc(), 6, false, facets(arc(), fan_triangles)));
  all.push_back(one_mode("triangle fan", arc(), 6, true, facets(arc(), fan_triangles)));
  all.push_back(indexed<std::uint8_t>("8-bit indices"));
  all.push_back(indexed<std::uint16_t>("16-bit indices"));
  all.push_back(indexed<std::uint32_t>("32-bit indices"));
  return all;
}

std::vector<Construct> accessor_constructs() {
  return {sparse_positions(), sparse_positions_alone(), sparse_indices(true), sparse_indices(false), zero_normals(),
          interleaved(),      offset_accessor()};
}

std::vector<Construct> quantized_constructs() {
  return {quantized<std::int8_t>("positions of signed bytes", false, false),
          quantized<std::int8_t>("positions of normalised signed bytes", true, true),
          quantized<std::uint8_t>("positions of bytes", false, true),
          quantized<std::uint8_t>("positions of normalised bytes", true, false),
          quantized<std::int16_t>("positions of signed shorts", false, true),
          quantized<std::int16_t>("positions of normalised signed shorts", true, true),
          quantized<std::uint16_t>("positions of shorts", false, false),
          quantized<std::uint16_t>("positions of normalised shorts", true, true),
          most_negative()};
}

}  // namespace umbrameter::test
