// Runs of the program for the browser to open, and the browser.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {pathToFileURL} from 'node:url';
import {chromium} from 'playwright-core';

const program = process.env.UMBRAMETER_PROGRAM;
const executablePath = process.env.UMBRAMETER_CHROMIUM;
export const folder = mkdtempSync(path.join(tmpdir(), 'umbrameter-page-'));

export const run = (...words) => run_in(process.cwd(), ...words);
export function run_in(cwd, ...words) {
  const {status, stdout, stderr} = spawnSync(program, words, {
    cwd, encoding: 'utf8', env: {...process.env, XDG_CACHE_HOME: path.join(folder, 'cache')}});
  if (status !== 0) throw new Error(`${words.join(' ')}: ${status} ${stderr}`);
  return stdout;
}

// 77 is what ctest counts as skipped.
export function skip_unless_possible() {
  if (!executablePath || !existsSync(executablePath)) {
    console.log('no chromium: scripts/setup installs it');
    process.exit(77);
  }
  if (run('info').includes('no usable device')) {
    console.log('no OpenGL driver');
    process.exit(77);
  }
}

// The one browser of all tests, and the runs that several tests open. Each is made when it is first asked for.
const shared = new Map();
function once(name, make) {
  if (!shared.has(name)) shared.set(name, make());
  return shared.get(name);
}
export const browser_of_all = () => once('browser', start_browser);
export const plain_run = () => once('run', () => compare('run', 'courtyard', '--light', 'sun'));
export const sweep_run = () => once('sweep', () => {
  const out = path.join(folder, 'sweep');
  run('sweep', 'courtyard', '-o', out, '--light', 'sun', '--size', '96x54', '--quiet', '--page-cells', '4', '--vary',
      'shadow.constant-bias=0.01:0.2:5:log', '--vary', 'shadow.resolution=512,1024', '--vary', 'shadow.filter=nearest,box');
  return out;
});
export const tune_run = () => once('tune', () => {
  const out = path.join(folder, 'tune');
  run('tune', 'courtyard', '-o', out, '--light', 'sun', '--size', '96x54', '--quiet', '--vary', 'shadow.constant-bias=0:0.2');
  return out;
});
// 10,000 cells, 20 of them with images.
export const large_run = () => once('large', () => {
  const out = path.join(folder, 'large');
  run('sweep', 'courtyard', '-o', out, '--light', 'sun', '--size', '160x90', '--quiet', '--page-cells', '20', '--vary',
      'shadow.constant-bias=0.001:0.2:500:log', '--vary', 'shadow.slope-bias=0:4:20', '--run.classes', 'fast');
  return out;
});
export async function close_all() {
  await (await shared.get('browser'))?.close();
  clean_up();
}

export const size = {width: 96, height: 54};
export function compare(name, scene, ...words) {
  const out = path.join(folder, name);
  run('compare', scene, '-o', out, '--size', '96x54', '--truth.spp', '16', '--quiet', ...words);
  return out;
}

// What the address of the page says.
export const fragment_of = (page) => page.evaluate(() => Object.fromEntries(new URLSearchParams(location.hash.slice(1))));

const fits = (found, wanted) => (wanted instanceof RegExp ? wanted.test(found ?? '') : found === wanted);

// Waits until the address says so: the viewer writes it a moment after a change. undefined: it says nothing of that.
export async function expect_fragment(page, expected) {
  let found;
  for (let i = 0; i < 60; ++i) {
    found = await fragment_of(page);
    if (Object.entries(expected).every(([name, wanted]) => fits(found[name], wanted))) return found;
    await page.waitForTimeout(50);
  }
  assert.fail(`${JSON.stringify(found)} is not ${Object.entries(expected).join('; ')}`);
}

// The colours of a layer as painted, one for each stored pixel: read in the middle of blocks of four by four. Waits
// until the viewer has painted what the address says.
export async function painted(page) {
  await page.waitForFunction(() => {
    const has = new URLSearchParams(document.querySelector('.stage').dataset.painted);
    const wanted = new URLSearchParams(location.hash.slice(1));
    wanted.delete('painter');
    return [...wanted].every(([name, value]) => has.get(name) === value);
  });
  return page.evaluate(({width, height}) => {
    const canvas = document.querySelector('.stage canvas');
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = copy.getContext('2d');
    context.drawImage(canvas, 0, 0);
    const {data} = context.getImageData(0, 0, copy.width, copy.height);
    const left = canvas.width / 2 - 2 * width + 2;
    const top = canvas.height / 2 - 2 * height + 2;
    const colors = [];
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        const at = 4 * (Math.floor(top + 4 * y) * canvas.width + Math.floor(left + 4 * x));
        colors.push([...data.slice(at, at + 3)].join());
      }
    }
    return colors;
  }, size);
}

