// The depth pyramid of Scalable Ambient Obscurance (M. McGuire, M. Mara and D. Luebke, HPG 2012). Level 0 is the depth
// buffer. A texel of any other level is one of four texels of the level before, never a mean of depths, which would lie
// on no surface. Which of the four alternates from texel to texel (rotated grid), so that no direction is favoured.
// Texels count from the lower left corner.

ivec2 level_size(ivec2 first, int level) {
  return ivec2(max(first.x >> level, 1), max(first.y >> level, 1));
}

/// The texel of the level before, of size `finer`, whose depth a texel holds.
ivec2 source_texel(ivec2 texel, ivec2 finer) {
  return ivec2(min(2 * texel.x + ((texel.y & 1) ^ 1), finer.x - 1),
               min(2 * texel.y + ((texel.x & 1) ^ 1), finer.y - 1));
}
