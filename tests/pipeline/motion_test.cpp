// SPDX-License-Identifier: MIT
// Keys on the controls of the rigged Xbot bake to joints that do what they should, and the same
// world motion comes out of copies whose bone axes were turned at random, whose ancestors are
// scaled or mirrored, and which face -Z.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "gltf/clips.h"
#include "gltf/rig.h"
#include "pipeline/bake_file.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"

namespace rigc {
namespace {

using math::Affine;
using math::Vec3;
using scene::NodeId;

/// A built rig, and where its space lies in the world.
struct Rigged {
  std::string path;
  std::string model;
  std::unique_ptr<gltf::Rig> rig;
  Affine space;

  const scene::Scene& scene() const { return rig->scene; }
  Affine world(NodeId id) const { return space * scene().rest_world(id); }
  int gltf_node(NodeId id) const { return rig->nodes[id.index]; }

  std::vector<NodeId> controls(const std::string& local, const std::string& role) const {
    std::vector<NodeId> found;
    for (NodeId id : scene().nodes()) {
      const scene::Node& node = scene()[id];
      if (node.kind == scene::Kind::control && node.ids.local == local &&
          node.identity.role == role)
        found.push_back(id);
    }
    REQUIRE_MESSAGE(!found.empty(), "no control in role " << role << " of group " << local);
    return found;
  }
  NodeId joint_of(NodeId control) const {
    for (NodeId id : scene().nodes()) {
      if (scene()[id].is_skeleton() &&
          scene()[id].identity.owner == scene()[control].identity.owner)
        return id;
    }
    return {};
  }
};

Rigged build_on(const std::string& model, const std::string& name) {
  Diagnostics diagnostics;
  pipeline::BuildRequest request;
  request.template_file = test::templates_folder() + "/biped.yaml";
  request.paths.templates = {test::templates_folder()};
  request.model = model;
  Rigged rigged;
  rigged.path = test::test_out(name + "_rig.glb");
  rigged.model = model;
  test::made_from(rigged.path, model);
  const auto built = pipeline::build(request, rigged.path, diagnostics);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  const auto file = gltf::open(rigged.path, diagnostics);
  REQUIRE(file);
  auto rigs = gltf::read_rigs(*file, diagnostics);
  REQUIRE_MESSAGE(rigs, render(diagnostics, false));
  REQUIRE(rigs->size() == 1);
  rigged.rig = std::make_unique<gltf::Rig>(std::move(rigs->front()));
  // The rig's space is what its first top-level node hangs under in the file.
  const test::Character character = test::load_glb(rigged.path);
  const std::vector<int> parents = test::parents_of(character.json);
  for (NodeId id : rigged.scene().nodes()) {
    if (rigged.scene()[id].parent.valid() || rigged.gltf_node(id) < 0) continue;
    for (int at = parents[static_cast<std::size_t>(rigged.gltf_node(id))]; at >= 0;
         at = parents[static_cast<std::size_t>(at)]) {
      rigged.space =
          test::local_of(character.json["nodes"][static_cast<std::size_t>(at)]) * rigged.space;
    }
    break;
  }
  return rigged;
}

anim::Channel keys(int node, anim::Path path, std::vector<float> first,
                   const std::vector<float>& second, const std::string& attribute = {}) {
  anim::Channel channel;
  channel.node = node;
  channel.path = path;
  channel.attribute = attribute;
  channel.curve.width = static_cast<int>(first.size());
  channel.curve.times = std::make_shared<const std::vector<float>>(std::vector<float>{0, 1});
  channel.curve.values = std::move(first);
  channel.curve.values.insert(channel.curve.values.end(), second.begin(), second.end());
  return channel;
}

/// A key that brings a control to a point of the world while what it hangs under rests.
anim::Channel move_to(const Rigged& rigged, NodeId control, Vec3 point) {
  const Affine zero = rigged.world(rigged.scene()[control].parent);
  const Vec3 t = math::inverse(zero) * point;
  return keys(rigged.gltf_node(control), anim::Path::translation, {0, 0, 0},
              {static_cast<float>(t.x), static_cast<float>(t.y), static_cast<float>(t.z)});
}

/// A key that turns a control by a rotation of the world.
anim::Channel turn_by(const Rigged& rigged, NodeId control, math::Quat turn) {
  const math::Mat3 zero = rigged.world(rigged.scene()[control].parent).linear;
  const math::Mat3 local = math::inverse(zero) * (math::matrix(turn) * zero);
  const math::Quat q = math::quaternion(math::orthonormal(local));
  return keys(rigged.gltf_node(control), anim::Path::rotation, {0, 0, 0, 1},
              {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
               static_cast<float>(q.w)});
}

anim::Channel switch_to(const Rigged& rigged, const std::string& group, float ik) {
  const NodeId settings = rigged.controls(group, "settings").front();
  return keys(rigged.gltf_node(settings), anim::Path::attribute, {ik}, {ik}, "ik_fk");
}

/// Writes a clip of keys into a copy of the rig and bakes it. Gives the baked file.
std::string bake_keys(const Rigged& rigged, const std::vector<anim::Channel>& channels,
                      const std::string& name) {
  Diagnostics diagnostics;
  const auto file = gltf::open(rigged.path, diagnostics);
  REQUIRE(file);
  gltf::Patch patch(*file);
  anim::Clip clip{"test", -1, channels};
  gltf::write_clip(patch, *file, clip, {});
  std::uint64_t bytes = 0;
  const std::string keyed = test::test_out(name + "_keyed.glb");
  REQUIRE(pipeline::write_output(patch, *file, keyed, bytes, diagnostics));
  pipeline::BakeRequest request;
  request.file = keyed;
  request.clips = {"test"};
  const std::string baked = test::test_out(name + "_baked.glb");
  const auto done = pipeline::bake_file(request, baked, diagnostics);
  REQUIRE_MESSAGE(done, render(diagnostics, false));
  CHECK_FALSE(done->clips.front().passed_through);
  test::made_from(keyed, rigged.model);
  test::made_from(baked, rigged.model);
  return baked;
}

/// Three joints of a limb by their glTF nodes, start to end.
struct LimbNodes {
  std::size_t start, middle, end;
};

LimbNodes limb_of(const Rigged& rigged, const std::string& group) {
  const auto fk = rigged.controls(group, "fk");
  REQUIRE(fk.size() >= 3);
  const auto node = [&](std::size_t i) {
    return static_cast<std::size_t>(rigged.gltf_node(rigged.joint_of(fk[i])));
  };
  return {node(0), node(1), node(2)};
}

struct LimbRest {
  Vec3 start, end;
  double length;
};

LimbRest rest_of(const Rigged& rigged, const std::string& group) {
  const auto fk = rigged.controls(group, "fk");
  Vec3 p[3];
  for (std::size_t i = 0; i < 3; ++i) p[i] = rigged.world(rigged.joint_of(fk[i])).origin;
  return {p[0], p[2], math::length(p[1] - p[0]) + math::length(p[2] - p[1])};
}

/// Every joint is as far from its parent as it was at rest.
void check_lengths(const Rigged& rigged, const std::vector<Affine>& worlds, double height) {
  double worst = 0;
  for (NodeId id : rigged.scene().nodes()) {
    const scene::Node& node = rigged.scene()[id];
    if (!node.is_skeleton() || !node.parent.valid()) continue;
    const double rest = math::length(rigged.world(id).origin - rigged.world(node.parent).origin);
    const double now =
        math::length(worlds[static_cast<std::size_t>(rigged.gltf_node(id))].origin -
                     worlds[static_cast<std::size_t>(rigged.gltf_node(node.parent))].origin);
    worst = std::max(worst, std::abs(now - rest));
  }
  CHECK(worst <= 2e-6 * height);
}

double height_of(const Rigged& rigged) {
  double low = 1e9, high = -1e9;
  for (NodeId id : rigged.scene().nodes()) {
    if (!rigged.scene()[id].is_skeleton()) continue;
    low = std::min(low, rigged.world(id).origin.y);
    high = std::max(high, rigged.world(id).origin.y);
  }
  return high - low;
}

/// One motion of the whole character, said in world space: `turn` is how the character stands
/// turned.
std::vector<anim::Channel> motion(const Rigged& rigged, const std::function<Vec3(Vec3)>& turn) {
  std::vector<anim::Channel> channels;
  const auto add_ik = [&](const std::string& group, Vec3 direction) {
    const LimbRest limb = rest_of(rigged, group);
    channels.push_back(switch_to(rigged, group, 1));
    channels.push_back(move_to(rigged, rigged.controls(group, "ik").front(),
                               limb.start + turn(direction) * limb.length));
  };
  add_ik("arm_l", {0.45, -0.2, 0.5});
  add_ik("leg_r", {-0.1, -0.75, 0.3});
  channels.push_back(switch_to(rigged, "arm_r", 0));
  const auto swing = rigged.controls("arm_r", "fk");
  channels.push_back(turn_by(rigged, swing[0], math::axis_angle(turn({0, 0, 1}), 0.7)));
  channels.push_back(turn_by(rigged, swing[1], math::axis_angle(turn({0, 1, 0}), 0.9)));
  return channels;
}

}  // namespace

TEST_CASE(
    "pipeline motion: IK reaches what it can, is straight where it cannot, and changes no length") {
  const std::string model = test::corpus_file("mixamo_Xbot_blender/Xbot.glb");
  if (model.empty()) return;
  const Rigged rigged = build_on(model, "motion_ik");
  const double height = height_of(rigged);
  const Vec3 directions[] = {
      {0.5, 0.2, 0.4}, {0.2, -0.7, 0.1}, {0.3, 0.6, -0.2}, {0.05, -0.3, 0.3}};
  for (const std::string group : {"arm_l", "arm_r", "leg_l", "leg_r"}) {
    const LimbRest limb = rest_of(rigged, group);
    const LimbNodes nodes = limb_of(rigged, group);
    const NodeId ik = rigged.controls(group, "ik").front();
    for (const Vec3& direction : directions) {
      const Vec3 reachable = limb.start + direction * limb.length;
      const auto baked = bake_keys(
          rigged, {switch_to(rigged, group, 1), move_to(rigged, ik, reachable)}, "motion_reach");
      const auto worlds = test::play(baked, "test", 1);
      CHECK(math::length(worlds[nodes.end].origin - reachable) <= 1e-5 * limb.length);
      check_lengths(rigged, worlds, height);

      const Vec3 far = limb.start + direction * (3 * limb.length);
      const auto stretched =
          bake_keys(rigged, {switch_to(rigged, group, 1), move_to(rigged, ik, far)}, "motion_far");
      const auto straight = test::play(stretched, "test", 1);
      const Vec3 upper = straight[nodes.middle].origin - straight[nodes.start].origin;
      const Vec3 whole = straight[nodes.end].origin - straight[nodes.start].origin;
      CHECK(math::length(whole) == doctest::Approx(limb.length).epsilon(1e-5));
      CHECK(math::length(math::cross(upper, whole)) <= 1e-5 * limb.length * limb.length);
      check_lengths(rigged, straight, height);
    }
  }
}

TEST_CASE("pipeline motion: FK swings, the switch and root travel") {
  const std::string model = test::corpus_file("mixamo_Xbot_blender/Xbot.glb");
  if (model.empty()) return;
  const Rigged rigged = build_on(model, "motion_fk");
  const double height = height_of(rigged);
  const LimbNodes arm = limb_of(rigged, "arm_l");
  const LimbRest rest = rest_of(rigged, "arm_l");
  const math::Quat turn = math::axis_angle({0, 0, 1}, -0.8);

  const NodeId fk = rigged.controls("arm_l", "fk").front();
  const auto swung = test::play(
      bake_keys(rigged, {switch_to(rigged, "arm_l", 0), turn_by(rigged, fk, turn)}, "motion_swing"),
      "test", 1);
  const Vec3 expected = rest.start + math::rotate(turn, rest.end - rest.start);
  CHECK(math::length(swung[arm.end].origin - expected) <= 1e-5 * rest.length);
  check_lengths(rigged, swung, height);

  // The FK swing does nothing while the switch stands at IK.
  const auto held = test::play(
      bake_keys(rigged, {switch_to(rigged, "arm_l", 1), turn_by(rigged, fk, turn)}, "motion_held"),
      "test", 1);
  CHECK(math::length(held[arm.end].origin - rest.end) <= 1e-5 * rest.length);

  NodeId root;
  for (NodeId id : rigged.scene().nodes()) {
    if (rigged.scene()[id].module == "root" && rigged.scene()[id].identity.role == "world")
      root = id;
  }
  REQUIRE(root.valid());
  const Vec3 travel{0.5, 0.1, 2};
  const auto moved = test::play(
      bake_keys(rigged, {move_to(rigged, root, rigged.world(root).origin + travel)}, "motion_root"),
      "test", 1);
  for (NodeId id : rigged.scene().nodes()) {
    if (!rigged.scene()[id].is_skeleton() ||
        rigged.rig->skeleton.joints[0].key == rigged.scene()[id].identity.owner)
      continue;
    const Vec3 now = moved[static_cast<std::size_t>(rigged.gltf_node(id))].origin;
    CHECK(math::length(now - (rigged.world(id).origin + travel)) <= 1e-5 * height);
  }
}

TEST_CASE(
    "pipeline motion: the same on turned bone axes, scaled and mirrored ancestors, and facing -Z") {
  const std::string model = test::corpus_file("mixamo_Xbot_blender/Xbot.glb");
  if (model.empty()) return;
  const test::Character original = test::load_glb(model);
  const auto names = test::joints_by_name(original.json);
  const auto same = [](Vec3 v) { return v; };
  const auto half_turn = [](Vec3 v) { return Vec3{-v.x, v.y, -v.z}; };

  const Rigged base = build_on(model, "motion_base");
  const double height = height_of(base);
  const auto expected = test::play(bake_keys(base, motion(base, same), "motion_base"), "test", 1);
  check_lengths(base, expected, height);

  struct Copy {
    std::string name;
    test::Character character;
    bool turned = false;
  };
  std::vector<Copy> copies;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    copies.push_back({fmt::format("axes{}", seed), test::with_random_axes(original, seed)});
  }
  copies.push_back({"small", test::under_scaled_ancestor(original, {0.01, 0.01, 0.01})});
  copies.push_back({"large", test::under_scaled_ancestor(original, {100, 100, 100})});
  copies.push_back({"mirror", test::under_scaled_ancestor(original, {-1, 1, 1})});
  copies.push_back({"mirror_axes",
                    test::with_random_axes(test::under_scaled_ancestor(original, {1, 1, -1}), 9)});
  copies.push_back({"back", test::turned(original, 180), true});
  for (const Copy& copy : copies) {
    CAPTURE(copy.name);
    const std::string path = test::test_out("motion_copy_" + copy.name + ".glb");
    test::save_glb(copy.character, path);
    test::made_from(path, path);  // an input: it may have what it has
    const Rigged rigged = build_on(path, "motion_" + copy.name);
    const auto worlds = test::play(
        bake_keys(rigged, motion(rigged, copy.turned ? std::function<Vec3(Vec3)>(half_turn) : same),
                  "motion_" + copy.name),
        "test", 1);
    double worst = 0;
    std::string where;
    for (const auto& [name, node] : names) {
      const Vec3 at = expected[static_cast<std::size_t>(node)].origin;
      const Vec3 wanted = copy.turned ? half_turn(at) : at;
      const double off = math::length(worlds[static_cast<std::size_t>(node)].origin - wanted);
      if (off > worst) where = name;
      worst = std::max(worst, off);
    }
    CAPTURE(where);
    CHECK(worst <= 2e-5 * height);
  }
}

}  // namespace rigc
