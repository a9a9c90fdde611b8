// Starts the adapter of three.js.
import path from 'node:path';
import {fileURLToPath} from 'node:url';
import {serve} from '../browser/host.mjs';
import {parameters} from './parameters.mjs';

await serve({
  name: 'three.js',
  home: path.dirname(fileURLToPath(import.meta.url)),
  packages: ['three', 'n8ao', 'postprocessing'],
  imports: {
    three: '/packages/three/build/three.module.js',
    'three/addons/': '/packages/three/examples/jsm/',
    'three/examples/jsm/': '/packages/three/examples/jsm/',
    n8ao: '/packages/n8ao/dist/N8AO.js',
    postprocessing: '/packages/postprocessing/build/index.js',
  },
  module: 'engine.mjs',
  parameters,
});
