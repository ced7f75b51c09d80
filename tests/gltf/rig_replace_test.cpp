// SPDX-License-Identifier: MIT
// A rig takes the place of another: nodes that stay keep their index and what others added to them.
#include <doctest/doctest.h>

#include "file_helpers.h"
#include "gltf/rig.h"
#include "rig_helpers.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;

namespace {

Rig read_one(const File& file) {
  Diagnostics diagnostics;
  auto rigs = read_rigs(file, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(rigs);
  REQUIRE(rigs->size() == 1);
  return std::move(rigs->front());
}

File opened(const std::string& json, const std::string& bin, const std::string& name) {
  const std::string path = make_folder("broken/" + name) + "/rig.glb";
  write_bytes(path, glb(json, bin));
  Diagnostics diagnostics;
  auto file = gltf::open(path, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(file);
  return *std::move(file);
}

std::string bin_of(const File& file) {
  const std::string bytes = text(file.whole);
  const std::size_t json_size = static_cast<unsigned char>(bytes[12]) |
                                static_cast<unsigned char>(bytes[13]) << 8u |
                                static_cast<unsigned char>(bytes[14]) << 16u;
  return bytes.size() > 28 + json_size ? bytes.substr(28 + json_size) : std::string();
}

/// Spans of each point into the same two files.
Rig sample() {
  Diagnostics diagnostics;
  return sample_rig(diagnostics);
}
Rig with_proxy() {
  Diagnostics diagnostics;
  return proxy_rig(diagnostics);
}

/// A rig of joints alone, as an unbuilt sample_rig().
Rig bare_rig() {
  RigMaker maker;
  maker.joint("root", -1, {});
  maker.joint("base", 0, {{0, 0.25, 0}, math::axis_angle({0, 0, 1}, 1.0 / 3), {1, 1, 1}});
  maker.joint("tip", 1, {{0, 1, 0}, {}, {1, 1, 1}});
  return maker.take();
}

/// Nodes of `old` for those of `fresh` that have its identities.
std::vector<int> places_of(const Rig& fresh, const Rig& old) {
  std::vector<int> out(fresh.scene.size(), -1);
  const std::vector<int> own = own_nodes(old);
  for (const scene::NodeId a : fresh.scene.nodes())
    for (const scene::NodeId b : old.scene.nodes())
      if (fresh.scene[a].identity == old.scene[b].identity) out[a.index] = own[b.index];
  return out;
}

File replaced_by(const File& file, const Rig& old, Rig& fresh, const std::string& name) {
  Diagnostics diagnostics;
  diagnostics.sources().add("templates/lamp.yaml", "");
  diagnostics.sources().add("templates/parts/arm.yaml", "");
  Patch patch(file);
  std::vector<Replacement> replacements = {
      {&old, &fresh, places_of(fresh, old), diagnostics.sources()}};
  REQUIRE(replace_rigs(patch, file, replacements, diagnostics));
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  const std::string path = make_folder(name) + "/rig.glb";
  write_output(*output, path, folder_of(file.path));
  if (file.path.find("/broken/") == std::string::npos) allow_messages_of(path, file.path);
  auto result = gltf::open(path, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(result);
  return *std::move(result);
}

json::Value node(const File& file, int index) {
  return file.root()["nodes"].items()[static_cast<std::size_t>(index)];
}

}  // namespace

TEST_CASE("gltf rig_replace: a rig in its own place changes no byte") {
  for (const bool proxy : {false, true}) {
    Rig rig = proxy ? with_proxy() : sample();
    const File file = written(empty_file(), rig, "replace_self");
    const Rig old = read_one(file);
    Rig fresh = proxy ? with_proxy() : sample();
    const File after = replaced_by(file, old, fresh, "replace_self_after");
    CHECK(fresh.nodes == old.nodes);
    CHECK(fresh.owned == old.owned);
    CHECK(text(after.whole) == text(file.whole));
  }
}

TEST_CASE(
    "gltf rig_replace: nodes that stay keep their index, free places are cut and taken again") {
  Rig rig = sample();
  const File file = written(empty_file(), rig, "replace_less");
  const Rig old = read_one(file);
  Rig bare = bare_rig();
  const File less = replaced_by(file, old, bare, "replace_less_after");
  const Rig now = read_one(less);
  for (const char* name : {"root", "base", "tip"})
    CHECK(now.nodes[joint_named(now, name).index] == old.nodes[joint_named(old, name).index]);
  CHECK(less.root()["nodes"].items().size() == 3);
  CHECK(less.root()["meshes"].items().empty());
  CHECK(now.owned.goes == Owned::Part{});
  Rig again = sample();
  const File more = replaced_by(less, now, again, "replace_more_after");
  CHECK(more.root()["nodes"].items().size() == file.root()["nodes"].items().size());
  CHECK(more.whole.size() == file.whole.size());
}

TEST_CASE("gltf rig_replace: what others put on a node and under it stays with it") {
  Rig rig = sample();
  const File built = written(empty_file(), rig, "replace_additions");
  const Rig before = read_one(built);
  const scene::NodeId control = with_role(before, "control");
  const int holder = before.nodes[control.index];
  const auto count = built.root()["nodes"].items().size();
  // Another program hangs a node there, and writes a member, an extra and an extension.
  std::string json(built.json.text());
  const std::string text_of_node(node(built, holder).text());
  std::string changed = test::replaced(text_of_node, "\"children\":[",
                                       "\"children\":[" + std::to_string(count) + ",");
  changed = test::replaced(changed, "\"extras\":{", "\"extras\":{\"note\":[1.50,null],");
  changed.insert(changed.size() - 1, R"(,"camera":0,"extensions":{"VENDOR_x":{"a":1e3}})");
  json = test::replaced(json, text_of_node, changed);
  const std::string nodes(built.root()["nodes"].text());
  json = test::replaced(json, nodes.substr(nodes.size() - 40),
                        nodes.substr(nodes.size() - 40, 39) + R"(,{"name":"lamp shade"}])");
  json.insert(1, R"("cameras":[{"type":"orthographic","orthographic":)"
                 R"({"xmag":1,"ymag":1,"zfar":2,"znear":1}}],)");
  const File file = opened(json, bin_of(built), "replace_additions");

  const Rig old = read_one(file);
  Rig fresh = sample();
  const File after = replaced_by(file, old, fresh, "broken/replace_additions_after");
  CHECK(fresh.nodes == old.nodes);
  const json::Value kept = node(after, holder);
  CHECK(kept["camera"].text() == "0");
  CHECK(kept["extensions"].text() == R"({"VENDOR_x":{"a":1e3}})");
  CHECK(kept["extras"]["note"].text() == "[1.50,null]");
  CHECK(kept["extras"]["rigc"].text() == node(built, holder)["extras"]["rigc"].text());
  bool hangs = false;
  for (const json::Value& child : kept["children"].items())
    hangs = hangs || child.integer() == static_cast<std::int64_t>(count);
  CHECK(hangs);
  CHECK(node(after, static_cast<int>(count)).text() == R"({"name":"lamp shade"})");

  // A rig without the control leaves the node to those who hang there.
  Rig bare = bare_rig();
  const File without = replaced_by(file, old, bare, "broken/replace_additions_without");
  CHECK(node(without, static_cast<int>(count)).text() == R"({"name":"lamp shade"})");
  const json::Value left = node(without, holder);
  CHECK(left["extras"]["note"].text() == "[1.50,null]");
  CHECK_FALSE(left["extras"]["rigc"]);
  CHECK_FALSE(left["mesh"]);
  CHECK(left["camera"].text() == "0");
}

TEST_CASE("gltf rig_replace: a joint that a skin of others is bound to stays") {
  Rig rig = sample();
  const File built = written(empty_file(), rig, "replace_skin");
  const int tip = rig.nodes[joint_named(rig, "tip").index];
  std::string json(built.json.text());
  json.insert(1, R"("skins":[{"joints":[)" + std::to_string(tip) + "]}],");
  const File file = opened(json, bin_of(built), "replace_skin");
  const Rig old = read_one(file);
  RigMaker maker;
  maker.joint("root", -1, {});
  maker.joint("base", 0, {{0, 0.25, 0}, {}, {1, 1, 1}});
  Rig fresh = maker.take();
  const File after = replaced_by(file, old, fresh, "broken/replace_skin_after");
  CHECK(after.root()["skins"].text() == file.root()["skins"].text());
  CHECK(node(after, tip)["name"].string() == "tip");
  CHECK_FALSE(node(after, tip)["extras"]["rigc"]);
  // It hangs where it hung.
  const int base = old.nodes[joint_named(old, "base").index];
  bool hangs = false;
  for (const json::Value& child : node(after, base)["children"].items())
    hangs = hangs || child.integer() == tip;
  CHECK(hangs);
}

TEST_CASE("gltf rig_replace: another rig of the file keeps its text and its nodes") {
  Diagnostics diagnostics;
  Rig first = sample();
  const File one = written(empty_file(), first, "replace_first");
  RigMaker maker(1);
  maker.joint("other", -1, {{1, 0, 0}, {}, {1, 1, 1}});
  maker.command("main", "control");
  maker.node(scene::Kind::control, "control");
  Rig second = maker.take();
  const File two = written(one, second, "replace_second");
  const auto rigs = read_rigs(two, diagnostics);
  REQUIRE(rigs);
  REQUIRE(rigs->size() == 2);
  Rig bare = bare_rig();
  const File after = replaced_by(two, rigs->front(), bare, "replace_one_of_two");
  const auto text_of = [](const File& file) {
    return std::string(file.root()["extensions"]["RIGC_rig"]["rigs"].items()[1].text());
  };
  CHECK(text_of(after) == text_of(two));
  for (const int index : second.nodes)
    if (index >= 0) CHECK(node(after, index).text() == node(two, index).text());
}
