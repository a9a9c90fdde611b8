// The contact gap and the shadow inset of each caster: the lit strip between the caster's foot and its shadow, and how
// far the shadow's outline lies inside the true outline.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/error_shape.h"
#include "scenes/view.h"

namespace umbrameter {

/// One length on a receiver in three units.
struct ReceiverLength {
  double metres = 0.0;  ///< in the world
  double texels = 0.0;  ///< perpendicular to the light's direction, in map texels at that point
  double pixels = 0.0;  ///< in the image
};

struct CasterShape {
  std::uint32_t object = 0;  ///< index into Scene::objects

  /// Pixels at which the caster's true shadow touches its foot on another object.
  std::uint64_t contacts = 0;
  std::uint64_t lost = 0;  ///< contacts at which the true shadow ends before the raster shadow begins
  ReceiverLength gap_median;
  ReceiverLength gap_largest;

  std::uint64_t edges = 0;      ///< edges of the true shadow (pairs of pixels) with a matching raster edge
  std::uint64_t unmatched = 0;  ///< edges of the true shadow without one
  ReceiverLength inset_median;  ///< above 0: the raster shadow is smaller; one median for each unit
};

/// Input of analyze_casters(); all images have the same size.
struct CasterInput {
  ShapeInput shape;
  const Image<float>& raster;
  const WrongTaps& wrong;
  const Image<std::uint32_t>& caster;  ///< instance of the first surface towards the light; no_id if there is none
  const Image<float>& distance;        ///< distance to that surface, metres
  const Scene& scene;
  const View& view;
};

/// Result of the search for contacts: pixels of a light's true shadow, counted by the first reason that applies.
struct ContactSearch {
  std::uint64_t shadowed = 0;    ///< counted pixels in the true shadow of an object: the sum of the others
  std::uint64_t own_object = 0;  ///< the caster and the receiver are one object
  std::uint64_t head_on = 0;     ///< the light is parallel to the receiver's normal: a gap has no direction
  std::uint64_t distant = 0;     ///< the caster is too far away for a contact
  std::uint64_t hidden = 0;      ///< at a foot, but the receiver is hidden, bends or leaves the image before a gap ends
  std::uint64_t measured = 0;    ///< contacts of all casters
};

struct CasterShapes {
  std::vector<CasterShape> casters;  ///< casters that have a contact or an edge, by object index
  ContactSearch search;
};

/// Measures contact gaps and insets for a light without extent.
///
/// Contact: a counted pixel in the true shadow of another object that is near. Along the ray the object is no farther
/// away than a texel or 1.5 pixels, whichever is longer there; along the receiver it is within 1.5 pixels. The gap is
/// measured from the contact along the receiver, away from the light. It starts at the caster, whose position follows
/// from the ray's length, and ends half-way between the last pixel that is lit in the raster and the first that is
/// blocked. It is 0 if the first pixel is blocked. If the true shadow ends first, the gap ends there. Contacts whose
/// path along the receiver is hidden do not count.
///
/// Inset: the distance from an edge of the true shadow to its matching edge in the raster visibility without acne. For
/// each of the edge's two pixels there is a nearest raster edge; the matching edge is the nearer one of these. The
/// inset is above 0 if the matching edge is inside the true shadow, below 0 if outside, and 0 if it is on another edge
/// of the true shadow. A raster edge in another caster's shadow does not match.
CasterShapes analyze_casters(const CasterInput& input);

}  // namespace umbrameter
