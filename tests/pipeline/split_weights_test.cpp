// SPDX-License-Identifier: MIT
// A character whose skin shares its weights with twist joints: an arm that does not wring, and a
// file that gives the model back.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "base/files.h"
#include "eval/evaluate.h"
#include "gltf/accessor.h"
#include "gltf/slim.h"
#include "pipeline/bake_file.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "pipeline/door_helpers.h"
#include "pipeline/named_edits_helpers.h"

namespace rigc {
namespace {

using math::Affine;
using math::Vec3;
using scene::NodeId;

constexpr int kMovesNothing = 910;

std::string folder(const std::string& name) {
  const std::string out = test::test_out("split_" + name);
  const std::string before = "      - feature: fk\n        switch: arms\n        commands:\n";
  const std::string twist =
      "      - command: twist_joints\n        id: upper_twist\n"
      "        with: {start: arm.shoulder, end: arm.elbow, mode: counter_roll, count: 4}\n"
      "      - command: twist_joints\n        id: lower_twist\n"
      "        with: {start: arm.elbow, end: arm.wrist, count: 4}\n";
  test::write_biped(out, 1, {{"parts/arm.yaml", before, twist + before}});
  return out;
}

struct Twisted {
  std::string model, path;
  gltf::Rig rig;
  std::vector<int> warnings;
};

constexpr const char* kXbot = "mixamo_Xbot_blender/Xbot.glb";
/// Characters with soft flesh; Xbot is of hard pieces, each bound to one joint.
constexpr const char* kSoft[] = {"gdquest_mannequiny/mannequiny-0.3.0.glb",
                                 "rpm_avatar_a/646d9dcdc8a5f5bddbfac913.glb"};

/// A character of the corpus with twist joints; nothing where there is no corpus.
std::optional<Twisted> character(const std::string& file, const std::string& name,
                                 bool split_weights) {
  Twisted out;
  out.model = test::corpus_file(file);
  if (out.model.empty()) return std::nullopt;
  const std::string templates = folder(name + "_" + stem_of(out.model));
  pipeline::BuildRequest request;
  request.template_file = templates + "/biped.yaml";
  request.paths.templates = {templates};
  request.model = out.model;
  request.split_weights = split_weights;
  out.path = templates + "/rig.glb";
  Diagnostics diagnostics;
  auto built = pipeline::build(request, out.path, diagnostics);
  test::made_from(out.path, out.model);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  out.rig = std::move(built->rig);
  for (const Diagnostic& said : diagnostics.all()) out.warnings.push_back(said.code->number);
  return out;
}

/// The same with the biped that comes with rigc and these features.
std::optional<Twisted> featured(const std::string& file, const std::string& name,
                                const std::vector<std::string>& features) {
  Twisted out;
  out.model = test::corpus_file(file);
  if (out.model.empty()) return std::nullopt;
  pipeline::BuildRequest request;
  request.template_file = test::templates_folder() + "/biped.yaml";
  request.paths.templates = {test::templates_folder()};
  request.model = out.model;
  request.features = features;
  request.split_weights = true;
  out.path = test::test_out("split_" + name + "_" + stem_of(out.model) + ".glb");
  Diagnostics diagnostics;
  auto built = pipeline::build(request, out.path, diagnostics);
  test::made_from(out.path, out.model);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  out.rig = std::move(built->rig);
  return out;
}

gltf::File opened(const std::string& path) {
  Diagnostics diagnostics;
  auto file = gltf::open(path, diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  return *std::move(file);
}

NodeId joint(const gltf::Rig& rig, const std::string& label) {
  for (const NodeId id : rig.scene.nodes())
    if (rig.scene[id].is_skeleton() && rig.scene[id].ids.local == "arm_l" &&
        rig.scene[id].ids.label == label)
      return id;
  FAIL("no joint " << label);
  return {};
}

/// A skin's vertices, deformed.
struct Skinned {
  std::vector<Vec3> rest, posed;         ///< rig space
  std::vector<std::vector<int>> joints;  ///< nodes of those that bend it
};

/// All vertices of the file's first skin, as `rig` stands with `settings`.
Skinned skinned(const gltf::File& file, const gltf::Rig& rig,
                const std::vector<eval::Setting>& settings) {
  Diagnostics diagnostics;
  const auto slim = gltf::read_slim(file, diagnostics);
  REQUIRE(slim);
  const auto read = [&](const json::Value& accessor) {
    const auto index = static_cast<int>(accessor.integer().value_or(-1));
    REQUIRE(index >= 0);
    const auto out = gltf::read_floats(
        file, *slim, index, slim->accessors[static_cast<std::size_t>(index)].count, diagnostics);
    REQUIRE(out);
    return *out;
  };
  const json::Value skin = file.root()["skins"].items()[0];
  const std::vector<float> matrices = read(skin["inverseBindMatrices"]);
  std::vector<int> nodes;
  std::vector<NodeId> joints;
  for (const json::Value& item : skin["joints"].items()) {
    nodes.push_back(static_cast<int>(*item.integer()));
    const auto at = std::find(rig.nodes.begin(), rig.nodes.end(), nodes.back());
    REQUIRE(at != rig.nodes.end());
    joints.push_back({static_cast<std::uint32_t>(at - rig.nodes.begin())});
  }
  std::vector<Affine> now = eval::worlds(rig.scene, joints, settings);
  std::vector<Affine> rest = eval::worlds(rig.scene, joints);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const float* m = matrices.data() + 16 * i;
    const Affine inverse_bind{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}},
                              {m[12], m[13], m[14]}};
    now[i] = now[i] * inverse_bind;
    rest[i] = rest[i] * inverse_bind;
  }
  Skinned out;
  for (const json::Value& mesh : file.root()["meshes"].items())
    for (const json::Value& primitive : mesh["primitives"].items()) {
      const json::Value attributes = primitive["attributes"];
      if (!attributes["JOINTS_0"]) continue;
      const auto positions = read(attributes["POSITION"]);
      const std::size_t first = out.rest.size();
      out.rest.resize(first + positions.size() / 3);
      out.posed.resize(out.rest.size());
      out.joints.resize(out.rest.size());
      for (const std::string set : {"0", "1"}) {
        if (!attributes["JOINTS_" + set]) continue;
        const auto bound = read(attributes["JOINTS_" + set]);
        const auto weights = read(attributes["WEIGHTS_" + set]);
        for (std::size_t i = 0; i < bound.size(); ++i) {
          const double weight = weights[i];
          if (weight == 0) continue;
          const std::size_t v = i / 4, b = static_cast<std::size_t>(bound[i]);
          const Vec3 p{positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]};
          out.rest[first + v] = out.rest[first + v] + rest[b] * p * weight;
          out.posed[first + v] = out.posed[first + v] + now[b] * p * weight;
          out.joints[first + v].push_back(nodes[b]);
        }
      }
    }
  return out;
}

