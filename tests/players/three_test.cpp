// SPDX-License-Identifier: MIT
// Baked files in three.js: every joint and vertex is where rigc's own evaluation has it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/files.h"
#include "pipeline/wiggle_helpers.h"
#include "players/puppet_helpers.h"
#include "support/corpus.h"

namespace rigc {
namespace {

using nlohmann::json;
using test::Puppet;
using test::ShownPrimitive;
using test::Wiggle;

constexpr double kAllowed = 1e-5;  // of the character's height

math::Affine affine_from(const json& m) {
  const auto column = [&](std::size_t i) {
    return math::Vec3{m[4 * i].get<double>(), m[4 * i + 1].get<double>(),
                      m[4 * i + 2].get<double>()};
  };
  return {{column(0), column(1), column(2)}, column(3)};
}

/// What tools/node/play_three.mjs prints; null (with a message) where three.js is not installed.
json played_by_three(const std::string& path, const std::string& clip,
                     const std::vector<double>& seconds) {
  const std::string tools = std::string(RIGC_SOURCE_DIR) + "/tools/node";
  const bool there = file_exists(tools + "/node_modules/three/package.json") &&
                     std::system("command -v node >/dev/null 2>&1") == 0;
  if (!there) {
    MESSAGE("no node or no three.js (tools/setup test): not compared");
    return {};
  }
  std::ostringstream command;
  command.precision(17);
  command << "node '" << tools << "/play_three.mjs' '" << path << "' '" << clip << "'";
  for (const double time : seconds) command << " " << time;
  const std::string out = path + ".three.json";
  command << " >'" << out << "'";
  REQUIRE(std::system(command.str().c_str()) == 0);
  std::ifstream stream(out);
  json document = json::parse(stream);
  std::remove(out.c_str());
  return document;
}

/// Farthest that a player's vertices are off.
double vertex_error(const Puppet& puppet, const json& state,
                    const std::vector<math::Affine>& worlds, double seconds) {
  double largest = 0;
  CHECK(state["vertices"].size() == puppet.primitives().size());
  for (const json& shown : state["vertices"]) {
    const auto primitive = std::find_if(
        puppet.primitives().begin(), puppet.primitives().end(), [&](const ShownPrimitive& one) {
          return one.node == shown["node"] && one.primitive == shown["primitive"];
        });
    REQUIRE(primitive != puppet.primitives().end());
    const std::vector<math::Vec3> wanted = puppet.vertices(*primitive, worlds, seconds);
    const std::size_t step = std::max<std::size_t>(1, (wanted.size() + 199) / 200);
    const auto numbers = shown["at"].get<std::vector<double>>();
    REQUIRE(numbers.size() == 3 * ((wanted.size() + step - 1) / step));
    for (std::size_t i = 0; 3 * i < numbers.size(); ++i) {
      const math::Vec3 there{numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
      largest = std::max(largest, math::length(there - wanted[i * step]));
    }
  }
  return largest;
}

/// `model` below the corpus; empty: the biped alone with its proxies.
void compare(const std::string& model, const std::string& map, const std::string& name,
             bool has_morphs = false) {
  CAPTURE(name);
  const Wiggle wiggle = test::wiggle(test::rig_model(model, map, name), name, 11);
  const std::string baked = test::test_out(name + "_baked.glb");
  test::bake_wiggle(wiggle, baked);
  // Every third frame, and times off the frames.
  std::vector<double> seconds = test::times_at(10);
  const std::size_t frames = seconds.size();
  for (int i = 0; i < 10; ++i) seconds.push_back(0.037 + 0.093 * i);
  const json shown = played_by_three(baked, wiggle.name, seconds);
  if (shown.is_null()) return;

  const Puppet puppet(baked, wiggle.name);
  CHECK((puppet.moving_weights() > 0) == has_morphs);
  const auto worlds = puppet.worlds(seconds);
  const double height = wiggle.rigged.height, limb = 0.1 * height;
  double rig = 0, joints = 0, vertices = 0;
  for (std::size_t t = 0; t < seconds.size(); ++t) {
    const json& state = shown["times"][t];
    for (const auto& [node, matrix] : state["nodes"].items())
      joints =
          std::max(joints, test::apart(affine_from(matrix), worlds[t][std::stoul(node)], limb));
    vertices = std::max(vertices, vertex_error(puppet, state, worlds[t], seconds[t]));
  }
  const auto driven = test::evaluate_joints(wiggle, seconds, test::spaces_of(wiggle, worlds));
  for (const test::DrivenJoint& joint : driven)
    for (std::size_t t = 0; t < frames; ++t)
      rig = std::max(
          rig, test::apart(affine_from(shown["times"][t]["nodes"][std::to_string(joint.node)]),
                           joint.worlds[t], limb));
  MESSAGE(name, ": joints against the rig ", rig / height, ", against the clip ", joints / height,
          ", vertices ", vertices / height, " of the height");
  CHECK(driven.size() >= 10);
  CHECK_FALSE(puppet.primitives().empty());
  CHECK(rig < kAllowed * height);
  CHECK(joints < kAllowed * height);
  CHECK(vertices < kAllowed * height);
}

}  // namespace

TEST_CASE("players three: the biped with its proxies") { compare("", "", "three_biped"); }

TEST_CASE("players three: characters of the corpus, skinned and morphed") {
  for (const test::Humanoid& humanoid : test::humanoids()) {
    const std::string model = test::corpus_file(humanoid.file);
    if (model.empty()) continue;
    const std::string folder = humanoid.file.substr(0, humanoid.file.find('/'));
    const bool has_morphs = folder == "gltftransform_RobotExpressive_quant";
    compare(model, test::user_map(humanoid), "three_" + folder, has_morphs);
  }
}

}  // namespace rigc
