// SPDX-License-Identifier: MIT
// Guides over the biped and over real characters: what is written builds the same bytes, what is
// moved moves, what the model owns stays, and keys survive.
#include "pipeline/guides.h"

#include <doctest/doctest.h>

#include <fmt/format.h>

#include <cstring>

#include "base/files.h"
#include "pipeline/character_helpers.h"
#include "pipeline/check.h"
#include "pipeline/named_edits_helpers.h"
#include "pipeline/rebuild.h"
#include "support/skeletons.h"
#include "templates/codes.h"

namespace rigc {
namespace {

using math::Vec3;
using nlohmann::ordered_json;

pipeline::BuildRequest biped(const std::string& model = {}) {
  pipeline::BuildRequest request;
  request.template_file = test::templates_folder() + "/biped.yaml";
  request.paths.templates = {test::templates_folder()};
  request.model = model;
  if (!model.empty()) request.features = {"eyes=off"};  // they would bend nothing, which is said
  return request;
}

std::string write_guides(const pipeline::BuildRequest& request, const std::string& before = {},
                         const std::string& from = {}) {
  Diagnostics diagnostics;
  const auto file = pipeline::write_guides({request, before, from}, diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  return file->yaml;
}

gltf::Rig build(pipeline::BuildRequest request, const std::string& guides, const std::string& out) {
  request.guides = guides;
  Diagnostics diagnostics;
  const auto built = pipeline::build(request, out, diagnostics);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  CHECK_MESSAGE(diagnostics.all().empty(), render(diagnostics, false));
  if (!request.model.empty()) test::made_from(out, request.model);
  CHECK_MESSAGE(pipeline::check(out, {}, diagnostics), render(diagnostics, false));
  return built->rig;
}

std::string edited(std::string text, const std::string& from, const std::string& to) {
  REQUIRE_MESSAGE(text.find(from) != std::string::npos, from);
  return text.replace(text.find(from), from.size(), to);
}

std::string saved(const std::string& name, const std::string& text) {
  const std::string path = test::test_out(name);
  test::write_text(path, text);
  return path;
}

Vec3 place_of(const tags::TaggedSkeleton& skeleton, const std::string& local,
              const std::string& label) {
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i)
    if (skeleton.joints[i].ids.local == local && skeleton.joints[i].ids.label == label)
      return skeleton.world(i).origin;
  FAIL("no joint " << local << "." << label);
  return {};
}

const std::string kElbow = "{at: [0.455, 1.42, -0.04], fitted";
const std::string kRaised = "{at: [0.455, 1.45, -0.04], fitted";
const std::string kNoMirror = "# mirror: left_to_right";
const std::string kHand = "# arm_l.wrist/ik_fk_limb#limb.ik: {shape: cube, size: 1}";

/// The left elbow 3 cm higher, the right one by its mirror, and a large green sphere for the hand.
std::string raised_elbows(const std::string& text) {
  const std::string moved =
      edited(edited(text, kElbow, kRaised), kNoMirror, "mirror: left_to_right");
  return edited(moved, kHand,
                "arm_l.wrist/ik_fk_limb#limb.ik: {shape: sphere, size: 1.5, color: green}");
}

const scene::Node& hand_control(const gltf::Rig& rig, const std::string& local) {
  return rig.scene[test::control(rig, local, "wrist", "ik")];
}

std::string shape_of(const scene::Node& node) {
  return std::get<std::string>(node.attributes[scene::control::kShape][0]);
}

/// Where skins have their joints bound, by node: inverses of the inverse binds.
std::map<int, Vec3> binds_of(const std::string& path) {
  const test::Character file = test::load_glb(path);
  std::map<int, Vec3> out;
  for (const auto& skin : file.json["skins"]) {
    const auto& accessor = file.json["accessors"][skin["inverseBindMatrices"].get<std::size_t>()];
    const auto& view = file.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::size_t at = view.value("byteOffset", 0U) + accessor.value("byteOffset", 0U);
    for (std::size_t j = 0; j < skin["joints"].size(); ++j) {
      float m[16];
      std::memcpy(m, file.bin.data() + at + j * sizeof m, sizeof m);
      const math::Affine inverse{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}},
                                 {m[12], m[13], m[14]}};
      out[skin["joints"][j].get<int>()] = math::inverse(inverse).origin;
    }
  }
  return out;
}

