// SPDX-License-Identifier: MIT
// Rigs that become one: they rest where they rested, keys do what they did, and what joined follows
// the joint that it hangs under.
#include "gltf/merge_into.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "base/files.h"
#include "eval/evaluate.h"
#include "gltf/clips.h"
#include "gltf/rig.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "pipeline/door_helpers.h"
#include "pipeline/merge.h"
#include "support/rig.h"

using namespace rigc;
namespace fs = std::filesystem;

namespace {

/// An arm with a hand, which names its rig in a selector.
const char* const kArm = R"(rigc: 1
name: third_arm
version: 3
features:
  ikfk: {kind: limb, switches: [arms]}
joints:
  - name: base
    at: [0.3, 1.3, 0.1]
    rotate: [10, 20, 30]
    local: third
    label: base
    tags:
      - command: control
      - command: attribute
        with: {attribute: half}
      - command: expression
        with: {to: ./control@half, value: "{extra:third.base/control@translate.x} / 2"}
parts:
  - {template: parts/arm, as: arm_x, attach: base, groups: {spine: third, torso: third, head: third, root: third}}
)";

const char* const kStick = R"(rigc: 1
name: stick
version: 1
joints:
  - name: a
    at: [0, 0, 0]
    local: stick
    label: a
    tags:
      - command: control
  - name: b
    parent: a
    at: [0, 1, 0]
    local: stick
    label: b
    tags:
      - command: control
)";

const char* const kStickMap = R"(map: stick
joints:
  stick.a: Bone
  stick.b: Bone.001
)";

std::string folder() {
  const std::string path = test::test_out("merge_into");
  fs::create_directories(path);
  return path;
}

std::string write(const std::string& name, const std::string& text) {
  Diagnostics diagnostics;
  REQUIRE(write_file(folder() + "/" + name, {Bytes(text)}, diagnostics));
  return folder() + "/" + name;
}

/// An arm that joins another character has no body or head of its own for its hand to follow.
std::vector<std::string> with_features(const std::string& template_file,
                                       std::vector<std::string> features = {}) {
  if (test::bytes_of(template_file).find("parts/arm,") != std::string::npos)
    features.push_back("spaces=off");
  return features;
}

std::string build(const std::string& template_file, const std::string& name,
                  const std::string& global = {}, const std::string& model = {},
                  const std::string& map = {}) {
  Diagnostics diagnostics;
  pipeline::BuildRequest request;
  request.template_file = template_file;
  request.paths.templates = {test::templates_folder()};
  request.global = global;
  request.model = model;
  request.map = map;
  request.features = with_features(template_file);
  const std::string out = folder() + "/" + name + ".glb";
  REQUIRE_MESSAGE(pipeline::build(request, out, diagnostics), render(diagnostics, false));
  if (!model.empty()) test::made_from(out, model);
  return out;
}

std::string biped() { return test::templates_folder() + "/biped.yaml"; }

