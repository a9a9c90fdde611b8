// The door to OpenGL: the only place that names the loader. For the .cpp files of raster, never for public headers.
#pragma once

#include <epoxy/gl.h>
