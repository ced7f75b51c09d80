// SPDX-License-Identifier: MIT
// Extract: the template that comes out of a rig builds the same rig, and is what comes out of that.
#include "pipeline/extract.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "base/files.h"
#include "base/text.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "pipeline/check.h"
#include "support/random_template.h"
#include "support/rig.h"
#include "tags/dump.h"
#include "tags/settings.h"

namespace rigc {
namespace {

using pipeline::BuildRequest;

/// A scene without the places in templates that its nodes came from.
std::string scene_text(const gltf::Rig& rig) {
  std::stringstream in(rig.scene.dump());
  std::string out;
  for (std::string line; std::getline(in, line);)
    if (!line.starts_with("  origin ")) out += line + "\n";
  return out;
}

/// What a rig is built from, without where it was written.
std::string tags_text(const gltf::Rig& rig) {
  tags::TaggedSkeleton skeleton = rig.skeleton;
  Diagnostics diagnostics;
  REQUIRE(tags::apply(skeleton, rig.settings, diagnostics));
  skeleton.templates.clear();
  skeleton.module_pins.clear();
  skeleton.character = {};  // its height is known only to the last bits
  skeleton.features.clear();
  for (tags::TaggedJoint& joint : skeleton.joints) {
    joint.features.clear();
    joint.guide = {};  // orientations are written as they are
    std::erase_if(joint.commands, [](const tags::CommandTag& tag) { return !tag.on; });
    for (tags::CommandTag& tag : joint.commands) {
      tag.feature = -1;
      tag.with.clear();  // those that are default were left out
    }
  }
  return dump(skeleton);
}

struct Round {
  gltf::Rig first, second;
  std::string yaml, again;
};

std::optional<pipeline::Built> build(const BuildRequest& request, const std::string& out) {
  Diagnostics diagnostics;
  auto built = pipeline::build(request, out, diagnostics);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  return built;
}

std::string extract(const std::string& file, const std::string& name = {},
                    const std::string& rig = {}) {
  Diagnostics diagnostics;
  pipeline::ExtractRequest request;
  request.file = file;
  request.name = name;
  request.rig = rig;
  const auto extracted = pipeline::extract(request, diagnostics);
  REQUIRE_MESSAGE(extracted, render(diagnostics, false));
  CHECK(diagnostics.all().empty());
  return extracted->yaml;
}

std::string write_text(const std::string& path, const std::string& text) {
  Diagnostics diagnostics;
  REQUIRE(write_file(path, {Bytes(text)}, diagnostics));
  return path;
}

/// Builds, extracts, builds that (without any option but the model's), extracts again.
Round round_trip(BuildRequest request, const std::string& name, const std::string& model = {}) {
  request.paths.templates = {test::templates_folder()};
  const std::string first = test::test_out("extract_" + name + ".glb");
  const std::string second = test::test_out("extract_" + name + "_2.glb");
  Round round;
  round.first = build(request, first)->rig;
  round.yaml = extract(first);
  BuildRequest again;
  again.template_file = write_text(test::test_out("extract_" + name + ".yaml"), round.yaml);
  Diagnostics checking;
  CHECK_MESSAGE(pipeline::check(again.template_file, again.paths, checking),
                render(checking, false));
  again.model = model;
  again.map = request.map;
  again.rest = request.rest;
  round.second = build(again, second)->rig;
  round.again = extract(second);
  if (!model.empty()) {
    test::made_from(first, model);
    test::made_from(second, model);
  }
  return round;
}

void check_same(const Round& round) {
  CHECK(scene_text(round.first) == scene_text(round.second));
  CHECK(tags_text(round.first) == tags_text(round.second));
  CHECK(round.yaml == round.again);
}

/// Of a scene all but values: nodes, identities, hierarchy, connections.
std::string structure(const gltf::Rig& rig) {
  std::stringstream in(scene_text(rig));
  std::string out;
  for (std::string line; std::getline(in, line);) {
    const auto is = [&](const char* word) { return line.starts_with(word); };
    if (is("node ") || is("  identity ") || is("  ids ") || is("  command ") || is("  parent ") ||
        is("  children ") || line.find(" <- ") != std::string::npos)
      out += line + "\n";
  }
  return out;
}

/// On a model the template's size is measured anew, which changes the last bits of what it scales.
void check_places_near(const gltf::Rig& a, const gltf::Rig& b) {
  REQUIRE(a.scene.size() == b.scene.size());
  double farthest = 0;
  for (const scene::NodeId id : a.scene.nodes()) {
    if (!scene::spec(a.scene[id].kind).is_transform) continue;
    const math::Affine left = a.scene.rest_world(id), right = b.scene.rest_world(id);
    farthest = std::max(farthest, math::length(left.origin - right.origin));
    for (const auto& [x, y] :
         {std::pair(left.linear.x, right.linear.x), std::pair(left.linear.y, right.linear.y)})
      CHECK(math::length(x - y) < 1e-12);
  }
  CHECK(farthest < 1e-12 * a.skeleton.character.height);
  MESSAGE("nodes differ by up to ", farthest);
}

}  // namespace

TEST_CASE("extract: the templates that come with rigc") {
  for (const char* name : {"biped", "biped_tail", "quadruped", "hand", "winged", "prop"}) {
    CAPTURE(name);
    BuildRequest request;
    request.template_file = name;
    check_same(round_trip(request, name));
  }
}

TEST_CASE("extract: every tutorial") {
  for (const std::string& file : list_folder(test::templates_folder() + "/tutorial")) {
    if (!file.ends_with(".yaml")) continue;
    CAPTURE(file);
    BuildRequest request;
    request.template_file = test::templates_folder() + "/tutorial/" + file;
    check_same(round_trip(request, stem_of(file)));
  }
}

TEST_CASE("extract: what was turned on and off stays so without options") {
  BuildRequest request;
  request.template_file = "biped";
  request.features = {"ikfk:arms=off", "fk:arms=on", "arm_l/fk=off", "eyes=off"};
  request.groups = {"leg_r=off"};
  request.global = "hero";
  const Round round = round_trip(request, "settings");
  check_same(round);
  CHECK(round.yaml.find("global: hero\n") != std::string::npos);
  CHECK(round.yaml.find("eyes: {kind: face, title: Eye controls, default: off}") !=
        std::string::npos);
  CHECK(round.second.settings.features.empty());
}

TEST_CASE("extract: random templates") {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    BuildRequest request;
    request.template_file =
        write_text(test::test_out("extract_random_in.yaml"), test::random_template(seed));
    check_same(round_trip(request, "random"));
  }
}