gltf::File opened(const std::string& path) {
  Diagnostics diagnostics;
  auto file = gltf::open(path, diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  return *std::move(file);
}

std::vector<gltf::Rig> rigs_of(const std::string& path) {
  Diagnostics diagnostics;
  auto rigs = gltf::read_rigs(opened(path), diagnostics);
  REQUIRE_MESSAGE(rigs, render(diagnostics, false));
  CHECK_MESSAGE(diagnostics.all().empty(), render(diagnostics, false));
  return *std::move(rigs);
}

int control_node(const gltf::Rig& rig, const std::string& local, const std::string& label) {
  for (scene::NodeId id : rig.scene.nodes()) {
    const scene::Node& node = rig.scene[id];
    if (node.kind == scene::Kind::control && node.ids.local == local && node.ids.label == label)
      return rig.nodes[id.index];
  }
  FAIL("no control " << local << "." << label);
  return -1;
}

/// A copy of the file with a clip that turns and moves controls.
std::string keyed(const std::string& path,
                  const std::vector<std::pair<const char*, const char*>>& controls) {
  const std::vector<gltf::Rig> rigs = rigs_of(path);
  std::vector<anim::Channel> channels;
  for (const auto& [local, label] : controls) {
    const int node = control_node(rigs.front(), local, label);
    channels.push_back(test::keys(node, anim::Path::rotation, 4,
                                  {0, 0, 0, 1, 0.6f, 0, 0, 0.8f, 0, 0.28f, 0, 0.96f}));
  }
  const std::string out = test::with_clip(path, channels);
  if (fs::exists(path + ".model"))
    fs::copy(path + ".model", out + ".model", fs::copy_options::overwrite_existing);
  return out;
}

struct Outcome {
  std::string path;
  std::string codes;
};

Outcome join(const std::vector<std::string>& files, const std::string& name,
             const std::string& into, const std::vector<std::string>& attach) {
  Diagnostics diagnostics;
  Outcome outcome{folder() + "/" + name + ".glb", {}};
  fs::remove(outcome.path);
  pipeline::merge_files({files, false, into, attach, {}}, outcome.path, diagnostics);
  outcome.codes = test::codes(diagnostics);
  std::string models;
  for (const std::string& file : files) models += file + "\n";
  test::made_from(outcome.path, models);
  return outcome;
}

using Worlds = std::map<std::string, math::Affine>;

/// Worlds of all joints of all rigs, by key, at a time of all clips together.
Worlds worlds(const std::string& path, double seconds) {
  Diagnostics diagnostics;
  const gltf::File file = opened(path);
  const auto clips = gltf::read_clips(file, diagnostics);
  REQUIRE(clips);
  Worlds out;
  for (const gltf::Rig& rig : rigs_of(path)) {
    std::map<int, scene::NodeId> by_node;
    for (scene::NodeId id : rig.scene.nodes())
      if (rig.nodes[id.index] >= 0) by_node[rig.nodes[id.index]] = id;
    std::vector<eval::Setting> settings;
    for (const anim::Clip& clip : clips->clips) {
      for (const anim::Channel& channel : clip.channels) {
        const auto found = by_node.find(channel.node);
        if (clip.name != "test" || found == by_node.end()) continue;
        double q[4];
        anim::sample(channel.curve, true, seconds, q);
        settings.push_back(
            {{found->second, scene::transform::kRotation}, math::Quat{q[0], q[1], q[2], q[3]}});
      }
    }
    std::vector<scene::NodeId> joints;
    for (scene::NodeId id : rig.scene.nodes())
      if (rig.scene[id].is_skeleton()) joints.push_back(id);
    const auto found = eval::worlds(rig.scene, joints, settings);
    REQUIRE(found.size() == joints.size());
    math::Affine space;
    const auto json = test::load_character(path).json;
    const std::vector<int> parents = test::parents_of(json);
    for (int at = rig.ancestor; at >= 0; at = parents[static_cast<std::size_t>(at)])
      space = test::local_of(json["nodes"][static_cast<std::size_t>(at)]) * space;
    for (std::size_t i = 0; i < joints.size(); ++i)
      out[to_text(rig.scene[joints[i]].identity.owner)] = space * found[i];
  }
  return out;
}

double difference(const math::Affine& a, const math::Affine& b) {
  double most = math::length(a.origin - b.origin);
  for (const auto& [x, y] : {std::pair(a.linear.x, b.linear.x), std::pair(a.linear.y, b.linear.y),
                             std::pair(a.linear.z, b.linear.z)})
    most = std::max(most, math::length(x - y) / std::max(1.0, math::length(y)));
  return most;
}

std::string key_of(const std::string& path, const std::string& local, const std::string& label) {
  for (const gltf::Rig& rig : rigs_of(path))
    for (const tags::TaggedJoint& joint : rig.skeleton.joints)
      if (joint.ids.local == local && joint.ids.label == label) return to_text(joint.key);
  FAIL("no joint " << local << "." << label);
  return {};
}

/// The joined file does what the two did, where what joined follows `above`.
void expect_follows(const std::string& into, const std::string& from, const std::string& joined,
                    const std::string& above, double tolerance) {
  const Worlds rest = worlds(into, 0);
  for (const double seconds : {0.0, 0.05, 0.1, 0.17, 0.2}) {
    CAPTURE(seconds);
    const Worlds a = worlds(into, seconds), b = worlds(from, seconds),
                 both = worlds(joined, seconds);
    REQUIRE(both.size() == a.size() + b.size());
    const math::Affine follow = a.at(above) * math::inverse(rest.at(above));
    double of_into = 0, of_from = 0;
    for (const auto& [key, world] : a) of_into = std::max(of_into, difference(both.at(key), world));
    for (const auto& [key, world] : b)
      of_from = std::max(of_from, difference(both.at(key), follow * world));
    CHECK(of_into == 0);
    CHECK(of_from < tolerance);
    if (seconds == 0.2) CHECK(difference(follow, {}) > 0.1);
  }
}

std::string arm() { return build(write("arm.yaml", kArm), "arm", "extra"); }

}  // namespace

