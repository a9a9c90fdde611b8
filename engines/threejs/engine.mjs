// three.js in the page: a scene, and frames of it.
import * as THREE from 'three';
import {GLTFLoader} from 'three/addons/loaders/GLTFLoader.js';
import {check_size, check_webgl, renderer_of, seed_random, share_image, stopwatch, vector_image}
  from '/browser/page.mjs';
import {occlusion} from './ambient.mjs';
import {add_light} from './lights.mjs';
import {leave_csm, set_shadow_side, use_csm, whiten} from './materials.mjs';

const types = {basic: THREE.BasicShadowMap, pcf: THREE.PCFShadowMap, vsm: THREE.VSMShadowMap};
const least_light = 1e-4;  // of the frame without shadows, 1 where the sun stands overhead, for a quotient

function make_camera({kind, vertical_fov, half_height, near, far, world_from_camera}, aspect) {
  const camera = kind === 'orthographic'
    ? new THREE.OrthographicCamera(-half_height * aspect, half_height * aspect, half_height, -half_height, near, far)
    : new THREE.PerspectiveCamera(THREE.MathUtils.radToDeg(vertical_fov), aspect, near, far);
  new THREE.Matrix4().fromArray(world_from_camera).decompose(camera.position, camera.quaternion, camera.scale);
  camera.updateMatrixWorld(true);
  return camera;
}

// Everything but meshes goes: the request has the camera and the light.
function keep_meshes(root) {
  const others = [];
  root.traverse((object) => { if (object.isLight || object.isCamera) others.push(object); });
  for (const object of others) object.removeFromParent();
}

class Engine {
  constructor() {
    this.renderer_of_three = new THREE.WebGLRenderer({antialias: false, preserveDrawingBuffer: false});
    const three = this.renderer_of_three;
    three.setClearColor(0x000000, 0);
    three.toneMapping = THREE.NoToneMapping;
    three.shadowMap.enabled = true;
    three.info.autoReset = false;
    this.gl = three.getContext();
    this.renderer = renderer_of(this.gl);
  }

  unload() {
    this.target?.dispose();
    this.scene?.traverse((object) => {
      object.geometry?.dispose();
      object.material?.map?.dispose();
      object.material?.dispose();
    });
    this.scene = undefined;
  }

  async load({camera, light, bounds, width, height}) {
    this.unload();
    check_size(this.renderer_of_three.capabilities.maxTextureSize, {width, height});
    const {scene: root} = await new GLTFLoader().loadAsync('/scene.glb');
    keep_meshes(root);
    this.materials = whiten(root);
    this.scene = new THREE.Scene();
    this.scene.add(root);
    this.scene.updateMatrixWorld(true);
    this.camera = make_camera(camera, width / height);
    Object.assign(this, {light, bounds, width, height});
    this.renderer_of_three.setSize(width, height, false);
    this.target = new THREE.WebGLRenderTarget(width, height, {
      count: 3, type: THREE.FloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter});
    this.cover = undefined;
    check_webgl(this.gl, 'load');
  }

  draw() {
    this.renderer_of_three.setRenderTarget(this.target);
    this.renderer_of_three.render(this.scene, this.camera);
  }

  read(index, target = this.target) {
    const pixels = new Float32Array(4 * this.width * this.height);
    this.renderer_of_three.readRenderTargetPixels(target, 0, 0, this.width, this.height, pixels, undefined, index);
    return pixels;
  }

  // The shadow factor; where cascades are CSM's, light with shadows ÷ light without.
  visibility(values) {
    const {shadowMap} = this.renderer_of_three;
    if (values.type === 'vsm' && this.light.kind === 'point') throw new Error('three.js has no vsm for point lights');
    shadowMap.type = types[values.type];
    set_shadow_side(this.materials, values['shadow-side']);
    const {shadows, csm, remove} = add_light(this.scene, this.camera, this.light, this.bounds, values);
    try {
      if (csm === undefined) {
        this.draw();
        return this.read(0);
      }
      use_csm(this.materials, csm);
      this.draw();
      const lit = this.read(0);
      for (const shadow of shadows) Object.assign(shadow, {intensity: 0, autoUpdate: false});
      this.draw();
      const open = this.read(0);
      return lit.map((value, i) => (open[i] > least_light ? Math.min(1, value / open[i]) : 0));
    } finally {
      if (csm !== undefined) leave_csm(this.materials, csm);
      remove();
    }
  }

  async render(outputs, values) {
    const images = {};
    const watch = stopwatch();
    const factor = outputs.includes('visibility') ? await watch.time(() => this.visibility(values)) : undefined;
    if (factor === undefined && this.cover === undefined) this.draw();
    this.cover ??= this.read(1);
    const {cover} = this;
    if (factor) images.visibility = share_image(factor, cover);
    if (outputs.includes('position')) images.position = vector_image(cover, cover);
    if (outputs.includes('normal')) {
      this.draw();
      images.normal = vector_image(this.read(2), cover);
    }
    if (outputs.includes('ao')) {
      seed_random();
      images.ao = share_image(await watch.time(() => occlusion(this, values)), cover);
    }
    check_webgl(this.gl, 'render');
    return {images, milliseconds: watch.milliseconds};
  }
}

export async function create() {
  return new Engine();
}
