// Draws plots without a browser: reads a JSON list of Vega-Lite specifications on stdin, writes a JSON list on stdout:
// for each {"svg": text} or {"error": one line}. Nothing is loaded from files or from the network.
import {readFileSync, writeSync} from 'node:fs';
import * as vega from 'vega';
import {compile} from 'vega-lite';

// Advance widths of DejaVu Sans 2.37 for the characters U+0020 to U+007E, thousandths of the font size. Without a
// browser there is nothing to measure text with, and Vega's own guess is up to half too wide.
const widths = [
  318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337, 636, 636, 636, 636, 636, 636,
  636, 636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632, 575, 775, 752, 295, 295,
  656, 557, 863, 748, 787, 603, 787, 695, 635, 611, 732, 684, 989, 685, 611, 685, 390, 337, 390, 838, 500, 500,
  613, 635, 550, 635, 615, 352, 635, 634, 278, 278, 579, 278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592,
  818, 592, 592, 525, 636, 337, 636, 838,
];
const other_width = 640;
const bold_factor = 1.1;

vega.textMetrics.width = (item, text) => {
  let sum = 0;
  for (const character of String(text ?? '')) sum += widths[character.codePointAt(0) - 32] ?? other_width;
  const bold = item.fontWeight === 'bold' || item.fontWeight >= 600;
  return sum * 0.001 * (item.fontSize ?? 11) * (bold ? bold_factor : 1);
};

const loader = {
  load: () => Promise.reject(new Error('a plot may not load anything')),
  sanitize: () => Promise.reject(new Error('a plot may not link to anything')),
};

// The data points of a plot with their places in the drawing, so that a page can tell which point the pointer is at.
// usermeta.fields names the fields to keep; a row that has several marks is listed once.
function points_of(view, fields) {
  const padding = view.padding();
  const [left, top] = [view.origin()[0] + padding.left, view.origin()[1] + padding.top];
  const points = new Map();
  const visit = (mark, dx, dy) => {
    for (const item of mark.items ?? []) {
      if (mark.marktype === 'group') {
        for (const inner of item.items ?? []) visit(inner, dx + (item.x ?? 0), dy + (item.y ?? 0));
      } else if (['line', 'symbol', 'rect'].includes(mark.marktype) && item.datum && 'x' in item.datum) {
        const values = fields.map((field) => item.datum[field] ?? null);
        const [x, y] = [item.x + (item.width ?? 0) / 2, item.y + (item.height ?? 0) / 2];
        if (Number.isFinite(x + y)) points.set(JSON.stringify(values), [tenths(x + dx), tenths(y + dy), ...values]);
      }
    }
  };
  visit(view.scenegraph().root, left, top);
  return [...points.values()];
}

const tenths = (value) => Math.round(10 * value) / 10;

const escaped = (text) => text.replace(/[&<>]/g, (c) => ({'&': '&amp;', '<': '&lt;', '>': '&gt;'})[c]);

// The drawing with `text` in front of its first element.
function with_first(svg, text) {
  const end = svg.indexOf('>', svg.indexOf('<svg')) + 1;
  return svg.slice(0, end) + text + svg.slice(end);
}

// usermeta's fields and "points", each [x, y, a value for each field], as the drawing's metadata; its hatching.
function with_additions(svg, view, meta) {
  if (meta?.patterns) svg = with_first(svg, `<defs>${meta.patterns}</defs>`);
  if (!meta?.fields) return svg;
  const {fields, columns, labels, keys} = meta;
  const data = {fields, columns, labels, keys, points: points_of(view, fields)};
  return with_first(svg, `<metadata>${escaped(JSON.stringify(data))}</metadata>`);
}

async function draw(spec) {
  const problems = [];
  const keep = (...words) => problems.push(words.join(' '));
  const logger = {level: () => logger, error: keep, warn: keep, info: () => logger, debug: () => logger};
  const runtime = vega.parse(compile(spec, {logger}).spec);
  const view = new vega.View(runtime, {renderer: 'none', loader, logger});
  const svg = with_additions(await view.toSVG(), view, spec.usermeta);
  view.finalize();
  if (problems.length > 0) throw new Error(problems.join('; '));
  return svg;
}

const size_of = (svg) => /<svg[^>]* viewBox="0 0 ([\d.]+) ([\d.]+)"/.exec(svg).slice(1).map(Number);

// A drawing for print: its plot is made narrower or wider until all of it, labels included, has the width of its place,
// and the height where one is given. Then it gets its size in millimetres.
async function draw_to_size(spec) {
  let svg = await draw(spec);
  const print = spec.usermeta?.print;
  if (!print) return svg;
  const panel = spec.spec ?? spec;
  const least = 40;
  for (let tries = 0; tries < 4; ++tries) {
    const [width, height] = size_of(svg);
    const too_wide = width - print.width;
    const too_high = print.height > 0 ? height - print.height : 0;
    if (Math.abs(too_wide) < 1 && Math.abs(too_high) < 1) break;
    panel.width = Math.max(least, panel.width - too_wide / print.columns);
    panel.height = Math.max(least, panel.height - too_high / print.rows);
    svg = await draw(spec);
  }
  const [width, height] = size_of(svg);
  const mm_wide = print.width / print.units_per_mm;
  const size = `width="${mm_wide.toFixed(2)}mm" height="${((mm_wide * height) / width).toFixed(2)}mm"`;
  return svg.replace(/(<svg[^>]*?) width="[\d.]+" height="[\d.]+"/, `$1 ${size}`);
}

function write_all(text) {
  const bytes = Buffer.from(text);
  for (let done = 0; done < bytes.length;) done += writeSync(1, bytes, done);
}

// XML 1.0 has no place for these characters, not even escaped.
const not_in_xml = /[\u0000-\u001f\u007f\ufffe\uffff]/g;
const clean = (key, value) => (typeof value === 'string' ? value.replace(not_in_xml, ' ') : value);

async function main() {
  const results = [];
  for (const spec of JSON.parse(readFileSync(0, 'utf8'), clean)) {
    try {
      results.push({svg: await draw_to_size(spec)});
    } catch (error) {
      results.push({error: String(error?.message ?? error).replace(/\s+/g, ' ')});
    }
  }
  write_all(JSON.stringify(results));
}

main();
