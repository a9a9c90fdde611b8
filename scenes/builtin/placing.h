// How the built-in scenes put things into a Scene: materials, instances, cameras, lights, chance.
// Internal to scenes/builtin*.
#pragma once

#include <string>

#include "core/random.h"
#include "scenes/builtin/shapes.h"

namespace umbrameter::builtin {

constexpr double degrees(double angle) { return angle * pi / 180.0; }

/// A value in [low, high) that depends on the two numbers only.
double chance(std::uint32_t seed, std::uint32_t index, double low = 0.0, double high = 1.0);

dmat4 moved(const dvec3& offset);
/// Turned by degrees about an axis through the origin.
dmat4 turned(double angle, const dvec3& axis = dvec3(0, 1, 0));
dmat4 scaled(const dvec3& factors);

/// Rigid; −Z points from eye to target. `up` fixes the roll.
dmat4 looking(const dvec3& eye, const dvec3& target, const dvec3& up = dvec3(0, 1, 0));

std::uint32_t add_material(Scene& scene, const std::string& name, const vec3& linear_color);
/// Seen from both sides.
std::uint32_t add_sheet_material(Scene& scene, const std::string& name, const vec3& linear_color);

std::uint32_t add_mesh(Scene& scene, Mesh mesh);
/// One more object that shows the mesh.
void place(Scene& scene, std::uint32_t mesh, const std::string& name, const dmat4& world_from_mesh = dmat4(1.0));
/// A mesh that stands in one place only, under its own name.
void place_once(Scene& scene, Mesh mesh, const dmat4& world_from_mesh = dmat4(1.0));

void add_camera(Scene& scene, const std::string& name, const dmat4& world_from_camera, double vertical_fov_degrees);
/// `to_light` need not be unit. Stands `distance` metres from `center`; `up` fixes the roll of its map.
void add_sun(Scene& scene, const std::string& name, const dvec3& center, const dvec3& to_light, double distance,
             double lux, const dvec3& up = dvec3(0, 1, 0));
/// A point light of warm white.
void add_lamp(Scene& scene, const std::string& name, const dvec3& at, double candela);
/// A spot light of warm white; the half angles of its cone are in degrees.
void add_spot(Scene& scene, const std::string& name, const dmat4& world_from_light, double inner, double outer,
              double candela);

}  // namespace umbrameter::builtin