TEST_CASE("extract: a rig on a model comes back on the model, and alone with its proportions") {
  const std::string model = test::corpus_file("mixamo_Xbot_blender/Xbot.glb");
  if (model.empty()) return;
  BuildRequest request;
  request.template_file = "biped";
  request.model = model;
  const Round round = round_trip(request, "xbot", model);
  check_places_near(round.first, round.second);
  CHECK(structure(round.first) == structure(round.second));
  CHECK(round.first.settings.features.size() == 1);  // without a proxy mesh
  CHECK(round.second.settings.features.size() == 1);

  BuildRequest alone;
  alone.template_file = test::test_out("extract_xbot.yaml");
  const auto built = build(alone, test::test_out("extract_xbot_alone.glb"));
  for (const tags::TaggedJoint& joint : built->rig.skeleton.joints) {
    const int there = round.first.skeleton.find(joint.key);
    REQUIRE(there >= 0);
    const auto here = static_cast<std::size_t>(&joint - built->rig.skeleton.joints.data());
    const tags::Character& character = round.first.skeleton.character;
    const math::Mat3 axes{character.left, character.up, character.forward};
    const math::Vec3 expected = round.first.skeleton.world(static_cast<std::size_t>(there)).origin;
    const math::Vec3 place = axes * built->rig.skeleton.world(here).origin * character.unit;
    // The model's bones are sheared by a few hundred millionths, which their rests cannot say.
    CHECK(math::length(place - expected) < 2e-7 * character.height);
  }
}

TEST_CASE("extract: a template under another name keeps the identities") {
  BuildRequest request;
  request.template_file = "biped";
  request.paths.templates = {test::templates_folder()};
  const std::string file = test::test_out("extract_named.glb");
  const auto first = build(request, file);
  const std::string yaml = extract(file, "hero");
  CHECK(yaml.find("name: hero\nwas: biped\nversion: 1\nglobal: biped\n") != std::string::npos);
  BuildRequest again;
  again.template_file = write_text(test::test_out("extract_named.yaml"), yaml);
  const auto second = build(again, test::test_out("extract_named_2.glb"));
  CHECK(scene_text(first->rig) == scene_text(second->rig));
  CHECK(second->rig.skeleton.name == "hero");
}

TEST_CASE("extract: earlier keys of joints and commands survive") {
  BuildRequest request;
  request.template_file = write_text(test::test_out("extract_was.yaml"),
                                     "rigc: 1\nname: t\nwas: [older]\nversion: 3\njoints:\n"
                                     "  - name: a\n    was: [b, c]\n    local: g\n    label: a\n"
                                     "    tags:\n"
                                     "      - {command: control, was: [gone/main, a/knob]}\n"
                                     "  - {name: d, parent: a, uid: 0123456789abcdef, was: e}\n");
  const Round round = round_trip(request, "was_out");
  check_same(round);
  REQUIRE(round.first.skeleton.joints[0].was.size() == 5);
  REQUIRE(round.first.skeleton.joints[1].was.size() == 2);
  CHECK(round.second.skeleton.joints[0].was == round.first.skeleton.joints[0].was);
  CHECK(round.second.skeleton.joints[0].commands[0].was ==
        round.first.skeleton.joints[0].commands[0].was);
}

TEST_CASE("extract: which rig, and under which name") {
  Diagnostics building;
  BuildRequest request;
  request.template_file = "prop";
  request.paths.templates = {test::templates_folder()};
  const std::string file = test::test_out("extract_errors.glb");
  build(request, file);
  const auto codes_of = [&](pipeline::ExtractRequest wanted) {
    Diagnostics diagnostics;
    if (wanted.file.empty()) wanted.file = file;
    CHECK_FALSE(pipeline::extract(wanted, diagnostics));
    return test::codes(diagnostics);
  };
  pipeline::ExtractRequest wanted;
  wanted.rig = "nobody";
  CHECK(codes_of(wanted) == "RIG0850");
  wanted = {};
  wanted.name = "7 dwarfs";
  CHECK(codes_of(wanted) == "RIG0851");
  wanted = {};
  wanted.version = "0";
  CHECK(codes_of(wanted) == "RIG0851");

  gltf::Rig a, b;
  a.skeleton.global = b.skeleton.global = "x";
  Diagnostics diagnostics;
  CHECK(pipeline::choose_rig({}, "", file, diagnostics) == nullptr);
  CHECK(pipeline::choose_rig({a, b}, "", file, diagnostics) == nullptr);
  CHECK(pipeline::choose_rig({a, b}, "x", file, diagnostics) == nullptr);
  CHECK(test::codes(diagnostics) == "RIG0754 RIG0850 RIG0850");
}

}  // namespace rigc
