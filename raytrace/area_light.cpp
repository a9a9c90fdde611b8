#include "raytrace/area_light.h"

#include <cassert>
#include <cmath>
#include <limits>

#include "raytrace/sampler.h"
#include "scenes/emitter.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

// Above this SphericalRectangle::error() a rectangle is very small or seen nearly edge-on, and is sampled by area.
constexpr double max_error = 0x1p-20;

float fraction(float value) { return value - std::floor(value); }

dvec3 across(const dvec3& n) {
  return glm::normalize(glm::cross(std::abs(n.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0), n));
}

}  // namespace

vec2 shear(vec2 point, vec2 factors) {
  const float u = fraction(point.x + factors.x * point.y);
  return {u, fraction(point.y + factors.y * u)};
}

LightView::LightView(const Light& light, LightSampling sampling, const dvec3& from) : sampling_(sampling) {
  assert(is_area(light));
  const dmat3 axes = axes_of(light);
  x_ = axes[0];
  y_ = axes[1];
  z_ = axes[2];
  to_center_ = light.position() - from;
  is_round_ = true;
  if (const auto* rectangle = std::get_if<RectangleEmitter>(&light.emitter)) {
    is_flat_ = true;
    is_round_ = false;
    x_ *= 0.5 * rectangle->width;
    y_ *= 0.5 * rectangle->height;
    if (sampling == LightSampling::solid_angle) {
      const SphericalRectangle spherical(to_center_, x_, y_);
      if (spherical.error() < max_error) spherical_ = spherical;
    }
  } else if (const auto* disk = std::get_if<DiskEmitter>(&light.emitter)) {
    is_flat_ = true;
    x_ *= disk->radius;
    y_ *= disk->radius;
  } else if (const auto* distant = std::get_if<DistantEmitter>(&light.emitter)) {
    to_center_ = z_;
    tangent_ = std::tan(0.5 * distant->angular_diameter);
    cap_ = 2.0 * std::pow(std::sin(0.25 * distant->angular_diameter), 2);
  } else if (const auto* sphere = std::get_if<SphereEmitter>(&light.emitter)) {
    radius_ = sphere->radius;
    const double distance = glm::length(to_center_);
    is_inside_ = !(distance > radius_);
    if (is_inside_) return;
    z_ = to_center_ / distance;
    x_ = across(z_);
    y_ = glm::cross(z_, x_);
    tangent_ = radius_ / std::sqrt((distance - radius_) * (distance + radius_));
    cap_ = 2.0 * std::pow(std::sin(0.5 * std::atan(tangent_)), 2);
  }
}

LightView::Sample LightView::sample(vec2 point) const {
  const dvec2 p = is_round_ ? dvec2(concentric_disk(point)) : 2.0 * dvec2(point) - 1.0;
  if (!is_flat_) return in_cone(p);
  Sample sample;
  const dvec3 offset = spherical_ ? spherical_->sample(dvec2(point)) : to_center_ + p.x * x_ + p.y * y_;
  const double distance = glm::length(offset);
  if (!(distance > std::numeric_limits<float>::min())) return {z_, 0.0, 1.0};  // the point is at the surfel
  sample.direction = offset / distance;
  sample.reach = distance;
  // A piece's solid angle is its area · cosine / distance², and the cosine is the surfel's height above the light's
  // plane / distance. The height is the same for all points and cancels, which also avoids 0/0 for lights seen edge-on.
  if (sampling_ == LightSampling::solid_angle && !spherical_) sample.weight = 1.0 / (distance * distance * distance);
  return sample;
}

LightView::Sample LightView::in_cone(const dvec2& disk) const {
  Sample sample;
  if (sampling_ == LightSampling::area) {
    sample.direction = glm::normalize(z_ + tangent_ * (disk.x * x_ + disk.y * y_));
  } else {
    // Uniform in the cap's area means uniform in height (Archimedes): 1 − cos θ = r²·cap. sin θ / r avoids 0/0.
    const double height = cap_ * glm::dot(disk, disk);
    sample.direction = (1.0 - height) * z_ + std::sqrt(cap_ * (2.0 - height)) * (disk.x * x_ + disk.y * y_);
  }
  if (radius_ == 0.0) {
    sample.reach = std::numeric_limits<double>::infinity();
    return sample;
  }
  // The nearer intersection with the sphere, t² − 2t(ω·c) + c² − R² = 0 with c = to_center_, without cancellation.
  const double along = glm::dot(sample.direction, to_center_);
  const dvec3 aside = to_center_ - along * sample.direction;
  const double half_chord = std::sqrt(std::max(radius_ * radius_ - glm::dot(aside, aside), 0.0));
  const double distance = glm::length(to_center_);
  sample.reach = (distance - radius_) * (distance + radius_) / (along + half_chord);
  return sample;
}

}  // namespace umbrameter
