// SPDX-License-Identifier: MIT
// check_report.mjs SCHEMA FOLDER...: every report of rigc (*.json with `rigc_report`) below the folders against
// the JSON Schema, and that the schema refuses reports that were damaged.
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import Ajv2020 from "ajv/dist/2020.js";

const [schema, ...folders] = process.argv.slice(2);
const validate = new Ajv2020({ allErrors: true, strictTypes: false }).compile(JSON.parse(readFileSync(schema, "utf8")));

function reports(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return reports(path);
    if (!entry.name.endsWith(".json")) return [];
    const text = readFileSync(path, "utf8");
    return text.includes('"rigc_report"') ? [{ path, report: JSON.parse(text) }] : [];
  });
}

const damages = [
  (report) => { report.rigc_report = 2; },
  (report) => { delete report.totals; },
  (report) => { report.totals.changed = -1; },
  (report) => { report.files[0].outcome = "done"; },
  (report) => { delete report.files[0].file; },
  (report) => { report.files[0].outcome = "changed"; report.files[0].errors = [{ code: "RIG0001", message: "", place: "" }]; },
  (report) => { report.files[0].warnings = [{ code: "1", message: "", place: "" }]; },
];

let failures = 0;
const found = folders.flatMap(reports);
for (const { path, report } of found) {
  if (validate(report)) continue;
  failures += 1;
  for (const { instancePath, message } of validate.errors.slice(0, 20)) console.error(`${path}#${instancePath}: ${message}`);
}
const whole = found.find(({ report }) => report.files.length > 0);
for (const damage of whole ? damages : []) {
  const report = structuredClone(whole.report);
  damage(report);
  if (!validate(report)) continue;
  failures += 1;
  console.error(`the schema accepts what this does to ${whole.path}: ${damage}`);
}
console.log(`report schema: ${found.length} reports, ${failures} mistakes`);
process.exit(whole && failures === 0 ? 0 : 1);
