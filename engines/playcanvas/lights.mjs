// The light of a scene in PlayCanvas, with the shadow that the parameters describe.
import * as pc from 'playcanvas';
import {settings_of} from '/browser/page.mjs';

const types = {
  'pcf1-16f': pc.SHADOW_PCF1_16F, 'pcf3-16f': pc.SHADOW_PCF3_16F, 'pcf5-16f': pc.SHADOW_PCF5_16F,
  'pcf1-32f': pc.SHADOW_PCF1_32F, 'pcf3-32f': pc.SHADOW_PCF3_32F, 'pcf5-32f': pc.SHADOW_PCF5_32F,
  'vsm-16f': pc.SHADOW_VSM_16F, 'vsm-32f': pc.SHADOW_VSM_32F, 'pcss-32f': pc.SHADOW_PCSS_32F,
};
const kinds = {directional: 'directional', spot: 'spot', point: 'omni'};
const degrees = (radians) => radians * 180 / Math.PI;

// The range is also the far plane of the shadow maps; where the file has none, it reaches the farthest corner.
function range_of({position, range}, bounds) {
  if (range > 0) return range;
  return 1.001 * Math.hypot(...position.map((x, axis) => Math.max(Math.abs(x - bounds.min[axis]),
                                                                  Math.abs(x - bounds.max[axis])))) + 1e-3;
}

function check(kind, values) {
  const type = values['shadow-type'];
  if (kind === 'point' && type.startsWith('vsm')) throw new Error(`PlayCanvas has no ${type} for point lights`);
  if (kind === 'point' && type.startsWith('pcf5')) throw new Error(`PlayCanvas has no ${type} for point lights`);
  if (kind !== 'directional' && values['clustered-lighting'] && !type.startsWith('pcf')) {
    throw new Error(`PlayCanvas has no ${type} for clustered lights`);
  }
}

/** Adds the light; gives its entity. */
export function add_light(app, request, bounds, values) {
  check(request.kind, values);
  const entity = new pc.Entity('light');
  const type = types[values['shadow-type']];
  entity.addComponent('light', {
    type: kinds[request.kind],
    color: new pc.Color(1, 1, 1),
    intensity: 1,
    castShadows: true,
    shadowType: type,
    vsmBlurMode: values['vsm-blur-mode'] === 'box' ? pc.BLUR_BOX : pc.BLUR_GAUSSIAN,
    ...settings_of(values, '', [
      'shadowResolution', 'shadowBias', 'normalOffsetBias', 'shadowDistance', 'shadowIntensity', 'numCascades',
      'cascadeDistribution', 'cascadeBlend', 'vsmBlurSize', 'vsmBias', 'penumbraSize', 'penumbraFalloff',
      'shadowSamples', 'shadowBlockerSamples']),
    ...(request.kind !== 'directional' && {range: range_of(request, bounds), falloffMode: pc.LIGHTFALLOFF_LINEAR}),
    ...(request.kind === 'spot' && {
      innerConeAngle: degrees(request.inner_cone), outerConeAngle: degrees(request.outer_cone)}),
  });
  if (values['clustered-lighting']) {
    if (request.kind !== 'directional') app.scene.lighting.shadowType = type;
    app.scene.lighting.shadowAtlasResolution = values['shadow-atlas-resolution'];
  }
  entity.setPosition(...request.position);
  // A light shines along its own −Y.
  entity.setRotation(new pc.Quat().setFromDirections(pc.Vec3.DOWN, new pc.Vec3(...request.direction).normalize()));
  app.root.addChild(entity);
  return entity;
}
