// The scene's file with white materials: the package has its own loader and its own materials, so the file is changed.

// Chunks of a binary glTF file: its JSON, and the bytes after it.
function parse(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.byteLength < 20 || view.getUint32(8, true) !== bytes.byteLength) throw new Error('scene.glb: is cut short');
  const end = 20 + view.getUint32(12, true);
  return {json: JSON.parse(new TextDecoder().decode(bytes.subarray(20, end))), rest: bytes.subarray(end)};
}

function write(json, rest) {
  const text = new TextEncoder().encode(JSON.stringify(json));
  const length = Math.ceil(text.length / 4) * 4;
  const bytes = new Uint8Array(20 + length + rest.length).fill(0x20);
  const view = new DataView(bytes.buffer);
  [0x46546c67, 2, bytes.length, length, 0x4e4f534a].forEach((word, i) => view.setUint32(4 * i, word, true));
  bytes.set(text, 20);
  bytes.set(rest, 20 + length);
  return bytes;
}

// Matte, with its sides; a mask keeps the texture of its alpha. Blended materials are opaque.
function matte(material) {
  const {doubleSided, alphaMode, alphaCutoff, pbrMetallicRoughness: {baseColorFactor, baseColorTexture} = {}} = material;
  const pbr = {metallicFactor: 0, roughnessFactor: 1, baseColorFactor: [1, 1, 1, 1]};
  if (alphaMode !== 'MASK') return {doubleSided, pbrMetallicRoughness: pbr};
  pbr.baseColorFactor[3] = baseColorFactor?.[3] ?? 1;
  return {doubleSided, alphaMode, alphaCutoff, pbrMetallicRoughness: {...pbr, baseColorTexture}};
}

/** The file without its lights, its cameras and its colours. */
export function whiten(bytes) {
  const {json, rest} = parse(bytes);
  json.materials = (json.materials ?? []).map((material) => matte(material));
  json.materials.push(matte({}));
  for (const {primitives} of json.meshes ?? []) {
    for (const primitive of primitives) primitive.material ??= json.materials.length - 1;
  }
  for (const node of json.nodes ?? []) {
    delete node.camera;
    delete node.extensions;
  }
  delete json.cameras;
  delete json.extensions;
  delete json.extensionsUsed;
  delete json.extensionsRequired;
  return write(json, rest);
}
