// Reads what reports/files/exr.cpp writes: scan lines of 32-bit floats, ZIP-compressed.
import {readFileSync} from 'node:fs';
import {inflateSync} from 'node:zlib';

function read_header(file) {
  let at = 8;
  const text = () => {
    const end = file.indexOf(0, at);
    const found = file.toString('latin1', at, end);
    at = end + 1;
    return found;
  };
  const header = {};
  for (let name = text(); name !== ''; name = text()) {
    text();  // the type
    const size = file.readInt32LE(at);
    header[name] = file.subarray(at + 4, at + 4 + size);
    at += 4 + size;
  }
  return {header, at};
}

function channel_names(list) {
  const names = [];
  for (let at = 0; list[at] !== 0; at += 16) {
    const end = list.indexOf(0, at);
    names.push(list.toString('latin1', at, end));
    at = end + 1;
  }
  return names;
}

// ZIP blocks hold differences of bytes, the even ones first.
function undo_prediction(bytes) {
  for (let i = 1; i < bytes.length; ++i) bytes[i] = (bytes[i - 1] + bytes[i] - 128) & 255;
  const plain = Buffer.alloc(bytes.length);
  const half = Math.ceil(bytes.length / 2);
  for (let i = 0; i < bytes.length; ++i) plain[i] = bytes[i % 2 === 0 ? i / 2 : half + (i - 1) / 2];
  return plain;
}

// {width, height, channels: {name: Float32Array}}
export function read_exr(path) {
  const file = readFileSync(path);
  const {header, at} = read_header(file);
  const names = channel_names(header.channels);
  const [left, top, right, bottom] = [0, 4, 8, 12].map((offset) => header.dataWindow.readInt32LE(offset));
  const [width, height] = [right - left + 1, bottom - top + 1];
  const channels = Object.fromEntries(names.map((name) => [name, new Float32Array(width * height)]));
  for (let block = 0; block < Math.ceil(height / 16); ++block) {
    const start = Number(file.readBigUInt64LE(at + 8 * block));
    const first = file.readInt32LE(start) - top;
    const lines = Math.min(16, height - first);
    const packed = file.subarray(start + 8, start + 8 + file.readInt32LE(start + 4));
    const size = lines * names.length * width * 4;
    const bytes = packed.length < size ? undo_prediction(inflateSync(packed)) : packed;
    for (let line = 0; line < lines; ++line) {
      names.forEach((name, c) => {
        for (let x = 0; x < width; ++x) {
          channels[name][(first + line) * width + x] = bytes.readFloatLE(4 * ((line * names.length + c) * width + x));
        }
      });
    }
  }
  return {width, height, channels};
}
