// Writes the name, version and licence of every package in a bundle: licences.mjs METAFILE OUTPUT
import {existsSync, readdirSync, readFileSync, writeFileSync} from 'node:fs';
import path from 'node:path';

const [metafile, output] = process.argv.slice(2);
const folders = new Set();
for (const input of Object.keys(JSON.parse(readFileSync(metafile, 'utf8')).inputs)) {
  const found = /^(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(input);
  if (found) folders.add(found[1]);
}

const parts = ['figures.cjs contains these packages.\n'];
for (const folder of [...folders].sort()) {
  const about = JSON.parse(readFileSync(path.join(folder, 'package.json'), 'utf8'));
  const file = readdirSync(folder).find((name) => /^licen[cs]e/i.test(name));
  const text = file && existsSync(path.join(folder, file)) ? readFileSync(path.join(folder, file), 'utf8').trim() : '';
  parts.push(`${about.name} ${about.version}: ${about.license ?? 'see below'}\n\n${text}\n`);
}
writeFileSync(output, parts.join('\n' + '-'.repeat(80) + '\n\n'));
