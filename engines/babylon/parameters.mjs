// What can be set in Babylon.js that changes its shadows or its ambient occlusion, under its own names.
import {boolean, choice, integer, number, what} from '../browser/parameters.mjs';

const meters = {min: 0, max: 1e6, unit: 'm'};
const filters = ['none', 'poisson', 'esm', 'blur-esm', 'close-esm', 'blur-close-esm', 'pcf', 'pcss'];

const shadow = [
  choice('filter', 'none', filters, 'ShadowGenerator.filter; cascades take none, pcf and pcss'),
  integer('map-size', 1024, 'mapSize: side of the shadow map, of a cube face, of a cascade', {min: 16, max: 8192, unit: 'texels'}),
  number('bias', 0.00005, 'bias: added to the depth of the caster', {min: -1, max: 1, unit: 'clip depth (pcf, pcss), map depth'}),
  number('normal-bias', 0, 'normalBias: shift of the caster against its normal, times sin θ', {min: -1000, max: 1000, unit: 'm'}),
  number('darkness', 0, 'darkness: visibility of what lies in shadow', {min: 0, max: 1}),
  choice('filtering-quality', 'high', ['low', 'medium', 'high'], 'filteringQuality: number of taps of pcf and pcss'),
  number('contact-hardening-light-size-uv-ratio', 0.1, 'contactHardeningLightSizeUVRatio: size of the light, of pcss',
         {min: 0, max: 1, unit: 'map widths'}),
  number('penumbra-darkness', 1, 'penumbraDarkness: how dark the penumbra of pcss is, of cascades', {min: 0, max: 100}),
  number('depth-scale', 50, 'depthScale: exponent of esm and its kin', {min: 0, max: 1e6}),
  number('blur-scale', 2, 'blurScale: how much smaller the map is while the blurred kinds blur it', {min: 1, max: 16}),
  integer('blur-box-offset', 1, 'blurBoxOffset: half the width of the box blur', {min: 0, max: 64, unit: 'texels'}),
  boolean('use-kernel-blur', false, 'useKernelBlur: Gaussian blur instead of the box'),
  number('blur-kernel', 1, 'blurKernel: width of the Gaussian blur', {min: 1, max: 512, unit: 'texels'}),
  number('frustum-edge-falloff', 0, 'frustumEdgeFalloff: where shadows fade at the edge of the map', {min: 0, max: 1}),
  boolean('force-back-faces-only', false, 'forceBackFacesOnly: whether only back faces cast'),
  boolean('use-float32-texture-type', false, 'useFloat32TextureType: 32-bit maps instead of 16-bit'),
  choice('light-position', 'bounds', ['bounds', 'file'],
         "position of a sun, from which depth is counted: one radius off the centre of the scene's bounds, or the file's"),
  boolean('auto-update-extends', true, 'autoUpdateExtends: whether the map of a sun encloses all casters'),
  number('shadow-ortho-scale', 0.1, 'shadowOrthoScale: margin on each side around the casters', {min: 0, max: 10, unit: 'map widths'}),
  number('shadow-frustum-size', 0, 'shadowFrustumSize: fixed width of the map of a sun; 0: that of the casters', meters),
  boolean('auto-calc-shadow-z-bounds', false, 'autoCalcShadowZBounds: whether the depth of a sun encloses just the casters'),
  number('shadow-min-z', 0, "shadowMinZ: nearest depth of the map; 0: the camera's minZ", meters),
  number('shadow-max-z', 0, "shadowMaxZ: farthest depth of the map, with cascades of the view; 0: the camera's maxZ", meters),
  number('shadow-angle-scale', 1, 'shadowAngleScale of a spot light: width of the map in cones', {min: 0.01, max: 10}),
  boolean('cascades', false, 'whether CascadedShadowGenerator draws the shadows of a sun; by itself it has filter pcf'),
  integer('num-cascades', 4, 'numCascades: number of cascades', {min: 2, max: 4}),
  number('lambda', 0.5, 'lambda: 0: equal parts of the depth, 1: logarithmic ones', {min: 0, max: 1}),
  boolean('stabilize-cascades', false, 'stabilizeCascades: cascades that keep their size as the camera turns'),
  number('cascade-blend-percentage', 0.1, 'cascadeBlendPercentage: share of a cascade that blends into the next', {min: 0, max: 1}),
  boolean('depth-clamp', true, 'depthClamp: whether casters before the near plane are kept, of cascades'),
  boolean('auto-calc-depth-bounds', false, 'autoCalcDepthBounds: whether cascades span just the depths in view'),
];

const ao = [
  number('ssao-ratio', 1, 'ssaoRatio of SSAO2RenderingPipeline: size of its images', {min: 0.1, max: 1, unit: 'image widths'}),
  number('blur-ratio', 1, 'blurRatio: size of the blurred images', {min: 0.1, max: 1, unit: 'image widths'}),
  number('radius', 2, 'radius of the hemisphere of samples', {min: 1e-6, max: 1e6, unit: 'm'}),
  number('total-strength', 1, 'totalStrength: factor of the occlusion', {min: 0, max: 100}),
  number('base', 0, 'base: added to the result', {min: 0, max: 1}),
  integer('samples', 8, 'samples per pixel', {min: 1, max: 512}),
  number('epsilon', 0.02, 'epsilon: depth by which an occluder must lie before a sample', {min: 0, max: 10}),
  number('max-z', 100, 'maxZ: depth at which the occlusion has faded', {min: 1e-3, max: 1e6, unit: 'm'}),
  number('min-z-aspect', 0.2, 'minZAspect: clamps the radius near the camera', {min: 0, max: 100}),
  boolean('bypass-blur', false, 'bypassBlur: whether the result stays noisy'),
  boolean('expensive-blur', true, 'expensiveBlur: the bilateral filter that the three values below describe'),
  integer('bilateral-samples', 16, 'bilateralSamples: samples of that filter in each direction', {min: 1, max: 128}),
  number('bilateral-soften', 0, 'bilateralSoften: how much less far samples of it count', {min: 0, max: 1}),
  number('bilateral-tolerance', 0, 'bilateralTolerance: tolerance of depth of it', {min: 0, max: 100}),
  boolean('force-geometry-buffer', false, 'forceGeometryBuffer: depth and normals from GeometryBufferRenderer'),
];

export const parameters = [...what('shadow', shadow), ...what('ao', ao)];
