// Drives adapters by the protocol: what they describe, their images of a box above a floor, their errors, and that they
// leave no process behind. usage: node test.mjs [ENGINE…]; 77: nothing could be tested.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {createInterface} from 'node:readline';
import test from 'node:test';
import {fileURLToPath} from 'node:url';
import {find_chromium} from './chromium.mjs';
import {box_scene, load_request} from './test_scene.mjs';

const engines = path.dirname(path.dirname(fileURLToPath(import.meta.url)));
// A parameter of each, two of its values between which the shadow of the box changes, and a choice.
const cases = {
  threejs: {name: 'three.js', bias: ['bias', 0, -0.2], choice: 'type'},
  babylon: {name: 'Babylon.js', bias: ['bias', 0.01, 0.3], choice: 'filter'},
  playcanvas: {name: 'PlayCanvas', bias: ['shadow-intensity', 1, 0.5], choice: 'shadow-type'},
  filament: {name: 'Filament', bias: ['constant-bias', 0.001, 2], choice: 'stable',
             shadow: ['lit', 'unshadowed'], has_more: false},
};

function skip(why) {
  console.log(why);
  process.exit(77);
}
const wanted = process.argv.length > 2 ? process.argv.slice(2) : Object.keys(cases);
const ready = wanted.filter((engine) => existsSync(path.join(engines, engine, 'node_modules')));
if (ready.length === 0) skip(`no packages: run ${wanted.map((engine) => `engines/${engine}/setup`).join(' or ')}`);
try {
  if (!existsSync(find_chromium())) skip(`no browser at ${find_chromium()}`);
} catch (error) {
  skip(error.message);
}

const folder = mkdtempSync(path.join(tmpdir(), 'umbrameter-engines-'));
process.on('exit', () => rmSync(folder, {recursive: true, force: true}));
const scene = path.join(folder, 'box.glb');
writeFileSync(scene, box_scene());
const frames = path.join(folder, 'frames');
mkdirSync(frames);

// A test that failed leaves its adapters behind.
const adapters = new Set();
const end_adapters = () => {
  for (const adapter of adapters) adapter.process.kill();
};

class Adapter {
  constructor(engine, environment = {}) {
    adapters.add(this);
    this.process = spawn(path.join(engines, engine, 'adapter'), {env: {...process.env, ...environment}});
    this.next_id = 1;
    this.errors = '';
    this.replies = createInterface({input: this.process.stdout})[Symbol.asyncIterator]();
    this.process.stderr.on('data', (text) => { this.errors += text; });
    this.ended = new Promise((resolve) => { this.process.on('exit', (code, signal) => resolve({code, signal})); });
    this.ended.then(() => adapters.delete(this));
  }

  async ask(request, more = {}) {
    const id = this.next_id++;
    this.process.stdin.write(`${JSON.stringify({id, request, ...more})}\n`);
    const {value, done} = await this.replies.next();
    if (done) return undefined;
    const reply = JSON.parse(value);
    assert.equal(reply.id, id);
    return reply;
  }

  async good(request, more) {
    const reply = await this.ask(request, more);
    assert.equal(reply?.error, undefined, reply?.error ?? this.errors);
    return reply;
  }

  load(more = {}) {
    return this.good('load', {...load_request(scene, frames), ...more});
  }

  async close() {
    this.process.stdin.end();
    return this.ended;
  }
}

// {width, height, channels, at(x, y from the top)}
function read_pfm(name) {
  const file = path.join(frames, name);
  const bytes = readFileSync(file);
  rmSync(file);
  let start = 0;
  const lines = [0, 1, 2].map(() => {
    const end = bytes.indexOf(10, start);
    const line = bytes.toString('latin1', start, end);
    start = end + 1;
    return line;
  });
  const [width, height] = lines[1].split(' ').map(Number);
  const channels = {Pf: 1, PF: 3}[lines[0]];
  assert.equal(lines[2], '-1.0');
  assert.equal(bytes.length - start, 4 * width * height * channels);
  const at = (x, y) => Array.from({length: channels}, (_, c) =>
    bytes.readFloatLE(start + 4 * (((height - 1 - y) * width + x) * channels + c)));
  return {width, height, channels, at, bytes: bytes.subarray(start)};
}

// The image of an output, or the quotient of two, each of whose channels are equal.
function share_of(files, outputs) {
  const [first, second] = outputs.map((output) => read_pfm(files[output]));
  if (second === undefined) return first;
  assert.deepEqual([first.channels, second.channels], [3, 3]);
  const at = (x, y) => [second.at(x, y)[0] > 0 ? first.at(x, y)[0] / second.at(x, y)[0] : 0];
  return {...first, channels: 1, at};
}