TEST_CASE("merge into: an arm joins a biped and follows its chest") {
  const std::string hero =
      keyed(build(biped(), "hero", "hero"), {{"spine", "chest"}, {"arm_l", "elbow"}});
  const std::string extra = keyed(arm(), {{"arm_x", "elbow"}, {"arm_x", "clavicle"}});
  const Outcome outcome = join({hero, extra}, "joined", "hero", {"third=spine.chest"});
  REQUIRE(outcome.codes.empty());
  expect_follows(hero, extra, outcome.path, key_of(hero, "spine", "chest"), 1e-12);

  const std::vector<gltf::Rig> one = rigs_of(outcome.path), first = rigs_of(hero),
                               second = rigs_of(extra);
  REQUIRE(one.size() == 1);
  const gltf::Rig& rig = one.front();
  CHECK(rig.skeleton.global == "hero");
  CHECK(rig.skeleton.joints.size() ==
        first[0].skeleton.joints.size() + second[0].skeleton.joints.size());
  CHECK(rig.commands.size() == first[0].commands.size() + second[0].commands.size());
  std::vector<std::string> mains;
  for (const tags::TemplateReference& reference : rig.skeleton.templates)
    if (reference.main) mains.push_back(reference.name);
  CHECK(mains == std::vector<std::string>{"third_arm"});
  for (const tags::TaggedJoint& joint : rig.skeleton.joints) {
    CHECK(joint.ids.global == "hero");
    const bool mine = second[0].skeleton.find(joint.key) >= 0;
    const auto& templates = mine ? second[0].skeleton : first[0].skeleton;
    const auto& old = templates.joints[static_cast<std::size_t>(templates.find(joint.key))];
    const auto& reference = rig.skeleton.templates[static_cast<std::size_t>(joint.template_index)];
    CHECK(reference.name == templates.templates[static_cast<std::size_t>(old.template_index)].name);
  }
  for (scene::NodeId id : rig.scene.nodes()) CHECK(rig.scene[id].identity.rig == rig.id);
  // The selector that named the rig by its group names the one that it is in now.
  const std::string text(opened(outcome.path).root()["extensions"]["RIGC_rig"].text());
  CHECK(text.find("{hero:third.base/control@translate.x} / 2") != std::string::npos);
  CHECK(text.find("extra:") == std::string::npos);
}

TEST_CASE("merge into: keys and other elements keep their text and their places") {
  const std::string hero = keyed(build(biped(), "hero", "hero"), {{"spine", "chest"}});
  const std::string extra = keyed(arm(), {{"arm_x", "elbow"}});
  Diagnostics diagnostics;
  const std::string apart = folder() + "/apart.glb";
  REQUIRE(pipeline::merge_files({{hero, extra}, false, {}, {}, {}}, apart, diagnostics));
  const Outcome outcome = join({apart}, "from_one_file", "hero", {"extra:arm_x=spine.chest"});
  REQUIRE(outcome.codes.empty());
  const gltf::File before = opened(apart), after = opened(outcome.path);
  for (const char* array : {"animations", "meshes", "accessors", "bufferViews", "materials"})
    CHECK(before.root()[array].text() == after.root()[array].text());
  CHECK(before.root()["nodes"].size() == after.root()["nodes"].size());
  CHECK(test::bytes_of(join({hero, extra}, "joined", "hero", {"third=spine.chest"}).path) ==
        test::bytes_of(outcome.path));
}

TEST_CASE("merge into: onto a character that stands in the middle of a clip") {
  const std::string model = test::corpus_file("mixamo_Xbot_blender/Xbot.glb");
  if (model.empty()) return;
  const std::string hero = keyed(build(biped(), "xbot", "hero", model), {{"spine", "chest"}});
  const std::string extra = keyed(arm(), {{"arm_x", "elbow"}});
  const Outcome outcome = join({hero, extra}, "on_xbot", "hero", {"third=spine.chest"});
  REQUIRE(outcome.codes.empty());
  expect_follows(hero, extra, outcome.path, key_of(hero, "spine", "chest"), 1e-9);
}

