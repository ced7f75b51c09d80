// SPDX-License-Identifier: MIT
// Rigs of files that others worked on: poses, nodes in another order, copies, damage; where nodes
// stand.
#include <doctest/doctest.h>

#include "file_helpers.h"
#include "gltf/rig.h"
#include "gltf/rig_codes.h"
#include "gltf/slim.h"
#include "rig_helpers.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;
namespace transform = rigc::scene::transform;

namespace {

constexpr scene::NodeId kTipControl{7};

/// A rig's file as .gltf text, to be edited.
std::string gltf_text(Rig& rig) {
  Diagnostics diagnostics;
  const File file = empty_file();
  Patch patch(file);
  REQUIRE(write_rig(patch, rig, -1, diagnostics));
  auto output = patch.finish(false, diagnostics);
  REQUIRE(output);
  std::string text = whole(*output);
  for (const ExtraFile& extra : output->extra_files)
    text = replaced(text, json::quote(extra.name), json::quote(data_uri(test::text(extra.bytes))));
  return text;
}

std::optional<std::vector<Rig>> read(const std::string& text, Diagnostics& diagnostics) {
  const auto file = open_text(text, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(file);
  return read_rigs(*file, diagnostics);
}

struct Sample {
  Diagnostics diagnostics;
  Rig rig = sample_rig(diagnostics);
  std::string text = gltf_text(rig);
};

/// What a rig's node says it is.
std::string mark(const Rig& rig, scene::NodeId id) {
  return R"("extras":{"rigc":")" + to_text(rig.scene[id].identity) + '"';
}

}  // namespace

TEST_CASE("gltf rig_read: values that animators set without keying are taken over") {
  Sample sample;
  const std::string at = mark(sample.rig, kTipControl);
  std::string text =
      replaced(sample.text, at, R"("translation":[1,2,3],"rotation":[1,0,0,0],)" + at);
  text = replaced(text, R"("ik_fk":1.0)", R"("ik_fk":0.25,"mine":7)");
  text = replaced(text, R"("count":3)", R"("count":true)");
  const auto rigs = read(text, sample.diagnostics);
  REQUIRE(rigs);
  CHECK(sample.diagnostics.all().empty());
  const scene::Scene& scene = (*rigs)[0].scene;
  CHECK(scene.local(kTipControl).translation == math::Vec3{1, 2, 3});
  CHECK(scene.local(kTipControl).rotation == math::Quat{1, 0, 0, 0});
  CHECK(scene[kTipControl].user[0].value == 0.25);
  CHECK(scene[kTipControl].user[0].initial == 0.1);
  CHECK(scene[kTipControl].user[2].value == 1);
}

TEST_CASE("gltf rig_read: a matrix is a pose too, rounding is none") {
  Sample sample;
  const std::string at = mark(sample.rig, kTipControl);
  const std::string matrix = R"("matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,5,0,1],)";
  const auto moved = read(replaced(sample.text, at, matrix + at), sample.diagnostics);
  REQUIRE(moved);
  CHECK((*moved)[0].scene.local(kTipControl).translation == math::Vec3{0, 5, 0});
  const auto noise = read(replaced(replaced(sample.text, at, R"("translation":[1e-10,0,0],)" + at),
                                   R"("roll":0.3333333333333333)", R"("roll":0.333333343)"),
                          sample.diagnostics);
  REQUIRE(noise);
  CHECK((*noise)[0].scene.dump() == sample.rig.scene.dump());
}

TEST_CASE("gltf rig_read: attributes that the rig drives and nodes that are no controls stay") {
  Sample sample;
  std::string text = sample.text;
  const std::string control = mark(sample.rig, kTipControl);
  text = replaced(text, control, R"("scale":[1,2,1],)" + control);  // scale.y is connected
  const std::string late = mark(sample.rig, {10});
  text = replaced(text, late, R"("translation":[1,2,3],)" + late);
  const auto rigs = read(text, sample.diagnostics);
  REQUIRE(rigs);
  CHECK((*rigs)[0].scene.dump() == sample.rig.scene.dump());
}

