// White materials in the place of a file's own, and what their fragment shader writes.
import * as pc from 'playcanvas';

export const what = {shadow: 0, position: 1, normal: 2};

// Of a sun, LIT_SHADOW_CATCHER has the shadow factor. Of other lights it is the sum of their diffuse light, whose other
// factors are 1 here: a quotient of two frames would say nothing where cone, range or shading normal leave no light.
const unshaded = {
  spotPS: 'float getSpotEffect(vec3 direction, float inner, float outer, vec3 to_surface) { return 1.0; }',
  falloffLinearPS: 'float getFalloffLinear(float range, vec3 to_surface) { return 1.0; }',
  lightDiffuseLambertPS: 'float getLightDiffuse(vec3 normal, vec3 view, vec3 to_surface) { return 1.0; }',
};
const declared = `
uniform float shown;
`;
const written = `
#if !defined(PICK_PASS) && !defined(PREPASS_PASS) && !defined(SHADOW_PASS)
  #ifdef LIT_SHADOW_CATCHER
    gl_FragColor = vec4(vec3(dShadowCatcher), 1.0);
  #else
    gl_FragColor = vec4(dDiffuseLight, 1.0);
  #endif
  if (shown > 0.5) gl_FragColor = vec4(vPositionW, 1.0);
  if (shown > 1.5) gl_FragColor = vec4(dVertexNormalW, 1.0);
#endif
`;

/** The replacement of a material of the loader: its sides, and the alpha of a mask. Blended materials are opaque. */
function white(original, is_sun) {
  const material = new pc.StandardMaterial();
  material.diffuse = new pc.Color(1, 1, 1);
  material.specular = new pc.Color(0, 0, 0);
  material.useMetalness = false;
  material.useSkybox = false;
  material.useFog = false;
  material.useTonemap = false;
  material.blendType = pc.BLEND_NONE;
  material.cull = original.cull;
  material.twoSidedLighting = original.twoSidedLighting;
  material.shadowCatcher = is_sun;
  if (original.alphaTest > 0) {
    material.alphaTest = original.alphaTest;
    material.opacity = original.opacity;
    material.opacityMap = original.opacityMap;
    material.opacityMapChannel = original.opacityMapChannel;
    material.opacityMapUv = original.opacityMapUv;
    material.opacityMapTiling = original.opacityMapTiling;
    material.opacityMapOffset = original.opacityMapOffset;
    material.opacityMapRotation = original.opacityMapRotation;
    material.opacityVertexColor = original.opacityVertexColor;
  }
  const chunks = material.getShaderChunks(pc.SHADERLANGUAGE_GLSL);
  chunks.set('litUserDeclarationPS', declared);
  chunks.set('litUserMainEndPS', written);
  if (!is_sun) for (const [name, text] of Object.entries(unshaded)) chunks.set(name, text);
  material.update();
  return material;
}

/** Replaces the materials below an entity. */
export function whiten(entity, is_sun) {
  const made = new Map();
  for (const render of entity.findComponents('render')) {
    render.castShadows = true;
    render.receiveShadows = true;
    for (const instance of render.meshInstances) {
      const {material} = instance;
      if (!made.has(material)) made.set(material, white(material, is_sun));
      instance.material = made.get(material);
    }
  }
}
