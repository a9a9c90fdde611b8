// What shadow maps of moments share. Bounds from moments are computed in double precision: a variance is a small
// difference of stored numbers, and a look-up must not add rounding to that of the map's format.

/// Upper bound of the share of texels at or behind a depth, from the mean of their depths and of their squares: the
/// one-tailed inequality of Chebyshev (Donnelly and Lauritzen, Variance Shadow Maps, I3D 2006).
SHARED double chebyshev_bound(dvec2 moments, double depth, double min_variance) {
  double behind = depth - moments.x;
  if (behind <= 0.0) return 1.0;
  double variance = max(moments.y - moments.x * moments.x, min_variance);
  return variance / (variance + behind * behind);
}

/// Cuts off the darkest part of the penumbra, where light bleeds, and stretches the rest (Lauritzen, Summed-Area
/// Variance Shadow Maps, GPU Gems 3, 2007).
SHARED double reduce_bleeding(double visibility, double amount) {
  return min(max((visibility - amount) / (1.0 - amount), 0.0), 1.0);
}
