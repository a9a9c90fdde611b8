// The OpenGL side in one header: what raster offers to the rest of the toolkit.
//
//   context = gl::Context::make()          scene = upload(context, Scene)
//   gbuffer = draw_gbuffer(...)            map = draw_shadow_map(...)
//   draw_visibility(...), draw_ao(...)     draw_bias_response(...)    list_unresolved_taps(...)    read_back(...)
#pragma once

#include "raster/ao/ao_pass.h"
#include "raster/gbuffer/gbuffer_pass.h"
#include "raster/gbuffer/uploaded_scene.h"
#include "raster/gl/context.h"
#include "raster/shadow/prefiltered_pass.h"
#include "raster/shadow/response_passes.h"
#include "raster/shadow/shadow_map.h"
#include "raster/shadow/technique_passes.h"
#include "techniques/ao/technique.h"
#include "techniques/shadow/technique.h"
