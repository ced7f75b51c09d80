// SPDX-License-Identifier: MIT
// Fingertip IK on every hand of the corpus: nothing moves at rest, fingertips go where their
// controls go, and fingers fold to the side to which the hand curls them.
#include <doctest/doctest.h>

#include <map>

#include "eval/evaluate.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "support/corpus.h"

namespace rigc {
namespace {

using math::Affine;
using math::Quat;
using math::Vec3;
using scene::NodeId;

gltf::Rig with_fingertips(const std::string& model, const std::string& map,
                          const std::string& name) {
  pipeline::BuildRequest request;
  request.template_file = test::templates_folder() + "/" + name + ".yaml";
  request.paths.templates = {test::templates_folder()};
  request.model = model;
  request.map = map;
  request.features = {"fingertips=on"};
  Diagnostics diagnostics;
  const std::string out = test::test_out("fingertips.glb");
  const auto built = pipeline::build(request, out, diagnostics);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  test::made_from(out, model);
  return built->rig;
}

/// A finger with a control at its tip.
struct Finger {
  NodeId ik;
  std::vector<NodeId> joints;  ///< that it moves, base to tip; not those before the knuckle
};

std::vector<Finger> fingers_of(const scene::Scene& scene) {
  std::map<JointKey, NodeId> joints;
  std::map<std::string, std::vector<NodeId>> chains;  // by group
  for (const NodeId id : scene.nodes()) {
    const scene::Node& node = scene[id];
    if (node.is_skeleton()) joints[node.identity.owner] = id;
    if (node.kind == scene::Kind::parent_constraint && node.module == "fk_chain" &&
        node.attributes[scene::constraint::kTargets].size() == 2)
      chains[node.ids.local].push_back(joints[node.identity.owner]);
  }
  std::vector<Finger> fingers;
  for (const NodeId id : scene.nodes()) {
    const scene::Node& node = scene[id];
    if (node.module == "fingertip_ik" && node.kind == scene::Kind::control)
      fingers.push_back({id, chains[node.ids.local]});
  }
  return fingers;
}

/// How a joint is turned against the one before it, about which axis and how far (radians).
Vec3 turn(const scene::Scene& scene, const std::vector<Affine>& worlds, const Finger& finger,
          std::size_t n) {
  const auto seen = [](const Affine& before, const Affine& after) {
    return math::quaternion(math::transposed(math::orthonormal(before.linear)) *
                            math::orthonormal(after.linear));
  };
  const Quat rest =
      seen(scene.rest_world(finger.joints[n - 1]), scene.rest_world(finger.joints[n]));
  Quat by = seen(worlds[n - 1], worlds[n]) * math::conjugate(rest);
  if (by.w < 0) by = {-by.x, -by.y, -by.z, -by.w};
  const Vec3 axis{by.x, by.y, by.z};
  return math::normalised(axis) * (2 * std::atan2(math::length(axis), by.w));
}

/// All attributes of controls that have one of these names.
std::vector<eval::Setting> set_all(const scene::Scene& scene, const std::vector<std::string>& names,
                                   double value) {
  std::vector<eval::Setting> settings;
  for (const NodeId id : scene.nodes()) {
    if (scene[id].module != "hand" || scene[id].kind != scene::Kind::control) continue;
    for (const std::string& name : names)
      if (const auto plug = scene.find_plug(id, name)) settings.push_back({*plug, value});
  }
  return settings;
}

/// Draws a fingertip toward the knuckle.
std::vector<eval::Setting> drawn(const scene::Scene& scene, const Finger& finger, double part) {
  const Vec3 tip = scene.rest_world(finger.ik).origin;
  const Vec3 knuckle = scene.rest_world(finger.joints[0]).origin;
  const Affine inward = math::inverse(scene.rest_world(scene[finger.ik].parent));
  const Vec3 by = inward.linear * ((knuckle - tip) * part);
  return {{*scene.find_plug(finger.ik, "ik_fk"), 1.0},
          {{finger.ik, scene::transform::kTranslate}, by}};
}

/// `early`: how far the tip may be off in the beginning, in lengths of the finger.
void check_finger(const scene::Scene& scene, const Finger& finger, double early) {
  REQUIRE(!finger.joints.empty());
  const double length =
      math::length(scene.rest_world(finger.ik).origin - scene.rest_world(finger.joints[0]).origin);
  const auto still = eval::worlds(scene, finger.joints, drawn(scene, finger, 0));
  const auto rest = eval::worlds(scene, finger.joints);
  for (std::size_t i = 0; i < rest.size(); ++i)
    CHECK(math::length(still[i].origin - rest[i].origin) < 1e-9 * length);

  const auto curled =
      eval::worlds(scene, finger.joints, set_all(scene, {"curl", "thumb_curl"}, 0.5));
  for (const double part : {0.02, 0.1, 0.2, 0.3}) {
    CAPTURE(part);
    std::vector<NodeId> nodes = finger.joints;
    nodes.push_back(finger.ik);
    const auto worlds = eval::worlds(scene, nodes, drawn(scene, finger, part));
    const Affine moved =
        worlds[finger.joints.size() - 1] * math::inverse(scene.rest_world(finger.joints.back()));
    const Vec3 tip = moved * scene.rest_world(finger.ik).origin;
    // A bone alone comes no nearer; the flat hand's thumb rests bent backward, and comes through
    // straight.
    const bool free = finger.joints.size() > 1;
    if (free)
      CHECK(math::length(tip - worlds.back().origin) < (part < 0.1 ? early : 1e-6) * length);
    for (std::size_t i = 1; i < finger.joints.size(); ++i) {
      CAPTURE(i);
      const Vec3 folded = turn(scene, worlds, finger, i), curl = turn(scene, curled, finger, i);
      CHECK(math::dot(folded, curl) > 0.9 * math::length(folded) * math::length(curl));
    }
  }
}

TEST_CASE("pipeline fingertips: on every humanoid of the corpus") {
  std::size_t count = 0;
  for (const test::Humanoid& humanoid : test::humanoids()) {
    CAPTURE(humanoid.file);
    const std::string model = test::corpus_file(humanoid.file);
    if (model.empty()) continue;
    const gltf::Rig rig = with_fingertips(model, test::user_map(humanoid), "biped");
    for (const Finger& finger : fingers_of(rig.scene)) {
      CAPTURE(rig.scene[finger.ik].name);
      check_finger(rig.scene, finger, 1e-6);
      ++count;
    }
  }
  MESSAGE(count << " fingers");
}

TEST_CASE("pipeline fingertips: on a hand alone, with metacarpals") {
  const std::string model = test::corpus_file("webxr_generic_hand_left/left.glb");
  if (model.empty()) return;
  const std::string map = std::string(RIGC_SOURCE_DIR) + "/tests/maps/hand.yaml";
  const gltf::Rig rig = with_fingertips(model, map, "hand");
  const auto fingers = fingers_of(rig.scene);
  CHECK(fingers.size() == 5);
  for (const Finger& finger : fingers) {
    CAPTURE(rig.scene[finger.ik].name);
    check_finger(rig.scene, finger, 0.03);
  }
}

}  // namespace
}  // namespace rigc
