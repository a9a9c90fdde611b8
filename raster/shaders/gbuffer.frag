// Which triangle a pixel centre sees, and its material. The rest follows from the ids, exactly: gbuffer_resolve.comp.
#include "material.glsl"
layout(location = 0) flat in uint instance;
layout(location = 1) in vec2 surface_texcoord;
layout(location = 0) out uvec2 ids;
layout(location = 1) out vec4 albedo;  // base colour, metallic
layout(location = 2) out vec4 specular;  // reflectance at normal incidence, perceptual roughness
#if ALPHA_MASK
uniform float alpha_cutoff;
#endif

void main() {
  vec4 color = base_color_at(surface_texcoord, true);
#if ALPHA_MASK
  if (!(color.a >= alpha_cutoff)) discard;
#endif
  ids = uvec2(instance, uint(gl_PrimitiveID));
  SurfaceMaterial material = surface_material_at(surface_texcoord, color.rgb);
  albedo = vec4(material.base_color, material.metallic);
  specular = vec4(material.specular, material.roughness);
}
