// Starts the adapter of PlayCanvas.
import path from 'node:path';
import {fileURLToPath} from 'node:url';
import {serve} from '../browser/host.mjs';
import {parameters} from './parameters.mjs';

await serve({
  name: 'PlayCanvas',
  home: path.dirname(fileURLToPath(import.meta.url)),
  packages: ['playcanvas'],
  imports: {playcanvas: '/packages/playcanvas/build/playcanvas.mjs'},
  module: 'engine.mjs',
  parameters,
});
