// The images as the program packs them (reports/page/plane.cpp and plane_words.cpp), unpacked to typed arrays.

export interface PackedPlane {
  type: 'u8' | 'u16' | 'f16' | 'pal' | 'share';
  data: string;
  palette?: number[]; // bits of half floats
  predictor?: 'none' | 'paeth' | 'gradient' | 'difference'; // of f16, as the rest
  channels?: number;
  columns?: number;
  bits?: number; // of each half float, the highest
}

export function bytes_of(base64: string): Uint8Array {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflate({data}: PackedPlane): Promise<Uint8Array> {
  const stream = new Blob([bytes_of(data) as BlobPart]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// IEEE 754 binary16.
export function from_half(bits: number): number {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 1023;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent ? (1 + fraction / 1024) * 2 ** (exponent - 15) : fraction * 2 ** -24);
}

const tables = new Map<number, Float32Array>();

// The values of integers that are in the order of the values.
function table_of(bits: number): Float32Array {
  const sign = 1 << (bits - 1);
  const known = tables.get(bits) ?? Float32Array.from({length: 2 * sign}, (_, word) =>
    from_half((word & sign ? word ^ sign : ~word & (2 * sign - 1)) << (16 - bits)));
  tables.set(bits, known);
  return known;
}

// The same sum as the program's, so that both have the same bits.
function ordered_differences(from: Float32Array, take: Float32Array): Uint16Array {
  const difference = new Float32Array(1);
  const bits = new Uint32Array(difference.buffer);
  const words = new Uint16Array(from.length);
  for (let i = 0; i < words.length; ++i) {
    difference[0] = from[i] - take[i];
    if (!Number.isFinite(difference[0])) continue;
    const rounded = (((bits[0] & 0x7fffffff) + 0x1000) >>> 13) - (112 << 10);
    const half = Math.min(Math.max(rounded, 0), 0x7c00);
    words[i] = bits[0] >>> 31 ? ~(half | 0x8000) : half | 0x8000;
  }
  return words;
}

function paeth(before: number, above: number, corner: number): number {
  const to_before = Math.abs(above - corner);
  const to_above = Math.abs(before - corner);
  const to_corner = Math.abs(before + above - 2 * corner);
  if (to_before <= to_above && to_before <= to_corner) return before;
  return to_above <= to_corner ? above : corner;
}

// Adds what was missed to what is predicted.
function add_predicted(bytes: Uint8Array, plane: PackedPlane, given?: Uint16Array): Float32Array[] {
  const {predictor, channels = 1, columns = 1, bits = 16} = plane;
  const count = bytes.length / 2 / channels;
  const [step, between, high] = predictor === 'none' ? [2 * channels, 2, 1] : [channels, 1, channels * count];
  const is_paeth = predictor === 'paeth';
  const is_spatial = is_paeth || predictor === 'gradient';
  const table = table_of(bits);
  const mask = table.length - 1;
  const missed = new Int32Array(count);
  const words = new Uint16Array(count);
  const planes: Float32Array[] = [];
  for (let c = 0; c < channels; ++c) {
    const values = new Float32Array(count);
    for (let i = 0, x = 0; i < count; ++i, ++x) {
      if (x === columns) x = 0;
      let guess = given ? given[i] : 0;
      if (is_spatial) {
        const has_above = i >= columns;
        const before = x > 0 ? words[i - 1] : has_above ? words[i - columns] : 0;
        const above = has_above ? words[i - columns] : before;
        const corner = x > 0 && has_above ? words[i - columns - 1] : above;
        guess = is_paeth ? paeth(before, above, corner) : before + above - corner;
      }
      const at = step * i + between * c;
      const stored = bytes[at] | (bytes[at + high] << 8);
      missed[i] += (stored >>> 1) ^ -(stored & 1);
      words[i] = (guess + missed[i]) & mask;
      values[i] = table[words[i]];
    }
    planes.push(values);
  }
  return planes;
}

// One, or of colours and vectors three.
export async function unpack(plane: PackedPlane): Promise<Float32Array[]> {
  const bytes = await inflate(plane);
  if (plane.type === 'f16') return add_predicted(bytes, plane);
  if (plane.type === 'u8') return [new Float32Array(bytes)];
  const is_long = plane.type === 'u16';
  const count = is_long ? bytes.length / 2 : bytes.length; // all low bytes come first
  const palette = plane.palette?.map(from_half);
  const values = new Float32Array(count);
  for (let i = 0; i < count; ++i) {
    const byte = bytes[i];
    values[i] = is_long ? byte | (bytes[count + i] << 8) : palette ? palette[byte] : byte / 255;
  }
  return [values];
}

// An error that was predicted from what it is the difference of.
export async function unpack_error(plane: PackedPlane, technique: Float32Array, reference: Float32Array): Promise<Float32Array> {
  return add_predicted(await inflate(plane), plane, ordered_differences(technique, reference))[0];
}

// The numbers of those pixels that have a category, stored by category.
export function ungroup(numbers: Float32Array, category: Float32Array): Float32Array {
  const values = new Float32Array(category.length);
  let next = 0;
  for (let c = 1; c < 256 && next < numbers.length; ++c) {
    for (let i = 0; i < values.length; ++i) if (category[i] === c) values[i] = numbers[next++];
  }
  return values;
}
