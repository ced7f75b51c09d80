// SPDX-License-Identifier: MIT
// Feet of the humanoids of the corpus on the ground: whatever rolls, no vertex of a foot sinks.
#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "eval/evaluate.h"
#include "gltf/vertices.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "support/corpus.h"

namespace rigc {
namespace {

using math::Affine;
using math::Vec3;
using scene::NodeId;

/// Of the length of the foot.
constexpr double kSinks = 0.005;

/// A vertex of the left foot: where it is seen from the joints that move it, by weight.
struct Vertex {
  struct Part {
    std::size_t joint;  ///< in Feet::joints
    Vec3 at;
    double weight;
  };
  std::vector<Part> parts;
  double of_foot = 0;  ///< weight of ankle and all below
};

/// The left foot of a character, and its mesh as joints move it.
struct Foot {
  const scene::Scene* scene = nullptr;
  Vec3 up;
  std::vector<NodeId> joints;
  std::vector<Vertex> vertices;
  NodeId ik, lean, body;
  NodeId goal, ankle;  ///< where the ankle goes, and where it is
  double ground = 0, length = 0;

  std::vector<Vec3> places(const std::vector<eval::Setting>& settings) const {
    const auto worlds = eval::worlds(*scene, joints, settings);
    std::vector<Vec3> out;
    for (const Vertex& vertex : vertices) {
      Vec3 sum;
      for (const auto& part : vertex.parts) sum = sum + worlds[part.joint] * part.at * part.weight;
      out.push_back(sum);
    }
    return out;
  }
  /// With the body where the leg is as long as it rests, so that the ankle reaches its goal: a leg
  /// that is short for its foot would not fold as far as some leans need.
  std::vector<eval::Setting> reached(std::vector<eval::Setting> settings) const {
    const Vec3 moved =
        eval::worlds(*scene, {goal}, settings)[0].origin - eval::worlds(*scene, {goal})[0].origin;
    const Affine axes{scene->rest_world(body).linear, {}};
    settings.push_back({{body, scene::transform::kTranslate}, math::inverse(axes) * moved});
    const auto places = eval::worlds(*scene, {goal, ankle}, settings);
    CHECK(math::length(places[0].origin - places[1].origin) < 1e-4 * length);
    return settings;
  }
  /// How far vertices are in the ground, of the foot's length.
  double sunk(const std::vector<eval::Setting>& settings) const {
    return (ground - lowest(reached(settings))) / length;
  }
  double lowest(const std::vector<eval::Setting>& settings) const {
    double low = 1e300;
    for (const Vec3& at : places(settings)) low = std::min(low, math::dot(at, up));
    return low;
  }
};

NodeId find(const gltf::Rig& rig, const std::string& module, const std::string& role,
            scene::Kind kind = scene::Kind::control) {
  for (const NodeId id : rig.scene.nodes()) {
    const scene::Node& node = rig.scene[id];
    if (node.module == module && node.identity.role == role && node.kind == kind &&
        node.ids.local == "leg_l")
      return id;
  }
  return {};
}

/// The control that moves the whole body, and the left ankle.
void find_ends(const gltf::Rig& rig, Foot& foot) {
  for (const NodeId id : rig.scene.nodes()) {
    const scene::Node& node = rig.scene[id];
    if (node.kind == scene::Kind::control && node.identity.command == "body") foot.body = id;
    if (node.is_skeleton() && node.ids.local == "leg_l" && node.ids.label == "ankle")
      foot.ankle = id;
  }
}

/// By node of the model the tagged joint that it is or hangs under, -1: none.
std::vector<int> riding_on(const gltf::Rig& rig, const nlohmann::ordered_json& json) {
  const std::vector<int> parents = test::parents_of(json);
  std::map<int, int> tagged;
  for (std::size_t i = 0; i < rig.skeleton.joints.size(); ++i)
    tagged[rig.skeleton.joints[i].foreign_node] = static_cast<int>(i);
  std::vector<int> out;
  for (std::size_t node = 0; node < parents.size(); ++node) {
    int at = static_cast<int>(node);
    while (at >= 0 && tagged.count(at) == 0) at = parents[static_cast<std::size_t>(at)];
    out.push_back(at < 0 ? -1 : tagged[at]);
  }
  return out;
}

Foot foot_of(const gltf::Rig& rig, const std::string& model) {
  Foot foot;
  foot.scene = &rig.scene;
  foot.up = rig.skeleton.character.up;
  foot.ik = find(rig, "ik_fk_limb", "ik");
  foot.lean = find(rig, "vector_foot", "tweak");
  foot.goal = find(rig, "ik_fk_limb", "driver", scene::Kind::transform);
  find_ends(rig, foot);
  std::vector<bool> of_foot;
  for (const tags::TaggedJoint& joint : rig.skeleton.joints) {
    for (const NodeId id : rig.scene.nodes()) {
      const scene::Node& node = rig.scene[id];
      if (node.is_skeleton() && node.identity.owner == joint.key) foot.joints.push_back(id);
    }
    of_foot.push_back(joint.ids.local == "leg_l" &&
                      (joint.ids.label == "ankle" || joint.ids.label == "ball"));
    of_foot.back() = of_foot.back() || joint.ids.local == "leg_l_tip";
  }
  REQUIRE(foot.joints.size() == rig.skeleton.joints.size());
  const auto rides = riding_on(rig, test::load_character(model).json);
  Diagnostics diagnostics;
  const auto file = gltf::open(model, diagnostics);
  for (const gltf::SkinnedVertices& skinned : gltf::read_vertices(*file)) {
    for (std::size_t v = 0; v < skinned.places.size(); ++v) {
      Vertex vertex;
      for (std::size_t i = v * skinned.slots; i < (v + 1) * skinned.slots; ++i) {
        const double weight = static_cast<double>(skinned.weights[i]);
        const auto used = static_cast<std::size_t>(skinned.used[i]);
        const int joint = rides[static_cast<std::size_t>(skinned.joints[used])];
        if (weight <= 0 || joint < 0) continue;
        const auto at = static_cast<std::size_t>(joint);
        // What hangs on a joint moves as if it were the joint's.
        const auto own = std::find(skinned.joints.begin(), skinned.joints.end(),
                                   rig.skeleton.joints[at].foreign_node);
        if (own == skinned.joints.end()) continue;
        const Affine& bound =
            skinned.inverse[static_cast<std::size_t>(own - skinned.joints.begin())];
        vertex.parts.push_back({at, bound * skinned.places[v], weight});
        if (of_foot[at]) vertex.of_foot += weight;
      }
      if (vertex.of_foot > 0.5) foot.vertices.push_back(std::move(vertex));
    }
  }
  if (foot.vertices.empty()) return foot;
  const Vec3 forward = rig.skeleton.character.forward;
  double low = 1e300, high = -1e300;
  for (const Vec3& at : foot.places({})) {
    low = std::min(low, math::dot(at, forward));
    high = std::max(high, math::dot(at, forward));
  }
  foot.length = high - low;
  foot.ground = foot.lowest({});
  return foot;
}

scene::Plug plug(const Foot& foot, NodeId node, const std::string& attribute) {
  const auto found = foot.scene->find_plug(node, attribute);
  REQUIRE(found);
  return *found;
}

/// Leaned by degrees toward a direction: 0 forward, 90 left.
math::Quat lean(double toward, double degrees) {
  const Vec3 direction{math::sin_degrees(toward), 0, math::cos_degrees(toward)};
  return math::axis_angle(math::cross({0, 1, 0}, direction), math::radians(degrees));
}

}  // namespace

TEST_CASE("pipeline soles: no vertex of a foot sinks into the ground, whatever the foot does") {
  if (test::corpus_file("mixamo_Xbot_blender/Xbot.glb").empty()) return;
  std::size_t feet = 0;
  for (const test::Humanoid& humanoid : test::humanoids()) {
    CAPTURE(humanoid.file);
    pipeline::BuildRequest request;
    request.template_file = test::templates_folder() + "/biped.yaml";
    request.model = test::corpus_file(humanoid.file);
    request.map = test::user_map(humanoid);
    request.features = {"vector_foot=on"};
    request.paths.templates = {test::templates_folder()};
    Diagnostics diagnostics;
    const auto built = pipeline::build(request, test::test_out("soles.glb"), diagnostics);
    INFO(render(diagnostics, false));
    REQUIRE(built);
    test::made_from(test::test_out("soles.glb"), request.model);
    const Foot foot = foot_of(built->rig, request.model);
    if (foot.vertices.empty() || !foot.ik.valid() || !foot.lean.valid()) continue;
    ++feet;
    double rolls = 0, rises = 0, banks = 0, lifts = 0, leans = 0, bends = 0;
    for (int i = -90; i <= 90; i += 5) {
      const double angle = i;
      if (i >= -80)  // beyond, the shin holds back what of the heel's skin is its own
        rolls = std::max(rolls, foot.sunk({{plug(foot, foot.ik, "roll"), angle}}));
      lifts = std::max(lifts, foot.sunk({{plug(foot, foot.ik, "toe_lift"), std::max(angle, 0.0)}}));
      banks = std::max(banks, foot.sunk({{plug(foot, foot.ik, "bank"), angle}}));
      if (std::abs(i) > 60) continue;  // no toes bend as far
      rises = std::max(rises, foot.sunk({{plug(foot, foot.ik, "roll"), angle},
                                         {plug(foot, foot.ik, "roll_break"), 90.0}}));
    }
    for (int toward = 0; toward < 360; toward += 10) {
      for (const double angle : {0.3, 1.0, 5.0, 20.0, 40.0, 60.0, 75.0, 90.0}) {
        const eval::Setting leaned{{foot.lean, scene::transform::kRotation}, lean(toward, angle)};
        leans = std::max(leans, foot.sunk({leaned}));
        if (angle > 60) continue;
        bends = std::max(bends, foot.sunk({leaned, {plug(foot, foot.lean, "ball"), 1.0}}));
      }
    }
    CHECK(banks < kSinks);
    CHECK(lifts < kSinks);
    CHECK(leans < kSinks);
    CHECK(bends < kSinks);
    CHECK(rolls < kSinks);
    CHECK(rises < kSinks);
  }
  CHECK(feet >= 9);
}

}  // namespace rigc
