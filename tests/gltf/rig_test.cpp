// SPDX-License-Identifier: MIT
// Rigs into files and out again: nodes, identities, shapes, several rigs, models that stay what
// they were.
#include "gltf/rig.h"

#include <doctest/doctest.h>

#include <limits>

#include "file_helpers.h"
#include "gltf/rig_codes.h"
#include "gltf/rig_json.h"
#include "rig_helpers.h"
#include "scene/random_edits.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;
namespace transform = rigc::scene::transform;

namespace {

std::vector<Rig> rigs_of(const File& file) {
  Diagnostics diagnostics;
  auto rigs = read_rigs(file, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(rigs);
  CHECK(diagnostics.all().empty());
  return std::move(*rigs);
}

json::Value node_of(const File& file, const Rig& rig, scene::NodeId id) {
  return file.root()["nodes"].items()[static_cast<std::size_t>(rig.nodes[id.index])];
}

std::string write_text(Rig& rig) {
  Diagnostics diagnostics;
  const File file = empty_file();
  Patch patch(file);
  REQUIRE(write_rig(patch, rig, -1, diagnostics));
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  return whole(*output);
}

}  // namespace

TEST_CASE("gltf rig: a rig comes back from its file") {
  Diagnostics diagnostics;
  Rig rig = sample_rig(diagnostics);
  const File file = written(empty_file(), rig, "rig_alone");
  const auto rigs = rigs_of(file);
  REQUIRE(rigs.size() == 1);
  CHECK(rigs[0].scene.dump() == rig.scene.dump());
  CHECK(rigs[0].nodes == rig.nodes);
  CHECK(rigs[0].owned == rig.owned);
  CHECK(rigs[0].commands.size() == rig.commands.size());
}

TEST_CASE("gltf rig: the same rig gives the same bytes") {
  Diagnostics first_diagnostics, second_diagnostics;
  second_diagnostics.sources().add("something else", "");
  Rig first = proxy_rig(first_diagnostics);
  Rig second = proxy_rig(second_diagnostics);
  CHECK(write_text(first) == write_text(second));
}

TEST_CASE("gltf rig: nodes show what the scene has") {
  Diagnostics diagnostics;
  Rig rig = sample_rig(diagnostics);
  const File file = written(empty_file(), rig, "rig_nodes");
  const scene::NodeId control = scene::NodeId{7};
  REQUIRE(rig.scene[control].name == "tip_control");
  const json::Value node = node_of(file, rig, control);
  CHECK(node["name"].string() == "tip_control");
  CHECK(node["extras"]["rigc"].string() == "0:77f228ca67e63e45:77f228ca67e63e45:aim:control:0");
  CHECK(node["extras"]["ik_fk"].text() == "1.0");
  CHECK(node["extras"]["count"].text() == "3");
  CHECK(node["extras"]["roll"].number() == 1.0 / 3);
  CHECK_FALSE(node["extras"]["secret"]);
  CHECK_FALSE(node["translation"]);
  const json::Value zero = node_of(file, rig, {2});
  CHECK(zero["translation"].items()[1].text() == "0.25");
  CHECK(zero["rotation"].items()[2].text() == "0.16589613");
  CHECK_FALSE(zero["scale"]);
  // The root joint and what has no parent are roots of the scene.
  const auto roots = file.root()["scenes"].items()[0]["nodes"].items();
  REQUIRE(roots.size() == 1);
  CHECK(roots[0].integer() == rig.nodes[joint_named(rig, "root").index]);
  for (const scene::NodeId id : rig.scene.nodes())
    CHECK((rig.nodes[id.index] >= 0) == scene::spec(rig.scene[id].kind).is_transform);
}

TEST_CASE("gltf rig: equal shapes of one colour are one mesh") {
  Diagnostics diagnostics;
  Rig rig = sample_rig(diagnostics);
  const File file = written(empty_file(), rig, "rig_shapes");
  REQUIRE(file.root()["meshes"].size() == 1);
  CHECK(file.root()["materials"].size() == 1);
  const json::Value primitive = file.root()["meshes"].items()[0]["primitives"].items()[0];
  CHECK(primitive["mode"].integer() == 1);
  const auto accessors = file.root()["accessors"].items();
  const json::Value points =
      accessors[static_cast<std::size_t>(*primitive["attributes"]["POSITION"].integer())];
  CHECK(points["count"].integer() == 5);
  CHECK(points["min"].text() == "[-1,0,-1]");
  CHECK(points["max"].text() == "[1,0,1]");
  CHECK(accessors[static_cast<std::size_t>(*primitive["indices"].integer())]["count"].integer() ==
        8);
  for (const scene::NodeId id : rig.scene.nodes()) {
    if (rig.scene[id].kind == scene::Kind::control)
      CHECK(node_of(file, rig, id)["mesh"].integer() == 0);
  }
}

TEST_CASE("gltf rig: a model keeps its nodes and gets identities") {
  Diagnostics diagnostics;
  const File model = model_file(small_model(), "rig_model");
  Rig rig = sample_rig(diagnostics, 0, 1);
  const File file = written(model, rig, "rig_on_model");
  const auto before = model.root()["nodes"].items();
  const auto after = file.root()["nodes"].items();
  CHECK(after[1]["extras"].text() == R"({"rigc":"0:77f228ca67e63e45"})");
  CHECK(after[1]["rotation"].text() == before[1]["rotation"].text());
  CHECK(after[2].text() == before[2].text());
  CHECK(after[0]["children"].text() == before[0]["children"].text());
  CHECK(rig.nodes[joint_named(rig, "tip").index] == 1);
  // The helper root is ours, and has no joint of the model below it.
  CHECK(rig.nodes[joint_named(rig, "root").index] >= 3);
  for (const char* array : {"accessors", "bufferViews", "animations", "skins"}) {
    const auto old = model.root()[array].items();
    const auto now = file.root()[array].items();
    REQUIRE(now.size() >= old.size());
    for (std::size_t i = 0; i < old.size() && std::string_view(array) != "bufferViews"; ++i)
      CHECK(now[i].text() == old[i].text());
  }
  const auto rigs = rigs_of(file);
  REQUIRE(rigs.size() == 1);
  CHECK(rigs[0].scene.dump() == rig.scene.dump());
  CHECK(rigs[0].skeleton.joints[2].foreign_node == 1);
}

TEST_CASE("gltf rig: what hangs under a model's joint hangs there in the file") {
  const File model = model_file(small_model(), "rig_model_under");
  RigMaker maker;
  maker.joint("base", -1, {}, 0);
  maker.command("helper", "transform");
  const scene::NodeId under =
      maker.node(scene::Kind::transform, "space", joint_named(maker.rig(), "base"));
  const scene::NodeId alone = maker.node(scene::Kind::transform, "other", {});
  const scene::NodeId constraint = maker.node(scene::Kind::expression, "sum", alone);
  const scene::NodeId below = maker.node(scene::Kind::handle, "handle", constraint);
  Rig rig = maker.take();
  const File file = written(model, rig, "rig_under_joint", 2);
  const auto nodes = file.root()["nodes"].items();
  const std::string at = std::to_string(rig.nodes[under.index]);
  CHECK(nodes[0]["children"].text() == "[1," + at + "]");
  CHECK(nodes[2]["children"].text() == "[" + std::to_string(rig.nodes[alone.index]) + "]");
  CHECK(node_of(file, rig, alone)["children"].text() ==
        "[" + std::to_string(rig.nodes[below.index]) + "]");
  CHECK(rigs_of(file)[0].ancestor == 2);
}

TEST_CASE("gltf rig: several rigs live in one file") {
  Diagnostics diagnostics;
  RigMaker second(7);
  second.joint("post", -1, {});
  second.command("main", "control");
  second.node(scene::Kind::control, "control");
  Rig first_rig = sample_rig(diagnostics);
  Rig second_rig = second.take();
  const File one = written(empty_file(), second_rig, "rig_one");
  const File two = written(one, first_rig, "rig_two");
  const auto rigs = rigs_of(two);
  REQUIRE(rigs.size() == 2);
  CHECK(rigs[0].id == 0);
  CHECK(rigs[1].id == 7);
  CHECK(rigs[0].scene.dump() == first_rig.scene.dump());
  CHECK(rigs[1].scene.dump() == second_rig.scene.dump());
}

TEST_CASE("gltf rig: random scenes come back from their files") {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    Rig rig;
    rig.skeleton.global = "random";
    rig.commands.push_back({{}, "joint", "id", "module", true, "", 0});
    scene::Journal journal;
    rigc::test::RandomEdits(rig.scene, seed, true).run(journal, nullptr, 200, 0);
    const std::string before = rig.scene.dump();
    const File file = written(empty_file(), rig, "rig_random_" + std::to_string(seed));
    CHECK(rigs_of(file)[0].scene.dump() == before);
  }
}