/// Turns a control of the left arm about the bone below `from`, the arm in FK.
std::vector<eval::Setting> turned(const gltf::Rig& rig, const std::string& from,
                                  const std::string& to, const std::string& turns, double degrees) {
  const NodeId control = test::control(rig, "arm_l", turns, "fk");
  const NodeId settings = test::control(rig, "arm_l", "wrist", "settings");
  const Vec3 axis = math::normalised(rig.scene.rest_world(joint(rig, to)).origin -
                                     rig.scene.rest_world(joint(rig, from)).origin);
  const Vec3 own = math::transposed(math::orthonormal(rig.scene.rest_world(control).linear)) * axis;
  const auto ik_fk = rig.scene.find_plug(settings, "ik_fk");
  REQUIRE(ik_fk);
  return {{*ik_fk, 0.0},
          {{control, scene::transform::kRotation}, math::axis_angle(own, math::radians(degrees))}};
}

/// How thin a bone's flesh becomes: the least ratio of a vertex's distance from the bone to what it
/// is at rest, among vertices of the model that the joint `of` bends, away from the other end.
double least_radius(const Twisted& built, const std::string& from, const std::string& to,
                    const std::string& turns, double degrees) {
  const gltf::File model = opened(built.model), file = opened(built.path);
  const auto settings = turned(built.rig, from, to, turns, degrees);
  const Skinned posed = skinned(file, built.rig, settings);
  const Skinned plain = skinned(model, built.rig, {});
  REQUIRE(posed.rest.size() == plain.rest.size());
  const NodeId bone = joint(built.rig, from);
  const std::vector<NodeId> ends{bone, joint(built.rig, to)};
  const std::vector<Affine> now = eval::worlds(built.rig.scene, ends, settings);
  const Vec3 begin = now[0].origin, axis = math::normalised(now[1].origin - begin);
  const double length = math::length(now[1].origin - begin);
  double least = 10;
  std::size_t count = 0;
  for (std::size_t v = 0; v < plain.rest.size(); ++v) {
    // Nothing moved by being bound anew.
    CHECK(math::length(posed.rest[v] - plain.rest[v]) < 1e-5 * length);
    const auto& joints = plain.joints[v];
    const int node = built.rig.nodes[bone.index];
    if (std::find(joints.begin(), joints.end(), node) == joints.end()) continue;
    const double along = math::dot(plain.rest[v] - begin, axis) / length;
    if (along < (from == "elbow" ? 0.2 : -0.3) || along > (from == "elbow" ? 1.3 : 0.8)) continue;
    const auto radius = [&](Vec3 p) {
      return math::length(p - begin - axis * math::dot(p - begin, axis));
    };
    least = std::min(least, radius(posed.posed[v]) / radius(plain.rest[v]));
    ++count;
  }
  CHECK(count > 100);
  return least;
}

