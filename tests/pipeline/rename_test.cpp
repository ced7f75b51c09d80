// SPDX-License-Identifier: MIT
// Renaming a rig of a file: names and selectors follow, nothing else changes.
#include "pipeline/rename.h"

#include <doctest/doctest.h>

#include "base/files.h"
#include "gltf/rig.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "pipeline/merge.h"
#include "support/rig.h"

using namespace rigc;

namespace {

/// A rig that names itself, and another if it is there.
const char* const kTemplate = R"(rigc: 1
name: prop
version: 1
joints:
  - name: base
    at: [0, 0, 0]
    local: base
    label: base
    tags:
      - command: control
  - name: tip
    parent: base
    at: [0, 1, 0]
    local: tip
    label: tip
    tags:
      - command: control
        with: {name: "OWN:tip"}
      - command: attribute
        with: {attribute: half}
      - command: expression
        with: {to: ./control@half, value: "{OWN:base.base/control@translate.x} / 2"}
      - command: parent_constraint
        with: {driven: ./control.zero, targets: ["OTHER:base.base/control | base.base/control"]}
)";

std::string replace_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at))
    text.replace(at, from.size(), to);
  return text;
}

/// Two rigs in one file: `left` and `right`.
std::string two_rigs(const std::string& name) {
  Diagnostics diagnostics;
  std::vector<std::string> files;
  for (const char* global : {"left", "right"}) {
    const bool left = std::string(global) == "left";
    const std::string path = test::test_out(name + "_" + global + ".yaml");
    const std::string text =
        replace_all(replace_all(kTemplate, "OWN", global), "OTHER", left ? "right" : "left");
    REQUIRE(write_file(path, {Bytes(text)}, diagnostics));
    pipeline::BuildRequest request;
    request.template_file = path;
    request.global = global;
    files.push_back(test::test_out(name + "_" + global + ".glb"));
    REQUIRE_MESSAGE(pipeline::build(request, files.back(), diagnostics),
                    render(diagnostics, false));
  }
  const std::string out = test::test_out(name + ".glb");
  REQUIRE_MESSAGE(pipeline::merge_files({files, false, {}, {}, {}}, out, diagnostics),
                  render(diagnostics, false));
  return out;
}

std::vector<std::string> globals(const std::string& path) {
  Diagnostics diagnostics;
  const auto file = gltf::open(path, diagnostics);
  REQUIRE(file);
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  REQUIRE_MESSAGE(rigs, render(diagnostics, false));
  std::vector<std::string> out;
  for (const gltf::Rig& rig : *rigs) {
    out.push_back(rig.skeleton.global);
    for (const tags::TaggedJoint& joint : rig.skeleton.joints)
      CHECK(joint.ids.global == rig.skeleton.global);
    for (const scene::NodeId id : rig.scene.nodes())
      CHECK(rig.scene[id].ids.global == rig.skeleton.global);
  }
  return out;
}

std::string run(const std::string& file, const std::vector<std::string>& pairs,
                const std::string& out = {}) {
  Diagnostics diagnostics;
  pipeline::rename_rigs({file, pairs, {}}, out, diagnostics);
  return test::codes(diagnostics);
}

}  // namespace

TEST_CASE("rename: names and selectors follow, in every rig of the file") {
  const std::string path = two_rigs("rename");
  Diagnostics diagnostics;
  const auto renamed = pipeline::rename_rigs({path, {"left=hero"}, {}}, {}, diagnostics);
  REQUIRE_MESSAGE(renamed, render(diagnostics, false));
  CHECK(renamed->rigs == 1);
  CHECK(renamed->selectors == 2);
  CHECK(globals(path) == std::vector<std::string>{"hero", "right"});
  const auto file = gltf::open(path, diagnostics);
  REQUIRE(file);
  const std::string text(file->root()["extensions"]["RIGC_rig"].text());
  CHECK(text.find("{hero:base.base/control@translate.x} / 2") != std::string::npos);
  CHECK(text.find("hero:base.base/control | base.base/control") != std::string::npos);
  // The name of a node is no selector.
  CHECK(text.find("left:tip") != std::string::npos);
  CHECK(replace_all(text, "left:tip", "").find("left:") == std::string::npos);
  CHECK(text.find("\"global\":\"left\"") == std::string::npos);
}

TEST_CASE("rename: there and back gives the same bytes, and nothing but RIGC_rig differs") {
  const std::string path = two_rigs("rename_back");
  const std::string other = test::test_out("rename_other.glb");
  const std::string before = test::bytes_of(path);
  CHECK(run(path, {"left=a_longer_name"}, other).empty());
  CHECK(test::bytes_of(path) == before);
  Diagnostics diagnostics;
  const auto a = gltf::open(path, diagnostics), b = gltf::open(other, diagnostics);
  REQUIRE((a && b));
  for (const auto& member : a->root().members()) {
    CAPTURE(member.first);
    if (member.first != "extensions") CHECK(member.second.text() == b->root()[member.first].text());
  }
  CHECK(a->bin->size() == b->bin->size());
  CHECK(run(other, {"a_longer_name=left"}).empty());
  CHECK(test::bytes_of(other) == before);
  // Names may change places.
  CHECK(run(path, {"left=right", "right=left"}).empty());
  CHECK(globals(path) == std::vector<std::string>{"right", "left"});
}

TEST_CASE("rename: what is no name, is not there or is taken") {
  const std::string path = two_rigs("rename_wrong");
  const std::string before = test::bytes_of(path);
  for (const char* pair : {"left", "left=", "=x", "left=1x", "left=a=b", "left=a b"})
    CHECK_MESSAGE(run(path, {pair}) == "RIG0830", pair);
  CHECK(run(path, {"left=a", "left=b"}) == "RIG0830");
  CHECK(run(path, {"middle=a"}) == "RIG0831");
  CHECK(run(path, {"left=right"}) == "RIG0832");
  CHECK(run(path, {"left=x", "right=x"}) == "RIG0832");
  CHECK(run(path, {"left=left"}).empty());
  CHECK(test::bytes_of(path) == before);
}
