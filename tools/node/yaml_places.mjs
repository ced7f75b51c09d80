// SPDX-License-Identifier: MIT
// YAML as editors read it (YAML 1.2 with merge keys), and JSON Schema's complaints about it as lines of the file.
import Ajv from "ajv";
import { LineCounter, isAlias, isMap, isSeq, parseDocument } from "yaml";

/// A text as {value, errors}; errors are the parser's own, as lines.
export function parseYaml(text) {
  const lines = new LineCounter();
  const document = parseDocument(text, { version: "1.2", merge: true, lineCounter: lines });
  const wrong = [...document.errors, ...document.warnings];
  if (wrong.length > 0) return { syntax: wrong.map(({ message }) => message) };
  try {
    return { value: document.toJS(), document, lines };
  } catch (error) {
    return { syntax: [String(error)] };
  }
}

/// A validator for the schemas that rigc prints; they have a few words of editors besides JSON Schema's.
export function compile(schema) {
  const ajv = new Ajv({ allErrors: true, allowUnionTypes: true, strictTypes: false, strictRequired: false });
  for (const word of ["markdownDescription", "markdownEnumDescriptions", "patternErrorMessage", "errorMessage",
    "deprecationMessage"])
    ajv.addKeyword(word);
  return ajv.compile(schema);
}

/// Complaints as {line, last, above, keyword, path, message}, in the order of the file: the lines of the node (or the
/// key) that is complained about, and the first lines of the nodes that it is in. Those that only say that one of
/// several schemas did not fit are left out where another says why.
export function complaints(validate, { value, document, lines }) {
  if (validate(value)) return [];
  const alternatives = validate.errors.filter(({ keyword }) => keyword === "anyOf");
  const inside = ({ schemaPath }) => alternatives.some((one) => schemaPath.startsWith(`${one.schemaPath}/`));
  const found = validate.errors.filter((error) => error.keyword !== "if" && !inside(error));
  const lineAt = (offset) => lines.linePos(offset).line;
  return found.map(({ instancePath, keyword, params, message }) => {
    const key = params.additionalProperty ?? params.propertyName;
    const path = key === undefined ? instancePath : `${instancePath}/${key}`;
    const ranges = rangesOf(document, path);
    const [begin, end] = ranges.pop();
    const above = ranges.map(([first]) => lineAt(first));
    return { line: lineAt(begin), last: lineAt(Math.max(begin, end - 1)), above, keyword, path, message };
  }).sort((a, b) => a.line - b.line);
}

/// [begin, end] of the nodes on the way to a JSON pointer, outermost first; of a value in a map with its key.
function rangesOf(document, pointer) {
  let node = document.contents;
  const ranges = [node.range];
  const steps = pointer.split("/").slice(1).map((step) => step.replaceAll("~1", "/").replaceAll("~0", "~"));
  for (const step of steps) {
    const holder = isAlias(node) ? node.resolve(document) : node;
    const pair = isMap(holder) ? holder.items.find(({ key }) => String(key.value) === step) : undefined;
    node = pair ? pair.value : isSeq(holder) ? holder.items[Number(step)] : undefined;
    if (!pair && !node) return ranges; // merged from elsewhere
    const [begin] = pair ? pair.key.range : node.range;
    ranges.push([begin, node?.range ? node.range[1] : begin]);
    if (!node) return ranges;
  }
  return ranges;
}
