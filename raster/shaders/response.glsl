// The axes of a bias response. raster/shadow/response_axes.cpp fills the buffers.
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