TEST_CASE("merge into: a model's own joints hang under another's, as they stand") {
  const std::string model = test::corpus_file("khronos_RiggedSimple_emb/rigged_simple.gltf");
  if (model.empty()) return;
  const std::string hero = keyed(build(biped(), "hero", "hero"), {{"spine", "chest"}});
  const std::string stick = keyed(
      build(write("stick.yaml", kStick), "stick", "", model, write("stick_map.yaml", kStickMap)),
      {{"stick", "b"}});
  const Outcome outcome = join({hero, stick}, "with_model", "hero", {"stick=spine.chest"});
  REQUIRE(outcome.codes.empty());
  expect_follows(hero, stick, outcome.path, key_of(hero, "spine", "chest"), 1e-6);
  // In the file nothing moves: every node of the stick stands where it stood.
  const auto before = test::load_character(stick).json,
             after = test::load_character(outcome.path).json;
  const std::size_t count = opened(hero).root()["nodes"].size();
  const auto world = [](const auto& json, std::size_t node) {
    const std::vector<int> parents = test::parents_of(json);
    math::Affine out;
    for (int at = static_cast<int>(node); at >= 0; at = parents[static_cast<std::size_t>(at)])
      out = test::local_of(json["nodes"][static_cast<std::size_t>(at)]) * out;
    return out;
  };
  for (std::size_t i = 0; i < before["nodes"].size(); ++i)
    CHECK(difference(world(after, count + i), world(before, i)) < 1e-5);
}

TEST_CASE("merge into: keys on what hangs elsewhere now are reported") {
  const std::string stick = build(write("stick.yaml", kStick), "moving");
  const std::vector<gltf::Rig> rigs = rigs_of(stick);
  const int root = rigs[0].nodes[0];
  const std::string moved =
      test::with_clip(stick, {test::keys(root, anim::Path::translation, 3, {0, 0, 0, 1, 0, 0})});
  const std::string hero = build(biped(), "hero", "hero");
  CHECK(join({hero, moved}, "moved", "hero", {"stick=spine.chest"}).codes == "RIG0697");
}

TEST_CASE("merge into: what stands above a joint in the file cannot hang under it") {
  const std::string hero = build(biped(), "hero", "hero");
  const std::string stick = build(write("stick.yaml", kStick), "stick_above");
  Diagnostics diagnostics;
  const std::string apart = folder() + "/above.glb";
  REQUIRE(pipeline::merge_files({{hero, stick}, false, {}, {}, {}}, apart, diagnostics));
  test::Character character = test::load_glb(apart);
  auto& json = character.json;
  const int root = rigs_of(hero)[0].nodes[0];
  const std::size_t above = opened(hero).root()["nodes"].size();  // first joint of the stick
  json["nodes"][above]["children"].push_back(root);
  auto& roots = json["scenes"][0]["nodes"];
  roots.erase(std::find(roots.begin(), roots.end(), root));
  test::save_glb(character, apart);
  CHECK(join({apart}, "refused", "hero", {"stick=spine.chest"}).codes == "RIG0696");
}

TEST_CASE("merge into: two rigs join a third in one go") {
  const std::string hero = build(biped(), "hero", "hero");
  std::string other = kArm;
  for (const auto& [from, to] : std::map<std::string, std::string>{{"third_arm", "fourth_arm"},
                                                                   {"third", "fourth"},
                                                                   {"extra:", "more:"},
                                                                   {"arm_x", "arm_y"}})
    for (std::size_t at = other.find(from); at != std::string::npos;
         at = other.find(from, at + to.size()))
      other.replace(at, from.size(), to);
  const std::string second = build(write("arm_y.yaml", other), "arm_y", "more");
  const Outcome outcome =
      join({arm(), hero, second}, "three", "hero", {"third=spine.chest", "arm_y=head.head"});
  REQUIRE(outcome.codes.empty());
  const std::vector<gltf::Rig> rigs = rigs_of(outcome.path);
  REQUIRE(rigs.size() == 1);
  const auto& joints = rigs[0].skeleton.joints;
  std::map<std::string, std::string> above;
  for (const tags::TaggedJoint& joint : joints)
    if (joint.parent >= 0)
      above[joint.ids.local + "." + joint.ids.label] =
          joints[static_cast<std::size_t>(joint.parent)].ids.label;
  CHECK(above.at("third.base") == "chest");
  CHECK(above.at("fourth.base") == "head");
}

