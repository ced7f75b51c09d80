// SPDX-License-Identifier: MIT
// Rebuild, unbuild, strip and prune; what inspect says of orphans.
#include "pipeline/rebuild.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "pipeline/inspect.h"
#include "pipeline/merge_codes.h"
#include "pipeline/named_edits_helpers.h"
#include "pipeline/update_codes.h"

namespace rigc {
namespace {

using test::rebuild;
using test::Shot;
using test::Story;
using test::unbuild;

std::string said(const Diagnostics& diagnostics) { return render(diagnostics, false); }

pipeline::Rebuilt rebuild_with(const std::string& path, const std::string& feature,
                               const std::string& group = "") {
  pipeline::RebuildRequest request;
  if (!feature.empty()) request.features = {feature};
  if (!group.empty()) request.groups = {group};
  return rebuild(path, request);
}

void biped(Story& story, unsigned seed) {
  test::write_biped(story.folder, 1);
  // The rig drives the scale of its root: keys there play nothing, and would wait for ever.
  story.build("biped.yaml", seed, {2, 0.5, 0.3, 4, 0});
}

/// The same keys, values and motion, bit for bit.
void check_same(const Shot& a, const Shot& b) {
  CHECK(test::differences(test::keys_of(a), test::keys_of(b)) == "");
  bool exact = false;
  CHECK(test::motion_difference(a, b, "", &exact) == 0);
  CHECK(exact);
}

std::size_t controls_of(const gltf::Rig& rig) {
  std::size_t count = 0;
  for (const scene::NodeId id : rig.scene.nodes())
    count += rig.scene[id].kind == scene::Kind::control ? 1 : 0;
  return count;
}

std::vector<int> numbers(const Diagnostics& diagnostics) {
  std::vector<int> out;
  for (const Diagnostic& diagnostic : diagnostics.all()) out.push_back(diagnostic.code->number);
  return out;
}

/// What inspect says of a file.
nlohmann::json inspected(const std::string& path) {
  Diagnostics diagnostics;
  const auto text = pipeline::inspect(path, true, diagnostics);
  REQUIRE_MESSAGE(text, said(diagnostics));
  return nlohmann::json::parse(*text);
}

/// A template with the way that a limb is made as a feature.
const char* const kLimb = R"(rigc: 1
name: limb
version: 1
features:
  limbs: {kind: limb, title: Limbs}
joints:
  - name: base
    at: [0, 0, 0]
    local: body
    label: base
    tags:
      - command: control
        with: {size: 0.4}
  - name: upper
    parent: base
    at: [0, 1, 0]
    local: arm
    label: shoulder
    tags:
      - feature: limbs
        commands:
          - command: attribute
            with: {on: "body.base/control", attribute: reach}
          - command: fk_chain
            with: {joints: "arm[*]", size: 0.2}
  - name: hand
    parent: upper
    at: [1, 1, 0]
    local: arm
    label: wrist
)";

}  // namespace

TEST_CASE("rebuild: a feature goes with its keys and comes back with them") {
  Story s("rebuild_feature");
  s.build_text(kLimb, 21, {2, 1, 1, 4});
  const auto off = rebuild_with(s.shot, "limbs=off");
  const Shot without = test::read_shot(s.shot);
  // Two controls of the chain, and an attribute of a control that stays.
  CHECK(without.rigs.front().orphans.size() == 3);
  CHECK(off.rigs.front().carry.controls_removed.size() == 2);
  CHECK(off.rigs.front().carry.new_orphans > 0);
  CHECK(test::differences(test::keys_of(s.original), test::keys_of(without)) == "");

  // Again the same changes nothing more.
  const auto again = rebuild_with(s.shot, "limbs=off");
  CHECK(again.rigs.front().carry.new_orphans == 0);
  CHECK(again.rigs.front().carry.orphans == off.rigs.front().carry.orphans);
  CHECK(test::differences(test::keys_of(s.original), test::keys_of(test::read_shot(s.shot))) == "");

  const auto on = rebuild_with(s.shot, "limbs=on");
  const Shot back = test::read_shot(s.shot);
  CHECK(back.rigs.front().orphans.empty());
  CHECK(on.rigs.front().carry.orphans == 0);
  check_same(s.original, back);
}

