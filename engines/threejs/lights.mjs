// The light of a scene in three.js, with the shadow that the parameters describe.
import * as THREE from 'three';
import {CSM} from 'three/addons/csm/CSM.js';
import {SunLight} from 'three/addons/lights/SunLight.js';

const vector = (numbers) => new THREE.Vector3(...numbers);

/** Distance from a point to the farthest corner of the bounds. */
function farthest(bounds, point) {
  const [low, high, at] = [bounds.min, bounds.max, point.toArray()];
  return Math.hypot(...at.map((x, axis) => Math.max(Math.abs(x - low[axis]), Math.abs(x - high[axis]))));
}

// fit: the sphere around the bounds, which the shadow camera of a sun encloses. engine: as DirectionalLight has it, at
// the place of the light in the file. custom: the bounds' centre lies in the middle between near and far.
function place_sun(light, {direction, position}, bounds, values) {
  const camera = light.shadow.camera;
  const center = vector(bounds.min).add(vector(bounds.max)).multiplyScalar(0.5);
  const radius = Math.max(0.5 * vector(bounds.min).distanceTo(vector(bounds.max)), 1e-6);
  const along = vector(direction).normalize();
  let [extent, near, far] = [camera.right, camera.near, camera.far];
  if (values['shadow-camera'] === 'fit') [extent, near, far] = [radius, 0, 2 * radius];
  if (values['shadow-camera'] === 'custom') {
    [extent, near, far] = [values['camera-extent'], values['camera-near'], values['camera-far']];
  }
  light.position.copy(values['shadow-camera'] === 'engine' ? vector(position)
                                                            : center.addScaledVector(along, -0.5 * (near + far)));
  light.target.position.copy(light.position).add(along);
  Object.assign(camera, {left: -extent, right: extent, top: extent, bottom: -extent, near, far});
  camera.updateProjectionMatrix();
}

// A spot or point light. fit: far is the range of the light, or else the farthest corner of the bounds, and near is
// far / 1000 but at most three.js's own.
function place_lamp(light, {position, range}, bounds, values) {
  const camera = light.shadow.camera;
  light.position.copy(vector(position));
  if (values['shadow-camera'] === 'custom') {
    light.distance = 0;  // else it would replace far
    Object.assign(camera, {near: values['camera-near'], far: values['camera-far']});
  } else {
    light.distance = range;
    if (values['shadow-camera'] === 'fit') {
      camera.far = range > 0 ? range : Math.max(farthest(bounds, light.position), 1e-3);
      camera.near = Math.min(camera.near, camera.far / 1000);
    }
  }
  camera.updateProjectionMatrix();
}

function make_light({kind, direction, inner_cone, outer_cone}, values) {
  if (kind === 'point') return new THREE.PointLight(0xffffff, 1);
  if (kind === 'spot') {
    const light = new THREE.SpotLight(0xffffff, 1);
    light.angle = Math.min(outer_cone, Math.PI / 2);
    light.penumbra = 1 - inner_cone / outer_cone;
    light.shadow.focus = values['spot-focus'];
    return light;
  }
  if (values.cascades === 'sun-light') {
    const light = new SunLight(0xffffff, Math.PI);
    light.position.copy(vector(direction).normalize().negate());
    return light;
  }
  return new THREE.DirectionalLight(0xffffff, Math.PI);
}

function set_shadow(shadow, values, {bias, size}) {
  shadow.bias = bias;
  shadow.normalBias = values['normal-bias'];
  shadow.radius = values.radius;
  shadow.blurSamples = values['blur-samples'];
  shadow.mapSize.set(size, size);
}

function check_camera(near, far) {
  if (!(near < far)) throw new Error(`the shadow camera's near plane, ${near}, lies not before its far plane, ${far}`);
}

/**
 * Adds the light to the scene. Gives {shadows (of each cascade), remove()}, and csm where that add-on is used.
 */
export function add_light(scene, camera, light, bounds, values) {
  if (light.kind === 'directional' && values.cascades === 'csm') return add_csm(scene, camera, light, values);
  if (values['shadow-camera'] === 'custom') check_camera(values['camera-near'], values['camera-far']);
  const made = make_light(light, values);
  const is_sun = made.isSunLight === true;
  made.castShadow = true;
  set_shadow(made.shadow, values, {bias: values.bias, size: values[is_sun ? 'sun-map-size' : 'map-size']});
  if (is_sun) {
    check_camera(values['sun-near'], values['sun-far']);
    Object.assign(made.shadow.camera, {near: values['sun-near'], far: values['sun-far']});
  } else if (made.isDirectionalLight) {
    place_sun(made, light, bounds, values);
  } else {
    place_lamp(made, light, bounds, values);
    check_camera(made.shadow.camera.near, made.shadow.camera.far);
    if (made.isSpotLight) made.target.position.copy(made.position).add(vector(light.direction));
  }
  scene.add(made);
  if (made.target) scene.add(made.target);
  return {
    shadows: [made.shadow],
    remove() {
      scene.remove(made);
      if (made.target) scene.remove(made.target);
      made.dispose();
    },
  };
}

function add_csm(scene, camera, {direction}, values) {
  check_camera(values['csm-light-near'], values['csm-light-far']);
  const csm = new CSM({
    camera, parent: scene, lightDirection: vector(direction).normalize(), lightIntensity: Math.PI,
    cascades: values['csm-cascades'], mode: values['csm-mode'], maxFar: values['csm-max-far'],
    shadowMapSize: values['csm-shadow-map-size'], lightMargin: values['csm-light-margin'],
    lightNear: values['csm-light-near'], lightFar: values['csm-light-far'],
  });
  csm.fade = values['csm-fade'];
  for (const {shadow} of csm.lights) {
    set_shadow(shadow, values, {bias: values['csm-shadow-bias'], size: values['csm-shadow-map-size']});
  }
  csm.updateFrustums();
  csm.update();
  return {
    csm,
    shadows: csm.lights.map(({shadow}) => shadow),
    remove() {
      csm.remove();
      for (const light of csm.lights) light.dispose();
    },
  };
}
