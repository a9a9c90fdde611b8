// Runs of the program for the browser to open, and the browser.
import {spawnSync} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {pathToFileURL} from 'node:url';
import {chromium} from 'playwright-core';

const program = process.env.UMBRAMETER_PROGRAM;
const executablePath = process.env.UMBRAMETER_CHROMIUM;
export const folder = mkdtempSync(path.join(tmpdir(), 'umbrameter-page-'));

export function run(...words) {
  const {status, stdout, stderr} = spawnSync(program, words, {
    encoding: 'utf8', env: {...process.env, XDG_CACHE_HOME: path.join(folder, 'cache')}});
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

export const size = {width: 96, height: 54};
export function compare(name, scene, ...words) {
  const out = path.join(folder, name);
  run('compare', scene, '-o', out, '--size', '96x54', '--truth.spp', '16', '--quiet', ...words);
  return out;
}

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

export async function start_browser() {
  const browser = await chromium.launch({executablePath,
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader']});
  return browser;
}

// Opens a run's page and waits until its script is done. `problems` collects what no page may do: write to the console,
// throw, or ask for another file.
export async function open_page(browser, out, {fragment = '', width = 700, ...options} = {}) {
  const context = await browser.newContext({viewport: {width, height: 700}, ...options});
  const page = await context.newPage();
  page.setDefaultTimeout(20_000);
  const problems = [];
  const address = pathToFileURL(path.join(out, 'index.html')).href;
  page.on('console', (message) => problems.push(`console: ${message.text()}`));
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
  return {page, problems};
}

export function clean_up() {
  rmSync(folder, {recursive: true, force: true});
}
