// Filament in the page: a scene, and frames of it.
import {check_webgl, renderer_of} from '/browser/page.mjs';
import {make_light} from './lights.mjs';
import {whiten} from './materials.mjs';
import {load_filament} from './package_loader.mjs';
import {ReadBack} from './read_back.mjs';

const usage = {color: 1, depth: 2, sampled: 16};  // TextureUsage, which the package's script does not name

// Positions from depth, which Filament reverses: a perspective camera has its far plane at infinity.
function positions_of(depth, {kind, vertical_fov, half_height, near, far, world_from_camera: m}, width, height) {
  const out = new Float32Array(3 * width * height).fill(NaN);
  const half = kind === 'orthographic' ? half_height : Math.tan(0.5 * vertical_fov);
  for (let i = 0; i < width * height; ++i) {
    const value = depth[4 * i];
    if (value === 0) continue;
    const z = kind === 'orthographic' ? near + (1 - value) * (far - near) : near / value;
    const scale = kind === 'orthographic' ? half : half * z;
    const x = (2 * (i % width + 0.5) / width - 1) * scale * width / height;
    const y = (2 * (Math.floor(i / width) + 0.5) / height - 1) * scale;
    for (let c = 0; c < 3; ++c) out[3 * i + c] = m[c] * x + m[4 + c] * y - m[8 + c] * z + m[12 + c];
  }
  return out;
}

const rgb_of = (pixels) => Float32Array.from({length: 3 * pixels.length / 4}, (_, i) => pixels[4 * Math.floor(i / 3) + i % 3]);

class Engine {
  constructor(filament) {
    const canvas = document.createElement('canvas');
    this.filament = filament;
    this.gl = canvas.getContext('webgl2', {majorVersion: 2, minorVersion: 0, antialias: false, depth: true, alpha: false});
    this.read_back = new ReadBack(this.gl);
    this.engine = filament.Engine.create(canvas);
    this.renderer = renderer_of(this.gl);
    const {engine} = this;
    this.drawer = engine.createRenderer();
    this.drawer.setClearOptions({clearColor: [0, 0, 0, 0], clear: true});
    this.view = engine.createView();
    this.view.setPostProcessingEnabled(false);
    this.view.setAntiAliasing(filament.View$AntiAliasing.NONE);
    this.camera = engine.createCamera(filament.EntityManager.get().create());
    this.camera.setExposureDirect(1);
    this.view.setCamera(this.camera);
    this.loader = engine.createAssetLoader();
  }

  set_camera({kind, vertical_fov, half_height, near, far, world_from_camera}, aspect) {
    const {PERSPECTIVE, ORTHO} = this.filament.Camera$Projection;
    const half = kind === 'orthographic' ? half_height : near * Math.tan(0.5 * vertical_fov);
    this.camera.setProjection(kind === 'orthographic' ? ORTHO : PERSPECTIVE, -half * aspect, half * aspect, -half, half,
                              near, far);
    this.camera.setModelMatrix(world_from_camera);
  }

  set_target(width, height) {
    const {filament, engine} = this;
    const {RGBA32F, DEPTH32F} = filament.Texture$InternalFormat;
    const texture = (format, use) => filament.Texture.Builder().width(width).height(height).levels(1)
      .sampler(filament.Texture$Sampler.SAMPLER_2D).format(format).usage(use | usage.sampled).build(engine);
    if (this.target) {
      engine.destroyRenderTarget(this.target);
      for (const each of this.textures) engine.destroyTexture(each);
    }
    this.textures = [texture(RGBA32F, usage.color), texture(DEPTH32F, usage.depth)];
    const {COLOR, DEPTH} = filament.RenderTarget$AttachmentPoint;
    this.target = filament.RenderTarget.Builder().texture(COLOR, this.textures[0]).texture(DEPTH, this.textures[1])
      .build(engine);
    engine.execute();
    this.color = this.read_back.last(this.gl.RGBA32F);
    this.depth = this.read_back.last(this.gl.DEPTH_COMPONENT32F);
    this.view.setRenderTarget(this.target);
    this.view.setViewport([0, 0, width, height]);
  }

  async load_asset(bytes) {
    const asset = this.loader.createAsset(whiten(bytes));
    if (!asset) throw new Error('Filament cannot read the scene');
    await new Promise((resolve) => { asset.loadResources(resolve, null, null, 1); });
    const scene = this.engine.createScene();
    scene.addEntities(asset.getEntities());
    return {asset, scene};
  }

  async load({camera, light, bounds, width, height}) {
    const limit = this.gl.getParameter(this.gl.MAX_TEXTURE_SIZE);
    if (Math.max(width, height) > limit) throw new Error(`an image may have at most ${limit} x ${limit} pixels here`);
    if (this.loaded) {
      this.engine.destroyScene(this.loaded.scene);
      this.loader.destroyAsset(this.loaded.asset);
      this.loaded = undefined;
    }
    this.loaded = await this.load_asset(new Uint8Array(await (await fetch('/scene.glb')).arrayBuffer()));
    Object.assign(this, {light, bounds, width, height, request_camera: camera});
    this.set_camera(camera, width / height);
    this.set_target(width, height);
    check_webgl(this.gl, 'load');
  }

  /** Draws and reads the colours. */
  draw(scene) {
    this.view.setScene(scene);
    const start = performance.now();
    this.drawer.renderStandaloneView(this.view);  // beginFrame() would skip frames
    this.engine.execute();
    const pixels = this.read_back.color(this.color, this.width, this.height);
    return {pixels, milliseconds: performance.now() - start};
  }

  shadows(values) {
    const {filament, engine, loaded: {scene}} = this;
    const entity = make_light(filament, engine, this.light, this.bounds, values);
    scene.addEntity(entity);
    try {
      const lit = this.draw(scene);
      const lights = engine.getLightManager();
      const instance = lights.getInstance(entity);
      lights.setShadowCaster(instance, false);
      instance.delete();
      return {lit, unshadowed: this.draw(scene)};
    } finally {
      scene.remove(entity);
      engine.destroyEntity(entity);
    }
  }

  async render(outputs, values) {
    const images = {};
    let milliseconds = 0;
    if (outputs.includes('lit') || outputs.includes('unshadowed')) {
      const frames = this.shadows(values);
      for (const [name, {pixels}] of Object.entries(frames)) images[name] = {channels: 3, pixels: rgb_of(pixels)};
      milliseconds = frames.lit.milliseconds;
    }
    if (outputs.includes('position')) {
      if (milliseconds === 0) milliseconds = this.draw(this.loaded.scene).milliseconds;
      const depth = this.read_back.depth(this.depth, this.width, this.height);
      images.position = {channels: 3, pixels: positions_of(depth, this.request_camera, this.width, this.height)};
    }
    check_webgl(this.gl, 'render');
    return {images, milliseconds};
  }
}

export async function create() {
  return new Engine(await load_filament());
}
