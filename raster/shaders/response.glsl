// The axes of a bias response. raster/shadow/response_passes.cpp fills the buffers.
layout(std140) uniform ResponseBlock {
  float min_bias;
  float max_bias;
  float min_slope;
  float max_slope;
  int bias_count;
  int slope_count;
};
layout(std430) restrict readonly buffer Axes {
  float bias_axis_values[];  // constant biases, ascending; then slope factors
};

// The number of constant biases of the axes at which the tap is blocked.
uint bias_bin(float flip, float bias_unit) {
  int first = 0;
  int count = bias_count;
  while (count > 0) {
    int half_count = count / 2;
    if (is_lit_at(bias_axis_values[first + half_count], bias_unit, flip)) {
      count = half_count;
    } else {
      first += half_count + 1;
      count -= half_count + 1;
    }
  }
  return uint(first);
}
