// What the viewer shows, and its form in the fragment of the page's address, so that a link opens the same view.
import {Run} from './data';

export type Mode = 'grid' | 'single' | 'wipe' | 'difference' | 'side';
export const modes: Mode[] = ['grid', 'single', 'wipe', 'difference', 'side'];
export type MapName = 'automatic' | 'sequential' | 'diverging';

export interface State {
  mode: Mode;
  group: string;
  a: string; // names of layers
  b: string;
  flipped: boolean; // single shows b
  zoom: number; // CSS pixels per stored pixel; 0 fits the image into its pane
  x: number; // centre of the view, in stored pixels
  y: number;
  exposure: number; // stops; of numbers it narrows the scale
  map: MapName;
  plain: boolean; // errors and causes without the picture below them, wrong pixels in their own size
  wipe: number; // 0 to 1 across the pane
  pixel: [number, number] | null; // pinned for the inspector, in stored pixels
}

export function groups_of(run: Run): string[] {
  return [...new Set(run.layers.map((layer) => layer.group))];
}

// Reference and technique of the group, or its first two layers.
export function default_pair(run: Run, group: string): [string, string] {
  const layers = run.layers.filter((layer) => layer.group === group);
  const a = layers.find((layer) => layer.role === 'reference') ?? layers[0];
  const b = layers.find((layer) => layer.role === 'technique' && layer !== a) ?? layers.find((layer) => layer !== a) ?? a;
  return [a.name, b.name];
}

export function initial_state(run: Run): State {
  const group = groups_of(run)[0];
  const [a, b] = default_pair(run, group);
  return {mode: 'grid', group, a, b, flipped: false, zoom: 0, x: run.columns / 2, y: run.rows / 2, exposure: 0,
          map: 'automatic', plain: false, wipe: 0.5, pixel: null};
}

const short = (value: number) => String(Number(value.toPrecision(6)));

// Positions are in pixels of the rendered image, so that a link fits a page with all pixels, too.
export function to_fragment(state: State, run: Run): string {
  const words = new URLSearchParams({view: state.mode, group: state.group});
  if (state.mode !== 'grid') {
    words.set('a', state.a);
    words.set('b', state.b);
  }
  if (state.flipped) words.set('flip', '1');
  if (state.zoom > 0) {
    words.set('zoom', short(state.zoom / run.stride));
    words.set('at', `${short(state.x * run.stride)},${short(state.y * run.stride)}`);
  }
  if (state.exposure !== 0) words.set('exposure', short(state.exposure));
  if (state.map !== 'automatic') words.set('map', state.map);
  if (state.plain) words.set('errors', 'plain');
  if (state.mode === 'wipe') words.set('wipe', short(state.wipe));
  if (state.pixel) words.set('pixel', `${state.pixel[0] * run.stride},${state.pixel[1] * run.stride}`);
  const bias = run.biases.find((each) => each.group === state.group);
  if (bias?.bin && bias.axis[bias.index] !== bias.used) words.set('bias', short(bias.axis[bias.index]));
  if (bias?.range) words.set('range', bias.range.map((index) => short(bias.axis[index])).join());
  return words.toString();
}

function number_in(text: string | null, low: number, high: number): number | null {
  const value = text === null || text === '' ? NaN : Number(text);
  return Number.isFinite(value) ? Math.min(high, Math.max(low, value)) : null;
}

function pair_in(text: string | null, width: number, height: number): [number, number] | null {
  const [x, y] = (text ?? '').split(',');
  const at = [number_in(x ?? null, 0, width), number_in(y ?? null, 0, height)];
  return at[0] !== null && at[1] !== null ? [at[0], at[1]] : null;
}

export interface Linked {
  state: State;
  bias: number | null;
  range: [number, number] | null; // of biases
}

// Null if the fragment is that of a heading. What it does not say, or says wrong, has its default.
export function from_fragment(fragment: string, run: Run): Linked | null {
  const words = new URLSearchParams(fragment.replace(/^#/, ''));
  const mode = modes.find((each) => each === words.get('view'));
  if (!mode) return null;
  const state = initial_state(run);
  state.mode = mode;
  const group = words.get('group') ?? '';
  if (groups_of(run).includes(group)) state.group = group;
  [state.a, state.b] = default_pair(run, state.group);
  const is_layer = (name: string | null) => run.layers.some((layer) => layer.name === name);
  if (is_layer(words.get('a'))) state.a = words.get('a')!;
  if (is_layer(words.get('b'))) state.b = words.get('b')!;
  state.flipped = words.get('flip') === '1';
  state.zoom = (number_in(words.get('zoom'), 0, 512) ?? 0) * run.stride;
  const at = pair_in(words.get('at'), run.width, run.height);
  if (at) [state.x, state.y] = [at[0] / run.stride, at[1] / run.stride];
  state.exposure = number_in(words.get('exposure'), -8, 8) ?? 0;
  if (words.get('map') === 'sequential' || words.get('map') === 'diverging') state.map = words.get('map') as MapName;
  state.plain = words.get('errors') === 'plain';
  state.wipe = number_in(words.get('wipe'), 0, 1) ?? 0.5;
  const pixel = pair_in(words.get('pixel'), run.width - 1, run.height - 1);
  if (pixel) state.pixel = [Math.floor(pixel[0] / run.stride), Math.floor(pixel[1] / run.stride)];
  return {state, bias: number_in(words.get('bias'), -1e9, 1e9), range: pair_in(words.get('range'), 1e9, 1e9)};
}
