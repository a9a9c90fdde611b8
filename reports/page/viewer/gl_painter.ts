// Paints layers with WebGL2: values stay float textures, the fragment shader turns them into colours (pixels.ts has the
// same formulas).
import {Layer, Run} from './data';
import {dot_of, is_of_errors, Look, scale_of, table_of} from './pixels';

// In device pixels from the top left.
export interface Rect {
  x: number;
  y: number;
  width: number;
  height: number;
}
// Which stored pixel lies at the middle of the pane, and device pixels per stored pixel.
export interface Placement {
  pane: Rect;
  x: number;
  y: number;
  scale: number;
}
export interface Painter {
  readonly name: string;
  use(run: Run): void; // the run whose layers are painted from now on
  start(): void;
  // Paints the part of the layer that lies within clip.
  paint(layer: Layer, look: Look, placement: Placement, clip: Rect): void;
}

const vertex_text = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`;

const fragment_text = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D values;
uniform sampler2D table;
uniform sampler2D base; // the picture below errors and causes
uniform bool has_base;
uniform float dots;     // device pixels that a wrong pixel covers at least; 0: its own
uniform vec2 size;
uniform vec2 middle;    // of the pane, device pixels from the bottom left
uniform vec2 center;    // the stored pixel there
uniform float scale;    // device pixels per stored pixel
uniform vec2 ends;      // of the layer's scale
uniform float gain;
uniform int kind;       // 0 scalar, 1 category, 2 colour, 3 vector, 4 error
uniform float entries;  // of the table
out vec4 color;

vec3 to_srgb(vec3 linear) {
  vec3 x = clamp(linear, 0.0, 1.0);
  return mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
}

vec3 entry(float number) { return texelFetch(table, ivec2(int(number), 0), 0).rgb; }

bool is_error() { return kind == 1 || kind == 4; }

// As strength_of() has it.
float strength_at(vec2 at) {
  float value = texelFetch(values, ivec2(at), 0).r;
  if (kind == 4) return min(1.0, abs(value) / ends.y);
  vec3 shown = value < entries ? entry(value) : vec3(1.0, 0.0, 1.0);
  return shown.r == shown.g && shown.g == shown.b ? 0.0 : 1.0;
}

vec3 plain_color_at(vec2 at) {
  vec3 value = texelFetch(values, ivec2(at), 0).rgb;
  if (value.r != value.r) return vec3(1.0, 0.0, 1.0);
  if (kind == 1) return value.r < entries ? entry(value.r) : vec3(1.0, 0.0, 1.0);
  if (kind == 2) return to_srgb(value * gain);
  if (kind == 3) return clamp(0.5 + 0.5 * value, 0.0, 1.0);
  float share = ends.x == ends.y ? 0.5 : clamp((value.r - ends.x) / (ends.y - ends.x), 0.0, 1.0);
  return entry(floor(share * (entries - 1.0) + 0.5));
}

vec3 color_at(vec2 at) {
  vec3 shown = plain_color_at(at);
  if (!has_base || !is_error() || shown == vec3(1.0, 0.0, 1.0)) return shown;
  vec3 picture = texelFetch(base, ivec2(at), 0).rgb;
  float grey = 0.6 + 0.4 * to_srgb(vec3(dot(picture, vec3(0.2126, 0.7152, 0.0722)))).r;
  return shown * mix(grey, 1.0, strength_at(at));
}

// The wrong pixel whose dot covers the place: the one of the largest error, of equal ones the nearest. Wrong is what
// has half the scale, as in regions.ts. (-1, -1) if there is none.
vec2 dot_at(vec2 at) {
  float reach = 0.5 * dots / scale;
  vec2 first = max(ceil(at - reach - 0.5), vec2(0.0));
  vec2 last = min(floor(at + reach - 0.5), size - 1.0);
  vec2 found = vec2(-1.0);
  float most = 0.5;
  float least = 1e9;
  for (float y = first.y; y <= last.y; ++y) {
    for (float x = first.x; x <= last.x; ++x) {
      float strength = strength_at(vec2(x, y));
      if (!(strength >= most)) continue;
      float distance_to = distance(at, vec2(x, y) + 0.5);
      if (strength == most && distance_to >= least) continue;
      most = strength;
      least = distance_to;
      found = vec2(x, y);
    }
  }
  return found;
}

void main() {
  vec2 at = center + (gl_FragCoord.xy - middle) * vec2(1.0, -1.0) / scale;
  if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, size))) discard;
  if (is_error() && scale < dots) {
    vec2 found = dot_at(at);
    if (found.x >= 0.0) {
      color = vec4(color_at(found), 1.0);
      return;
    }
  }
  if (scale >= 1.0) {
    color = vec4(color_at(at), 1.0);
    return;
  }
  // A reduced image is the mean of colours, so that single wrong pixels stay visible.
  int steps = min(int(ceil(1.0 / scale)), 8);
  vec3 sum = vec3(0.0);
  for (int y = 0; y < steps; ++y) {
    for (int x = 0; x < steps; ++x) {
      vec2 offset = ((vec2(x, y) + 0.5) / float(steps) - 0.5) / scale;
      sum += color_at(clamp(at + offset, vec2(0.0), size - 1.0));
    }
  }
  color = vec4(sum / float(steps * steps), 1.0);
}`;

