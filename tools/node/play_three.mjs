// SPDX-License-Identifier: MIT
// play_three.mjs FILE.glb CLIP SECONDS... : what three.js makes of a clip. Prints one JSON document:
// {"times": [{"nodes": {"3": [16 numbers, column by column]}, "vertices": [{"node", "primitive", "at": [...]}]}]}
// in world space; of each primitive at most 200 vertices, in equal steps. Materials and images are left out.
import { readFileSync } from 'node:fs';
import { AnimationMixer, LoopOnce, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

const kMostVertices = 200;

// The file without what only renderers need, which Node cannot decode.
function withoutImages(bytes) {
  const length = bytes.readUInt32LE(12);
  const json = JSON.parse(bytes.subarray(20, 20 + length).toString());
  for (const key of ['materials', 'textures', 'images', 'samplers']) delete json[key];
  for (const mesh of json.meshes ?? [])
    for (const primitive of mesh.primitives) {
      delete primitive.material;
      delete primitive.extensions;
    }
  delete json.extensionsRequired;
  let text = Buffer.from(JSON.stringify(json));
  text = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, 0x20)]);
  const rest = bytes.subarray(20 + length);
  const head = Buffer.alloc(20);
  head.write('glTF');
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(20 + text.length + rest.length, 8);
  head.writeUInt32LE(text.length, 12);
  head.write('JSON', 16);
  return Buffer.concat([head, text, rest]);
}

function load(path) {
  const bytes = withoutImages(readFileSync(path));
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
  return new Promise((resolve, reject) => new GLTFLoader().parse(buffer, '', resolve, reject));
}

// Of an object: the glTF node that it is, or that it is a primitive of.
function nodeOf(object, associations) {
  for (let at = object; at; at = at.parent) {
    const node = associations.get(at)?.nodes;
    if (node !== undefined) return node;
  }
  return -1;
}

function verticesOf(mesh) {
  const count = mesh.geometry.attributes.position.count;
  const step = Math.max(1, Math.ceil(count / kMostVertices));
  const at = [];
  const point = new Vector3();
  for (let i = 0; i < count; i += step) {
    mesh.getVertexPosition(i, point);
    point.applyMatrix4(mesh.matrixWorld);
    at.push(point.x, point.y, point.z);
  }
  return at;
}

function stateOf(gltf) {
  const { associations } = gltf.parser;
  const nodes = {};
  const vertices = [];
  gltf.scene.updateMatrixWorld(true);
  gltf.scene.traverse((object) => {
    const own = associations.get(object);
    if (own?.nodes !== undefined) nodes[own.nodes] = object.matrixWorld.toArray();
    if (!object.isMesh) return;
    const primitive = own?.primitives ?? 0;
    vertices.push({ node: nodeOf(object, associations), primitive, at: verticesOf(object) });
  });
  return { nodes, vertices };
}

const [path, name, ...times] = process.argv.slice(2);
const gltf = await load(path);
const clip = gltf.animations.find((animation) => animation.name === name);
if (!clip) throw new Error(`no clip ${name}`);
const mixer = new AnimationMixer(gltf.scene);
const action = mixer.clipAction(clip);
action.setLoop(LoopOnce);
action.clampWhenFinished = true;
const states = [];
for (const time of times) {
  action.reset().play();
  mixer.setTime(Number(time));
  states.push(stateOf(gltf));
}
process.stdout.write(JSON.stringify({ times: states }));
