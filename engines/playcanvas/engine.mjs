// PlayCanvas in the page: a scene, and frames of it.
import * as pc from 'playcanvas';
import {check_size, check_webgl, renderer_of, seed_random, share_image, stopwatch, vector_image}
  from '/browser/page.mjs';
import {read_occlusion} from './ambient.mjs';
import {add_light} from './lights.mjs';
import {what, whiten} from './materials.mjs';

async function make_app(canvas) {
  const options = new pc.AppOptions();
  options.graphicsDevice = await pc.createGraphicsDevice(canvas, {
    deviceTypes: [pc.DEVICETYPE_WEBGL2], antialias: false, stencil: false});
  options.componentSystems = [pc.RenderComponentSystem, pc.CameraComponentSystem, pc.LightComponentSystem];
  options.resourceHandlers = [pc.TextureHandler, pc.ContainerHandler];
  const app = new pc.AppBase(canvas);
  app.init(options);
  app.setCanvasResolution(pc.RESOLUTION_FIXED, 16, 16);
  app.scene.ambientLight = new pc.Color(0, 0, 0);
  app.scene.exposure = 1;
  return app;
}

function make_camera(app, {kind, vertical_fov, half_height, near, far, world_from_camera}, target) {
  const entity = new pc.Entity('camera');
  entity.addComponent('camera', {
    projection: kind === 'orthographic' ? pc.PROJECTION_ORTHOGRAPHIC : pc.PROJECTION_PERSPECTIVE,
    fov: (vertical_fov ?? 1) * 180 / Math.PI,
    orthoHeight: half_height ?? 1,
    nearClip: near, farClip: far,
    clearColor: new pc.Color(0, 0, 0, 0),
    toneMapping: pc.TONEMAP_NONE,
    gammaCorrection: pc.GAMMA_NONE,
    renderTarget: target,
  });
  const matrix = new pc.Mat4().set(world_from_camera);
  entity.setPosition(matrix.getTranslation());
  entity.setRotation(new pc.Quat().setFromMat4(matrix));
  app.root.addChild(entity);
  return entity;
}

function make_target(device, width, height) {
  const color = new pc.Texture(device, {
    name: 'target', width, height, format: pc.PIXELFORMAT_RGBA32F, mipmaps: false, minFilter: pc.FILTER_NEAREST,
    magFilter: pc.FILTER_NEAREST, addressU: pc.ADDRESS_CLAMP_TO_EDGE, addressV: pc.ADDRESS_CLAMP_TO_EDGE});
  return new pc.RenderTarget({colorBuffer: color, depth: true, samples: 1});
}

function load_scene(app) {
  return new Promise((resolve, reject) => {
    const asset = new pc.Asset('scene', 'container', {url: '/scene.glb', filename: 'scene.glb'});
    asset.once('load', () => resolve(asset));
    asset.once('error', (error) => reject(new Error(`scene: ${error}`)));
    app.assets.add(asset);
    app.assets.load(asset);
  });
}

class Engine {
  async start() {
    this.app = await make_app(document.createElement('canvas'));
    this.gl = this.app.graphicsDevice.gl;
    this.renderer = renderer_of(this.gl);
    return this;
  }

  unload() {
    const {app, asset} = this;
    if (asset === undefined) return;
    this.root.destroy();
    this.camera.destroy();
    this.target.destroyTextureBuffers();
    this.target.destroy();
    asset.unload();
    app.assets.remove(asset);
    this.asset = undefined;
  }

  // Clustered lighting that was turned off cannot be turned on again, so the engine starts once more.
  async use_clusters(is_on) {
    if (is_on && !this.app.scene.clusteredLightingEnabled) {
      this.unload();
      this.app.destroy();
      await this.start();
      await this.load(this.request);
    }
    this.app.scene.clusteredLightingEnabled = is_on;
  }

  async load(request) {
    const {camera, light, bounds, width, height} = request;
    const {app} = this;
    this.unload();
    check_size(app.graphicsDevice.maxTextureSize, request);
    app.setCanvasResolution(pc.RESOLUTION_FIXED, width, height);
    this.asset = await load_scene(app);
    this.root = this.asset.resource.instantiateRenderEntity();
    const others = ['light', 'camera'].flatMap((kind) => this.root.findComponents(kind));
    for (const {entity} of others) entity.destroy();
    whiten(this.root, light.kind === 'directional');
    app.root.addChild(this.root);
    this.target = make_target(app.graphicsDevice, width, height);
    this.camera = make_camera(app, camera, this.target);
    Object.assign(this, {request, light, bounds, width, height, cover: undefined});
    check_webgl(this.gl, 'load');
  }

  draw(value) {
    const {app, target, width, height} = this;
    app.graphicsDevice.scope.resolve('shown').setValue(value);
    app.update(0);
    app.render();
    return target.colorBuffer.read(0, 0, width, height, {renderTarget: target, immediate: true});
  }

  async visibility(values) {
    const {light, bounds} = this;
    await this.use_clusters(values['clustered-lighting'] || light.kind === 'directional');
    const entity = add_light(this.app, light, bounds, values);
    try {
      return await this.draw(what.shadow);
    } finally {
      entity.destroy();
    }
  }

  async render(outputs, values) {
    const images = {};
    const watch = stopwatch();
    const factor = outputs.includes('visibility') ? await watch.time(() => this.visibility(values)) : undefined;
    this.cover ??= await this.draw(what.position);
    const {cover} = this;
    if (factor !== undefined) images.visibility = share_image(factor, cover);
    if (outputs.includes('ao')) {
      seed_random();
      images.ao = share_image(await watch.time(() => read_occlusion(this, values)), cover);
    }
    if (outputs.includes('position')) images.position = vector_image(cover, cover);
    if (outputs.includes('normal')) images.normal = vector_image(await this.draw(what.normal), cover);
    check_webgl(this.gl, 'render');
    return {images, milliseconds: watch.milliseconds};
  }
}

export async function create() {
  return new Engine().start();
}
