// Portable float maps: the rows that WebGL reads, from the bottom, are the order of the format.
import {writeFileSync} from 'node:fs';

/** Writes 1 or 3 channels of little-endian 32-bit floats; `bytes` has the bottom row first. */
export function write_pfm(file, width, height, channels, bytes) {
  if (bytes.length !== 4 * width * height * channels) throw new Error(`${file}: ${bytes.length} bytes are no image`);
  const header = Buffer.from(`${channels === 3 ? 'PF' : 'Pf'}\n${width} ${height}\n-1.0\n`, 'latin1');
  writeFileSync(file, Buffer.concat([header, bytes]));
}