TEST_CASE("gltf rig: a file without rigs has none") { CHECK(rigs_of(empty_file()).empty()); }

TEST_CASE("gltf rig: numbers that glTF cannot hold are reported") {
  for (const double bad :
       {std::numeric_limits<double>::infinity(), 1e39, std::numeric_limits<double>::quiet_NaN()}) {
    RigMaker maker;
    const scene::NodeId joint = maker.joint("base", -1, {});
    maker.edit.set({joint, transform::kTranslate}, math::Vec3{0, bad, 0});
    Rig rig = maker.take();
    Diagnostics diagnostics;
    const File file = empty_file();
    Patch patch(file);
    CHECK_FALSE(write_rig(patch, rig, -1, diagnostics));
    CHECK(numbers(diagnostics) == std::vector<int>{codes::kNotWritable.number});
  }
}

TEST_CASE("gltf rig: a hierarchy that could not be read again is not written") {
  RigMaker maker;
  maker.joint("base", -1, {});
  maker.command("deep", "transform");
  scene::NodeId parent;
  for (std::size_t i = 0; i <= kMostDepth; ++i) {
    scene::Node node;
    node.parent = parent;
    node.command = 0;
    node.identity.counter = static_cast<std::uint32_t>(i + 1);
    parent = maker.edit.make(node);
  }
  Rig rig = maker.take();
  Diagnostics diagnostics;
  const File file = empty_file();
  Patch patch(file);
  CHECK_FALSE(write_rig(patch, rig, -1, diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{codes::kRigTooLarge.number});
}