TEST_CASE("merge into: settings of each rig go on to hold for it alone") {
  Diagnostics diagnostics;
  const auto with_setting = [&](const std::string& template_file, const std::string& name,
                                const std::vector<std::string>& features) {
    pipeline::BuildRequest request;
    request.template_file = template_file;
    request.paths.templates = {test::templates_folder()};
    request.features = with_features(template_file, features);
    request.global = name.find("arm") == std::string::npos ? "" : "extra";
    REQUIRE_MESSAGE(pipeline::build(request, folder() + "/" + name, diagnostics),
                    render(diagnostics, false));
    return folder() + "/" + name;
  };
  const std::string hero = with_setting(biped(), "set.glb", {"fk=on", "ikfk=off", "eyes=off"});
  const std::string extra =
      with_setting(write("arm.yaml", kArm), "set_arm.glb", {"arm_x/ikfk=on", "fk=off"});
  const Outcome outcome = join({hero, extra}, "set_both", "biped", {"third=spine.chest"});
  REQUIRE(outcome.codes.empty());
  const tags::Settings settings = rigs_of(outcome.path)[0].settings;
  std::map<std::string, std::set<bool>> fk;
  bool eyes = false;
  for (const auto& feature : settings.features) {
    if (feature.name == "fk") fk[feature.group].insert(feature.on);
    if (feature.name == "eyes") eyes = feature.group.empty() && !feature.on;
  }
  CHECK(eyes);
  CHECK(fk.count("") == 0);
  CHECK(fk.at("arm_l") == std::set<bool>{true});
  CHECK(fk.at("arm_x") == std::set<bool>{false});
}

TEST_CASE("merge into: what cannot become one is refused") {
  const std::string hero = build(biped(), "hero", "hero"), again = build(biped(), "again", "again"),
                    extra = arm();
  const auto codes = [&](const std::vector<std::string>& files, const std::string& into,
                         const std::vector<std::string>& attach) {
    const Outcome outcome = join(files, "refused", into, attach);
    CHECK(!fs::exists(outcome.path));
    return outcome.codes;
  };
  const std::vector<std::string> two = {hero, extra};
  CHECK(codes(two, "nobody", {"third=spine.chest"}) == "RIG0689");
  CHECK(codes(two, "hero", {"fifth=spine.chest"}) == "RIG0689");
  CHECK(codes(two, "hero", {"third=spine.tail"}) == "RIG0689");
  CHECK(codes(two, "hero", {"third=spine.chest", "arm_x=head.head"}) == "RIG0689");
  CHECK(codes({hero, again, extra}, "extra", {"arm_l=third.base"}) == "RIG0689");
  CHECK(codes({hero, again}, "hero", {"torso=spine.chest"}) == "RIG0696 RIG0696 RIG0696");
  std::string root = kStick;
  root.replace(root.find("command: control"), 16, "command: root");
  CHECK(codes({hero, build(write("rooted.yaml", root), "rooted")}, "hero", {"stick=spine.chest"}) ==
        "RIG0696");
  for (const char* attach : {"third", "third=", "third=chest", "a:b:third=spine.chest", "=a.b"})
    CHECK_MESSAGE(codes(two, "hero", {attach}) == "RIG0833", attach);
  CHECK(codes(two, "hero", {}) == "RIG0833");
  CHECK(codes(two, "", {"third=spine.chest"}) == "RIG0833");

  std::string roots = kStick;
  roots.replace(roots.find("    parent: a\n"), 14, "");
  roots.replace(roots.rfind("local: stick"), 12, "local: other");
  const std::string twins = build(write("twins.yaml", roots), "twins");
  CHECK(codes({hero, twins}, "hero", {"stick=spine.chest"}) == "RIG0695");
  CHECK(join({hero, twins}, "twins_joined", "hero", {"stick=spine.chest", "other=head.head"})
            .codes.empty());

  // Somebody's edit: a joint that no node of the rig stands for.
  std::string bare = kStick;
  bare.erase(bare.rfind("    tags:\n"));
  test::Character edited = test::load_glb(build(write("bare.yaml", bare), "stick_edited"));
  auto& joints = edited.json["extensions"]["RIGC_rig"]["rigs"][0]["joints"];
  joints.push_back(joints[1]);
  joints[2]["key"] = "00000000000000aa";
  joints[2]["label"] = "c";
  const std::string odd = folder() + "/stick_edited.glb";
  test::save_glb(edited, odd);
  CHECK(codes({odd, extra}, "stick", {"third=stick.c"}) == "RIG0696");
}