// The fragment of one layer, four screen pixels for each stored one; errors and causes in their own colours.
export const single = (layer, more = '') => `#view=single&group=sun&a=${layer}&zoom=4&at=48,27&errors=plain${more}`;

// Follows a link within the page.
export const go = (page, fragment) => page.evaluate((hash) => (location.hash = hash), fragment);

// Of the categories in class_sun.
export const class_colors = ['240,240,240', '213,94,0', '204,121,167', '0,114,178', '86,180,233', '200,200,200', '255,255,255'];

// A binary glTF whose scene, nodes, materials and cameras have the name.
export function rename_all(from, to, name) {
  const file = readFileSync(from);
  const length = file.readUInt32LE(12);
  const scene = JSON.parse(file.toString('utf8', 20, 20 + length));
  for (const list of [scene.nodes, scene.materials, scene.cameras, scene.meshes, scene.scenes,
                      scene.extensions?.KHR_lights_punctual?.lights]) {
    for (const each of list ?? []) each.name = name;
  }
  let json = Buffer.from(JSON.stringify(scene));
  json = Buffer.concat([json, Buffer.alloc((4 - (json.length % 4)) % 4, ' ')]);
  const rest = file.subarray(20 + length);
  const head = Buffer.from(file.subarray(0, 20));
  head.writeUInt32LE(20 + json.length + rest.length, 8);
  head.writeUInt32LE(json.length, 12);
  writeFileSync(to, Buffer.concat([head, json, rest]));
}

// The page's own OpenGL is software; to compose the window by it, too, would take twice the time.
async function start_browser() {
  return chromium.launch({executablePath, args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
                                                 '--disable-gpu-compositing']});
}
// What chromium says of composing a canvas that way: it reads it back. The viewer itself reads nothing back.
const is_of_composing = (text) => text.endsWith('GPU stall due to ReadPixels') ||
                                  text.endsWith('GPU stall due to ReadPixels (this message will no longer repeat)');

// Pages that no test has open. To load one again takes half the time of a new context, which has processes of its own.
const idle_pages = [];

async function new_page(options) {
  const browser = await browser_of_all();
  const page = await (await browser.newContext(options)).newPage();
  page.setDefaultTimeout(20_000);  // for machines that do much else
  return page;
}

// Opens a run's page and waits until its script is done. `problems` collects what no page may do: write to the console,
// throw, or ask for another file. Without further options of a context the page is one that an earlier test has closed.
export async function open_page(out, {fragment = '', width = 700, ...options} = {}) {
  const is_special = Object.keys(options).length > 0;
  const page = (is_special ? undefined : idle_pages.pop()) ?? await new_page(options);
  await page.setViewportSize({width, height: 700});
  const problems = [];
  const address = pathToFileURL(path.join(out, 'index.html')).href;
  page.on('console', (message) => {
    if (!is_of_composing(message.text())) problems.push(`console: ${message.text()}`);
  });
  page.on('pageerror', (error) => problems.push(`error: ${error.message}`));
  page.on('dialog', (dialog) => {
    problems.push(`dialog: ${dialog.message()}`);
    void dialog.dismiss();
  });
  page.on('request', (request) => {
    const url = request.url();
    if (url.split('#')[0] !== address && !url.startsWith('data:') && !url.startsWith('blob:')) problems.push(`request: ${url}`);
  });
  await page.goto(address + fragment);
  if (options.javaScriptEnabled !== false) await page.locator('html[data-ready="yes"]').waitFor({state: 'attached'});
  const close = async () => {
    for (const event of ['console', 'pageerror', 'dialog', 'request']) page.removeAllListeners(event);
    if (is_special) return page.context().close();
    await page.emulateMedia({media: null, colorScheme: null});
    await page.mouse.move(0, 0);
    await page.goto('about:blank');
    idle_pages.push(page);
  };
  return {page, problems, close};
}

function clean_up() {
  rmSync(folder, {recursive: true, force: true});
}