TEST_CASE("gltf rig_read: what is locked stays, and that is said") {
  Diagnostics diagnostics;
  Rig rig = sample_rig(diagnostics);
  scene::Journal journal;
  const double locked = 1 + 8 * 7;  // translate.x, rotate
  scene::Edit(rig.scene, journal, nullptr).set({kTipControl, scene::control::kLocked}, locked);
  const std::string at = mark(rig, kTipControl);
  const std::string text = gltf_text(rig);
  const auto moved =
      read(replaced(text, at, R"("translation":[1,2,3],"rotation":[1,0,0,0],)" + at), diagnostics);
  REQUIRE(moved);
  const math::Trs local = (*moved)[0].scene.local(kTipControl);
  CHECK(local.translation == math::Vec3{0, 2, 3});
  CHECK(local.rotation == math::Quat{});
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].code->number == codes::kLockedMoved.number);
  // What is not locked moves without a word.
  Diagnostics free;
  REQUIRE(read(replaced(text, at, R"("translation":[0,2,3],)" + at), free));
  CHECK(free.all().empty());
}

TEST_CASE("gltf rig_read: an attribute that is no number is a warning") {
  Sample sample;
  const auto rigs =
      read(replaced(sample.text, R"("ik_fk":1.0)", R"("ik_fk":"1.0")"), sample.diagnostics);
  REQUIRE(rigs);
  CHECK(numbers(sample.diagnostics) == std::vector<int>{codes::kExtraNotNumber.number});
  CHECK((*rigs)[0].scene.dump() == sample.rig.scene.dump());
}

TEST_CASE("gltf rig_read: what a node says counts more than its number") {
  Sample sample;
  // Swap what two nodes say: as if another program had written them in another order.
  const scene::NodeId a{3}, b{7};
  std::string text = replaced(sample.text, mark(sample.rig, a), "@here@");
  text = replaced(text, mark(sample.rig, b), mark(sample.rig, a));
  text = replaced(text, "@here@", mark(sample.rig, b));
  const auto rigs = read(text, sample.diagnostics);
  REQUIRE(rigs);
  CHECK((*rigs)[0].nodes[a.index] == sample.rig.nodes[b.index]);
  CHECK((*rigs)[0].nodes[b.index] == sample.rig.nodes[a.index]);
}

TEST_CASE("gltf rig_read: without marks the recorded nodes count") {
  Sample sample;
  std::string text = sample.text;
  for (std::size_t at = text.find(R"("extras":{"rigc")"); at != std::string::npos;
       at = text.find(R"("extras":{"rigc")"))
    text.replace(at, 16, R"("extras":{"gone")");
  const auto rigs = read(text, sample.diagnostics);
  REQUIRE(rigs);
  CHECK(sample.diagnostics.all().empty());
  CHECK((*rigs)[0].nodes == sample.rig.nodes);
}

TEST_CASE("gltf rig_read: a copied node is an error that names both") {
  Sample sample;
  const std::string text =
      replaced(sample.text, mark(sample.rig, {10}), mark(sample.rig, kTipControl));
  CHECK_FALSE(read(text, sample.diagnostics));
  REQUIRE(numbers(sample.diagnostics) == std::vector<int>{codes::kSameIdentity.number});
  const std::string& message = sample.diagnostics.all()[0].message;
  CHECK(message.find("tip_control") != std::string::npos);
  CHECK(message.find("tip_late") != std::string::npos);
}

TEST_CASE("gltf rig_read: a node that is gone is a warning") {
  Sample sample;
  const std::string text =
      replaced(sample.text, mark(sample.rig, {10}), R"("extras":{"rigc":"0:0000000000000001")");
  const auto rigs = read(text, sample.diagnostics);
  REQUIRE(rigs);
  CHECK(numbers(sample.diagnostics) == std::vector<int>{codes::kNodeLost.number});
  CHECK((*rigs)[0].nodes[10] == -1);
}

TEST_CASE("gltf rig_read: versions, sizes and indices are checked") {
  struct Case {
    std::string from, to;
    int code;
  };
  Sample sample;
  const std::string node = R"("name":"base_driver",)";
  const Case cases[] = {
      {R"("RIGC_rig":{"version":1,)", R"("RIGC_rig":{"version":2,)", codes::kRigVersion.number},
      {R"("RIGC_rig":{"version":1,)", R"("RIGC_rig":{)", codes::kRigVersion.number},
      {R"("rigs":[)", R"("rigs":3,"old":[)", codes::kRigType.number},
      {R"("rigs":[)", R"("rigs":[3,)", codes::kRigType.number},
      {node, node + R"("node":1,)", codes::kRigIndex.number},
      {node, node + R"("node":999,)", codes::kRigIndex.number},
  };
  for (const Case& c : cases) {
    CAPTURE(c.to);
    Diagnostics diagnostics;
    CHECK_FALSE(read(replaced(sample.text, c.from, c.to), diagnostics));
    REQUIRE_FALSE(diagnostics.all().empty());
    CHECK(diagnostics.all()[0].code->number == c.code);
  }
}

