// The OpenGL side in one header: what raster offers to the rest of the toolkit.
//
//   context = gl::Context::make()          scene = upload(context, Scene)
//   gbuffer = draw_gbuffer(...)            map = draw_shadow_map(...)
//   draw_visibility(...), draw_ao(...)     draw_bias_response(...)    list_foreign_taps(...)    read_back(...)
#pragma once

#include "raster/bias_response_pass.h"
#include "raster/foreign_taps_pass.h"
#include "raster/gbuffer_pass.h"
#include "raster/gl/context.h"
#include "raster/parameters.h"
#include "raster/shadow_map.h"
#include "raster/ssao_pass.h"
#include "raster/uploaded_scene.h"
#include "raster/visibility_pass.h"
