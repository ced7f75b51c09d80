// SPDX-License-Identifier: MIT
// check_schema.mjs SCHEMA FILE|FOLDER...: `extensions.RIGC_rig` of every rig there against the JSON Schema.
import { readFileSync } from "node:fs";
import Ajv2020 from "ajv/dist/2020.js";
import { gltfFiles, readJson } from "./files.mjs";

const [schema, ...paths] = process.argv.slice(2);
const validate = new Ajv2020({ allErrors: true }).compile(JSON.parse(readFileSync(schema, "utf8")));
let rigs = 0;
let failures = 0;
for (const path of gltfFiles(paths)) {
  const rig = readJson(path).extensions?.RIGC_rig;
  if (rig === undefined) continue;
  rigs += 1;
  if (validate(rig)) continue;
  failures += 1;
  if (failures > 5) continue;
  for (const { instancePath, message, params } of validate.errors.slice(0, 20)) {
    console.error(`${path}#/extensions/RIGC_rig${instancePath}: ${message} ${JSON.stringify(params)}`);
  }
}
console.log(`schema: ${rigs} rigs, ${failures} that do not fit`);
process.exit(rigs > 0 && failures === 0 ? 0 : 1);
