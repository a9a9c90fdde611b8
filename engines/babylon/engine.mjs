// Babylon.js in the page: a scene, and frames of it.
import {FreeCamera} from '@babylonjs/core/Cameras/freeCamera.js';
import {Camera} from '@babylonjs/core/Cameras/camera.js';
import {Constants} from '@babylonjs/core/Engines/constants.js';
import {Engine as BabylonEngine} from '@babylonjs/core/Engines/engine.js';
import {LoadAssetContainerAsync} from '@babylonjs/core/Loading/sceneLoader.js';
import {RenderTargetTexture} from '@babylonjs/core/Materials/Textures/renderTargetTexture.js';
import {Color4} from '@babylonjs/core/Maths/math.color.js';
import {Matrix, Quaternion, Vector3} from '@babylonjs/core/Maths/math.vector.js';
import {Scene} from '@babylonjs/core/scene.js';
import '@babylonjs/loaders/glTF/2.0/index.js';
import {check_size, check_webgl, renderer_of, seed_random, share_image, vector_image} from '/browser/page.mjs';
import {add_occlusion} from './ambient.mjs';
import {add_light} from './lights.mjs';
import {shown, what, whiten} from './materials.mjs';

const patience = 50_000;  // milliseconds for shaders to compile

function make_camera(scene, {kind, vertical_fov, half_height, near, far, world_from_camera}, aspect) {
  const camera = new FreeCamera('camera', Vector3.Zero(), scene);
  camera.minZ = near;
  camera.maxZ = far;
  camera.rotationQuaternion = Quaternion.Identity();
  // A camera of a right-handed scene looks along its own −Z, as that of glTF.
  Matrix.FromArray(world_from_camera).decompose(undefined, camera.rotationQuaternion, camera.position);
  if (kind === 'orthographic') {
    camera.mode = Camera.ORTHOGRAPHIC_CAMERA;
    Object.assign(camera, {orthoTop: half_height, orthoBottom: -half_height, orthoLeft: -half_height * aspect,
                           orthoRight: half_height * aspect});
  } else {
    camera.fov = vertical_fov;
  }
  return camera;
}

class Engine {
  constructor() {
    const canvas = document.createElement('canvas');
    this.babylon = new BabylonEngine(canvas, false, {stencil: false, audioEngine: false, useHighPrecisionFloats: true});
    this.gl = this.babylon._gl;
    this.renderer = renderer_of(this.gl);
  }

  async load({camera, light, bounds, width, height}) {
    this.scene?.dispose();
    check_size(this.babylon.getCaps().maxTextureSize, {width, height});
    this.babylon.setSize(width, height);
    const scene = new Scene(this.babylon);
    Object.assign(this, {scene, light, bounds, width, height, cover: undefined});
    scene.useRightHandedSystem = true;
    scene.clearColor = new Color4(0, 0, 0, 0);
    scene.ambientColor.set(0, 0, 0);
    scene.imageProcessingConfiguration.isEnabled = false;
    const container = await LoadAssetContainerAsync('/scene.glb', scene, {pluginExtension: '.glb'});
    for (const each of [...container.lights, ...container.cameras]) each.dispose();
    container.lights.length = 0;
    container.cameras.length = 0;
    container.addAllToScene();
    this.meshes = scene.meshes.filter((mesh) => mesh.getTotalVertices() > 0);
    whiten(this.meshes, scene);
    this.camera = make_camera(scene, camera, width / height);
    scene.activeCamera = this.camera;
    this.target = new RenderTargetTexture('target', {width, height}, scene, {
      generateMipMaps: false, type: Constants.TEXTURETYPE_FLOAT, format: Constants.TEXTUREFORMAT_RGBA,
      samplingMode: Constants.TEXTURE_NEAREST_SAMPLINGMODE, generateDepthBuffer: true});
    this.camera.outputRenderTarget = this.target;
    check_webgl(this.gl, 'load');
  }

  async ready(generator) {
    const late = new Promise((resolve, reject) => {
      setTimeout(() => reject(new Error('shaders did not compile in time')), patience);
    });
    await Promise.race([Promise.all([this.scene.whenReadyAsync(true), generator?.forceCompilationAsync()]), late]);
  }

  /** Draws the scene and reads it; with `times`, several frames, the last of which counts. */
  async draw(value, times = 1) {
    shown.value = value;
    const start = performance.now();
    for (let i = 0; i < times; ++i) this.scene.render();
    const pixels = await this.target.readPixels();
    return {pixels: new Float32Array(pixels.buffer, pixels.byteOffset, 4 * this.width * this.height),
            milliseconds: performance.now() - start};
  }

  async visibility(values) {
    const {scene, camera, meshes, light, bounds} = this;
    const shadow = add_light(scene, camera, meshes, light, bounds, values);
    try {
      await this.ready(shadow.generator);
      // The depths in view are read back from the frame before.
      return await this.draw(what.shadow, values.cascades && values['auto-calc-depth-bounds'] ? 4 : 1);
    } finally {
      shadow.dispose();
    }
  }

  async occlusion(values) {
    seed_random();
    const pipeline = add_occlusion(this.scene, this.camera, values);
    try {
      await this.ready();
      return await this.draw(what.white);
    } finally {
      pipeline.dispose();
    }
  }

  async render(outputs, values) {
    const images = {};
    let milliseconds = 0;
    if (this.cover === undefined) {
      await this.ready();
      this.cover = (await this.draw(what.position)).pixels;
    }
    const {cover} = this;
    const single = async (name, frame) => {
      milliseconds += frame.milliseconds;
      images[name] = share_image(frame.pixels, cover);
    };
    if (outputs.includes('visibility')) await single('visibility', await this.visibility(values));
    if (outputs.includes('ao')) await single('ao', await this.occlusion(values));
    if (outputs.includes('position')) images.position = vector_image(cover, cover);
    if (outputs.includes('normal')) {
      await this.ready();
      images.normal = vector_image((await this.draw(what.normal)).pixels, cover);
    }
    check_webgl(this.gl, 'render');
    return {images, milliseconds};
  }
}

export async function create() {
  return new Engine();
}
