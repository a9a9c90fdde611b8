// Ambient occlusion of three.js: its post-processing passes over a white image, so that the result is what they
// multiply.
import {N8AOPass} from 'n8ao';
import * as THREE from 'three';
import {GTAOPass} from 'three/addons/postprocessing/GTAOPass.js';
import {SAOPass} from 'three/addons/postprocessing/SAOPass.js';
import {SSAOPass} from 'three/addons/postprocessing/SSAOPass.js';

function ssao({scene, camera, width, height}, values) {
  const pass = new SSAOPass(scene, camera, width, height, values['ssao-kernel-size']);
  pass.kernelRadius = values['ssao-kernel-radius'];
  pass.minDistance = values['ssao-min-distance'];
  pass.maxDistance = values['ssao-max-distance'];
  return pass;
}

function sao({scene, camera, width, height}, values) {
  const pass = new SAOPass(scene, camera, new THREE.Vector2(width, height));
  Object.assign(pass.params, {
    saoBias: values['sao-bias'],
    saoIntensity: values['sao-intensity'],
    saoScale: values['sao-scale'],
    saoKernelRadius: values['sao-kernel-radius'],
    saoMinResolution: values['sao-min-resolution'],
    saoBlur: values['sao-blur'],
    saoBlurRadius: values['sao-blur-radius'],
    saoBlurStdDev: values['sao-blur-std-dev'],
    saoBlurDepthCutoff: values['sao-blur-depth-cutoff'],
  });
  return pass;
}

function gtao({scene, camera, width, height}, values) {
  const pass = new GTAOPass(scene, camera, width, height);
  pass.blendIntensity = values['gtao-blend-intensity'];
  pass.updateGtaoMaterial({
    radius: values['gtao-radius'],
    distanceExponent: values['gtao-distance-exponent'],
    thickness: values['gtao-thickness'],
    distanceFallOff: values['gtao-distance-fall-off'],
    scale: values['gtao-scale'],
    samples: values['gtao-samples'],
    screenSpaceRadius: values['gtao-screen-space-radius'],
  });
  pass.updatePdMaterial({
    lumaPhi: values['gtao-pd-luma-phi'],
    depthPhi: values['gtao-pd-depth-phi'],
    normalPhi: values['gtao-pd-normal-phi'],
    radius: values['gtao-pd-radius'],
    radiusExponent: values['gtao-pd-radius-exponent'],
    rings: values['gtao-pd-rings'],
    samples: values['gtao-pd-samples'],
  });
  return pass;
}

// Its own image of the scene is all that it shades, so it shows the occlusion alone.
function n8ao({scene, camera, width, height}, values) {
  const pass = new N8AOPass(scene, camera, width, height);
  Object.assign(pass.configuration, {
    aoRadius: values['n8ao-radius'],
    aoSamples: values['n8ao-samples'],
    distanceFalloff: values['n8ao-distance-falloff'],
    intensity: values['n8ao-intensity'],
    denoiseSamples: values['n8ao-denoise-samples'],
    denoiseRadius: values['n8ao-denoise-radius'],
    denoiseIterations: values['n8ao-denoise-iterations'],
    aoTones: values['n8ao-tones'],
    biasOffset: values['n8ao-bias-offset'],
    biasMultiplier: values['n8ao-bias-multiplier'],
    screenSpaceRadius: values['n8ao-screen-space-radius'],
    halfRes: values['n8ao-half-res'],
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
