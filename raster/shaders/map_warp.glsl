// techniques/shadow/map_warp.h, in double precision. Includes follow light.glsl.
#if MAP_WARPED
dvec2 on_warped(dvec2 p) {
  precise double w = p.y - warp_center.y;
  precise dvec2 place = dvec2(warp_scale.x * (p.x - warp_center.x) / w + warp_shift.x, warp_scale.y / w + warp_shift.y);
  return place;
}

// w at a height on the map, in texels.
double warp_w(double height) {
  precise double place = height / double(resolution) * 2.0lf - 1.0lf;
  precise double w = warp_scale.y / (place - warp_shift.y);
  return w;
}

dvec2 from_warped(dvec2 place) {
  precise double w = warp_scale.y / (place.y - warp_shift.y);
  precise dvec2 p = dvec2((place.x - warp_shift.x) * w / warp_scale.x + warp_center.x, w + warp_center.y);
  return p;
}

double warped_texel(dvec2 p) {
  precise double w = p.y - warp_center.y;
  precise double along = (p.x - warp_center.x) / w;
  precise double across = w / warp_scale.x;
  precise double lengthwise = w * w * sqrt(along * along + 1.0lf) / -warp_scale.y;
  precise double side = 2.0lf * max(across, lengthwise) / double(resolution);
  return side;
}
#endif
