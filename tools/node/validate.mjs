// SPDX-License-Identifier: MIT
// validate.mjs FILE|FOLDER...: the Khronos validator over every .glb and .gltf there. A file beside which stands
// FILE.model (a text: the path of the model that it was made from) may have the errors and warnings that the
// model has, counted by code and pointer; where it names several models, one a line, those of all of them, counted
// by code, because what they point at has moved. Any other file may have none. Exit status 1 where a file has more.
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
async function messagesOfModel(model) {
  if (!models.has(model)) models.set(model, await messages(model));
  return models.get(model);
}

/// "error CODE pointer" as "error CODE"; counts of equal ones are added up.
function byCode(lists) {
  const sums = new Map();
  for (const [key, { count, message }] of lists.flatMap((list) => [...list])) {
    const code = key.split(" ").slice(0, 2).join(" ");
    sums.set(code, { count: (sums.get(code)?.count ?? 0) + count, message });
  }
  return sums;
}

/// The messages that a file has, and those that its models have, as far as they can be compared.
async function compared(path) {
  const own = await messages(path);
  const sidecar = `${path}.model`;
  if (!existsSync(sidecar)) return [own, new Map()];
  const names = readFileSync(sidecar, "utf8").split("\n").map((name) => name.trim()).filter((name) => name);
  const lists = [];
  for (const name of names) lists.push(await messagesOfModel(resolve(dirname(path), name)));
  return names.length === 1 ? [own, lists[0]] : [byCode([own]), byCode(lists)];
}

const files = gltfFiles(process.argv.slice(2));
let failures = 0;
for (const path of files) {
  const [own, before] = await compared(path);
  for (const [key, { count, message }] of own) {
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