const kinds: Record<string, number> = {category: 1, color: 2, vector: 3, error: 4};

function compile(gl: WebGL2RenderingContext): WebGLProgram {
  const program = gl.createProgram()!;
  for (const [type, text] of [[gl.VERTEX_SHADER, vertex_text], [gl.FRAGMENT_SHADER, fragment_text]] as const) {
    const shader = gl.createShader(type)!;
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error('WebGL: the shader does not link');
  return program;
}

function make_texture(gl: WebGL2RenderingContext): WebGLTexture {
  const texture = gl.createTexture()!;
  gl.bindTexture(gl.TEXTURE_2D, texture);
  for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
  for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
  return texture;
}

// Red, green and blue of three planes, one after the other.
function interleave(planes: Float32Array[]): Float32Array {
  const values = new Float32Array(3 * planes[0].length);
  planes.forEach((plane, c) => plane.forEach((value, i) => (values[3 * i + c] = value)));
  return values;
}

// Null where WebGL2 is missing or its textures are too small for the images.
export function make_gl_painter(canvas: HTMLCanvasElement, first: Run): Painter | null {
  let run = first;
  const gl = canvas.getContext('webgl2', {alpha: true, antialias: false, preserveDrawingBuffer: true});
  if (!gl || gl.getParameter(gl.MAX_TEXTURE_SIZE) < Math.max(run.columns, run.rows)) return null;
  const program = compile(gl);
  const place = new Map(['values', 'table', 'size', 'middle', 'center', 'scale', 'ends', 'gain', 'kind', 'entries', 'base', 'has_base',
                         'dots'].map(
    (name) => [name, gl.getUniformLocation(program, name)]));
  const textures = new Map<Layer, {texture: WebGLTexture; version: number}>();
  const tables = new Map<Uint8Array | Layer, WebGLTexture>();
  gl.bindVertexArray(gl.createVertexArray());
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);

  function bind_values(layer: Layer, unit: number): void {
    gl!.activeTexture(unit);
    const known = textures.get(layer);
    if (known) gl!.bindTexture(gl!.TEXTURE_2D, known.texture);
    if (known?.version === layer.version) return;
    const texture = known?.texture ?? make_texture(gl!);
    const is_scalar = layer.planes.length === 1;
    gl!.texImage2D(gl!.TEXTURE_2D, 0, is_scalar ? gl!.R32F : gl!.RGB32F, run.columns, run.rows, 0,
                   is_scalar ? gl!.RED : gl!.RGB, gl!.FLOAT, is_scalar ? layer.planes[0] : interleave(layer.planes));
    textures.set(layer, {texture, version: layer.version});
  }

  function bind_table(layer: Layer, look: Look): number {
    const is_category = layer.kind === 'category';
    const colors = is_category ? Uint8Array.from(layer.categories.flatMap((each) => each.color))
      : table_of(layer, look, run);
    const key = is_category ? layer : colors;
    gl!.activeTexture(gl!.TEXTURE1);
    const known = tables.get(key);
    if (known) {
      gl!.bindTexture(gl!.TEXTURE_2D, known);
    } else {
      tables.set(key, make_texture(gl!));
      gl!.texImage2D(gl!.TEXTURE_2D, 0, gl!.RGB8, colors.length / 3, 1, 0, gl!.RGB, gl!.UNSIGNED_BYTE, colors);
    }
    return colors.length / 3;
  }

  return {
    name: 'WebGL2',
    use(next) {
      for (const {texture} of textures.values()) gl.deleteTexture(texture);
      textures.clear();
      run = next;
    },
    start() {
      gl.disable(gl.SCISSOR_TEST);
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT);
    },
    paint(layer, look, {pane, x, y, scale}, clip) {
      gl.useProgram(program);
      const base = is_of_errors(layer) ? look.base : null;
      bind_values(base ?? layer, gl.TEXTURE2);
      bind_values(layer, gl.TEXTURE0);
      const entries = bind_table(layer, look);
      gl.enable(gl.SCISSOR_TEST);
      gl.scissor(clip.x, canvas.height - clip.y - clip.height, Math.max(0, clip.width), Math.max(0, clip.height));
      gl.uniform1i(place.get('values')!, 0);
      gl.uniform1i(place.get('table')!, 1);
      gl.uniform1i(place.get('base')!, 2);
      gl.uniform1i(place.get('has_base')!, Number(base !== null));
      gl.uniform1f(place.get('dots')!, dot_of(layer, look));
      gl.uniform2f(place.get('size')!, run.columns, run.rows);
      gl.uniform2f(place.get('middle')!, pane.x + pane.width / 2, canvas.height - pane.y - pane.height / 2);
      gl.uniform2f(place.get('center')!, x, y);
      gl.uniform1f(place.get('scale')!, scale);
      gl.uniform2f(place.get('ends')!, ...scale_of(layer, look));
      gl.uniform1f(place.get('gain')!, 2 ** look.exposure);
      gl.uniform1i(place.get('kind')!, kinds[layer.kind] ?? 0);
      gl.uniform1f(place.get('entries')!, entries);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    },
  };
}
