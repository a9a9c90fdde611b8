// What the bindings of Filament's npm package let one set of its shadows and its ambient occlusion, under its own names.
import {boolean, choice, integer, number, what} from '../browser/parameters.mjs';

const qualities = ['low', 'medium', 'high', 'ultra'];
const meters = {min: 0, max: 1e6, unit: 'm'};

const shadow = [
  integer('map-size', 1024, 'mapSize: side of the shadow map, of a cube face, of a cascade',
          {min: 8, max: 2048, unit: 'texels'}),
  integer('shadow-cascades', 1, 'shadowCascades: number of cascades of a sun', {min: 1, max: 4}),
  number('constant-bias', 0.001, 'constantBias: shift of the map along the light', {min: 0, max: 2, unit: 'm'}),
  number('normal-bias', 1, 'normalBias: shift of the receiver along its normal, times sin θ; changed nothing under a sun',
         {min: 0, max: 3, unit: 'texels'}),
  number('shadow-far', 0, "shadowFar: distance from the camera where shadows of a sun end; 0: the camera's far plane",
         meters),
  boolean('stable', false, 'stable: maps of a sun that keep their size as the camera turns, and no warp'),
  boolean('lispsm', true, 'lispsm: warps the map of a sun, unless it is stable'),
  number('polygon-offset-constant', 0.5, 'polygonOffsetConstant: offset of the caster', {min: -1e6, max: 1e6}),
  number('polygon-offset-slope', 2, 'polygonOffsetSlope: offset of the caster, times its slope', {min: -1e6, max: 1e6}),
  number('falloff', 0, "radius where the light of a lamp ends, and its map; 0: the range of the file, or past the scene",
         meters),
];

const ao = [
  number('ao-radius', 0.3, 'radius of the occluders', {min: 1e-4, max: 1e6, unit: 'm'}),
  number('ao-power', 1, 'power of the result', {min: 0.01, max: 100}),
  number('ao-bias', 0.0005, 'bias against self-occlusion', {min: 0, max: 100, unit: 'm'}),
  choice('ao-resolution', 'half', ['half', 'full'], 'resolution of its image'),
  number('ao-intensity', 1, 'intensity of the occlusion', {min: 0, max: 100}),
  number('ao-bilateral-threshold', 0.05, 'bilateralThreshold: depth distance across which the result is not blurred', meters),
  choice('ao-quality', 'low', qualities, 'quality: number of samples'),
  choice('ao-low-pass-filter', 'medium', qualities, 'lowPassFilter: width of the blur'),
  choice('ao-upsampling', 'low', qualities, 'upsampling to the full resolution'),
  number('ao-min-horizon-angle', 0, 'minHorizonAngleRad: angle below which occluders do not count',
         {min: 0, max: 0.7853, unit: 'rad'}),
];

export const parameters = [...what('shadow', shadow), ...what('ao', ao)];