std::string bytes(const std::string& path) { return test::bytes_of(path); }

}  // namespace

TEST_CASE("split_weights: a wrist turned by 150 degrees does not wring the forearm") {
  for (const char* file : kSoft) {
    CAPTURE(file);
    const auto plain = character(file, "plain", false), split = character(file, "forearm", true);
    if (!plain) return;
    CHECK(plain->warnings == std::vector<int>{kMovesNothing});
    CHECK(split->warnings.empty());
    for (const double degrees : {150.0, -150.0}) {
      CHECK(least_radius(*plain, "elbow", "wrist", "wrist", degrees) < 0.4);
      CHECK(least_radius(*split, "elbow", "wrist", "wrist", degrees) > 0.9);
    }
  }
}

TEST_CASE("split_weights: an upper arm turned by 120 degrees does not wring the shoulder") {
  for (const char* file : kSoft) {
    CAPTURE(file);
    const auto plain = character(file, "plain_up", false), split = character(file, "up", true);
    if (!plain) return;
    CHECK(least_radius(*plain, "shoulder", "elbow", "shoulder", 120) < 0.51);
    CHECK(least_radius(*split, "shoulder", "elbow", "shoulder", 120) > 0.85);
  }
}

TEST_CASE("split_weights: building again changes no byte, and the model comes back") {
  for (const char* file : {kXbot, kSoft[0], kSoft[1]}) {
    CAPTURE(file);
    const auto built = character(file, "rounds", true);
    if (!built) return;
    const std::string before = bytes(built->path);
    test::rebuild(built->path);
    CHECK(bytes(built->path) == before);
    pipeline::RebuildRequest apart;
    apart.unbuild = true;
    test::rebuild(built->path, apart);
    CHECK(opened(built->path).root()["skins"].items()[0]["joints"].size() ==
          opened(built->model).root()["skins"].items()[0]["joints"].size());
    test::rebuild(built->path);
    CHECK(bytes(built->path) == before);
    Diagnostics diagnostics;
    REQUIRE(pipeline::strip({}, {built->path, built->path, ""}, diagnostics));
    CHECK(bytes(built->path) == bytes(built->model));
  }
}

