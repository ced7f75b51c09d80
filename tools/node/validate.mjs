// SPDX-License-Identifier: MIT
// validate.mjs FILE|FOLDER...: the Khronos validator over every .glb and .gltf there. A file beside which stands
// FILE.model (a text: the path of the model that it was made from) may have the errors and warnings that the
// model has, counted by code and pointer; any other file may have none. Exit status 1 where a file has more.
import { existsSync, readFileSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { validateBytes } from "gltf-validator";
import { gltfFiles } from "./files.mjs";

const severities = ["error", "warning"];

/// Messages of a file as a map from "severity CODE pointer" to how often it is there.
async function messages(path) {
  try {
    return countMessages((await validate(path)).issues.messages);
  } catch (error) {
    return new Map([["error UNREADABLE ", { count: 1, message: String(error) }]]);
  }
}

function validate(path) {
  return validateBytes(new Uint8Array(readFileSync(path)), {
    uri: path,
    maxIssues: 0,
    externalResourceFunction: async (uri) =>
      new Uint8Array(readFileSync(resolve(dirname(path), decodeURIComponent(uri)))),
  });
}

function countMessages(list) {
  const counts = new Map();
  for (const { severity, code, pointer, message } of list) {
    if (severity >= severities.length) continue;
    const key = `${severities[severity]} ${code} ${pointer ?? ""}`;
    counts.set(key, { count: (counts.get(key)?.count ?? 0) + 1, message });
  }
  return counts;
}

const models = new Map(); // path of a model -> its messages
async function allowed(path) {
  const sidecar = `${path}.model`;
  if (!existsSync(sidecar)) return new Map();
  const model = resolve(dirname(path), readFileSync(sidecar, "utf8").trim());
  if (!models.has(model)) models.set(model, await messages(model));
  return models.get(model);
}

const files = gltfFiles(process.argv.slice(2));
let failures = 0;
for (const path of files) {
  const before = await allowed(path);
  for (const [key, { count, message }] of await messages(path)) {
    if (count <= (before.get(key)?.count ?? 0)) continue;
    console.error(`${path}: ${key}: ${message}`);
    failures += 1;
  }
}
if (files.length === 0) {
  console.error("no .glb or .gltf file to validate");
  failures = 1;
}
console.log(`validator: ${files.length} files, ${failures} messages that should not be there`);
process.exit(failures === 0 ? 0 : 1);
