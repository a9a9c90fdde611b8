// Colours and texts of single pixels. The GL painter has the same formulas in its shader; a test compares both.
import {Color, Layer, Run} from './data';
import {MapName} from './state';

export interface Look {
  exposure: number; // stops
  map: MapName;
  base: Layer | null; // the picture below errors and causes, in grey
  dot: number; // see dot_of
}

export const not_a_number: Color = [255, 0, 255];
const table_size = 1025;

// The values at the two ends of the layer's scale. Exposure brightens colours and narrows the scale of all others.
export function scale_of(layer: Layer, look: Look): [number, number] {
  const [first, last] = layer.range;
  const factor = 2 ** -look.exposure;
  return layer.kind === 'error' ? [first * factor, last * factor] : [first, first + (last - first) * factor];
}

export function table_of(layer: Layer, look: Look, run: Run): Uint8Array {
  const own = layer.kind === 'error' ? 'diverging' : 'sequential';
  return run.maps[look.map === 'automatic' ? own : look.map];
}

// IEC 61966-2-1.
function srgb_byte(linear: number): number {
  const x = Math.min(1, Math.max(0, linear));
  return Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
}

// A kind that shows what is wrong, and where nothing is, the picture below.
export const is_of_errors = (layer: Layer) => layer.kind === 'error' || layer.kind === 'category';

// Device pixels that a wrong pixel of this layer covers at least; 0: as many as it has. As in figures, a map in which
// more than half of the pixels have an error, as of ambient occlusion, shows them as they are.
const single_errors = new WeakMap<Layer, boolean>();
export function dot_of(layer: Layer, look: Look): number {
  if (!is_of_errors(layer)) return 0;
  if (layer.kind === 'category') return look.dot;
  let is_single = single_errors.get(layer);
  if (is_single === undefined) {
    const values = layer.planes[0];
    let right = 0;
    for (const value of values) right += Number(!(Math.abs(value) > 0));
    is_single = 2 * right >= values.length;
    single_errors.set(layer, is_single);
  }
  return is_single ? look.dot : 0;
}

export const is_grey = ([r, g, b]: Color) => r === g && g === b;

// 0 is right, 1 the end of the scale. Categories that are no error are grey.
export function strength_of(layer: Layer, i: number, look: Look): number {
  const value = layer.planes[0][i];
  if (layer.kind === 'category') return is_grey(layer.categories[value]?.color ?? not_a_number) ? 0 : 1;
  const [, end] = scale_of(layer, look);
  return Math.min(1, Math.abs(value) / end);
}

// The lightest part of the greys, so that colours stay distinct on all of it.
const darkest_base = 0.6;

export function color_of(layer: Layer, i: number, look: Look, run: Run): Color {
  const color = plain_color_of(layer, i, look, run);
  if (!look.base || !is_of_errors(layer) || Number.isNaN(layer.planes[0][i])) return color;
  const grey = darkest_base + ((1 - darkest_base) * srgb_byte(luminance(look.base, i))) / 255;
  const strength = strength_of(layer, i, look);
  return color.map((each) => Math.round(each * (grey + (1 - grey) * strength))) as Color;
}

function plain_color_of(layer: Layer, i: number, look: Look, run: Run): Color {
  const value = layer.planes[0][i];
  if (Number.isNaN(value)) return not_a_number;
  if (layer.kind === 'category') return layer.categories[value]?.color ?? not_a_number;
  if (layer.kind === 'color') return layer.planes.map((plane) => srgb_byte(plane[i] * 2 ** look.exposure)) as Color;
  if (layer.kind === 'vector') {
    return layer.planes.map((plane) => Math.round(255 * Math.min(1, Math.max(0, 0.5 + 0.5 * plane[i])))) as Color;
  }
  const [first, last] = scale_of(layer, look);
  const share = last === first ? 0.5 : Math.min(1, Math.max(0, (value - first) / (last - first)));
  const entry = 3 * Math.round(share * (table_size - 1));
  const table = table_of(layer, look, run);
  return [table[entry], table[entry + 1], table[entry + 2]];
}

export function luminance(layer: Layer, i: number): number {
  const [r, g, b] = layer.planes;
  return layer.planes.length === 3 ? 0.2126 * r[i] + 0.7152 * g[i] + 0.0722 * b[i] : r[i];
}

// Three digits are what half floats hold.
export function number_text(value: number): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? 'no value' : value > 0 ? 'infinite' : '−infinite';
  if (value === 0) return '0';
  const digits = Math.abs(value) >= 1000 ? value.toFixed(0) : String(Number(value.toPrecision(4)));
  return digits.replace('-', '−');
}

// Two digits of an uncertainty.
const is_uncertainty = (layer: Layer) => /^truth_(ao|image|visibility)_standard_error/.test(layer.name);
export const layer_number = (layer: Layer, value: number) =>
  number_text(is_uncertainty(layer) ? Number(value.toPrecision(2)) : value);

export function value_text(layer: Layer, i: number): string {
  if (layer.kind === 'category') return layer.categories[layer.planes[0][i]]?.name ?? 'no value';
  const text = layer.planes.map((plane) => layer_number(layer, plane[i])).join(', ');
  return layer.unit ? `${text} ${layer.unit}` : text;
}

// a − b; of colours the difference of luminances, of categories where they differ.
export function difference(a: Layer, b: Layer): Layer {
  const values = new Float32Array(a.planes[0].length);
  const is_category = a.kind === 'category' || b.kind === 'category';
  for (let i = 0; i < values.length; ++i) {
    const change = luminance(a, i) - luminance(b, i);
    values[i] = is_category ? Number(change !== 0) : change;
  }
  const reach = Math.max(...[a, b].map((layer) => {
    return layer.kind === 'number' || layer.kind === 'error' ? Math.max(...layer.range.map(Math.abs)) : 1;
  }));
  return {name: `${a.name} − ${b.name}`, title: `${a.title} − ${b.title}`, group: a.group, role: 'other', kind: 'error',
          unit: a.unit === b.unit ? a.unit : '', range: [-reach, reach], reach, categories: [], planes: [values], version: 0};
}
