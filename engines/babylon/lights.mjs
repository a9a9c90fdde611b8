// The light of a scene in Babylon.js, with the shadow that the parameters describe.
import {DirectionalLight} from '@babylonjs/core/Lights/directionalLight.js';
import {PointLight} from '@babylonjs/core/Lights/pointLight.js';
import {SpotLight} from '@babylonjs/core/Lights/spotLight.js';
import {CascadedShadowGenerator} from '@babylonjs/core/Lights/Shadows/cascadedShadowGenerator.js';
import {ShadowGenerator} from '@babylonjs/core/Lights/Shadows/shadowGenerator.js';
import '@babylonjs/core/Lights/Shadows/shadowGeneratorSceneComponent.js';
import {Vector3} from '@babylonjs/core/Maths/math.vector.js';
import {settings_of} from '/browser/page.mjs';

const filters = {
  none: ShadowGenerator.FILTER_NONE,
  poisson: ShadowGenerator.FILTER_POISSONSAMPLING,
  esm: ShadowGenerator.FILTER_EXPONENTIALSHADOWMAP,
  'blur-esm': ShadowGenerator.FILTER_BLUREXPONENTIALSHADOWMAP,
  'close-esm': ShadowGenerator.FILTER_CLOSEEXPONENTIALSHADOWMAP,
  'blur-close-esm': ShadowGenerator.FILTER_BLURCLOSEEXPONENTIALSHADOWMAP,
  pcf: ShadowGenerator.FILTER_PCF,
  pcss: ShadowGenerator.FILTER_PCSS,
};
const qualities = {
  low: ShadowGenerator.QUALITY_LOW, medium: ShadowGenerator.QUALITY_MEDIUM, high: ShadowGenerator.QUALITY_HIGH,
};

function sun({direction, position}, bounds, values, scene) {
  const light = new DirectionalLight('light', Vector3.FromArray(direction).normalize(), scene);
  const [low, high] = [Vector3.FromArray(bounds.min), Vector3.FromArray(bounds.max)];
  const radius = 0.5 * Vector3.Distance(low, high);
  light.position = values['light-position'] === 'file'
    ? Vector3.FromArray(position)
    : low.add(high).scale(0.5).subtract(light.direction.scale(radius));
  const names = ['autoCalcShadowZBounds', 'shadowOrthoScale', 'shadowFrustumSize'];
  return Object.assign(light, settings_of(values, '', names));
}

function spot({position, direction, outer_cone}, values, scene) {
  const along = Vector3.FromArray(direction).normalize();
  const light = new SpotLight('light', Vector3.FromArray(position), along, 2 * outer_cone, 0, scene);
  light.shadowAngleScale = values['shadow-angle-scale'];
  return light;
}

function make_light(request, bounds, values, scene) {
  if (request.kind === 'directional') return sun(request, bounds, values, scene);
  if (request.kind === 'spot') return spot(request, values, scene);
  return new PointLight('light', Vector3.FromArray(request.position), scene);
}

function cascaded(light, camera, values) {
  const generator = new CascadedShadowGenerator(values['map-size'], light, values['use-float32-texture-type'], camera);
  Object.assign(generator, settings_of(values, '', [
    'numCascades', 'lambda', 'stabilizeCascades', 'cascadeBlendPercentage', 'depthClamp', 'penumbraDarkness']));
  if (values['shadow-max-z'] > 0) generator.shadowMaxZ = values['shadow-max-z'];
  return generator;
}

function check(kind, {filter, cascades}) {
  if (kind === 'directional' && cascades) {
    if (!['none', 'pcf', 'pcss'].includes(filter)) throw new Error(`Babylon.js has no filter ${filter} with cascades`);
  } else if (kind === 'point' && !['none', 'poisson', 'esm', 'close-esm'].includes(filter)) {
    throw new Error(`Babylon.js has no filter ${filter} for point lights`);
  }
}

/** Gives {light, generator, dispose()}; the meshes cast. */
export function add_light(scene, camera, meshes, request, bounds, values) {
  check(request.kind, values);
  const is_cascaded = request.kind === 'directional' && values.cascades;
  const light = make_light(request, bounds, values, scene);
  if (!is_cascaded) {
    if (values['shadow-min-z'] > 0) light.shadowMinZ = values['shadow-min-z'];
    if (values['shadow-max-z'] > 0) light.shadowMaxZ = values['shadow-max-z'];
  }
  const generator = is_cascaded
    ? cascaded(light, camera, values)
    : new ShadowGenerator(values['map-size'], light, values['use-float32-texture-type'], camera);
  generator.filter = filters[values.filter];
  generator.filteringQuality = qualities[values['filtering-quality']];
  Object.assign(generator, settings_of(values, '', ['bias', 'normalBias', 'darkness']));
  generator.contactHardeningLightSizeUVRatio = values['contact-hardening-light-size-uv-ratio'];
  Object.assign(generator, settings_of(values, '', [
    'depthScale', 'blurScale', 'blurBoxOffset', 'useKernelBlur', 'blurKernel', 'frustumEdgeFalloff',
    'forceBackFacesOnly']));
  for (const mesh of meshes) generator.addShadowCaster(mesh, false);
  if (is_cascaded && values['auto-calc-depth-bounds']) generator.autoCalcDepthBounds = true;
  return {
    light, generator,
    dispose() {
      generator.dispose();
      light.dispose();
    },
  };
}
