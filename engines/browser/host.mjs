// An adapter of an engine that runs in a browser: reads requests on stdin, passes them to the engine's page, writes the
// images, and replies on stdout. docs/engine-protocol.md has the protocol.
import {closeSync, openSync, readSync, statSync} from 'node:fs';
import path from 'node:path';
import {createInterface} from 'node:readline';
import {start_chromium, version_of} from './chromium.mjs';
import {values_of} from './parameters.mjs';
import {write_pfm} from './pfm.mjs';

const piece = 12 << 20;          // bytes of an image that one message carries
const patience_at_end = 4_000;   // milliseconds for requests that are still open when stdin ends
const largest_image = 1 << 26;   // pixels

const one_line = (error) => String(error?.message ?? error).split('\n')[0].trim() || 'unknown error';

function check_scene(file) {
  const head = Buffer.alloc(4);
  try {
    const handle = openSync(file, 'r');
    try {
      readSync(handle, head, 0, 4, 0);
    } finally {
      closeSync(handle);
    }
  } catch (error) {
    throw new Error(`${file}: cannot be read (${error.code})`);
  }
  if (head.toString('latin1') !== 'glTF') throw new Error(`${file}: is no binary glTF file`);
}

function check_load({scene, folder, width, height, camera, light, bounds}, {lights, cameras}) {
  if (typeof scene !== 'string' || typeof folder !== 'string') throw new Error("load: 'scene' and 'folder' are needed");
  check_scene(scene);
  if (!statSync(folder, {throwIfNoEntry: false})?.isDirectory()) throw new Error(`${folder}: is no folder`);
  const is_size = (value) => Number.isInteger(value) && value > 0;
  if (!is_size(width) || !is_size(height) || width * height > largest_image) {
    throw new Error(`load: ${width} x ${height} is no size of an image`);
  }
  if (!lights.includes(light?.kind)) throw new Error(`load: lights of kind '${light?.kind}' are not supported`);
  if (!cameras.includes(camera?.kind)) throw new Error(`load: cameras of kind '${camera?.kind}' are not supported`);
  if (bounds?.min?.length !== 3 || bounds?.max?.length !== 3) throw new Error("load: 'bounds' is needed");
}

/** Requests of one session, in order. */
class Session {
  constructor(adapter) {
    this.adapter = adapter;
    this.started = undefined;
    this.loaded = undefined;
    this.constant = new Map();  // images that no parameter changes, by output: {channels, bytes}
  }

  browser() {
    this.started ??= start_chromium(this.adapter).then(async (chromium) => {
      try {
        const {renderer} = await chromium.page.evaluate(() => globalThis.umbrameter.start());
        return {...chromium, state: chromium, renderer};
      } catch (error) {
        await chromium.browser.close();
        throw error;
      }
    });
    this.started.catch(() => { this.started = undefined; });
    return this.started;
  }

  /** Starts the engine again, with the last scene, if its WebGL is lost. */
  async revive() {
    const {page} = await this.browser();
    if (!await page.evaluate(() => globalThis.umbrameter.is_lost())) return;
    await page.reload();
    await page.waitForFunction(() => globalThis.umbrameter !== undefined);
    await page.evaluate(() => globalThis.umbrameter.start());
    if (this.loaded !== undefined) await page.evaluate((load) => globalThis.umbrameter.load(load), this.loaded);
  }

  async describe({protocol}) {
    if (protocol !== 1) throw new Error(`protocol ${protocol} is not supported: this adapter speaks 1`);
    const {adapter} = this;
    const {renderer} = await this.browser();
    return {protocol: 1, name: adapter.name, version: version_of(adapter.home, adapter.packages[0]), renderer,
            outputs: adapter.outputs, lights: adapter.lights, cameras: adapter.cameras, parameters: adapter.parameters};
  }

  async load(request) {
    check_load(request, this.adapter);
    const {page, state} = await this.browser();
    this.loaded = undefined;
    this.constant.clear();
    await this.revive();
    state.scene = request.scene;
    const {warnings} = await page.evaluate((load) => globalThis.umbrameter.load(load), request);
    this.loaded = request;
    return warnings.length > 0 ? {warnings} : {};
  }

  async render({id, outputs, frames}) {
    if (this.loaded === undefined) throw new Error('render: no scene is loaded');
    if (!Array.isArray(outputs) || outputs.length === 0 || !Array.isArray(frames) || frames.length === 0) {
      throw new Error("render: 'outputs' and 'frames' are needed");
    }
    for (const name of outputs) {
      if (!this.adapter.outputs.includes(name)) throw new Error(`render: output '${name}' is not supported`);
    }
    // All of them before the first image.
    const values = frames.map((frame) => values_of(this.adapter.parameters, frame));
    await this.revive();
    const done = [];
    for (const [index, each] of values.entries()) done.push(await this.frame(`${id}-${index}`, outputs, each));
    return {frames: done};
  }

