// The values of one pixel, and the legend of the layers in view.
import {bias_text, critical_text, images_of} from './bias';
import {Bias, Layer, Parts, Run} from './data';
import {make} from './dom';
import {is_grey, layer_number, Look, number_text, scale_of, table_of, value_text} from './pixels';

export function part_of(parts: Parts | null, i: number): string {
  return parts && parts.index[i] > 0 ? parts.names[parts.index[i] - 1] : '';
}

// The 95 % interval of a sampled reference.
function interval_rows(run: Run, group: string, i: number): [string, string][] {
  const find = (test: (layer: Layer) => boolean) => run.layers.find((layer) => layer.group === group && test(layer));
  const reference = find((layer) => layer.role === 'reference' && layer.planes.length === 1);
  const error = find((layer) => /^truth_(ao|visibility)_standard_error/.test(layer.name));
  if (!reference || !error) return [];
  const [value, reach] = [reference.planes[0][i], error.reach * error.planes[0][i]];
  if (!Number.isFinite(value + reach)) return [];
  const [low, high] = [value - reach, value + reach].map((each) => number_text(Number(Math.min(1, Math.max(0, each)).toPrecision(3))));
  return [['Reference, 95 % interval', `${low} to ${high}`]];
}

// What blocks the pixel in the map lies this far in front of it: the bias that removes it.
function occluder_rows(bias: Bias, i: number): [string, string][] {
  const is_blocked_by_another = bias.cause![i] === 3; // wrong, peter-panning, once the bias is larger
  if (!is_blocked_by_another || bias.bin![i] < 2 || bias.bin![i] > bias.axis.length) return [];
  return [['Occluder distance', `${bias_text(bias, bias.axis[bias.bin![i] - 1])} along the light, in the map`]];
}

// Name and value of all that is known of a pixel: the layers of the group first.
export function pixel_rows(run: Run, group: string, i: number): [string, string][] {
  const rows = run.layers.filter((layer) => layer.group === group)
    .map((layer): [string, string] => [layer.title, value_text(layer, i)]);
  const bias = run.biases.find((each) => each.group === group);
  const cause = images_of(run, group)?.cause;
  rows.push(...interval_rows(run, group, i));
  const is_counted = !['not counted', 'background'].includes(cause ? value_text(cause, i) : '');
  if (bias?.bin && is_counted) rows.push(['Critical bias', critical_text(bias, i)], ...occluder_rows(bias, i));
  rows.push(['Object', part_of(run.objects, i) || 'background'], ['Material', part_of(run.materials, i) || '—']);
  const depth = run.layers.find((layer) => layer.name === 'Z');
  if (depth && depth.group !== group) rows.push(['Depth', value_text(depth, i)]);
  return rows;
}

export function fill_inspector(element: HTMLElement, run: Run, group: string, pixel: [number, number] | null,
                               is_pinned: boolean): void {
  if (!pixel) {
    element.replaceChildren(make('p', {class: 'hint'}, 'Point at a pixel to read its values; click to keep them.'));
    return;
  }
  const i = pixel[1] * run.columns + pixel[0];
  const place = `${pixel[0] * run.stride}, ${pixel[1] * run.stride}`;
  const rows = pixel_rows(run, group, i).map(([name, value]) =>
    make('tr', {}, make('th', {scope: 'row'}, name), make('td', {}, value)));
  element.replaceChildren(make('table', {}, make('caption', {}, `Pixel ${place}${is_pinned ? ', pinned' : ''}`),
                               make('tbody', {}, ...rows)));
}

function color_bar(table: Uint8Array): HTMLCanvasElement {
  const width = table.length / 3;
  const bar = make('canvas', {class: 'bar', width, height: 1, 'aria-hidden': 'true'});
  const context = bar.getContext('2d')!;
  const pixels = new ImageData(width, 1);
  for (let i = 0; i < width; ++i) pixels.data.set([table[3 * i], table[3 * i + 1], table[3 * i + 2], 255], 4 * i);
  context.putImageData(pixels, 0, 0);
  return bar;
}

function swatch(color: number[]): SVGSVGElement {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  const box = document.createElementNS('http://www.w3.org/2000/svg', 'rect');
  for (const [name, value] of Object.entries({width: '100%', height: '100%', fill: `rgb(${color.join(',')})`})) {
    box.setAttribute(name, value);
  }
  svg.setAttribute('class', 'swatch');
  svg.setAttribute('aria-hidden', 'true');
  svg.append(box);
  return svg;
}

function scale_legend(titles: string[], layer: Layer, look: Look, run: Run): HTMLElement {
  const [first, last] = scale_of(layer, look).map((end) => layer_number(layer, end));
  const unit = layer.unit ? ` ${layer.unit}` : '';
  const ends = layer.kind === 'error' ? [`${first}${unit} too dark`, `+${last}${unit} too bright`] : [first, last + unit];
  return make('div', {class: 'scale'}, make('span', {class: 'name'}, titles.join(', ')),
              color_bar(table_of(layer, look, run)), make('span', {}, ends[0]), make('span', {class: 'end'}, ends[1]));
}

// Over the picture, a pixel without an error shows the picture, and no category's colour.
function shown_categories(layer: Layer, look: Look): Layer['categories'] {
  if (!look.base) return layer.categories;
  const grey = layer.categories.filter(({color}) => is_grey(color));
  const names = grey.map(({name}) => name).filter((name) => name !== 'background');
  const picture = {name: `grey: the picture (${names.join(' or ')})`, color: grey[0].color};
  return [...layer.categories.filter(({color}) => !is_grey(color)), picture];
}

// One scale for layers that share it, the names of categories with their share of the pixels that have a category.
export function fill_legend(element: HTMLElement, layers: Layer[], look: Look, run: Run): void {
  const parts: HTMLElement[] = [];
  const titles = new Map<string, string[]>();
  const scaled = layers.filter((layer) => !['category', 'color', 'vector'].includes(layer.kind));
  const key_of = (layer: Layer) => `${layer.kind} ${scale_of(layer, look).join(' ')} ${layer.unit}`;
  for (const layer of scaled) titles.set(key_of(layer), [...(titles.get(key_of(layer)) ?? []), layer.title]);
  for (const layer of scaled) {
    const same = titles.get(key_of(layer));
    if (same) parts.push(scale_legend([...new Set(same)], layer, look, run));
    titles.delete(key_of(layer));
  }
  for (const layer of layers.filter((each, i) => each.kind === 'category' && layers.indexOf(each) === i)) {
    parts.push(make('ul', {class: 'categories'}, ...shown_categories(layer, look).map((each) =>
      make('li', {}, swatch(each.color), each.name))));
  }
  element.replaceChildren(...parts);
}
