// Starts the adapter of Filament.
import path from 'node:path';
import {fileURLToPath} from 'node:url';
import {serve} from '../browser/host.mjs';
import {parameters} from './parameters.mjs';

await serve({
  name: 'Filament',
  home: path.dirname(fileURLToPath(import.meta.url)),
  packages: ['filament'],
  imports: {},
  module: 'engine.mjs',
  outputs: ['lit', 'unshadowed', 'position'],
  constant: ['position'],
  parameters,
});
