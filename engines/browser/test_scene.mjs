// A scene whose shadows and positions are known: a box of 1 m hovers 0.5 m above a floor of 10 m, the sun overhead.

// Corners of a face: its centre ± its two half axes, counter-clockwise seen from outside.
function face(center, u, v) {
  return [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => center.map((c, i) => c + a * u[i] + b * v[i]));
}

const faces = [
  {normal: [0, 1, 0], corners: face([0, 0, 0], [5, 0, 0], [0, 0, -5])},
  {normal: [0, 1, 0], corners: face([0, 1.5, 0], [0.5, 0, 0], [0, 0, -0.5])},
  {normal: [0, -1, 0], corners: face([0, 0.5, 0], [0.5, 0, 0], [0, 0, 0.5])},
  {normal: [1, 0, 0], corners: face([0.5, 1, 0], [0, 0, -0.5], [0, 0.5, 0])},
  {normal: [-1, 0, 0], corners: face([-0.5, 1, 0], [0, 0, 0.5], [0, 0.5, 0])},
  {normal: [0, 0, 1], corners: face([0, 1, 0.5], [0.5, 0, 0], [0, 0.5, 0])},
  {normal: [0, 0, -1], corners: face([0, 1, -0.5], [-0.5, 0, 0], [0, 0.5, 0])},
];

/** The bytes of a binary glTF file. */
export function box_scene() {
  const positions = Float32Array.from(faces.flatMap(({corners}) => corners.flat()));
  const normals = Float32Array.from(faces.flatMap(({normal}) => [normal, normal, normal, normal].flat()));
  const indices = Uint16Array.from(faces.flatMap((_, i) => [0, 1, 2, 0, 2, 3].map((corner) => 4 * i + corner)));
  const binary = Buffer.concat([positions, normals, indices].map((each) => Buffer.from(each.buffer)));
  const json = {
    asset: {version: '2.0'}, scene: 0, scenes: [{nodes: [0]}], nodes: [{mesh: 0}],
    meshes: [{primitives: [{attributes: {POSITION: 0, NORMAL: 1}, indices: 2, material: 0}]}],
    materials: [{pbrMetallicRoughness: {baseColorFactor: [0.5, 0.5, 0.5, 1], metallicFactor: 0}}],
    accessors: [
      {bufferView: 0, componentType: 5126, count: 28, type: 'VEC3', min: [-5, 0, -5], max: [5, 1.5, 5]},
      {bufferView: 1, componentType: 5126, count: 28, type: 'VEC3'},
      {bufferView: 2, componentType: 5123, count: 42, type: 'SCALAR'},
    ],
    bufferViews: [
      {buffer: 0, byteOffset: 0, byteLength: 336}, {buffer: 0, byteOffset: 336, byteLength: 336},
      {buffer: 0, byteOffset: 672, byteLength: 84},
    ],
    buffers: [{byteLength: 756}],
  };
  const text = Buffer.from(JSON.stringify(json));
  const padded = Buffer.concat([text, Buffer.alloc((4 - text.length % 4) % 4, ' ')]);
  const head = Buffer.alloc(20);
  head.write('glTF', 0, 'latin1');
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(28 + padded.length + binary.length, 8);
  head.writeUInt32LE(padded.length, 12);
  head.write('JSON', 16, 'latin1');
  const between = Buffer.alloc(8);
  between.writeUInt32LE(binary.length, 0);
  between.write('BIN\0', 4, 'latin1');
  return Buffer.concat([head, padded, between, binary]);
}

/** A load request: the camera stands 2 m above the floor, 6 m before the box, and looks down by 0.2 rad. */
export function load_request(scene, folder) {
  const [c, s] = [Math.cos(0.2), Math.sin(0.2)];
  return {
    scene, folder, width: 160, height: 120,
    camera: {kind: 'perspective', vertical_fov: 0.9, near: 0.1, far: 50,
             world_from_camera: [1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0, 0, 2, 6, 1]},
    light: {kind: 'directional', direction: [0, -1, 0], position: [0, 10, 0], color: [1, 1, 1], intensity: 3, range: 0,
            inner_cone: 0, outer_cone: 0.785},
    bounds: {min: [-5, 0, -5], max: [5, 1.5, 5]},
  };
}
