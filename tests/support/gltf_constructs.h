// Every construct of glTF that the loader reads, one small file each, with the geometry that it stands for as the
// specification says (glTF 2.0 and the extensions' texts), known from how the file was made.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/load_options.h"
#include "scenes/scene.h"
#include "tests/support/gltf_builder.h"

namespace umbrameter::test {

/// A point on the geometry, and whether the alpha mask lets it exist.
struct MaskProbe {
  dvec3 point;
  bool exists = false;
};

struct CameraPose {
  dvec3 position;
  dvec3 forward;  ///< unit
  dvec3 up;       ///< unit, across forward
  bool is_endless = false;
};

struct Construct {
  std::string name;  ///< words
  Bytes file;
  std::string file_name = "scene.glb";
  std::map<std::string, Bytes> side_files;  ///< by their path beside the file
  std::string part;                         ///< of load_gltf()
  LoadOptions options{};                    ///< the same
  std::vector<Triangle> triangles;          ///< world, counter-clockwise seen from the front
  double tolerance = 1e-6;                  ///< metres, of each coordinate
  bool in_order = true;                     ///< else the triangles are a set
  bool flat_normals = false;                ///< the normals at each triangle's corners are its own
  double normal_tolerance = 1e-3;
  std::vector<MaskProbe> probes;
  std::vector<std::string> notes;    ///< a word of each note that loading leaves; no further ones
  std::vector<std::string> refused;  ///< words of the error, where the file is one to refuse
  std::optional<CameraPose> camera;
  std::optional<dvec4> base_color;  ///< linear, of the first triangle's material, the same all over
  std::optional<dvec3> f0;          ///< reflectance at normal incidence of its dielectric part
};

std::vector<Construct> all_constructs();

/// Writes the file and those beside it into a folder, and loads it from there.
Scene load(const Construct& construct, const std::filesystem::path& folder);

// One function a family, for all_constructs().
std::vector<Construct> topology_constructs();
std::vector<Construct> accessor_constructs();
std::vector<Construct> quantized_constructs();
std::vector<Construct> draco_constructs();
std::vector<Construct> meshopt_constructs();
std::vector<Construct> material_constructs();
std::vector<Construct> mask_constructs();
std::vector<Construct> node_constructs();
std::vector<Construct> instancing_constructs();
std::vector<Construct> deformed_constructs();
std::vector<Construct> file_constructs();
std::vector<Construct> tolerated_constructs();

/// Triangles over a list of corners.
struct Solid {
  std::vector<dvec3> corners;
  std::vector<uvec3> triangles;
};
/// A tetrahedron with three unequal legs and, beside it, an upright rectangle: no rotation, mirroring or exchange of
/// axes maps it to itself. Coordinates are multiples of 1/4 from 0 to 3.5.
Solid solid();
/// The same with corners of its own for each triangle.
Solid split_solid();
/// Of each triangle, at each of its corners.
std::vector<dvec3> flat_normals(const Solid& split);

/// World triangles; of a mirroring transform the other winding is the front (glTF 2.0, section 3.7.4).
std::vector<Triangle> placed(const Solid& solid, const dmat4& world_from_mesh = dmat4(1.0));

std::vector<float> floats(const std::vector<dvec3>& points);
template <class Index>
std::vector<Index> indices_of(const Solid& solid) {
  std::vector<Index> indices;
  for (const uvec3& t : solid.triangles) {
    for (int i = 0; i < 3; ++i) indices.push_back(static_cast<Index>(t[i]));
  }
  return indices;
}

std::string text_of(double value);
std::string list_of(const std::vector<double>& values);
std::string list_of(const dmat4& matrix);  ///< column by column

dmat4 translation(const dvec3& offset);
dmat4 scaling(const dvec3& factors);
dmat4 rotation(const dvec3& axis, double angle);          ///< right-handed, radians
std::string quaternion(const dvec3& axis, double angle);  ///< as JSON

/// A mesh of one primitive. `more` are further members of it, each with a comma before it.
int add_mesh(GltfBuilder& builder, const std::string& attributes, int indices = -1, const std::string& more = "");
/// The solid as a mesh of floats and 16-bit indices.
int add_solid(GltfBuilder& builder, const std::string& more = "");
void use(GltfBuilder& builder, const std::string& extension, bool is_required = false);

/// A construct from what was built: as GLB, with one scene of node 0 where the builder has none.
Construct finished(const std::string& name, GltfBuilder& builder, std::vector<Triangle> triangles);

}  // namespace umbrameter::test
