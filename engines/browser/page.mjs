// Runs in the page: passes requests of the host to the engine's module, and hands its pixels over in pieces of text.
// The module exports create(), which gives {renderer, gl, load(request), render(outputs, parameters)}.

// The engine's own messages become warnings of the reply; each is kept once.
const messages = new Set();
for (const level of ['warn', 'error']) {
  console[level] = (...words) => {
    const text = words.map(String).join(' ').replace(/\s+/g, ' ').slice(0, 300);
    if (messages.size < 20) messages.add(text);
  };
}
// The work's result; a failure also quotes what the engine said first.
async function with_messages(work) {
  try {
    return await work();
  } catch (error) {
    const [first] = take_messages();
    throw first === undefined ? error : new Error(`${error?.message ?? error}; ${first}`);
  }
}
function take_messages() {
  const taken = [...messages];
  messages.clear();
  return taken;
}

// Engines draw random numbers for sample patterns; a frame must not depend on what was drawn before.
export function seed_random(seed = 1) {
  let state = seed >>> 0;
  Math.random = () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 4294967296;
  };
}

function to_base64(bytes) {
  return new Promise((resolve, reject) => {
    const reader = new FileReader();
    reader.onload = () => resolve(reader.result.slice(reader.result.indexOf(',') + 1));
    reader.onerror = () => reject(reader.error);
    reader.readAsDataURL(new Blob([bytes]));
  });
}

/** Throws when WebGL reports an error or has lost its context, which is how the lack of memory shows. */
export function check_webgl(gl, what) {
  if (gl.isContextLost()) throw new Error(`${what}: WebGL has lost its context (out of memory?)`);
  const codes = new Set();
  for (let code = gl.getError(); code !== gl.NO_ERROR && codes.size < 8; code = gl.getError()) codes.add(code);
  if (codes.has(gl.OUT_OF_MEMORY)) throw new Error(`${what}: WebGL is out of memory`);
  const names = [...codes].map((code) => `0x${code.toString(16)}`);
  if (names.length > 0) throw new Error(`${what}: WebGL error ${names.join(', ')}`);
}

/** The driver's name, as the browser reports it. */
export function renderer_of(gl) {
  const extension = gl.getExtension('WEBGL_debug_renderer_info');
  return String(gl.getParameter(extension ? extension.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
}

/** Settings of an engine under its own names: {camelName: the value of 'prefix-camel-name'} for each name. */
export const settings_of = (values, prefix, names) => Object.fromEntries(names.map((name) =>
  [name, values[prefix + name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`)]]));

/** Throws for an image that the engine cannot draw. */
export function check_size(limit, {width, height}) {
  if (Math.max(width, height) > limit) throw new Error(`an image may have at most ${limit} x ${limit} pixels here`);
}

/**
 * Selects channels of an RGBA float image, rows as WebGL has them, from the bottom. `pixels`: 4 floats each.
 * Where `cover` (4 floats each, the last one is 0 where nothing is seen) is given, `empty` stands for the background.
 */
export function channels_of(pixels, channels, {cover, empty = NaN, first = 0} = {}) {
  const count = pixels.length / 4;
  const out = new Float32Array(count * channels);
  for (let i = 0; i < count; ++i) {
    const is_empty = cover !== undefined && cover[4 * i + 3] === 0;
    for (let c = 0; c < channels; ++c) out[i * channels + c] = is_empty ? empty : pixels[4 * i + first + c];
  }
  return out;
}

/** Images of a frame: shares of light, open where nothing is seen, and positions or normals. */
export const share_image = (pixels, cover) => ({channels: 1, pixels: channels_of(pixels, 1, {cover, empty: 1})});
export const vector_image = (pixels, cover) => ({channels: 3, pixels: channels_of(pixels, 3, {cover})});

/** {milliseconds, time(work)}: the sum over all works, of which each one's result is given. */
export function stopwatch() {
  return {
    milliseconds: 0,
    async time(work) {
      const start = performance.now();
      const result = await work();
      this.milliseconds += performance.now() - start;
      return result;
    },
  };
}

export function serve(import_engine) {
  let engine;
  let images = {};
  globalThis.umbrameter = {
    async start() {
      engine = await (await import_engine()).create();
      return {renderer: engine.renderer};
    },
    // Whether the engine can draw no more; a new page can.
    is_lost: () => engine === undefined || engine.gl.isContextLost(),
    async load(request) {
      take_messages();
      images = {};
      await with_messages(() => engine.load(request));
      return {warnings: take_messages()};
    },
    async render(outputs, parameters) {
      take_messages();
      const frame = await with_messages(() => engine.render(outputs, parameters));
      images = frame.images;
      const sizes = {};
      for (const [name, {channels, pixels}] of Object.entries(images)) {
        sizes[name] = {channels, bytes: pixels.byteLength};
      }
      return {images: sizes, milliseconds: frame.milliseconds, warnings: take_messages()};
    },
    // Bytes of an image of the last frame, as base64.
    take(name, start, end) {
      const {pixels} = images[name];
      return to_base64(new Uint8Array(pixels.buffer, pixels.byteOffset + start, end - start));
    },
  };
}