TEST_CASE("gltf rig_read: two rigs with one id, and two scene nodes at one node, are errors") {
  Sample sample;
  const auto document = json::parse(sample.text, "", 0, sample.diagnostics);
  REQUIRE(document);
  const std::string rig(document->root()["extensions"]["RIGC_rig"]["rigs"].items()[0].text());
  const std::string twice = replaced(sample.text, rig, rig + "," + rig);
  CHECK_FALSE(read(twice, sample.diagnostics));
  REQUIRE(sample.diagnostics.errors() > 0);
  CHECK(sample.diagnostics.all()[0].code == &codes::kRigDuplicate);
}

TEST_CASE("gltf rig_read: a rig with too many elements is refused before it is built") {
  Sample sample;
  std::string nulls = "[null";
  for (int i = 0; i < 4096; ++i) nulls += ",null";
  Diagnostics diagnostics;
  const std::string from = R"("command":1,"values":{"targets":[null],)";
  CHECK_FALSE(
      read(replaced(sample.text, from, R"("command":1,"values":{"targets":)" + nulls + "],"),
           diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{codes::kRigTooLarge.number});
}

TEST_CASE("gltf rig_read: standings are what the file shows") {
  Diagnostics diagnostics;
  std::string model_text =
      replaced(small_model(), R"({"name": "root", "children": [1], "translation": [0, 0, 0]})",
               R"({"name": "root", "children": [3], "translation": [0, 2, 0]})");
  model_text =
      replaced(model_text, R"("skin": 0})",
               R"("skin": 0}, {"name": "between", "children": [1], "translation": [0, 0.5, 0]})");
  const File model = model_file(model_text, "standing_model");
  Rig rig = sample_rig(diagnostics, 0, 1);
  const File file = written(model, rig, "rig_standing");
  const auto rigs = read_rigs(file, diagnostics);
  REQUIRE(rigs);
  const auto slim = read_slim(file, diagnostics);
  REQUIRE(slim);
  const std::vector<Standing> places = standings(*slim, (*rigs)[0]);
  const scene::NodeId base = joint_named(rig, "base"), tip = joint_named(rig, "tip");
  // In the scene the base hangs under a helper; in the file it is a root.
  CHECK_FALSE(places[base.index].base.valid());
  CHECK(places[base.index].between == math::Affine{});
  CHECK(places[base.index].local.translation == math::Vec3{0, 2, 0});
  CHECK(places[tip.index].base == base);
  CHECK(places[tip.index].between.origin == math::Vec3{0, 0.5, 0});
  CHECK(places[kTipControl.index].base == rig.scene[kTipControl].parent);
  // "between" is nobody's of the rig and moves with the base.
  REQUIRE(places[base.index].points.size() == 1);
  CHECK(places[base.index].points[0] == math::Vec3{0, 0.5, 0});
  CHECK(places[tip.index].points.empty());
}

TEST_CASE("gltf rig_read: damage anywhere in RIGC_rig never crashes") {
  Sample sample;
  const std::size_t begin = sample.text.find("\"RIGC_rig\"");
  const std::size_t end = sample.text.find("\"extensionsUsed\"", begin);
  REQUIRE(begin != std::string::npos);
  std::uint64_t state = 12345;
  const auto random = [&] {
    return state = state * 6364136223846793005u + 1442695040888963407u, state >> 33;
  };
  const std::string pieces[] = {"0", "-1", "9", "null", "[]", "{}", "\"\"", "1e300", "true", ","};
  std::size_t read_count = 0;
  for (int round = 0; round < 400; ++round) {
    std::string text = sample.text;
    const std::size_t last = end == std::string::npos ? text.size() : end;
    const std::size_t at = begin + random() % (last - begin);
    const std::size_t digit = text.find_first_of("0123456789", at);
    if (digit == std::string::npos || digit >= last) continue;
    text.replace(digit, 1, pieces[random() % 10]);
    Diagnostics diagnostics;
    const auto document = json::parse(text, "", 0, diagnostics);
    if (!document) continue;
    const auto file = open_text(text, diagnostics);
    if (!file) continue;
    const auto rigs = read_rigs(*file, diagnostics);
    CHECK(rigs.has_value() == diagnostics.ok());
    ++read_count;
  }
  CHECK(read_count > 50);
}
