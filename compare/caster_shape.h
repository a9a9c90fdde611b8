// How far each caster's shadow is displaced: the lit strip between a caster's foot and its shadow, and how far the
// shadow's outline lies inside the true one.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/error_shape.h"
#include "scenes/view.h"

namespace umbrameter {

/// One length on a receiver in three units.
struct ReceiverLength {
  double metres = 0.0;  ///< in the world
  double texels = 0.0;  ///< of the map there, across the light's way
  double pixels = 0.0;  ///< in the image
};

struct CasterShape {
  std::uint32_t object = 0;  ///< index into Scene::objects

  /// Pixels at which its true shadow touches its foot on another object.
  std::uint64_t contacts = 0;
  std::uint64_t lost = 0;  ///< those from which the true shadow ends before the raster one begins
  ReceiverLength gap_median;
  ReceiverLength gap_largest;

  std::uint64_t edges = 0;      ///< of its true shadow, pairs of pixels, that have a raster edge to go with
  std::uint64_t unmatched = 0;  ///< those that have none
  ReceiverLength inset_median;  ///< above 0: the raster shadow is smaller; by metres, texels and pixels each
};

/// All that it is measured on; images of one size.
struct CasterInput {
  ShapeInput shape;
  const Image<float>& raster;
  const WrongTaps& wrong;
  const Image<std::uint32_t>& caster;  ///< instance of the first surface on the way to the light; no_id without one
  const Image<float>& distance;        ///< metres to it
  const Scene& scene;
  const View& view;
};

/// What became of the search for contacts: how many pixels of a light's true shadow, by the first reason that applies.
struct ContactSearch {
  std::uint64_t shadowed = 0;    ///< counted pixels in the true shadow of an object: the sum of the others
  std::uint64_t own_object = 0;  ///< the caster and the receiver are one object
  std::uint64_t head_on = 0;     ///< the light falls along the receiver's normal: a strip has no direction
  std::uint64_t distant = 0;     ///< the caster is farther away than a contact may be
  std::uint64_t hidden = 0;      ///< at a foot, but the receiver is hidden, bends or leaves the image before a gap ends
  std::uint64_t measured = 0;    ///< contacts of all casters
};

struct CasterShapes {
  std::vector<CasterShape> casters;  ///< those that have a contact or an edge, by their index
  ContactSearch search;
};

/// Of a light without extent.
///
/// Contact: a counted pixel in the true shadow of another object, which is no farther away along the ray than a texel
/// or one and a half pixels, whichever is longer there, and within one and a half pixels along the receiver. From there
/// along the receiver, away from the light, the gap ends half-way between the last pixel that the raster calls lit and
/// the first that it calls blocked; it starts where the caster stands by the ray's length, and is 0 where the first
/// pixel is blocked. Where the true shadow ends first, the gap is as long as that. Contacts from which the way is
/// hidden do not count.
///
/// Inset: from each edge of the true shadow to the nearer of those edges of the raster visibility, without its acne,
/// that are nearest to its two pixels; above 0 within the true shadow, below 0 outside, 0 on another edge of it. An
/// edge that lies in another caster's shadow is none to go with.
CasterShapes analyze_casters(const CasterInput& input);

}  // namespace umbrameter