/// A limb with all that goes along: chains, a joint between two others, what hangs on the end.
const std::string kLimbs = R"(rigc: 1
name: limbs
version: 1
global: limbs
joints:
  - {name: hips, at: [0, 1, 0], local: torso, label: hips, tags: [{command: control}]}
  - {name: spine, parent: hips, at: [0, 1.1, 0], chain: {count: 4, to: [0, 1.4, 0]}, local: spine,
     orient: {aim: +y, up: +z}, tags: [{command: control}]}
  - {name: arm_l, parent: spine, at: [0.2, 1.4, 0], local: arm_l, label: shoulder,
     orient: {aim: +y, up: +z}, tags: [{command: control}]}
  - {name: elbow_l, parent: arm_l, at: [0.5, 1.4, -0.02], local: arm_l, label: elbow,
     orient: {aim: +y, up: +z, toward: wrist_l}, tags: [{command: control}]}
  - {name: roll_l, parent: elbow_l, at: [0.65, 1.4, -0.01], local: arm_l, label: roll,
     guide: {between: [elbow_l, wrist_l], at: 0.6}}
  - {name: wrist_l, parent: elbow_l, at: [0.75, 1.4, 0], local: arm_l, label: wrist}
  - {name: hand_l, parent: wrist_l, translate: [0.1, 0, 0], local: hand_l, label: palm,
     tags: [{command: control}]}
  - {name: arm_r, parent: spine, at: [-0.2, 1.4, 0], local: arm_r, label: shoulder,
     tags: [{command: control}]}
  - {name: elbow_r, parent: arm_r, at: [-0.5, 1.4, -0.02], local: arm_r, label: elbow,
     tags: [{command: control}]}
  - {name: wrist_r, parent: elbow_r, at: [-0.75, 1.4, 0], local: arm_r, label: wrist}
)";

std::string numbers(const Vec3& v) {
  return fmt::format("[{:.5f}, {:.5f}, {:.5f}]", v.x, v.y, v.z);
}

/// A file that mentions a few joints and controls of a rig, at random.
class ShortFile {
 public:
  ShortFile(const gltf::Rig& rig, test::Random& random) : name_(rig.skeleton.name) {
    const char* mirrors[] = {"", "mirror: left_to_right\n", "mirror: both\n"};
    mirror_ = mirrors[random.below(3)];
    const auto names = templates::guide_names(rig.skeleton, nullptr);
    for (std::size_t i = 1 + random.below(4); i > 0; --i) {
      const std::size_t joint = random.below(names.size());
      const Vec3 fitted =
          templates::to_template(rig.skeleton.character, rig.skeleton.world(joint).origin);
      const auto way = [&] { return 0.01 * static_cast<double>(random.below(9)) - 0.04; };
      const Vec3 at = fitted + (random.below(4) == 0 ? Vec3{} : Vec3{way(), way(), way()});
      joints_[names[joint]] = random.below(3) == 0
                                  ? numbers(at)
                                  : "{at: " + numbers(at) + ", fitted: " + numbers(fitted) + "}";
      back_[names[joint]] = "{at: " + numbers(fitted) + ", fitted: " + numbers(fitted) + "}";
      const tags::TaggedJoint& tagged = rig.skeleton.joints[joint];
      const int other = rig.skeleton.find(tagged.mirror.opposite);
      if (mirror_.empty() || other < 0) continue;
      const auto opposite = static_cast<std::size_t>(other);
      const std::string there = numbers(
          templates::to_template(rig.skeleton.character, rig.skeleton.world(opposite).origin));
      back_.emplace(names[opposite], "{at: " + there + ", fitted: " + there + "}");
    }
    std::vector<std::string> controls;
    for (const scene::NodeId id : rig.scene.nodes()) {
      const scene::Node& node = rig.scene[id];
      const int owner = rig.skeleton.find(node.identity.owner);
      if (node.kind != scene::Kind::control || node.ids.local.empty() || owner < 0) continue;
      controls.push_back(names[static_cast<std::size_t>(owner)] + "/" + node.module + "#" +
                         node.identity.command + "." + node.identity.role);
    }
    const char* edits[] = {"{}", "{size: 2}", "{shape: sphere, color: red}"};
    controls_[controls[random.below(controls.size())]] = edits[random.below(3)];
  }
  std::string text() const { return text(joints_, controls_, mirror_); }
  /// Everything that both mention as it was without guides.
  std::string back(const ShortFile& other) const {
    auto joints = back_;
    joints.insert(other.back_.begin(), other.back_.end());
    Lines controls;
    for (const ShortFile* file : {this, &other})
      for (const auto& [control, edit] : file->controls_) controls[control] = "{}";
    return text(joints, controls, "mirror: both\n");
  }

