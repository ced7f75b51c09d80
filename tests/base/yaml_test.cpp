// SPDX-License-Identifier: MIT
// Tests of the reader in src/base/yaml.h: the tree, its spans, and hostile files.
#include "base/yaml.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "base/codes.h"

using namespace rigc;
using yaml::Node;

namespace {

struct Result {
  Diagnostics diagnostics;
  std::optional<Node> node;
};

Result read(std::string text) {
  Result result;
  const std::uint32_t file = result.diagnostics.sources().add("x.yaml", std::move(text));
  result.node = yaml::read(file, result.diagnostics);
  CHECK(result.node.has_value() == result.diagnostics.ok());
  return result;
}

Node good(const std::string& text) {
  const Result result = read(text);
  INFO(text.substr(0, 200));
  INFO(render(result.diagnostics, false));
  REQUIRE(result.node);
  return *result.node;
}

/// The code of the only error, or 0; `place` is its line and column.
int bad(const std::string& text, Span place = {}) {
  const Result result = read(text);
  INFO(text.substr(0, 200));
  INFO(render(result.diagnostics, false));
  REQUIRE(result.diagnostics.all().size() == 1);
  const Diagnostic& one = result.diagnostics.all()[0];
  if (place.line != 0) {
    CHECK(one.place.span.line == place.line);
    CHECK(one.place.span.column == place.column);
  }
  return one.code->number;
}

Span at(std::uint32_t line, std::uint32_t column) { return {0, line, column, 0}; }

std::string keys(const Node& node) {
  std::string text;
  for (const Node::Entry& entry : node.entries) text += entry.key + '=' + entry.value.text + ' ';
  return text;
}

std::string repeat(const std::string& text, std::size_t times) {
  std::string all;
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

}  // namespace

TEST_CASE("base yaml: kinds, text and quoting") {
  const Node root =
      good("a: 1\nb: 'x'\nc: [1, ~, null, ]\nd: {}\ne:\nf: |\n  two\n  lines\n! g: ! 7\n");
  REQUIRE(root.is_map());
  CHECK(root.find("a")->text == "1");
  CHECK(!root.find("a")->quoted);
  CHECK(root.find("b")->quoted);
  REQUIRE(root.find("c")->items.size() == 3);
  CHECK(root.find("c")->items[1].is_null());
  CHECK(root.find("c")->items[2].is_null());
  CHECK(root.find("d")->is_map());
  CHECK(root.find("e")->is_null());
  CHECK(root.find("f")->text == "two\nlines\n");
  CHECK(root.find("f")->quoted);
  CHECK(root.find("g")->quoted);
  CHECK(root.find("z") == nullptr);
  CHECK(good("'null'").is_scalar());
}

TEST_CASE("base yaml: spans") {
  const Node root = good("# note\njoints:\n  - name: hips\n    at: [0, \"q\"]\n");
  CHECK(root.entries[0].key_span == Span{1, 2, 1, 6});
  const Node& joint = root.entries[0].value.items[0];
  CHECK(joint.entries[0].value.span == Span{1, 3, 11, 4});
  CHECK(joint.entries[1].value.items[1].span == Span{1, 4, 13, 3});
  CHECK(good("\xef\xbb\xbf"
             "a: b")
            .entries[0]
            .key == "a");
  CHECK(good("a: 1\r\nb: 2\r\n").entries[1].key_span == Span{1, 2, 1, 1});
}

TEST_CASE("base yaml: an empty document is a null node") {
  for (const char* text : {"", "\n", "# only a comment\n", "---\n", "--- ~\n", "---\n...\n"})
    CHECK(good(text).is_null());
  CHECK(good("").span == Span{1, 1, 1, 1});
}

TEST_CASE("base yaml: anchors, aliases and merge keys") {
  CHECK(keys(good("a: &x 1\nb: *x\n")) == "a=1 b=1 ");
  CHECK(keys(good("&k c: 2\nd: {*k : 3}\n")) == "c=2 d= ");
  CHECK(bad("&k c: 2\n*k : 3\n") == codes::kYamlDuplicateKey.number);
  const Node root = good(
      "base: &base {size: 1, color: red}\nmore: &more {size: 2, shape: box}\n"
      "one: {<<: *base, color: blue}\nlast: {color: blue, <<: *base}\n"
      "both: {<<: [*base, *more], x: 1}\nquoted: {\"<<\": 1}\n");
  CHECK(keys(*root.find("one")) == "size=1 color=blue ");
  CHECK(keys(*root.find("last")) == "color=blue size=1 ");
  CHECK(keys(*root.find("both")) == "size=1 color=red shape=box x=1 ");
  CHECK(keys(*root.find("quoted")) == "<<=1 ");
  CHECK(root.find("one")->find("size")->span.line == 1);
  const Node again = good("- &a 1\n- &a 2\n- *a\n");
  CHECK(again.items[2].text == "2");
}

TEST_CASE("base yaml: syntax errors have a place") {
  CHECK(bad("a: [1, 2\nb: 3\n") == codes::kYamlSyntax.number);
  CHECK(bad("a: b: c\n", at(1, 5)) == codes::kYamlSyntax.number);
  CHECK(bad("a:\n\t- 1\n", at(2, 2)) == codes::kYamlSyntax.number);
  CHECK(read("a:\n\t- 1\n").diagnostics.all()[0].hint == "indent with spaces, not tabs");
  for (const char* text :
       {"a: \"x", "a: \"x\n", "a: \"x\\\"\n \n", "a: 'x''\n", "- &q\n  'x\n", "'\n"})
    CHECK(bad(text) == codes::kYamlSyntax.number);
  CHECK(good("a: &q \"x\\\"\"\n\n").find("a")->text == "x\"");
  CHECK(good("- ! 'it''s'\n").items[0].text == "it's");
  CHECK(bad("a: *nowhere\n", at(1, 4)) == codes::kYamlUnknownAnchor.number);
  CHECK(bad("%YAML 3.0\n---\na\n") == codes::kYamlSyntax.number);
}

TEST_CASE("base yaml: keys") {
  CHECK(bad("a: 1\nb: 2\na: 3\n", at(3, 1)) == codes::kYamlDuplicateKey.number);
  CHECK(bad("a: 1\n\"a\": 3\n") == codes::kYamlDuplicateKey.number);
  CHECK(bad("x: &x {a: 1}\ny: {<<: *x, <<: *x}") == codes::kYamlDuplicateKey.number);
  CHECK(bad("? [1, 2]\n: x\n") == codes::kYamlBadKey.number);
  CHECK(bad("~: x\n") == codes::kYamlBadKey.number);
  CHECK(bad("a: &a 1\nb: {<<: *a}\n") == codes::kYamlBadMerge.number);
  CHECK(bad("a: &a [1]\nb: {<<: [*a]}\n") == codes::kYamlBadMerge.number);
  CHECK(read("a: 1\na: 2\nb: 1\nb: 2\n").diagnostics.errors() == 2);
}

TEST_CASE("base yaml: what is not used here") {
  CHECK(bad("a: !!int 1\n", at(1, 4)) == codes::kYamlTag.number);
  CHECK(bad("a: !foo {b: 1}\n", at(1, 4)) == codes::kYamlTag.number);
  CHECK(bad("a: !!null\n") == codes::kYamlTag.number);
  CHECK(bad("a: 1\n---\nb: 2\n", at(2, 1)) == codes::kYamlDocuments.number);
  CHECK(bad("---\n---\n") == codes::kYamlDocuments.number);
}

TEST_CASE("base yaml: bytes") {
  CHECK(bad("a: 1\nb: \xff\n", at(2, 4)) == codes::kYamlBadUtf8.number);
  CHECK(bad("a: \xed\xa0\x80\n") == codes::kYamlBadUtf8.number);
  CHECK(bad("\xff\xfe"
            "a") == codes::kYamlBadUtf8.number);
  CHECK(bad(std::string("a\0b", 3), at(1, 2)) == codes::kYamlControlCharacter.number);
  CHECK(bad("a: \x04 b") == codes::kYamlControlCharacter.number);
  CHECK(bad("a: \x1b[31m") == codes::kYamlControlCharacter.number);
  CHECK(good("a: \"\\x1b\"").find("a")->text == "\x1b");
}

TEST_CASE("base yaml: alias cycles") {
  CHECK(bad("&x [1, *x]\n", at(1, 8)) == codes::kYamlAliasCycle.number);
  CHECK(bad("a: &x {b: {c: *x}}\n") == codes::kYamlAliasCycle.number);
  CHECK(bad("a: &x {<<: *x}\n") == codes::kYamlAliasCycle.number);
}

TEST_CASE("base yaml: a billion laughs") {
  std::string laughs = "a0: &a0 [ha, ha, ha, ha, ha, ha, ha, ha, ha]\n";
  for (int i = 1; i < 12; ++i)
    laughs += fmt::format("a{0}: &a{0} [{1}]\n", i, repeat(fmt::format("*a{}, ", i - 1), 9));
  CHECK(bad(laughs) == codes::kYamlAliasExplosion.number);
  CHECK(bad("- &a \"" + std::string(1'000'000, 'x') + "\"\n" + repeat("- *a\n", 100)) ==
        codes::kYamlAliasExplosion.number);
  CHECK(bad("a: &a {" + repeat("k: 1, ", 1) + "}\nb: {<<: [" + repeat("*a, ", 150'000) + "]}\n") ==
        codes::kYamlAliasExplosion.number);
  CHECK(good("a: &a [1, 2]\nb: [" + repeat("*a, ", 1000) + "]\n").find("b")->items.size() == 1000);
}

TEST_CASE("base yaml: depth") {
  CHECK(good(repeat("[", 100) + repeat("]", 100)).is_sequence());
  CHECK(bad(repeat("[", 101) + repeat("]", 101)) == codes::kYamlTooDeep.number);
  CHECK(bad(repeat("- ", 100'000)) == codes::kYamlTooDeep.number);
  CHECK(bad(repeat("{a: ", 10'000)) == codes::kYamlTooDeep.number);
  const std::string deep = repeat("[", 60) + "%" + repeat("]", 60);
  const auto with = [&](const std::string& inner) {
    return std::string(deep).replace(deep.find('%'), 1, inner);
  };
  CHECK(bad("a: &a " + with("1") + "\nb: &b " + with("*a") + "\n") == codes::kYamlTooDeep.number);
}

TEST_CASE("base yaml: size") {
  CHECK(bad(std::string((4u << 20) + 1, ' ')) == codes::kYamlTooLarge.number);
  CHECK(bad(fmt::format("[{}]", repeat("a,", 1'500'000))) == codes::kYamlTooLarge.number);
  CHECK(bad(repeat("-\n", 1'500'000)) == codes::kYamlTooLarge.number);
  CHECK(good(std::string(4u << 20, ' ')).is_null());
}

TEST_CASE("base yaml: cut and changed texts never crash") {
  const std::string text =
      "rigc: 1\nname: &n biped\nfeatures: {ikfk: {kind: limb, on: *n}}\njoints:\n"
      "  - name: \"hips\"\n    at: [0, 0.95, 'x']\n    <<: {b: 1}\n  - |\n   block\n  - ? a\n    : "
      "b\n";
  const std::string spice = "{}[]:,-?&*!|>'\"%@`# \n\t\\<~";
  std::uint32_t state = 1;
  const auto next = [&](std::size_t below) {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) % below;
  };
  for (int i = 0; i < 4000; ++i) {
    std::string changed = text;
    for (std::size_t edits = 1 + next(4); edits-- > 0;) {
      const std::size_t place = next(changed.size());
      if (next(3) == 0)
        changed.erase(place, 1 + next(5));
      else
        changed.insert(place, 1, spice[next(spice.size())]);
      if (changed.empty()) changed += 'a';
    }
    const Result result = read(changed);
    CHECK(!render(result.diagnostics, true).empty() == !result.diagnostics.ok());
  }
}
