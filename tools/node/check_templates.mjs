// SPDX-License-Identifier: MIT
// check_templates.mjs RIGC [--update]: the JSON Schemas that `rigc schema` prints, applied to every template, part and
// example there is, to the bad inputs of tests/bad, and to random changes of good templates. A folder of tests/bad has
// a file `schema` exactly where the schema (or YAML itself) sees the mistake: the lines it complains about, which are
// among those that rigc complains about. --update writes these files. Exit status 1 where anything differs.
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { changed } from "./template_changes.mjs";
import { compile, complaints, parseYaml } from "./yaml_places.mjs";

const [rigc, option] = process.argv.slice(2);
const root = join(dirname(fileURLToPath(import.meta.url)), "../..");
const run = (...args) => execFileSync(rigc, args, { encoding: "utf8", maxBuffer: 1 << 26 });
const schemaOf = (name, ...args) => compile(JSON.parse(run("schema", name, ...args)));
let failures = 0;
function fail(message) {
  console.error(message);
  failures += 1;
}

function yamlFiles(folder) {
  return readdirSync(folder).sort().flatMap((name) => {
    const path = join(folder, name);
    if (statSync(path).isDirectory()) return yamlFiles(path);
    return name.endsWith(".yaml") ? [path] : [];
  });
}

/// What a schema says about a text: "line keyword message" each, or the parser's errors.
function verdict(validate, text) {
  const parsed = parseYaml(text);
  return parsed.syntax ? { syntax: parsed.syntax, list: [] } : { list: complaints(validate, parsed) };
}

function mustFit(validate, name, text) {
  const { syntax = [], list } = verdict(validate, text);
  for (const message of syntax) fail(`${name}: ${message}`);
  for (const { line, path, message } of list) fail(`${name}:${line}: ${path} ${message}`);
}

// Good files.
const ofTemplates = schemaOf("template");
const templates = yamlFiles(join(root, "templates")).filter((path) => basename(dirname(path)) !== "maps");
for (const path of templates) mustFit(ofTemplates, path, readFileSync(path, "utf8"));
const modules = JSON.parse(run("modules", "--json"));
for (const { module, example } of modules) if (example) mustFit(ofTemplates, `example of ${module}`, example);
const ofMaps = schemaOf("map");
for (const path of yamlFiles(join(root, "templates/maps"))) mustFit(ofMaps, path, readFileSync(path, "utf8"));
const ofModules = schemaOf("module");
for (const path of yamlFiles(join(root, "modules.d"))) mustFit(ofModules, path, readFileSync(path, "utf8"));

// Bad files and their repaired twins.
let seen = 0;
const cases = readdirSync(join(root, "tests/bad")).filter((name) => statSync(join(root, "tests/bad", name)).isDirectory());
for (const name of cases) {
  const folder = join(root, "tests/bad", name);
  const own = join(folder, "modules.d");
  const validate = existsSync(own) ? schemaOf("template", "--modules", own) : ofTemplates;
  mustFit(validate, join(folder, "good.yaml"), readFileSync(join(folder, "good.yaml"), "utf8"));
  const { syntax, list } = verdict(validate, readFileSync(join(folder, "bad.yaml"), "utf8"));
  const found = syntax ? ["syntax"] : [...new Set(list.map(({ line, keyword }) => `${line} ${keyword}`))];
  const kept = join(folder, "schema");
  const text = found.map((line) => `${line}\n`).join("");
  seen += found.length > 0 ? 1 : 0;
  const expected = readFileSync(join(folder, "expected"), "utf8");
  const lines = [...expected.matchAll(/^(\d+):/gm)].map(([, line]) => Number(line));
  for (const { line, last, above, path, message } of list)
    if (!lines.some((one) => (one >= line && one <= last) || above.includes(one)))
      fail(`${folder}/bad.yaml:${line}: ${path} ${message}: rigc says nothing about this place`);
  if (option === "--update") {
    if (text) writeFileSync(kept, text);
    else rmSync(kept, { force: true });
  } else if (text !== (existsSync(kept) ? readFileSync(kept, "utf8") : "")) {
    fail(`${kept}: the schema now says\n${text || "nothing\n"}(check it, then run with --update)`);
  }
}

// Random changes: what the schema rejects, rigc rejects; and the schema sees most of what rigc sees.
const folder = mkdtempSync(join(tmpdir(), "rigc_schema_"));
const texts = templates.map((path) => readFileSync(path, "utf8")).concat(modules.map(({ example }) => example).filter(Boolean));
const names = changed(texts, 600).map((text, index) => {
  const name = join(folder, `change_${String(index).padStart(4, "0")}.yaml`);
  writeFileSync(name, text);
  return name;
});
const checked = spawnSync(rigc, ["check", "--json", "--templates", join(root, "templates"), "--templates",
  join(root, "templates/tutorial"), ...names], { encoding: "utf8", maxBuffer: 1 << 28 });
let rejected = 0;
let both = 0;
for (const { file, errors, diagnostics } of JSON.parse(checked.stdout).files) {
  const { syntax, list } = verdict(ofTemplates, readFileSync(file, "utf8"));
  const sees = syntax !== undefined || list.length > 0;
  rejected += errors > 0 ? 1 : 0;
  both += errors > 0 && sees ? 1 : 0;
  if (sees && errors === 0) fail(`${file}:${list[0]?.line}: ${list[0]?.path} ${list[0]?.message}: rigc takes it`);
  if (process.env.VERBOSE && errors > 0 && !sees) console.log(`${file}: ${diagnostics[0].line}: ${diagnostics[0].message}`);
}
const share = Math.round((100 * both) / rejected);
if (share < 70) fail(`of ${rejected} changes that rigc rejects the schema sees only ${both}`);
if (failures === 0) rmSync(folder, { recursive: true });

console.log(`schemas: ${templates.length} templates, ${modules.length} modules, ${cases.length} bad inputs of which they see ` +
  `${seen}, ${rejected} wrong changes of which they see ${share} %, ${failures} failures`);
process.exit(failures === 0 ? 0 : 1);
