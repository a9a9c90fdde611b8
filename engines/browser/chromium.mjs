// The one headless Chromium of an adapter, and the page in it that runs the engine. Files reach the page by
// interception of its requests: there is no listening socket, and the page reaches no network.
import {accessSync, constants, mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {fileURLToPath} from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url));
const origin = 'https://engine.invalid';
const kinds = {'.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.json': 'application/json',
               '.wasm': 'application/wasm', '.glb': 'model/gltf-binary'};
const flags = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-gpu-compositing', '--mute-audio',
               '--disable-gpu-watchdog', '--disable-background-networking'];

/** Path of the browser: $CHROMIUM, or the first of the usual names in PATH. */
export function find_chromium(environment = process.env) {
  if (environment.CHROMIUM) return environment.CHROMIUM;
  for (const name of ['chromium', 'chromium-browser', 'google-chrome']) {
    for (const folder of (environment.PATH ?? '').split(path.delimiter)) {
      const file = path.join(folder, name);
      try {
        accessSync(file, constants.X_OK);
        return file;
      } catch {
        // the next one
      }
    }
  }
  throw new Error('no Chromium: install it, or set CHROMIUM to its path');
}

/** The folder of an installed package, as Node finds it from the adapter's folder. */
function package_folder(home, name) {
  for (let folder = home;; folder = path.dirname(folder)) {
    const found = path.join(folder, 'node_modules', name);
    try {
      accessSync(path.join(found, 'package.json'));
      return found;
    } catch {
      if (folder !== path.dirname(folder)) continue;
      throw new Error(`package ${name} is missing: run ${path.join(home, 'setup')}`);
    }
  }
}

export const version_of = (home, name) =>
  JSON.parse(readFileSync(path.join(package_folder(home, name), 'package.json'), 'utf8')).version;

/**
 * What the page may read: /packages/NAME/… of the packages, /engine/… of the adapter's folder, /browser/… of this
 * one. Gives the file of a path, or undefined.
 */
function files_of({home, packages}) {
  const roots = new Map([['engine', home], ['browser', here]]);
  for (const name of packages) roots.set(`packages/${name}`, package_folder(home, name));
  return (place) => {
    for (const [prefix, root] of roots) {
      if (!place.startsWith(`/${prefix}/`)) continue;
      const file = path.join(root, path.normalize(place.slice(prefix.length + 1)));
      if (file.startsWith(root + path.sep)) return file;
    }
    return undefined;
  };
}

// The browser's own files, which go when this process ends.
function use_own_temporary_folder() {
  const folder = mkdtempSync(path.join(tmpdir(), 'umbrameter-browser-'));
  process.env.TMPDIR = folder;
  process.on('exit', () => {
    try {
      rmSync(folder, {recursive: true, force: true, maxRetries: 5, retryDelay: 50});
    } catch {
      // The browser still writes there.
    }
  });
}

const start_page = (imports, module) => `<!doctype html><meta charset="utf-8"><title>engine</title>
<script type="importmap">${JSON.stringify({imports})}</script>
<script type="module">import {serve} from '/browser/page.mjs'; serve(() => import('/engine/${module}'));</script>`;

/**
 * Starts Chromium and the engine's page. `adapter` is {home, packages, imports, module}. Throws if there is no browser
 * or no package.
 */
export async function start_chromium(adapter) {
  const file_of = files_of(adapter);
  const require = createRequire(path.join(adapter.home, 'package.json'));
  package_folder(adapter.home, 'playwright-core');
  const {chromium} = require('playwright-core');
  use_own_temporary_folder();
  // The connection is a pipe: when this process ends, however it ends, the browser ends too.
  const browser = await chromium.launch({executablePath: find_chromium(), args: flags, handleSIGINT: false,
                                         handleSIGTERM: false, handleSIGHUP: false});
  const page = await (await browser.newContext()).newPage();
  const state = {browser, page, scene: undefined, lost: undefined};
  const lose = (what) => { state.lost ??= what; };
  browser.on('disconnected', () => lose('Chromium has ended'));
  page.on('crash', () => lose("the engine's page crashed (out of memory?)"));
  page.on('console', (message) => {
    if (message.type() === 'error') process.stderr.write(`page: ${message.text().replace(/\s+/g, ' ')}\n`);
  });
  page.on('pageerror', (error) => process.stderr.write(`page: ${String(error).replace(/\s+/g, ' ')}\n`));
  page.setDefaultTimeout(0);
  await page.route('**/*', async (route) => {
    const {pathname, origin: from} = new URL(route.request().url());
    if (from !== origin) return route.abort();
    if (pathname === '/') {
      return route.fulfill({contentType: kinds['.html'], body: start_page(adapter.imports, adapter.module)});
    }
    const file = pathname === '/scene.glb' ? state.scene : file_of(pathname);
    try {
      await route.fulfill({contentType: kinds[path.extname(pathname)] ?? 'application/octet-stream',
                           body: readFileSync(file)});
    } catch {
      await route.fulfill({status: 404, body: ''}).catch(() => {});
    }
  });
  await page.goto(`${origin}/`);
  await page.waitForFunction(() => globalThis.umbrameter !== undefined);
  return state;
}
