// The AO image and the surfels that its pixels show: techniques/ao/resolution.h. Rows count from the bottom.
#if AO_RESOLUTION == AO_RESOLUTION_HALF

ivec2 ao_image_size(ivec2 view_size) { return (view_size + 1) / 2; }

ivec2 surfel_pixel(ivec2 ao_pixel, ivec2 view_size) {
  int row = ao_image_size(view_size).y - 1 - ao_pixel.y;  // from the top
  return ivec2(2 * ao_pixel.x, view_size.y - 1 - 2 * row);
}

#else

ivec2 ao_image_size(ivec2 view_size) { return view_size; }
ivec2 surfel_pixel(ivec2 ao_pixel, ivec2 view_size) { return ao_pixel; }

#endif
