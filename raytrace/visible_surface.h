// What one depth buffer knows of a scene, as an exact surface, and rays through it: the reference of all that a
// screen-space method can know. For references and tests; no technique uses it.
//
// The surface: each pixel is a facet, the part that the pixel's square sees of the plane of the triangle at its centre.
// Planes are exact, also between pixels. Where the planes of two neighbouring pixels meet between their centres, the
// facets end at that crease. Where a facet meets neither neighbour along an axis, the depth buffer does not show how
// far it tilts: its tilt is limited to what reaches the depth of one of them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/gbuffer.h"
#include "core/math.h"
#include "scenes/view.h"

namespace umbrameter {

/// A ray met the surface, or is behind it in one of the pixels that it crosses.
struct SurfaceEvent {
  double distance = 0.0;  ///< metres along the ray
  dvec3 seen{0.0};        ///< the surface's point there, in view space: what the depth buffer holds
  /// The ray passes through the surface itself, from either side. Otherwise it is behind a facet whose depth edge it
  /// has passed, where the image shows an object's outline but not how thick the object is.
  bool is_connected = true;
};

class VisibleSurface {
 public:
  VisibleSurface(const GBuffer& gbuffer, const View& view);

  /// Calls visit() at both ends of each part of a pixel in which the ray from the pixel's surfel is behind the surface
  /// within the reach, from near to far, until it returns false. `direction` is in view space, unit, and points away
  /// from the surfel's facet.
  void march(std::size_t pixel, const dvec3& direction, double reach,
             const std::function<bool(const SurfaceEvent&)>& visit) const;

  /// How far along a ray from the pixel's surfel an occluder can be that the camera has in its view: at most `reach`,
  /// and up to where the ray leaves the image or passes the near plane. Metres.
  double reach_in_view(std::size_t pixel, const dvec3& direction, double reach) const;

  /// Whether the facets of two pixels that share a side join: they lie in one plane, or meet in a crease between the
  /// centres.
  bool is_joined(std::size_t pixel, std::size_t neighbour) const;

  /// The pixel's surfel in view space, and unit vectors to the viewer and along the normal.
  const dvec3& position(std::size_t pixel) const { return positions_[pixel]; }
  dvec3 to_viewer(std::size_t pixel) const;

  /// Metres; infinite for an orthographic camera.
  double distance_to_viewer(std::size_t pixel) const;

  const dmat3& view_from_world() const { return view_from_world_; }

 private:
  // Nearness to the camera, which is linear over the image of a plane: 1/depth for a perspective camera, −depth for an
  // orthographic one. `x` and `y`: change per pixel to the right and down. The masks have one bit per side.
  struct Facet {
    double center = 0.0;
    double x = 0.0;
    double y = 0.0;
    bool is_surface = false;
    std::uint8_t joined = 0;
    std::uint8_t convex = 0;   // in a crease that points to the camera
    std::uint8_t concave = 0;  // in a crease that points away from it
  };
  struct Place {
    dvec2 pixel{0.0};
    double w = 1.0;
    double nearness = 0.0;
  };
  struct Ray;
  enum class Meeting { none, plane, convex, concave };

  Place place_of(const dvec3& position) const;
  double depth_of(double nearness) const { return is_orthographic_ ? -nearness : 1.0 / nearness; }
  dvec2 center_of(std::size_t pixel) const;
  double nearness_at(std::size_t pixel, const dvec2& at) const;
  double surface_at(std::size_t pixel, const dvec2& at, bool has_own_plane) const;
  Meeting meeting_of(std::size_t pixel, std::size_t neighbour) const;
  std::size_t neighbour_of(std::size_t pixel, unsigned side) const;
  bool has_neighbour(std::size_t pixel, unsigned side) const;
  void tilt(const GBuffer& gbuffer, std::size_t pixel);
  void join(std::size_t pixel);
  void limit(std::size_t pixel);

  int width_;
  int height_;
  bool is_orthographic_;
  double near_plane_;
  dmat4 clip_from_view_;
  dmat3 view_from_world_;
  std::vector<dvec3> positions_;
  std::vector<Facet> facets_;
};

}  // namespace umbrameter
