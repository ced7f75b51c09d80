// SPDX-License-Identifier: MIT
// Random changes of good templates, one a text: a value of another type or out of range, a key that is gone, new or
// misspelt. The same texts give the same changes.
import { isMap, isScalar, isSeq, parseDocument } from "yaml";

/// Numbers by Marsaglia's xorshift: the same everywhere.
function randomNumbers(seed) {
  let state = seed;
  return (below) => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) % below;
  };
}

const values = [0, -1, 1e9, 2.5, "word", "two words", "1_2", "off", null, [], [1], [1, 2, 3], [1, "two", 3], {},
  { a: 1 }, "$no_such", "a.b/c@d", "a..b", ""];

/// Every pair and item of a document, with what holds it.
function places(node, found = []) {
  if (isMap(node)) {
    for (const pair of node.items) {
      found.push({ parent: node, pair });
      places(pair.value, found);
    }
  } else if (isSeq(node)) {
    node.items.forEach((item, index) => {
      found.push({ parent: node, index });
      places(item, found);
    });
  }
  return found;
}

function change(document, random) {
  const all = places(document.contents);
  const { parent, pair, index } = all[random(all.length)];
  const value = document.createNode(values[random(values.length)]);
  const kind = random(5);
  if (kind === 0) {
    if (pair) parent.items.splice(parent.items.indexOf(pair), 1);
    else parent.items.splice(index, 1);
  } else if (kind === 1 && pair && isScalar(pair.key)) {
    pair.key.value = `${pair.key.value}x`;
  } else if (kind === 2 && pair) {
    parent.items.push(document.createPair("surplus", values[random(values.length)]));
  } else if (pair) {
    pair.value = value;
  } else {
    parent.items[index] = value;
  }
}

/// `count` texts that differ from one of the given ones in one place.
export function changed(texts, count) {
  const random = randomNumbers(20260101);
  const result = [];
  while (result.length < count) {
    const text = texts[random(texts.length)];
    const document = parseDocument(text, { version: "1.2", merge: true });
    change(document, random);
    result.push(String(document));
  }
  return result;
}
