// Ambient occlusion of three.js: its post-processing passes over a white image, so that the result is what they
// multiply.
import {N8AOPass} from 'n8ao';
import * as THREE from 'three';
import {GTAOPass} from 'three/addons/postprocessing/GTAOPass.js';
import {SAOPass} from 'three/addons/postprocessing/SAOPass.js';
import {SSAOPass} from 'three/addons/postprocessing/SSAOPass.js';
import {settings_of} from '/browser/page.mjs';

function ssao({scene, camera, width, height}, values) {
  const pass = new SSAOPass(scene, camera, width, height, values['ssao-kernel-size']);
  return Object.assign(pass, settings_of(values, 'ssao-', ['kernelRadius', 'minDistance', 'maxDistance']));
}

function sao({scene, camera, width, height}, values) {
  const pass = new SAOPass(scene, camera, new THREE.Vector2(width, height));
  Object.assign(pass.params, settings_of(values, '', [
    'saoBias', 'saoIntensity', 'saoScale', 'saoKernelRadius', 'saoMinResolution', 'saoBlur', 'saoBlurRadius',
    'saoBlurStdDev', 'saoBlurDepthCutoff']));
  return pass;
}

function gtao({scene, camera, width, height}, values) {
  const pass = new GTAOPass(scene, camera, width, height);
  pass.blendIntensity = values['gtao-blend-intensity'];
  pass.updateGtaoMaterial(settings_of(values, 'gtao-', [
    'radius', 'distanceExponent', 'thickness', 'distanceFallOff', 'scale', 'samples', 'screenSpaceRadius']));
  pass.updatePdMaterial(settings_of(values, 'gtao-pd-', [
    'lumaPhi', 'depthPhi', 'normalPhi', 'radius', 'radiusExponent', 'rings', 'samples']));
  return pass;
}

// Its own image of the scene is all that it shades, so it shows the occlusion alone.
function n8ao({scene, camera, width, height}, values) {
  const pass = new N8AOPass(scene, camera, width, height);
  Object.assign(pass.configuration, {
    aoRadius: values['n8ao-radius'],
    aoSamples: values['n8ao-samples'],
    aoTones: values['n8ao-tones'],
    ...settings_of(values, 'n8ao-', [
      'distanceFalloff', 'intensity', 'denoiseSamples', 'denoiseRadius', 'denoiseIterations', 'biasOffset',
      'biasMultiplier', 'screenSpaceRadius', 'halfRes']),
    gammaCorrection: false,
  });
  pass.setDisplayMode('AO');
  return pass;
}

const passes = {ssao, sao, gtao, n8ao};

function white_target(renderer, width, height) {
  // Half floats, as in EffectComposer.
  const target = new THREE.WebGLRenderTarget(width, height, {type: THREE.HalfFloatType});
  const color = renderer.getClearColor(new THREE.Color());
  const alpha = renderer.getClearAlpha();
  renderer.setRenderTarget(target);
  renderer.setClearColor(0xffffff, 1);
  renderer.clear();
  renderer.setClearColor(color, alpha);
  return target;
}

function read_half(renderer, target) {
  const {width, height} = target;
  const halves = new Uint16Array(4 * width * height);
  renderer.readRenderTargetPixels(target, 0, 0, width, height, halves);
  return Float32Array.from(halves, (half) => Math.min(1, Math.max(0, THREE.DataUtils.fromHalfFloat(half))));
}

/** RGBA of the occlusion, 1 where open. SAO goes far below 0; no image can show that, so 0 is the least here. */
export function occlusion(engine, values) {
  const {renderer_of_three: renderer, width, height} = engine;
  const pass = passes[values['ao-method']](engine, values);
  const [written, read] = [white_target(renderer, width, height), white_target(renderer, width, height)];
  try {
    pass.renderToScreen = false;
    if (pass.setSize) pass.setSize(width, height);
    pass.render(renderer, written, read, 0, false);
    return read_half(renderer, pass instanceof SSAOPass || pass instanceof SAOPass ? read : written);
  } finally {
    pass.dispose?.();
    written.dispose();
    read.dispose();
  }
}