// Processes below one, by Linux's /proc; empty elsewhere.
function descendants(root) {
  if (!existsSync('/proc/self/stat')) return [];
  const parents = new Map();
  for (const name of readdirSync('/proc')) {
    try {
      if (!/^\d+$/.test(name)) continue;
      parents.set(Number(name), Number(/\) . (\d+)/.exec(readFileSync(`/proc/${name}/stat`, 'utf8'))[1]));
    } catch {
      // it has ended
    }
  }
  const found = [root];
  for (const one of found) for (const [child, parent] of parents) if (parent === one) found.push(child);
  return found.slice(1);
}
const is_running = (process_id) => existsSync(`/proc/${process_id}`) &&
                                   !/\) [ZX] /.test(readFileSync(`/proc/${process_id}/stat`, 'utf8'));
async function expect_end(process_ids) {
  const left = () => process_ids.filter((each) => { try { return is_running(each); } catch { return false; } });
  for (let i = 0; i < 50 && left().length > 0; ++i) await new Promise((resolve) => { setTimeout(resolve, 100); });
  assert.deepEqual(left(), [], 'processes that still run');
}

// The floor is y = 0, 10 m wide; the box spans 1 m, its underside at y = 0.5; the sun stands overhead.
function check_images(position, visibility) {
  let [background, in_shadow, in_light] = [0, 0, 0];
  for (let y = 0; y < position.height; ++y) {
    for (let x = 0; x < position.width; ++x) {
      const [value] = visibility.at(x, y);
      assert.ok(value >= 0 && value <= 1, `visibility ${value}`);
      const [px, py, pz] = position.at(x, y);
      if (Number.isNaN(px)) {
        ++background;
        assert.ok(Number.isNaN(py) && Number.isNaN(pz));
        continue;
      }
      assert.ok(Math.abs(px) < 5.01 && py > -0.001 && py < 1.501 && Math.abs(pz) < 5.01, `position ${px} ${py} ${pz}`);
      const distance = Math.max(Math.abs(px), Math.abs(pz));
      if (py > 0.001) continue;
      if (distance < 0.35) {
        ++in_shadow;
        assert.ok(value < 0.1, `visibility ${value} below the box, at ${px} ${pz}`);
      } else if (distance > 0.7) {
        ++in_light;
        assert.ok(value > 0.9, `visibility ${value} beside the box, at ${px} ${pz}`);
      }
    }
  }
  assert.ok(background > 100 && in_shadow > 10 && in_light > 1000, `${background} ${in_shadow} ${in_light}`);
  // The camera looks along −Z from above: the top of the image is far away, its right is +X.
  const [left, right] = [position.at(20, 100), position.at(139, 100)];
  assert.ok(left[0] < -1 && right[0] > 1 && position.at(80, 115)[2] > position.at(80, 60)[2]);
}

