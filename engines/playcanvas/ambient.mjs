// Ambient occlusion of PlayCanvas: the image of CameraFrame's SSAO, which its materials and its composition multiply.
import * as pc from 'playcanvas';
import {settings_of} from '/browser/page.mjs';

/** RGBA of the occlusion, 1 where open, of the size of the scene's image. */
export async function read_occlusion({app, camera, width, height}, values) {
  const frame = new pc.CameraFrame(app, camera.camera);
  frame.rendering.renderFormats = [pc.PIXELFORMAT_RGBA16F];
  Object.assign(frame.ssao, {
    type: pc.SSAOTYPE_COMBINE,
    ...settings_of(values, 'ssao-', [
      'radius', 'samples', 'intensity', 'power', 'minAngle', 'scale', 'blurEnabled', 'randomize']),
  });
  frame.update();
  try {
    app.update(0);
    app.render();
    const {ssaoTexture: texture, renderTarget} = frame.renderPassCamera.ssaoPass;
    const bytes = await texture.read(0, 0, texture.width, texture.height, {renderTarget, immediate: true});
    return sample(bytes, texture.width, texture.height, width, height);
  } finally {
    frame.destroy();
  }
}

// Bilinear, as the materials read it.
function sample(bytes, width, height, out_width, out_height) {
  const step = bytes.length / (width * height);
  const clamp = (value, count) => Math.min(Math.max(value, 0), count - 1);
  const at = (x, y) => bytes[step * (clamp(y, height) * width + clamp(x, width))] / 255;
  const out = new Float32Array(4 * out_width * out_height);
  for (let y = 0; y < out_height; ++y) {
    const v = (y + 0.5) * height / out_height - 0.5;
    const row = Math.floor(v);
    for (let x = 0; x < out_width; ++x) {
      const u = (x + 0.5) * width / out_width - 0.5;
      const column = Math.floor(u);
      const low = at(column, row) * (1 - u + column) + at(column + 1, row) * (u - column);
      const high = at(column, row + 1) * (1 - u + column) + at(column + 1, row + 1) * (u - column);
      out.fill(low * (1 - v + row) + high * (v - row), 4 * (y * out_width + x), 4 * (y * out_width + x) + 4);
    }
  }
  return out;
}
