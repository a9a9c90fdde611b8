// White materials in the place of a file's own, and what their fragment shader writes.
import {MaterialPluginBase} from '@babylonjs/core/Materials/materialPluginBase.js';
import {Material} from '@babylonjs/core/Materials/material.js';
import {StandardMaterial} from '@babylonjs/core/Materials/standardMaterial.js';
import {Color3} from '@babylonjs/core/Maths/math.color.js';

/** What the next frame shows; all materials share it. */
export const shown = {value: 0};
export const what = {shadow: 0, position: 1, normal: 2, white: 3};

// `shadow` is the factor that the shader of StandardMaterial computes for its last light, here the only one.
const written = `
  color = vec4(vec3(shadow), 1.0);
  if (shown > 0.5) color = vec4(vPositionW, 1.0);
  if (shown > 1.5) color = vec4(normalW, 1.0);
  if (shown > 2.5) color = vec4(1.0);
`;

class Output extends MaterialPluginBase {
  constructor(material) {
    super(material, 'Output', 200, {OUTPUT: false}, true, true);
  }

  isCompatible(language) {
    return language === 0;  // GLSL
  }

  getClassName() {
    return 'Output';
  }

  prepareDefines(defines) {
    defines.OUTPUT = true;
  }

  getUniforms() {
    return {ubo: [{name: 'shown', size: 1, type: 'float'}]};
  }

  bindForSubMesh(buffer) {
    buffer.updateFloat('shown', shown.value);
  }

  getCustomCode(shader) {
    return shader === 'fragment' ? {CUSTOM_FRAGMENT_BEFORE_FRAGCOLOR: written} : null;
  }
}

/** The replacement of a material of the loader: its sides, and the alpha of a mask. Blended materials are opaque. */
function white(original, scene) {
  const material = new StandardMaterial(original.name, scene);
  material.diffuseColor = Color3.White();
  material.specularColor = Color3.Black();
  material.backFaceCulling = original.backFaceCulling;
  material.sideOrientation = original.sideOrientation;
  material.twoSidedLighting = !original.backFaceCulling;
  material.transparencyMode = Material.MATERIAL_OPAQUE;
  if (original.transparencyMode === Material.MATERIAL_ALPHATEST) {
    material.transparencyMode = Material.MATERIAL_ALPHATEST;
    material.alphaCutOff = original.alphaCutOff;
    material.alpha = original.alpha;
    material.diffuseTexture = original.albedoTexture;
    if (material.diffuseTexture) material.diffuseTexture.hasAlpha = true;
    material.useAlphaFromDiffuseTexture = true;
  }
  material.maxSimultaneousLights = 1;
  new Output(material);
  return material;
}

/** Replaces the materials of the meshes. */
export function whiten(meshes, scene) {
  const made = new Map();
  for (const mesh of meshes) {
    mesh.receiveShadows = true;
    if (mesh.isAnInstance) continue;  // it has the material of its source
    if (!made.has(mesh.material)) made.set(mesh.material, white(mesh.material, scene));
    mesh.material = made.get(mesh.material);
  }
}
