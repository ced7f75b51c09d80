// SPDX-License-Identifier: MIT
// Rigs taken out of their files: nothing of ours remains but joints and proxy meshes, all of others
// does.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "file_helpers.h"
#include "gltf/rig.h"
#include "rig_helpers.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;

namespace {

File stripped(const File& file, const std::string& name, Strip remains = Strip::character) {
  Diagnostics diagnostics;
  const auto rigs = read_rigs(file, diagnostics);
  REQUIRE(rigs);
  Patch patch(file);
  strip_rigs(patch, file, *rigs, remains);
  const auto output = patch.finish(file.binary, diagnostics);
  REQUIRE(output);
  const std::string path = make_folder(name) + "/stripped.glb";
  write_output(*output, path, folder_of(file.path));
  allow_messages_of(path, file.path);
  auto opened = gltf::open(path, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(opened);
  return std::move(*opened);
}

bool mentions(const File& file, std::string_view word) {
  return file.json.text().find(word) != std::string_view::npos;
}

}  // namespace

TEST_CASE("gltf rig_strip: a model with its rig taken away is the model") {
  Diagnostics diagnostics;
  const File as_text = model_file(small_model(), "strip_text");
  Patch nothing(as_text);
  const auto as_glb = nothing.finish(true, diagnostics);
  REQUIRE(as_glb);
  const std::string path = make_folder("broken/strip_model") + "/model.glb";
  write_bytes(path, whole(*as_glb));
  const auto model = gltf::open(path, diagnostics);
  REQUIRE(model);
  // No helper joint, which would stay.
  RigMaker maker;
  maker.joint("base", -1, {}, 0);
  maker.command("main", "control");
  const auto control = maker.node(scene::Kind::control, "control");
  maker.edit.set({control, scene::control::kPoints}, std::vector<double>{2, 0, 0, 0, 1, 0, 0});
  Rig rig = maker.take();
  const File file = written(*model, rig, "strip_rigged");
  CHECK(mentions(file, "RIGC_rig"));
  const File after = stripped(file, "strip_back");
  CHECK(after.json.text() == model->json.text());
  CHECK(text(after.whole) == text(model->whole));
}

TEST_CASE("gltf rig_strip: joints and proxies stay, everything else goes without holes") {
  Diagnostics diagnostics;
  Rig rig = proxy_rig(diagnostics);
  const File file = written(empty_file(), rig, "strip_proxy");
  const File after = stripped(file, "strip_proxy_after");
  CHECK_FALSE(mentions(after, "RIGC"));
  CHECK_FALSE(mentions(after, "extras"));
  CHECK_FALSE(mentions(after, "ik_fk"));
  std::vector<std::string> names;
  for (const json::Value& node : after.root()["nodes"].items())
    names.push_back(node["name"].string().value_or(""));
  CHECK(names == std::vector<std::string>{"root", "base", "tip", "tip_mesh"});
  CHECK(after.root()["meshes"].size() == 1);
  CHECK(after.root()["skins"].size() == 1);
  CHECK(after.root()["scenes"].items()[0]["nodes"].size() == 2);
}

TEST_CASE("gltf rig_strip: what others hung under a control keeps its place") {
  Diagnostics diagnostics;
  Rig rig = sample_rig(diagnostics);
  const File file = written(empty_file(), rig, "strip_hung");
  // Another program appends a node under a control.
  Patch patch(file);
  const int control = rig.nodes[7];
  const int lamp = patch.append("nodes", R"({"name":"lamp"})");
  patch.add_child(control, lamp);
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  const std::string path = make_folder("strip_hung_more") + "/more.glb";
  write_bytes(path, whole(*output));
  const auto more = gltf::open(path, diagnostics);
  REQUIRE(more);
  const File after = stripped(*more, "strip_hung_after");
  const auto nodes = after.root()["nodes"].items();
  REQUIRE(nodes.size() == static_cast<std::size_t>(lamp) + 1);
  CHECK(nodes[static_cast<std::size_t>(lamp)]["name"].string() == "lamp");
  CHECK(nodes[static_cast<std::size_t>(control)]["name"].string() == "tip_control");
  CHECK_FALSE(nodes[static_cast<std::size_t>(control)]["mesh"]);
  CHECK_FALSE(nodes[static_cast<std::size_t>(control)]["extras"]);
  CHECK_FALSE(mentions(after, "RIGC"));
}

TEST_CASE("gltf rig_strip: what bends a skin that others use stays") {
  Diagnostics diagnostics;
  Rig rig = proxy_rig(diagnostics);
  const File file = written(empty_file(), rig, "strip_bent");
  int control = -1;
  for (const scene::NodeId id : rig.scene.nodes())
    if (rig.scene[id].kind == scene::Kind::control) control = rig.nodes[id.index];
  REQUIRE(control >= 0);
  // Another program binds a mesh to a control, and uses the proxy's skin a second time.
  Patch patch(file);
  const int base = rig.nodes[joint_named(rig, "base").index];
  const int skin = patch.append("skins", fmt::format(R"({{"joints":[{},{}]}})", control, base));
  const int coat =
      patch.append("nodes", fmt::format(R"({{"name":"coat","mesh":0,"skin":{}}})", skin));
  const int cloak = patch.append("nodes", R"({"name":"cloak","mesh":0,"skin":0})");
  for (const int node : {coat, cloak}) patch.add_child(-1, node);
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  const std::string path = make_folder("strip_bent_more") + "/more.glb";
  write_bytes(path, whole(*output));
  const auto more = gltf::open(path, diagnostics);
  REQUIRE(more);
  for (const Strip remains : {Strip::character, Strip::nothing}) {
    CAPTURE(static_cast<int>(remains));
    const File after = stripped(*more, "strip_bent_after", remains);
    const auto nodes = after.root()["nodes"].items();
    const auto named = [&](const json::Value& index) {
      return nodes.at(static_cast<std::size_t>(*index.integer()))["name"].string().value_or("");
    };
    REQUIRE(after.root()["skins"].size() == 2);
    CHECK(named(after.root()["skins"].items()[1]["joints"].items()[0]) == "tip_control");
    for (const json::Value& joint : after.root()["skins"].items()[0]["joints"].items())
      CHECK(named(joint) != "");
    CHECK_FALSE(mentions(after, "RIGC"));
  }
}

TEST_CASE("gltf rig_strip: another rig of the file stays") {
  Diagnostics diagnostics;
  RigMaker second(7);
  second.joint("post", -1, {});
  second.command("main", "control");
  second.node(scene::Kind::control, "control");
  Rig second_rig = second.take();
  Rig first_rig = sample_rig(diagnostics);
  const File one = written(empty_file(), first_rig, "strip_first");
  const File two = written(one, second_rig, "strip_both");
  Patch patch(two);
  strip_rig(patch, two, first_rig);
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  const std::string path = make_folder("strip_one_of_two") + "/rest.glb";
  write_bytes(path, whole(*output));
  const auto rest = gltf::open(path, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(rest);
  const auto rigs = read_rigs(*rest, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(rigs);
  REQUIRE(rigs->size() == 1);
  CHECK(rigs->front().id == 7);
  CHECK(rigs->front().scene.dump() == second_rig.scene.dump());
}
