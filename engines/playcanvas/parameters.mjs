// What can be set in PlayCanvas that changes its shadows or its ambient occlusion, under its own names.
import {boolean, choice, integer, number, what} from '../browser/parameters.mjs';

const types = [
  'pcf1-16f', 'pcf3-16f', 'pcf5-16f', 'pcf1-32f', 'pcf3-32f', 'pcf5-32f', 'vsm-16f', 'vsm-32f', 'pcss-32f',
];

const shadow = [
  choice('shadow-type', 'pcf3-32f', types, 'shadowType: kind of shadow map; clustered lamps take the pcf types'),
  integer('shadow-resolution', 1024,
          'shadowResolution: side of the map; cascades share it, clustered lamps have the atlas',
          {min: 16, max: 8192, unit: 'texels'}),
  number('shadow-bias', 0.05, 'shadowBias: depth bias of casters, constant and by slope (not of point lights and pcss)',
         {min: 0, max: 1, bias: 'up'}),
  number('normal-offset-bias', 0,
         'normalOffsetBias: shift of the receiver along its normal; with vsm and for point lights times (1 - cos θ) and, '
         + 'of spot and point lights, the distance', {min: 0, max: 1, unit: 'm'}),
  number('shadow-distance', 40, 'shadowDistance: where the shadows of a sun end', {min: 1e-3, max: 1e6, unit: 'm'}),
  number('shadow-intensity', 1, 'shadowIntensity: how much of the light shadows take away', {min: 0, max: 1}),
  integer('num-cascades', 1, 'numCascades: number of cascades of a sun', {min: 1, max: 4}),
  number('cascade-distribution', 0.5, 'cascadeDistribution: 0: equal parts of the depth, 1: logarithmic ones',
         {min: 0, max: 1}),
  number('cascade-blend', 0, 'cascadeBlend: share of a cascade that is dithered into the next', {min: 0, max: 1}),
  integer('vsm-blur-size', 11, 'vsmBlurSize: width of the blur of vsm', {min: 1, max: 25, unit: 'texels'}),
  choice('vsm-blur-mode', 'gaussian', ['box', 'gaussian'], 'vsmBlurMode: shape of the blur of vsm'),
  number('vsm-bias', 0.0025, 'vsmBias: normal offset of vsm', {min: 0, max: 1}),
  number('penumbra-size', 1, 'penumbraSize: size of the light, of pcss', {min: 0, max: 1000}),
  number('penumbra-falloff', 1, 'penumbraFalloff: how fast the penumbra of pcss widens, of a sun', {min: 0, max: 100}),
  integer('shadow-samples', 16, 'shadowSamples: taps of pcss, of a sun', {min: 1, max: 256}),
  integer('shadow-blocker-samples', 16, 'shadowBlockerSamples: taps of the search of pcss, of a sun; 0: no penumbra',
          {min: 0, max: 256}),
  boolean('clustered-lighting', true,
          'scene.clusteredLightingEnabled: spot and point lights share an atlas of shadow maps'),
  integer('shadow-atlas-resolution', 2048, 'scene.lighting.shadowAtlasResolution: side of that atlas',
          {min: 32, max: 8192, unit: 'texels'}),
];

const ao = [
  number('ssao-radius', 30, 'CameraFrame.ssao.radius', {min: 1e-6, max: 1e6, unit: 'm'}),
  integer('ssao-samples', 12, 'ssao.samples per pixel', {min: 1, max: 256}),
  number('ssao-intensity', 0.5, 'ssao.intensity: factor of the occlusion', {min: 0, max: 100}),
  number('ssao-power', 6, 'ssao.power: exponent of the result', {min: 0.01, max: 100}),
  number('ssao-min-angle', 10, 'ssao.minAngle: least angle of an occluder above the surface',
         {min: 0, max: 90, unit: 'degrees'}),
  number('ssao-scale', 1, 'ssao.scale: size of its image', {min: 0.1, max: 1, unit: 'image widths'}),
  boolean('ssao-blur-enabled', true, 'ssao.blurEnabled: whether the result is blurred'),
  boolean('ssao-randomize', false, 'ssao.randomize: whether each frame turns the pattern of samples'),
];

export const parameters = [...what('shadow', shadow), ...what('ao', ao)];