TEST_CASE("rebuild: groups and features of the biped, off and on") {
  Story s("rebuild_biped");
  biped(s, 22);
  for (const std::string group : {"arm_l", "head"}) {
    INFO(group);
    rebuild_with(s.shot, "", group + "=off");
    const Shot without = test::read_shot(s.shot);
    CHECK(!without.rigs.front().orphans.empty());
    CHECK(test::differences(test::keys_of(s.original), test::keys_of(without)) == "");
    rebuild_with(s.shot, "", group + "=on");
    check_same(s.original, test::read_shot(s.shot));
  }
  rebuild_with(s.shot, "fingers=off");
  rebuild_with(s.shot, "ikfk:legs=off");
  rebuild_with(s.shot, "ikfk:legs=on");
  rebuild_with(s.shot, "fingers=on");
  check_same(s.original, test::read_shot(s.shot));
}

TEST_CASE("rebuild: without other settings nothing is lost or moved") {
  Story s("rebuild_same");
  biped(s, 23);
  const auto rebuilt = rebuild(s.shot);
  CHECK(rebuilt.rigs.front().carry.changed.empty());
  CHECK(largest_difference(rebuilt.rigs.front()).mm == 0);
  const Shot after = test::read_shot(s.shot);
  check_same(s.original, after);
  CHECK(after.rigs.front().nodes == s.original.rigs.front().nodes);
  const std::string bytes = test::bytes_of(s.shot);
  rebuild(s.shot);
  CHECK(test::bytes_of(s.shot) == bytes);
}

TEST_CASE("rebuild: a plan says the same and writes nothing") {
  Story s("rebuild_plan");
  s.build_text(kLimb, 24, {1, 1, 1, 4});
  const std::string bytes = test::bytes_of(s.shot);
  pipeline::RebuildRequest request;
  request.features = {"limbs=off"};
  request.plan = true;
  const auto plan = rebuild(s.shot, request);
  CHECK(test::bytes_of(s.shot) == bytes);
  request.plan = false;
  const auto done = rebuild(s.shot, request);
  CHECK(test::bytes_of(s.shot) != bytes);
  CHECK(as_text(plan.rigs.front(), true) == as_text(done.rigs.front(), true));
}

TEST_CASE("rebuild: strict and tolerance leave the file alone") {
  Story s("rebuild_strict");
  s.build_text(kLimb, 25, {1, 1, 1, 4});
  const std::string bytes = test::bytes_of(s.shot);
  pipeline::RebuildRequest request;
  request.features = {"limbs=off"};
  Diagnostics diagnostics;
  SUBCASE("strict") {
    request.strict = true;
    CHECK(!pipeline::rebuild(request, catalog::Catalogue(), {s.shot, s.shot, ""}, diagnostics));
    CHECK(numbers(diagnostics) == std::vector<int>{pipeline::codes::kWouldOrphan.number});
  }
  SUBCASE("tolerance") {
    request.tolerance_mm = 0.1;
    CHECK(!pipeline::rebuild(request, catalog::Catalogue(), {s.shot, s.shot, ""}, diagnostics));
    CHECK(numbers(diagnostics) == std::vector<int>{pipeline::codes::kMoves.number});
  }
  SUBCASE("a rig that the file has not") {
    request.rigs = {"nobody"};
    CHECK(!pipeline::rebuild(request, catalog::Catalogue(), {s.shot, s.shot, ""}, diagnostics));
    CHECK(numbers(diagnostics) == std::vector<int>{pipeline::codes::kNoSuchRig.number});
    CHECK(said(diagnostics).find("its rigs: limb") != std::string::npos);
  }
  CHECK(test::bytes_of(s.shot) == bytes);
}