 private:
  using Lines = std::map<std::string, std::string>;
  std::string text(const Lines& joints, const Lines& controls, const std::string& mirror) const {
    std::string out = "guides: " + name_ + "\n" + mirror + "joints:\n";
    for (const auto& [name, line] : joints) out += "  " + name + ": " + line + "\n";
    out += "controls:\n";
    for (const auto& [name, line] : controls) out += "  " + name + ": " + line + "\n";
    return out;
  }
  std::string name_, mirror_;
  Lines joints_, back_, controls_;
};

double difference(const tags::TaggedSkeleton& a, const tags::TaggedSkeleton& b) {
  REQUIRE(a.joints.size() == b.joints.size());
  double most = std::abs(a.character.height - b.character.height);
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    const math::Affine p = a.world(i), q = b.world(i);
    most = std::max({most, length(p.origin - q.origin), length(p.linear.x - q.linear.x),
                     length(p.linear.y - q.linear.y)});
  }
  return most;
}

const tags::TaggedSkeleton skeleton_of(const std::string& path) {
  return test::read_shot(path).rigs.front().skeleton;
}

std::string rebuilt(const std::string& path, const std::string& guides) {
  pipeline::RebuildRequest request;
  request.guides = saved("rebuilt.yaml", guides);
  test::rebuild(path, request);
  return test::bytes_of(path);
}

}  // namespace

TEST_CASE("pipeline guides: any file twice is the file once, and all of it put back is nothing") {
  test::Random random(6);
  for (int turn = 0; turn < 24; ++turn) {
    pipeline::BuildRequest request = biped();
    if (turn % 4 == 1) request.template_file = test::templates_folder() + "/quadruped.yaml";
    if (turn % 4 == 2) request.template_file = test::templates_folder() + "/tentacle.yaml";
    if (turn % 4 == 3) request.template_file = saved("limbs.yaml", kLimbs);
    const std::string plain = test::test_out("laws_plain.glb"), path = test::test_out("laws.glb");
    const gltf::Rig rig = build(request, "", plain);
    const ShortFile first(rig, random), second(rig, random);
    CAPTURE(turn);
    CAPTURE(first.text());
    CAPTURE(second.text());
    const std::string without = test::bytes_of(plain);

    // Built with it; built, and rebuilt with it; and once more.
    build(request, saved("laws.yaml", first.text()), path);
    const tags::TaggedSkeleton built = skeleton_of(path);
    const std::string once = rebuilt(plain, first.text());
    CHECK(difference(skeleton_of(plain), built) < 1e-9);
    CHECK((rebuilt(plain, first.text()) == once));
    rebuilt(path, first.text());
    CHECK(difference(skeleton_of(path), built) < 1e-9);

    // A second file: what it does not mention stays, and it is idempotent too.
    const std::string both = rebuilt(plain, second.text());
    CHECK((rebuilt(plain, second.text()) == both));
    CHECK((rebuilt(plain, "guides: " + rig.skeleton.name + "\n") == both));

    // What a rig was moved to comes back out of it, and builds it again.
    pipeline::BuildRequest again = request;
    const std::string taken = write_guides(request, {}, plain);
    const gltf::Rig copy = build(again, saved("taken.yaml", taken), path);
    CHECK(difference(copy.skeleton, skeleton_of(plain)) < 1e-4);
    rebuilt(plain, taken);
    CHECK(difference(copy.skeleton, skeleton_of(plain)) < 1e-4);

    CHECK((rebuilt(plain, first.back(second)) == without));
  }
}

TEST_CASE("pipeline guides: what a file does not mention stays, and what it sets back is said") {
  const std::string path = test::test_out("said.glb");
  build(biped(), saved("said.yaml", raised_elbows(write_guides(biped()))), path);
  const auto run = [&](const std::string& text) {
    pipeline::RebuildRequest request;
    request.guides = saved("said.yaml", "guides: biped\n" + text);
    return test::rebuild(path, request).rigs.front();
  };
  const auto shapes = [&] {
    const gltf::Rig rig = test::read_shot(path).rigs.front();
    return shape_of(hand_control(rig, "arm_l")) + " " + shape_of(hand_control(rig, "arm_r"));
  };
  using Names = std::vector<std::string>;
  // A file without `controls:` is no reason to lose them, nor one without `joints:`.
  CHECK(run("joints:\n  arm_l.elbow: {at: [0.455, 1.42, -0.04], fitted: [0.455, 1.42, -0.04]}\n")
            .put_back == Names{"arm_l.elbow"});
  CHECK(shapes() == "sphere sphere");
  CHECK(run("controls:\n  arm_l.wrist/ik_fk_limb#limb.ik: {}\n").put_back ==
        Names{"arm_l.wrist/ik_fk_limb#limb.ik"});
  CHECK(shapes() == "cube sphere");
  const pipeline::RigReport last =
      run("mirror: both\njoints:\n  arm_l.elbow: {fitted: [0.455, 1.42, -0.04]}\n"
          "controls:\n  arm_l.wrist/ik_fk_limb#limb.ik: {}\n");
  CHECK(last.put_back == Names{"arm_r.elbow", "arm_r.wrist/ik_fk_limb#limb.ik"});
  CHECK(as_text(last, false).find("2 edits set back by the guides: arm_r.elbow") !=
        std::string::npos);
  CHECK(shapes() == "cube cube");
}

