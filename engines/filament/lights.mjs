// The light of a scene in Filament, with the shadow that the parameters describe.
import {settings_of} from '/browser/page.mjs';

const distance = (a, b) => Math.hypot(...a.map((value, i) => value - b[i]));

// The distance from a lamp to the farthest corner of the scene, and a half: light ends there.
function radius_past({position}, {min, max}) {
  const farthest = position.map((value, i) => (Math.abs(value - min[i]) > Math.abs(value - max[i]) ? min[i] : max[i]));
  return 1.5 * distance(position, farthest);
}

const options_of = (values) => ({
  ...settings_of(values, '', [
    'mapSize', 'shadowCascades', 'constantBias', 'normalBias', 'shadowFar', 'stable', 'lispsm', 'polygonOffsetConstant',
    'polygonOffsetSlope']),
  shadowBulbRadius: 0.02,  // its default; only soft shadows read it, which the package cannot choose
});

/** An entity with the light; it casts shadows. */
export function make_light(filament, engine, request, bounds, values) {
  const entity = filament.EntityManager.get().create();
  const {kind, direction, position, range, inner_cone, outer_cone} = request;
  const {DIRECTIONAL, SPOT, POINT} = filament.LightManager$Type;
  const builder = filament.LightManager.Builder({directional: DIRECTIONAL, spot: SPOT, point: POINT}[kind])
    .color([1, 1, 1]).castShadows(true).shadowOptions(options_of(values));
  if (kind === 'directional') {
    builder.direction(direction).intensity(1);
  } else {
    builder.position(position).intensity(1000).falloff(values.falloff || range || radius_past(request, bounds));
    if (kind === 'spot') builder.direction(direction).spotLightCone(inner_cone, outer_cone);
  }
  builder.build(engine, entity);
  return entity;
}
