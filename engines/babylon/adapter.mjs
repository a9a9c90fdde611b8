// Starts the adapter of Babylon.js.
import path from 'node:path';
import {fileURLToPath} from 'node:url';
import {serve} from '../browser/host.mjs';
import {parameters} from './parameters.mjs';

await serve({
  name: 'Babylon.js',
  home: path.dirname(fileURLToPath(import.meta.url)),
  packages: ['@babylonjs/core', '@babylonjs/loaders'],
  imports: {
    '@babylonjs/core/': '/packages/@babylonjs/core/',
    '@babylonjs/loaders/': '/packages/@babylonjs/loaders/',
  },
  module: 'engine.mjs',
  parameters,
});