TEST_CASE("pipeline guides: a biped built with the guides that it gave has the same bytes") {
  const std::string guides = saved("same.yaml", write_guides(biped()));
  build(biped(), "", test::test_out("without.glb"));
  build(biped(), guides, test::test_out("with.glb"));
  CHECK(test::bytes_of(test::test_out("without.glb")) ==
        test::bytes_of(test::test_out("with.glb")));
}

TEST_CASE("pipeline guides: moved elbows and an edited control are in the rig, skin and all") {
  const std::string guides = saved("elbow.yaml", raised_elbows(write_guides(biped())));
  const gltf::Rig plain = build(biped(), "", test::test_out("plain.glb"));
  const std::string out = test::test_out("elbow.glb");
  const gltf::Rig rig = build(biped(), guides, out);
  for (const char* arm : {"arm_l", "arm_r"}) {
    const Vec3 way = place_of(rig.skeleton, arm, "elbow") - place_of(plain.skeleton, arm, "elbow");
    CHECK(length(way - Vec3{0, 0.03, 0}) < 1e-12);
    CHECK(length(place_of(rig.skeleton, arm, "wrist") - place_of(plain.skeleton, arm, "wrist")) <
          1e-12);
    CHECK(shape_of(hand_control(plain, arm)) == "cube");
    CHECK(shape_of(hand_control(rig, arm)) == "sphere");
  }
  // The proxy meshes are bound to the joints where they are now.
  const test::Shot shot = test::read_shot(out);
  const auto binds = binds_of(out);
  std::size_t compared = 0;
  const gltf::Rig& read = shot.rigs.front();
  for (const scene::NodeId id : read.scene.nodes()) {
    const auto bind = binds.find(read.nodes[id.index]);
    if (bind == binds.end()) continue;
    CHECK(length(bind->second - read.scene.rest_world(id).origin) < 1e-5);
    ++compared;
  }
  CHECK(compared > 20);
}

TEST_CASE("pipeline guides: a file that is written again keeps what was edited") {
  const std::string text = raised_elbows(write_guides(biped()));
  const std::string guides = saved("again.yaml", text);
  const std::string again = write_guides(biped(), guides);
  CHECK(again.find(kRaised) != std::string::npos);
  CHECK(again.find("mirror: left_to_right\n") != std::string::npos);
  CHECK(
      again.find("\n  arm_l.wrist/ik_fk_limb#limb.ik: {shape: sphere, size: 1.5, color: green}") !=
      std::string::npos);
  CHECK(write_guides(biped(), saved("again.yaml", again)) == again);
}

TEST_CASE("pipeline guides: what a rig was built with comes back out of it") {
  const std::string first = saved("first.yaml", raised_elbows(write_guides(biped())));
  const std::string rig = test::test_out("first.glb"), again = test::test_out("second.glb");
  build(biped(), first, rig);
  const std::string text = write_guides(biped(), "", rig);
  CHECK(text.find(kRaised) != std::string::npos);
  CHECK(text.find("arm_r.wrist/ik_fk_limb#limb.ik: {shape: sphere, size: 1.5, color: green}") !=
        std::string::npos);
  const gltf::Rig built = build(biped(), saved("second.yaml", text), again);
  const gltf::Rig was = test::read_shot(rig).rigs.front();
  for (std::size_t i = 0; i < was.skeleton.joints.size(); ++i)
    CHECK(length(built.skeleton.world(i).origin - was.skeleton.world(i).origin) < 1e-5);
  Diagnostics diagnostics;
  pipeline::GuidesRequest other{biped(), "", rig};
  other.build.template_file = test::templates_folder() + "/quadruped.yaml";
  CHECK_FALSE(pipeline::write_guides(other, diagnostics));
  CHECK(diagnostics.errors() == 1);
}