TEST_CASE("rebuild: a file without a rig is refused") {
  const std::string path = test::fresh_folder("rebuild_none") + "/model.gltf";
  test::write_text(path, R"({"asset": {"version": "2.0"}, "nodes": [{}]})");
  Diagnostics diagnostics;
  CHECK(!pipeline::rebuild({}, catalog::Catalogue(), {path, path, ""}, diagnostics));
  CHECK(!pipeline::strip({}, {path, path, ""}, diagnostics));
  CHECK(!pipeline::prune({}, {path, path, ""}, diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>(3, pipeline::codes::kNoRigHere.number));
}

TEST_CASE("unbuild: everything waits, and comes back") {
  Story s("unbuild");
  biped(s, 26);
  const auto apart = unbuild(s.shot);
  CHECK(apart.rigs.front().carry.orphans == apart.rigs.front().carry.new_orphans);
  const Shot bare = test::read_shot(s.shot);
  CHECK(controls_of(bare.rigs.front()) == 0);
  CHECK(bare.rigs.front().commands.empty());
  CHECK(bare.rigs.front().skeleton.joints.size() == s.original.rigs.front().skeleton.joints.size());
  CHECK(test::differences(test::keys_of(s.original), test::keys_of(bare)) == "");

  SUBCASE("by rebuild") {
    rebuild(s.shot);
    const Shot back = test::read_shot(s.shot);
    CHECK(back.rigs.front().orphans.empty());
    check_same(s.original, back);
  }
  SUBCASE("an update does not build it") {
    test::write_biped(s.folder, 2);
    s.update();
    CHECK(controls_of(s.after.rigs.front()) == 0);
    CHECK(s.after.rigs.front().skeleton.templates.front().version == 2);
    CHECK(test::differences(test::keys_of(s.original), test::keys_of(s.after)) == "");
    rebuild(s.shot);
    check_same(s.original, test::read_shot(s.shot));
  }
}

TEST_CASE("strip: a model is what it was, byte for byte") {
  std::size_t stripped = 0;
  for (const char* file :
       {"mixamo_Xbot_blender/Xbot.glb", "rpm_avatar_a/646d9dcdc8a5f5bddbfac913.glb"}) {
    const std::string model = test::corpus_file(file);
    if (model.empty()) continue;
    INFO(file);
    Story s("strip_" + std::to_string(stripped++));
    test::write_biped(s.folder, 1);
    test::build_rig(s.folder + "/biped.yaml", s.shot, model);
    test::made_from(s.shot, model);
    test::animate(s.shot, 27, {2, 0.3, 0, 4});
    // With orphans, which go too.
    rebuild_with(s.shot, "", "arm_l=off");
    Diagnostics diagnostics;
    const auto removed = pipeline::strip({}, {s.shot, s.shot, ""}, diagnostics);
    REQUIRE_MESSAGE(removed, said(diagnostics));
    CHECK(removed->channels > 0);
    CHECK(removed->orphans > 0);
    const test::Character before = test::load_character(model),
                          after = test::load_character(s.shot);
    for (auto at = before.json.begin(); at != before.json.end(); ++at) {
      INFO(at.key());
      // What the test's own clips brought is behind the model's: they remain, empty.
      const bool longer = at.value().is_array() && at.key() != "nodes" && at.key() != "buffers";
      if (at.key() == "buffers") continue;
      if (!longer) CHECK(after.json[at.key()] == at.value());
      for (std::size_t i = 0; longer && i < at.value().size(); ++i)
        CHECK(after.json[at.key()][i] == at.value()[i]);
    }
  }
  if (stripped == 0) MESSAGE("the corpus is absent: nothing was stripped");
}

TEST_CASE("strip: a model without clips of ours has the bytes of before") {
  const std::string model = test::corpus_file("mixamo_Xbot_blender/Xbot.glb");
  if (model.empty()) return;
  Story s("strip_bytes");
  test::write_biped(s.folder, 1);
  test::build_rig(s.folder + "/biped.yaml", s.shot, model);
  test::made_from(s.shot, model);
  SUBCASE("as built") {}
  SUBCASE("updated") {
    test::write_biped(s.folder, 2, test::without_clavicle());
    s.update();
  }
  SUBCASE("taken apart") { unbuild(s.shot); }
  Diagnostics diagnostics;
  REQUIRE(pipeline::strip({}, {s.shot, s.shot, ""}, diagnostics));
  CHECK(test::bytes_of(s.shot) == test::bytes_of(model));
}

TEST_CASE("strip: joints of a character that came from a template remain") {
  Story s("strip_template");
  biped(s, 28);
  Diagnostics diagnostics;
  const auto removed = pipeline::strip({}, {s.shot, s.shot, ""}, diagnostics);
  REQUIRE_MESSAGE(removed, said(diagnostics));
  const Shot bare = test::read_shot(s.shot);
  CHECK(bare.rigs.empty());
  const test::Character before = test::load_character(s.shot);
  std::vector<std::string> names;
  for (const auto& node : before.json["nodes"]) names.push_back(node.value("name", ""));
  for (const tags::TaggedJoint& joint : s.original.rigs.front().skeleton.joints)
    CHECK(std::find(names.begin(), names.end(), joint.name) != names.end());
  CHECK(test::bytes_of(s.shot).find("RIGC_rig") == std::string::npos);
  CHECK(test::bytes_of(s.shot).find("\"rigc\":\"") == std::string::npos);
  for (const anim::Clip& clip : bare.clips) CHECK(clip.channels.empty());
}

TEST_CASE("prune: orphans go with their keys, and nothing else") {
  Story s("prune");
  s.build_text(kLimb, 29, {2, 1, 1, 4});
  rebuild_with(s.shot, "limbs=off");
  const Shot before = test::read_shot(s.shot);
  std::vector<std::string> expected = test::keys_of(before);
  std::vector<std::string> lost;
  for (const gltf::Orphan& orphan : before.rigs.front().orphans) {
    Identity identity = orphan.identity;
    identity.rig = 0;
    lost.push_back("limb " + to_text(identity) + " ");
  }
  const nlohmann::json json = inspected(s.shot);
  const auto orphans = json["rigs"][0]["orphans"];
  REQUIRE(orphans.size() == 3);
  Diagnostics diagnostics;
  const auto removed = pipeline::prune({}, {s.shot, s.shot, ""}, diagnostics);
  REQUIRE_MESSAGE(removed, said(diagnostics));
  CHECK(removed->orphans == 3);
  std::size_t channels = 0;
  for (const auto& orphan : orphans) channels += orphan["channels"].get<std::size_t>();
  CHECK(removed->channels == channels);

  const Shot after = test::read_shot(s.shot);
  CHECK(after.rigs.front().orphans.empty());
  // What stays on the control that lost one attribute is named by the same identity.
  const std::vector<std::string> kept = test::keys_of(after);
  for (const std::string& line : kept)
    CHECK(std::find(expected.begin(), expected.end(), line) != expected.end());
  CHECK(expected.size() - kept.size() >= channels);
  for (const std::string& line : expected) {
    const bool was_lost = std::any_of(lost.begin(), lost.end(), [&](const std::string& owner) {
      return line.rfind(owner, 0) == 0;
    });
    if (!was_lost) CHECK(std::find(kept.begin(), kept.end(), line) != kept.end());
  }
  bool exact = false;
  CHECK(test::motion_difference(before, after, "", &exact) == 0);
  CHECK(exact);
  CHECK(after.rigs.front().nodes == before.rigs.front().nodes);

  // Nothing more to prune: not written again.
  const std::string bytes = test::bytes_of(s.shot);
  const auto again = pipeline::prune({}, {s.shot, s.shot, ""}, diagnostics);
  REQUIRE(again);
  CHECK(again->orphans == 0);
  CHECK(test::bytes_of(s.shot) == bytes);
}

TEST_CASE("inspect: says what waits for its node") {
  Story s("inspect_orphans");
  s.build_text(kLimb, 30, {2, 1, 1, 4});
  CHECK(inspected(s.shot)["rigs"][0]["orphans"].empty());
  rebuild_with(s.shot, "limbs=off");
  const auto orphans = inspected(s.shot)["rigs"][0]["orphans"];
  REQUIRE(orphans.size() == 3);
  const Shot shot = test::read_shot(s.shot);
  const test::Character file = test::load_character(s.shot);
  std::size_t reach = 0;
  for (const auto& orphan : orphans) {
    const auto& node = file.json["nodes"][orphan["node"].get<std::size_t>()];
    CHECK(node["extras"]["rigc"] == "orphan:" + orphan["identity"].get<std::string>());
    CHECK(orphan["channels"].get<std::size_t>() > 0);
    CHECK(orphan.contains("name"));
    if (orphan["label"] == "base") {
      ++reach;
      CHECK(orphan["local"] == "body");
      CHECK(orphan["attributes"].size() == 1);
      CHECK(orphan["attributes"]["reach"].get<double>() == node["extras"]["reach"].get<double>());
    } else {
      CHECK(orphan["local"] == "arm");
      CHECK(orphan["attributes"].contains("rotation"));
    }
  }
  CHECK(reach == 1);
  Diagnostics diagnostics;
  const auto text = pipeline::inspect(s.shot, false, diagnostics);
  REQUIRE(text);
  CHECK(text->find("  orphan    arm.shoulder/fk_chain.fk: ") != std::string::npos);
}

}  // namespace rigc
