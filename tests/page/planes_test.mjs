// Every value that the page's script unpacks is the half float of that in images.exr.
import assert from 'node:assert/strict';
import {readFileSync, writeFileSync} from 'node:fs';
import path from 'node:path';
import test from 'node:test';
import {pathToFileURL} from 'node:url';
import ts from 'typescript';
import {read_exr} from './exr.mjs';
import {compare, folder, plain_run, tune_run} from './runs.mjs';

// The script's own module, as Node loads it.
async function load_pack() {
  for (const name of ['data', 'planes']) {
    const text = readFileSync(path.join(process.env.UMBRAMETER_VIEWER, `${name}.ts`), 'utf8');
    const {outputText} = ts.transpileModule(text, {compilerOptions: {module: 'esnext', target: 'es2022'}});
    writeFileSync(path.join(folder, `${name}.mjs`), outputText.replace("'./planes'", "'./planes.mjs'"));
  }
  return (await import(pathToFileURL(path.join(folder, 'data.mjs')).href)).Pack;
}

async function sets_of(out) {
  const html = readFileSync(path.join(out, 'index.html'), 'utf8');
  const Pack = await load_pack();
  const pack = new Pack(/id="viewer-data">(.*?)<\/script>/s.exec(html)[1]);
  return Promise.all(pack.cells.map((_, index) => pack.read(index)));
}

// Of a number of `bits` bits; the subnormal half floats have an even step.
const step_of = (value, bits) => 2 ** (Math.max(Math.floor(Math.log2(Math.abs(value))), -14) + 1 - bits);
// The picture is rounded twice: to 11 bits, then to 7.
const bound_of = (name, value) => 0.5 * (step_of(value, 11) + (name === 'picture' ? step_of(value, 7) : 0));
const channels_of = ({name}) => (name === 'picture' ? ['R', 'G', 'B'] : name === 'Z' ? ['Z'] : [`${name}.Y`]);

test('every value of the page is the half float of images.exr', async () => {
  for (const out of [plain_run(), compare('filtered', 'courtyard', '--light', 'sun', '--shadow.filter', 'gaussian', '--shadow.filter-size', '7')]) {
    const {channels} = read_exr(path.join(out, 'images.exr'));
    const [{layers}] = await sets_of(out);
    for (const name of ['error_ao', 'error_visibility_sun']) assert.ok(layers.some((layer) => layer.name === name), name);
    for (const layer of layers) {
      const names = layer.kind === 'vector' ? ['X', 'Y', 'Z'].map((each) => `${layer.name}.${each}`) : channels_of(layer);
      assert.equal(layer.planes.length, names.length, layer.name);
      for (const [c, plane] of layer.planes.entries()) {
        const values = channels[names[c]];
        assert.equal(plane.length, values.length);
        const wrong = plane.findIndex((value, i) =>
          !Object.is(value, values[i]) && !(Math.abs(value - values[i]) <= bound_of(layer.name, values[i])));
        assert.equal(wrong, -1, `${names[c]} at ${wrong}: ${plane[wrong]}, not ${values[wrong]}`);
      }
    }
  }
});

test('sets of images that share planes are unpacked whole', async () => {
  for (const {layers, biases, columns, rows} of await sets_of(tune_run())) {
    for (const layer of layers) for (const plane of layer.planes) assert.equal(plane.length, columns * rows);
    for (const {bin, cause} of biases) {
      assert.ok(bin.every((each, i) => (each > 0) === (cause[i] > 0)));
    }
  }
});