const timeout = 240_000;
for (const engine of ready) {
  const {name, bias: [bias, ...biases], choice, shadow = ['visibility'], has_more = true} = cases[engine];

  test(name, {timeout}, async (adapter_test) => {
    adapter_test.after(end_adapters);
    const adapter = new Adapter(engine);
    await adapter_test.test('what fails is answered in a line, and the adapter goes on', async () => {
      const fails = async (request, more, pattern) => {
        const {error} = await adapter.ask(request, more);
        assert.match(error ?? 'no error', pattern);
        assert.ok(!error.includes('\n'));
      };
      await fails('describe', {protocol: 2}, /protocol 2/);
      await fails('draw', {}, /no request 'draw'/);
      await fails('render', {outputs: shadow, frames: [{}]}, /no scene/);
      await fails('load', load_request(path.join(folder, 'absent.glb'), frames), /absent\.glb: cannot be read/);
      await fails('load', load_request(fileURLToPath(import.meta.url), frames), /no binary glTF/);
      writeFileSync(path.join(folder, 'broken.glb'), box_scene().subarray(0, 200));
      await fails('load', load_request(path.join(folder, 'broken.glb'), frames), /./);
      await fails('load', {...load_request(scene, frames), light: {kind: 'area'}}, /'area'/);
      await fails('load', {...load_request(scene, frames), width: 40_000, height: 2}, /at most/);
      await adapter.load();
      await fails('render', {outputs: shadow, frames: [{[choice]: 'best'}]}, new RegExp(`'${choice}'.*best`));
      await fails('render', {outputs: shadow, frames: [{[bias]: 1e9}]}, /outside/);
      await fails('render', {outputs: shadow, frames: [{wish: 1}]}, /no parameter 'wish'/);
      await fails('render', {outputs: ['depth'], frames: [{}]}, /'depth'/);
      const {frames: [frame]} = await adapter.good('render', {outputs: shadow, frames: [{}]});
      share_of(frame.files, shadow);

      const lonely = new Adapter(engine, {CHROMIUM: path.join(folder, 'no-browser')});
      assert.match((await lonely.ask('describe', {protocol: 1})).error, /no-browser|executable/);
      assert.deepEqual(await lonely.close(), {code: 0, signal: null});
    });

    await adapter_test.test('describes itself, and draws what it is asked for', async () => {
      const described = await adapter.good('describe', {protocol: 1});
      assert.equal(described.protocol, 1);
      assert.equal(described.name, name);
      for (const parameter of described.parameters) {
        assert.match(parameter.name, /^[a-z][a-z0-9]*(-[a-z0-9]+)*$/);
        assert.ok(['number', 'integer', 'boolean', 'choice'].includes(parameter.type) && parameter.meaning !== '');
        assert.ok(['shadow', 'ao'].includes(parameter.for));
        const {default: value, min = -Infinity, max = Infinity, choices} = parameter;
        const is_allowed = choices ? choices.includes(value)
                                   : typeof value === 'boolean' || (value >= min && value <= max);
        assert.ok(is_allowed, parameter.name);
      }
      assert.equal(new Set(described.parameters.map((each) => each.name)).size, described.parameters.length);

      await adapter.load();
      const defaults = Object.fromEntries(described.parameters.map((each) => [each.name, each.default]));
      const values = [biases[0], biases[1], biases[0]].map((value) => ({...defaults, [bias]: value}));
      const {frames: drawn} = await adapter.good('render', {outputs: [...shadow, 'position'], frames: values});
      assert.equal(drawn.length, 3);
      const images = drawn.map(({files, milliseconds}) => {
        assert.ok(milliseconds > 0);
        return {visibility: share_of(files, shadow), position: read_pfm(files.position)};
      });
      for (const {visibility, position} of images) {
        assert.deepEqual([visibility.width, visibility.height, visibility.channels], [160, 120, 1]);
        assert.deepEqual([position.width, position.height, position.channels], [160, 120, 3]);
      }
      check_images(images[0].position, images[0].visibility);
      assert.notDeepEqual(images[1].visibility.bytes, images[0].visibility.bytes, `${bias} changes nothing`);
      assert.deepEqual(images[2].visibility.bytes, images[0].visibility.bytes, 'a frame depends on the one before');

      if (has_more) {
        const outputs = ['ao', 'normal', 'position'];
        const {frames: [ambient]} = await adapter.good('render', {outputs, frames: [defaults]});
        const [ao, normal, position] = outputs.map((output) => read_pfm(ambient.files[output]));
        for (let y = 0; y < 120; ++y) {
          for (let x = 0; x < 160; ++x) {
            assert.ok(ao.at(x, y)[0] >= 0 && ao.at(x, y)[0] <= 1);
            const [nx, ny, nz] = normal.at(x, y);
            assert.equal(Number.isNaN(nx), Number.isNaN(position.at(x, y)[0]));
            if (!Number.isNaN(nx)) assert.ok(Math.abs(Math.hypot(nx, ny, nz) - 1) < 1e-3);
          }
        }
      }
      for (const kind of ['spot', 'point']) {
        const above = {kind, position: [0, 4, 0], direction: [0, -1, 0], range: 0, inner_cone: 0, outer_cone: 0.8};
        await adapter.load({light: {...load_request(scene, frames).light, ...above}});
        const {frames: [lamp]} = await adapter.good('render', {outputs: [...shadow, 'position'], frames: [defaults]});
        const [visible, where] = [share_of(lamp.files, shadow), read_pfm(lamp.files.position)];
        let shadowed = 0;
        for (let i = 0; i < 160 * 120; ++i) {
          const [px, py, pz] = where.at(i % 160, Math.floor(i / 160));
          if (Math.abs(py) < 1e-3 && Math.max(Math.abs(px), Math.abs(pz)) < 0.3) {
            ++shadowed;
            assert.ok(visible.at(i % 160, Math.floor(i / 160))[0] < 0.1, `${kind} light below the box`);
          }
        }
        assert.ok(shadowed > 5);
      }
    });

    const below = descendants(adapter.process.pid);
    assert.deepEqual(await adapter.close(), {code: 0, signal: null});
    await expect_end(below);
  });

  // The host is the same for all engines.
  if (engine !== 'threejs') continue;
  test(`${name}: no process is left when the browser, the adapter or its caller ends`, {timeout}, async (process_test) => {
    process_test.after(end_adapters);
    if (!existsSync('/proc/self/stat')) return;
    const start = async () => {
      const adapter = new Adapter(engine);
      await adapter.load();
      const below = descendants(adapter.process.pid);
      assert.ok(below.length > 0);
      return {adapter, below};
    };
    const killed = await start();
    process.kill(killed.below[0], 'SIGKILL');
    assert.equal(await killed.adapter.ask('render', {outputs: shadow, frames: [{}]}), undefined);
    assert.equal((await killed.adapter.ended).code, 1);
    assert.match(killed.adapter.errors.trim().split('\n').at(-1), /Chromium has ended/);
    await expect_end(killed.below);

    for (const [signal, code] of [['SIGTERM', 143], ['SIGKILL', null]]) {
      const {adapter, below} = await start();
      adapter.process.kill(signal);
      assert.equal((await adapter.ended).code, code);
      await expect_end(below);
    }
  });
}
