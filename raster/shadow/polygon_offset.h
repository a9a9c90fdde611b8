// The unit of the hardware's polygon offset, measured.
#pragma once

#include "raster/gl/context.h"
#include "techniques/shadow/map_depth.h"

namespace umbrameter {

/// The shift of the stored depth by a polygon offset of one unit at a stored depth of ½, found by drawing a triangle
/// with and without an offset. OpenGL leaves it to the driver. In a float format the unit of a triangle is that of its
/// largest depth: twice as large from ½ on, half as large below ¼, and so on.
double measure_offset_unit(const gl::Context& context, MapDepthFormat format);

}  // namespace umbrameter
