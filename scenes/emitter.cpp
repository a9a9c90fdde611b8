#include "scenes/emitter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"

namespace umbrameter {
namespace {

constexpr double degrees = pi / 180.0;
constexpr double widest_angle = 179.0;    // degrees; the tangent of half of it is 115
constexpr double largest_emitter = 1e12;  // metres, radius or side

constexpr double not_given = -1.0;
std::optional<double> if_given(double value) { return value == not_given ? std::nullopt : std::optional(value); }

EmitterSizes sizes_of(const LightParams& params) {
  EmitterSizes sizes{if_given(params.radius), if_given(params.width), if_given(params.height), {}, params.shape};
  if (params.angle != not_given) sizes.angular_diameter = params.angle * degrees;
  return sizes;
}

bool is_directional(const Light& light) { return std::holds_alternative<DirectionalLight>(light.shape); }

// Metres, of a sphere or a disk.
std::optional<double> radius_of(const Emitter& emitter) {
  if (const auto* sphere = std::get_if<SphereEmitter>(&emitter)) return sphere->radius;
  if (const auto* disk = std::get_if<DiskEmitter>(&emitter)) return disk->radius;
  return std::nullopt;
}

}  // namespace

Parameters describe(LightParams& params) {
  static constexpr std::array<std::string_view, 3> shapes = {"usual", "sphere", "disk"};
  return Description("light")
      .field("radius", params.radius,
             {.unit = "m",
              .meaning = "radius of point and spot lights; 0: none, -1: the scene's",
              .min = -1.0,
              .max = largest_emitter,
              .basic = true})
      .field("width", params.width,
             {"m", "width of a rectangular light, along its x axis; 0: none, -1: the scene's", -1.0, largest_emitter})
      .field("height", params.height,
             {"m", "height of a rectangular light, along its y axis; 0: none, -1: the scene's", -1.0, largest_emitter})
      .field("angle", params.angle,
             {.unit = "degrees",
              .meaning = "angular diameter of suns; 0: none, -1: the scene's",
              .min = -1.0,
              .max = widest_angle,
              .basic = true})
      .choice("shape", params.shape, shapes,
              {"", "shape of a light with a radius; usual: sphere for point lights, disk for spot lights"})
      .take();
}

std::string objection(const EmitterSizes& sizes) {
  const auto is_bad = [](const std::optional<double>& size, double max) {
    return size && !(*size >= 0.0 && *size <= max);
  };
  const auto out_of_range = [](const char* what, double max, const char* unit) {
    return std::string("its ") + what + " is below 0 or above " + to_string(max) + " " + unit;
  };
  if (is_bad(sizes.radius, largest_emitter)) return out_of_range("radius", largest_emitter, "m");
  if (is_bad(sizes.width, largest_emitter)) return out_of_range("width", largest_emitter, "m");
  if (is_bad(sizes.height, largest_emitter)) return out_of_range("height", largest_emitter, "m");
  if (is_bad(sizes.angular_diameter, widest_angle * degrees * (1.0 + 1e-12))) {
    return out_of_range("angular diameter", widest_angle, "degrees");
  }
  if (sizes.radius && (sizes.width || sizes.height)) return "it has a radius and the sides of a rectangle";
  if (sizes.width.has_value() != sizes.height.has_value()) return "it has one side of a rectangle and not the other";
  if (sizes.width && (*sizes.width > 0.0) != (*sizes.height > 0.0)) return "one side of its rectangle is 0";
  return {};
}

Emitter make_emitter(const Light& light, const EmitterSizes& sizes) {
  if (is_directional(light)) {
    const double angle = sizes.angular_diameter.value_or(0.0);
    return angle > 0.0 ? Emitter(DistantEmitter{angle}) : Emitter();
  }
  if (sizes.width && *sizes.width > 0.0) return RectangleEmitter{*sizes.width, *sizes.height};
  const double radius = sizes.radius.value_or(0.0);
  if (!(radius > 0.0)) return {};
  const bool is_disk = sizes.shape == EmitterShape::usual ? std::holds_alternative<SpotLight>(light.shape)
                                                          : sizes.shape == EmitterShape::disk;
  return is_disk ? Emitter(DiskEmitter{radius}) : Emitter(SphereEmitter{radius});
}

bool is_area(const Light& light) { return !std::holds_alternative<std::monostate>(light.emitter); }

double half_size(const Emitter& emitter) {
  if (const auto* sphere = std::get_if<SphereEmitter>(&emitter)) return sphere->radius;
  if (const auto* disk = std::get_if<DiskEmitter>(&emitter)) return disk->radius;
  if (const auto* sides = std::get_if<RectangleEmitter>(&emitter)) return std::sqrt(sides->width * sides->height / pi);
  const auto* distant = std::get_if<DistantEmitter>(&emitter);
  return distant != nullptr ? std::tan(0.5 * distant->angular_diameter) : 0.0;
}

Light with_extent(Light light, const LightParams& params) {
  EmitterSizes sizes = sizes_of(params);
  // A shape alone is one of the radius that the scene gives.
  if (sizes.shape != EmitterShape::usual && !sizes.has_lengths()) sizes.radius = radius_of(light.emitter);
  if (is_directional(light) ? sizes.angular_diameter.has_value() : sizes.has_lengths()) {
    light.emitter = make_emitter(light, sizes);
  }
  return light;
}

void require_sense(const LightParams& params, std::span<const Light> lights) {
  const EmitterSizes sizes = sizes_of(params);
  const std::string why = objection(sizes);
  if (!why.empty())
    throw Error(ExitCode::usage, "light.*", "invalid light: " + why,
                "give one extent, of 0 (none) or more; -1 is the scene's");
  const bool any_directional = std::ranges::any_of(lights, is_directional);
  const bool all_directional = std::ranges::all_of(lights, is_directional);
  if (sizes.angular_diameter && !any_directional) {
    throw Error(ExitCode::usage, "light.angle", "no measured light is directional",
                "give point and spot lights a light.radius, or a light.width and light.height");
  }
  if (sizes.has_lengths() && all_directional) {
    throw Error(ExitCode::usage, sizes.radius ? "light.radius" : "light.width",
                "all measured lights are directional and cannot have a radius or a width", "set light.angle instead");
  }
  const bool any_radius =
      std::ranges::any_of(lights, [](const Light& light) { return radius_of(light.emitter).has_value(); });
  if (sizes.shape != EmitterShape::usual && !sizes.radius && (sizes.has_lengths() || !any_radius)) {
    throw Error(ExitCode::usage, "light.shape", "it needs a radius", "set light.radius");
  }
}

const char* kind_of(const Emitter& emitter) {
  static constexpr const char* names[] = {"", "sphere", "disk", "rectangle", "distant disk"};
  return names[emitter.index()];
}

}  // namespace umbrameter
