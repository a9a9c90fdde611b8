// White Lambert materials in the place of a file's own. three.js draws them as any material; their fragment shader also
// writes the shadow factor, the position and the normal of each pixel.
import * as THREE from 'three';

const outputs = `
layout(location = 1) out highp vec4 position_out;
layout(location = 2) out highp vec4 normal_out;
varying highp vec3 position_in_world;
`;

// MASKED: the shadow factor as three.js gives it to ShadowMaterial. Otherwise the light that leaves the surface, from
// which a factor results by division, because the cascades of CSM are chosen within the sum over the lights.
const written = `
#ifdef MASKED
  gl_FragColor = vec4(vec3(getShadowMask()), 1.0);
#else
  gl_FragColor = vec4(outgoingLight, 1.0);
#endif
  position_out = vec4(position_in_world, 1.0);
  normal_out = vec4(inverseTransformDirection(normal, viewMatrix), 1.0);
`;

function add_outputs(shader) {
  shader.vertexShader = shader.vertexShader
    .replace('#include <common>', `#include <common>
varying highp vec3 position_in_world;`)
    .replace('#include <fog_vertex>', `#include <fog_vertex>
  position_in_world = (modelMatrix * vec4(transformed, 1.0)).xyz;`);
  shader.fragmentShader = shader.fragmentShader
    .replace('#include <common>', `#include <common>\n${outputs}`)
    .replace('#include <shadowmap_pars_fragment>', `#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>`)
    // Only the alpha of textures and factors matters.
    .replace('#include <alphahash_fragment>', '#include <alphahash_fragment>\n  diffuseColor = vec4(1.0);')
    .replace('#include <dithering_fragment>', written);
}

const sides = {default: null, front: THREE.FrontSide, back: THREE.BackSide, double: THREE.DoubleSide};

/** The replacement of a material: its sides, and the alpha of a mask. Blended materials are opaque. */
function white(original, geometry) {
  const is_mask = original.alphaTest > 0;
  const material = new THREE.MeshLambertMaterial({
    color: 0xffffff,
    side: original.side,
    map: is_mask ? original.map : null,
    alphaTest: original.alphaTest,
    opacity: is_mask ? original.opacity : 1,
    vertexColors: is_mask && geometry.attributes.color?.itemSize === 4,
  });
  material.defines = {MASKED: ''};
  material.onBeforeCompile = add_outputs;
  return material;
}

// A mesh without normals is flat (glTF 2.0, section 3.7.2.1). The loader leaves that to the fragment shader, but a bias
// along the normal and passes that override materials read the attribute.
function with_normals(geometry) {
  if (geometry.attributes.normal !== undefined) return geometry;
  const flat = geometry.index === null ? geometry : geometry.toNonIndexed();
  flat.computeVertexNormals();
  return flat;
}

/** Replaces the materials of all meshes below `root`; gives the new ones. */
export function whiten(root) {
  const made = new Map();
  const geometries = new Map();
  root.traverse((object) => {
    if (!object.isMesh) return;
    if (!geometries.has(object.geometry)) geometries.set(object.geometry, with_normals(object.geometry));
    object.geometry = geometries.get(object.geometry);
    const key = `${object.material.uuid} ${object.geometry.attributes.color?.itemSize}`;
    if (!made.has(key)) made.set(key, white(object.material, object.geometry));
    object.material = made.get(key);
    object.castShadow = true;
    object.receiveShadow = true;
  });
  return [...made.values()];
}

export function set_shadow_side(materials, name) {
  for (const material of materials) material.shadowSide = sides[name];
}

/** Has the materials write light instead of the shadow factor, with the shader of `csm`. */
export function use_csm(materials, csm) {
  for (const material of materials) {
    delete material.defines.MASKED;
    csm.setupMaterial(material);
    const of_csm = material.onBeforeCompile;
    material.onBeforeCompile = (shader, renderer) => {
      of_csm(shader, renderer);
      add_outputs(shader);
    };
    material.needsUpdate = true;
  }
}

/** Undoes use_csm(). */
export function leave_csm(materials, csm) {
  csm.dispose();
  for (const material of materials) {
    material.defines = {MASKED: ''};
    material.onBeforeCompile = add_outputs;
    material.needsUpdate = true;
  }
}