TEST_CASE("pipeline guides: rebuild and update keep keys and edits") {
  test::Story story("guides_rebuild");
  test::write_biped(story.folder, 1);
  story.build("biped.yaml", 31, {2, 0.5, 0.3, 4, 0});
  const test::Shot before = test::read_shot(story.shot);
  const std::string text = raised_elbows(write_guides(biped()));
  pipeline::RebuildRequest request;
  request.guides = saved("rebuild.yaml", text);
  test::rebuild(story.shot, request);
  const test::Shot after = test::read_shot(story.shot);
  // Keys of FK controls whose axes turned are other numbers for the same motion in their space.
  CHECK(after.rigs.front().orphans.empty());
  CHECK(test::keys_of(after).size() == test::keys_of(before).size());
  const auto& was = before.rigs.front().skeleton;
  const auto elbow = [&](const test::Shot& shot) {
    return place_of(shot.rigs.front().skeleton, "arm_l", "elbow") - place_of(was, "arm_l", "elbow");
  };
  CHECK(length(elbow(after) - Vec3{0, 0.03, 0}) < 1e-12);
  CHECK(shape_of(hand_control(after.rigs.front(), "arm_r")) == "sphere");

  // Again with the same guides: nothing moves. Without guides: what was edited stays.
  const std::string bytes = test::bytes_of(story.shot);
  test::rebuild(story.shot, request);
  CHECK((test::bytes_of(story.shot) == bytes));
  test::rebuild(story.shot);
  CHECK((test::bytes_of(story.shot) == bytes));

  // A new version of the template too.
  test::write_biped(story.folder, 2);
  story.update();
  const test::Shot updated = test::read_shot(story.shot);
  CHECK(length(elbow(updated) - Vec3{0, 0.03, 0}) < 1e-9);
  CHECK(shape_of(hand_control(updated.rigs.front(), "arm_l")) == "sphere");

  // The elbow is put back: guides of a rig say where joints were fitted.
  request.guides = saved("back.yaml", edited(text, kRaised, kElbow));
  test::rebuild(story.shot, request);
  CHECK(length(elbow(test::read_shot(story.shot))) < 1e-5);
}

TEST_CASE("pipeline guides: joints of a model stay, those that rigc makes can be moved") {
  for (const char* name :
       {"mixamo_Xbot_blender/Xbot.glb", "rpm_avatar_a/646d9dcdc8a5f5bddbfac913.glb"}) {
    const std::string model = test::corpus_file(name);
    if (model.empty()) return;
    CAPTURE(name);
    const std::string text = write_guides(biped(model));
    const std::string plain = test::test_out("model_plain.glb"), out = test::test_out("model.glb");
    build(biped(model), "", plain);
    build(biped(model), saved("model.yaml", text), out);
    CHECK((test::bytes_of(plain) == test::bytes_of(out)));

    // The model's own joint.
    Diagnostics diagnostics;
    pipeline::BuildRequest request = biped(model);
    request.guides = saved("bone.yaml", "guides: biped\njoints:\n  arm_l.elbow: [0.4, 1.4, 0]\n");
    CHECK_FALSE(pipeline::build(request, test::test_out("bone.glb"), diagnostics));
    REQUIRE(diagnostics.all().size() == 1);
    CHECK(diagnostics.all()[0].code == &templates::codes::kGuideOfModel);
    CHECK_FALSE(file_exists(test::test_out("bone.glb")));

    // The root, which rigc made: 10 cm forward; every node and byte of the model is as it was.
    const std::size_t at = text.find("root.root:");
    const std::size_t begin = text.find("{at: ", at), end = text.find('\n', at);
    std::string moved = text;
    moved.replace(begin, end - begin, "[0, 0, 0.1]");
    const gltf::Rig rig = build(biped(model), saved("root.yaml", moved), out);
    const Vec3 root = place_of(rig.skeleton, "root", "root");
    CHECK(length(templates::to_template(rig.skeleton.character, root) - Vec3{0, 0, 0.1}) < 1e-9);
    const auto a = test::load_glb(plain).json, b = test::load_glb(out).json;
    const auto model_nodes = test::load_glb(model).json["nodes"].size();
    for (std::size_t i = 0; i < model_nodes; ++i) CHECK(a["nodes"][i] == b["nodes"][i]);
    CHECK(a["skins"] == b["skins"]);
  }
}

}  // namespace rigc