  async frame(prefix, outputs, values) {
    const {page} = await this.browser();
    const wanted = outputs.filter((name) => !this.constant.has(name));
    const frame = await page.evaluate(([names, parameters]) => globalThis.umbrameter.render(names, parameters),
                                      [wanted, values]);
    const files = {};
    for (const name of outputs) {
      let image = this.constant.get(name);
      if (image === undefined) {
        if (frame.images[name] === undefined) throw new Error(`the engine gave no '${name}'`);
        image = await this.fetch(page, name, frame.images[name]);
        if (this.adapter.constant.includes(name)) this.constant.set(name, image);
      }
      files[name] = `${prefix}-${name}.pfm`;
      const {folder, width, height} = this.loaded;
      write_pfm(path.join(folder, files[name]), width, height, image.channels, image.bytes);
    }
    const {milliseconds, warnings} = frame;
    return warnings.length > 0 ? {files, milliseconds, warnings} : {files, milliseconds};
  }

  async fetch(page, name, {channels, bytes}) {
    const parts = [];
    for (let start = 0; start < bytes; start += piece) {
      const range = [name, start, Math.min(bytes, start + piece)];
      const text = await page.evaluate((which) => globalThis.umbrameter.take(...which), range);
      parts.push(Buffer.from(text, 'base64'));
    }
    return {channels, bytes: Buffer.concat(parts)};
  }

  async reply(request) {
    const verbs = {describe: this.describe, load: this.load, render: this.render};
    try {
      const verb = Object.hasOwn(verbs, request.request) ? verbs[request.request] : undefined;
      if (verb === undefined) throw new Error(`there is no request '${request.request}'`);
      return {id: request.id, ...await verb.call(this, request)};
    } catch (error) {
      return {id: request.id, error: one_line(error).replace(/^page\.\w+: (Error: )?/, '')};
    }
  }

  /** What ended the browser, or undefined while its page answers. */
  async lost() {
    const running = await this.started?.catch(() => undefined);
    if (running === undefined) return undefined;
    // A request can fail before the event arrives that says why: the page itself knows.
    const answers = await running.page.evaluate(() => true).catch(() => false);
    return running.state.lost ?? (answers ? undefined : 'Chromium has ended');
  }

  async close() {
    const limit = new Promise((resolve) => { setTimeout(resolve, 2_000).unref(); });
    await Promise.race([this.started?.then(({browser}) => browser.close()).catch(() => {}), limit]);
  }
}

function parse(line) {
  const request = JSON.parse(line);
  if (!Number.isInteger(request?.id) || request.id < 1) throw new Error('no id');
  return request;
}

// What every engine here can do.
const abilities = {
  outputs: ['visibility', 'ao', 'position', 'normal'],
  constant: ['position', 'normal'],  // that no parameter changes
  lights: ['directional', 'spot', 'point'],
  cameras: ['perspective', 'orthographic'],
};

/** Serves requests until stdin ends. `engine`: {name, home, packages (the engine first), imports, module, parameters}. */
export async function serve(engine) {
  const adapter = {...abilities, ...engine};
  const session = new Session(adapter);
  let ending = false;
  const end = async (code, why) => {
    if (ending) return;
    ending = true;
    if (why) process.stderr.write(`${adapter.name} adapter: ${why}\n`);
    await session.close();
    process.exit(code);
  };
  const signals = {SIGHUP: 129, SIGINT: 130, SIGTERM: 143};
  for (const [signal, code] of Object.entries(signals)) process.on(signal, () => end(code));
  process.stdout.on('error', () => end(1));

  let queue = Promise.resolve();
  for await (const line of createInterface({input: process.stdin, crlfDelay: Infinity})) {
    if (line.trim() === '') continue;
    queue = queue.then(async () => {
      if (ending) return undefined;
      let request;
      try {
        request = parse(line);
      } catch (error) {
        return end(2, `a line is no request: ${one_line(error)}`);
      }
      const reply = await session.reply(request);
      // Without a reply: the caller starts an adapter that ended once more, with the last scene.
      const lost = reply.error === undefined ? undefined : await session.lost();
      if (lost !== undefined) return end(1, lost);
      if (ending) return undefined;
      return new Promise((resolve) => { process.stdout.write(`${JSON.stringify(reply)}\n`, resolve); });
    });
  }
  const limit = new Promise((resolve) => { setTimeout(resolve, patience_at_end).unref(); });
  await Promise.race([queue, limit]);
  await end(0);
}
