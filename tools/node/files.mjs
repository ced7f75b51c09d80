// SPDX-License-Identifier: MIT
// What the checks of this folder share: finding glTF files under folders and reading their JSON.
import { readFileSync, readdirSync, lstatSync } from "node:fs";
import { basename, join } from "node:path";

/// All .glb and .gltf files at or under the paths, sorted. Folders named `broken` hold inputs that tests damage on
/// purpose; they are left out.
export function gltfFiles(paths) {
  const found = [];
  const visit = (path) => {
    if (basename(path) === "broken") return;
    if (lstatSync(path).isDirectory()) readdirSync(path).forEach((name) => visit(join(path, name)));
    else if (/\.(glb|gltf)$/.test(path)) found.push(path);
  };
  paths.forEach(visit);
  return found.sort();
}

/// The JSON of a .glb or .gltf file.
export function readJson(path) {
  const bytes = readFileSync(path);
  const binary = bytes.length >= 20 && bytes.toString("latin1", 0, 4) === "glTF";
  return JSON.parse(binary ? bytes.toString("utf8", 20, 20 + bytes.readUInt32LE(12)) : bytes.toString("utf8"));
}