TEST_CASE("split_weights: baked, twist joints are joints of the character like others") {
  const auto built = character(kSoft[0], "baked", true);
  if (!built) return;
  const NodeId control = test::control(built->rig, "arm_l", "wrist", "fk");
  const int node = built->rig.nodes[control.index];
  const auto settings = turned(built->rig, "elbow", "wrist", "wrist", 120);
  const auto turn = std::get<math::Quat>(settings[1].value);
  std::vector<float> values;
  for (int i = 0; i <= 10; ++i) {
    const math::Quat q = math::slerp({}, turn, 0.1 * i);
    for (const double x : {q.x, q.y, q.z, q.w}) values.push_back(static_cast<float>(x));
  }
  const std::string path =
      test::with_clip(built->path, {test::keys(node, anim::Path::rotation, 4, values)});
  pipeline::BakeRequest request;
  request.file = path;
  const std::string out = test::fresh_folder("split_baked") + "/plain.glb";
  Diagnostics diagnostics;
  REQUIRE_MESSAGE(pipeline::bake_file(request, out, diagnostics), render(diagnostics, false));
  test::made_from(out, built->model);
  test::made_from(path, built->model);
  const gltf::File file = opened(out);
  CHECK(!file.root()["extensions"]["RIGC_rig"]);
  const auto joints = file.root()["skins"].items()[0]["joints"].items();
  CHECK(joints.size() == opened(built->path).root()["skins"].items()[0]["joints"].size());

  const NodeId elbow = joint(built->rig, "elbow");
  const auto worlds = test::play(out, "test", 1.0);
  std::size_t twisted = 0;
  for (const NodeId id : built->rig.scene.nodes()) {
    if (built->rig.scene[id].identity.role != "twist" || built->rig.scene[id].parent != elbow)
      continue;
    const auto rig = eval::worlds(built->rig.scene, {elbow, id}, settings);
    const auto at = [&](NodeId other) {
      return worlds[static_cast<std::size_t>(built->rig.nodes[other.index])];
    };
    const Affine expected = math::inverse(rig[0]) * rig[1], now = math::inverse(at(elbow)) * at(id);
    CHECK(math::length(expected.linear.y - now.linear.y) < 1e-5);
    CHECK(math::length(expected.linear.z - now.linear.z) < 1e-5);
    ++twisted;
  }
  CHECK(twisted == 4);
}

TEST_CASE("split_weights: twist and ribbons together bend and roll as each alone") {
  for (const char* file : kSoft) {
    CAPTURE(file);
    const auto both = featured(file, "both", {"twist=on", "ribbons=on"});
    if (!both) return;
    const auto ribbons = featured(file, "ribbons", {"ribbons=on"});
    for (const double degrees : {170.0, -170.0}) {
      CHECK(least_radius(*both, "elbow", "wrist", "wrist", degrees) > 0.8);
      CHECK(least_radius(*ribbons, "elbow", "wrist", "wrist", degrees) < 0.5);
    }
    CHECK(least_radius(*both, "shoulder", "elbow", "shoulder", 120) > 0.8);
    const auto bowed = [](const Twisted& built) {
      std::vector<eval::Setting> settings;
      for (const NodeId id : built.rig.scene.nodes()) {
        const scene::Node& node = built.rig.scene[id];
        if (node.kind == scene::Kind::control && node.module == "ribbon" &&
            node.identity.counter < 3)
          settings.push_back({{id, scene::transform::kTranslate}, Vec3{0, 0.05, 0.02}});
      }
      return skinned(opened(built.path), built.rig, settings);
    };
    const Skinned one = bowed(*both), other = bowed(*ribbons);
    REQUIRE(one.posed.size() == other.posed.size());
    double most = 0, apart = 0;
    for (std::size_t v = 0; v < one.posed.size(); ++v) {
      most = std::max(most, math::length(one.posed[v] - one.rest[v]));
      apart = std::max(apart, math::length(one.posed[v] - other.posed[v]));
    }
    CHECK(most > 0.04);
    CHECK(apart < 1e-6);

    // Off and on again in either order; and the model comes back.
    for (const char* first : {"twist", "ribbons"}) {
      CAPTURE(first);
      const std::string second = first == std::string("twist") ? "ribbons" : "twist";
      for (const std::string& setting : {std::string(first) + "=off", second + "=off",
                                         first + std::string("=on"), second + "=on"}) {
        pipeline::RebuildRequest request;
        request.features = {setting};
        test::rebuild(both->path, request);
      }
      const gltf::File now = opened(both->path);
      Diagnostics reading;
      const auto reread = gltf::read_rigs(now, reading);
      REQUIRE(reread);
      CHECK(least_radius({both->model, both->path, reread->front(), {}}, "elbow", "wrist", "wrist",
                         170) > 0.8);
    }
    Diagnostics diagnostics;
    REQUIRE(pipeline::strip({}, {both->path, both->path, ""}, diagnostics));
    CHECK(bytes(both->path) == bytes(both->model));
  }
}

}  // namespace rigc
