// The run as the program writes it into the page (reports/page/viewer_json.cpp), unpacked to typed arrays.

export type Kind = 'share' | 'error' | 'number' | 'category' | 'color' | 'vector';
export type Role = 'reference' | 'technique' | 'error' | 'cause' | 'other';
export type Color = [number, number, number];

interface PackedPlane {
  type: 'u8' | 'u16' | 'f16';
  data: string;
}
interface LayerHead {
  name: string;
  title: string;
  group: string;
  role: Role;
  kind: Kind;
  unit: string;
  range: [number, number];
  categories: {name: string; color: Color}[];
}
interface BiasHead {
  group: string;
  missing: string;
  unit: 'm' | 'texels';
  mean_texel: number;
  used: number;
  axis: number[];
  shares: [number, number, number, number][];
}
interface PackedParts {
  names: string[];
  plane: PackedPlane;
}
interface PackedRun {
  title: string;
  width: number;
  height: number;
  stride: number;
  maps: {sequential: string; diverging: string};
  layers: (LayerHead & {planes: PackedPlane[]})[];
  biases: (BiasHead & {bin?: PackedPlane; cause?: PackedPlane})[];
  objects: PackedParts | null;
  materials: PackedParts | null;
}

export interface Layer extends LayerHead {
  planes: Float32Array[];
  version: number; // grows when the values change, so that painters upload them again
}
export interface Bias extends BiasHead {
  index: number; // of the selected bias on the axis
  bin?: Float32Array; // absent if the images cannot follow the bias
  cause?: Float32Array;
}
export interface Parts {
  names: string[];
  index: Float32Array; // 0 is the background, otherwise 1 + an index into names
}
export interface Run {
  title: string;
  width: number; // of the rendered images, pixels
  height: number;
  stride: number; // every stride-th pixel is here
  columns: number; // of the images here
  rows: number;
  maps: {sequential: Uint8Array; diverging: Uint8Array}; // sRGB bytes
  layers: Layer[];
  biases: Bias[];
  objects: Parts | null;
  materials: Parts | null;
}

function bytes_of(base64: string): Uint8Array {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflate(bytes: Uint8Array): Promise<Uint8Array> {
  const stream = new Blob([bytes as BlobPart]).stream().pipeThrough(new DecompressionStream('deflate'));
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

let half_table: Float32Array | undefined;

async function unpack(plane: PackedPlane): Promise<Float32Array> {
  const bytes = await inflate(bytes_of(plane.data));
  if (plane.type === 'u8') return Float32Array.from(bytes);
  half_table ??= Float32Array.from({length: 65536}, (_, bits) => from_half(bits));
  const count = bytes.length / 2;
  const values = new Float32Array(count);
  for (let i = 0; i < count; ++i) {
    const word = bytes[i] | (bytes[count + i] << 8); // all low bytes come first
    values[i] = plane.type === 'u16' ? word : half_table[word];
  }
  return values;
}

async function unpack_parts(parts: PackedParts | null): Promise<Parts | null> {
  return parts ? {names: parts.names, index: await unpack(parts.plane)} : null;
}

// The value of the axis that is the run's own bias.
export function used_index(bias: BiasHead): number {
  let best = 0;
  bias.axis.forEach((value, i) => {
    if (Math.abs(value - bias.used) < Math.abs(bias.axis[best] - bias.used)) best = i;
  });
  return best;
}

export async function read_run(json: string): Promise<Run> {
  const packed = JSON.parse(json) as PackedRun;
  const layers = packed.layers.map(async ({planes, ...head}) => {
    return {...head, planes: await Promise.all(planes.map(unpack)), version: 0};
  });
  const biases = packed.biases.map(async ({bin, cause, ...head}) => {
    const bias: Bias = {...head, index: used_index(head)};
    if (bin && cause) [bias.bin, bias.cause] = await Promise.all([unpack(bin), unpack(cause)]);
    return bias;
  });
  return {
    title: packed.title,
    width: packed.width,
    height: packed.height,
    stride: packed.stride,
    columns: Math.ceil(packed.width / packed.stride),
    rows: Math.ceil(packed.height / packed.stride),
    maps: {sequential: bytes_of(packed.maps.sequential), diverging: bytes_of(packed.maps.diverging)},
    layers: await Promise.all(layers),
    biases: await Promise.all(biases),
    objects: await unpack_parts(packed.objects),
    materials: await unpack_parts(packed.materials),
  };
}
