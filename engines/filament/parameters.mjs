// What the bindings of Filament's npm package let one set of its shadows, under its own names.
import {boolean, integer, number, what} from '../browser/parameters.mjs';

const meters = {min: 0, max: 1e6, unit: 'm'};

const shadow = [
  integer('map-size', 1024, 'mapSize: side of the shadow map, of a cube face, of a cascade',
          {min: 8, max: 2048, unit: 'texels'}),
  integer('shadow-cascades', 1, 'shadowCascades: number of cascades of a sun', {min: 1, max: 4}),
  number('constant-bias', 0.001, 'constantBias: shift of the map along the light', {min: 0, max: 2, unit: 'm'}),
  number('normal-bias', 1, 'normalBias: shift of the receiver along its normal, times sin θ; a sun has 1, whatever is set',
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

export const parameters = what('shadow', shadow);
