// SPDX-License-Identifier: MIT
// What check finds in rig files and models.
#include "pipeline/check.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

#include "pipeline/character_helpers.h"
#include "pipeline/codes.h"
#include "pipeline/door_helpers.h"

namespace rigc {
namespace {

using anim::Path;
namespace codes = pipeline::codes;

struct Result {
  pipeline::CheckedFile file;
  Diagnostics diagnostics;
  std::vector<std::string> messages(const Code& code) const {
    std::vector<std::string> found;
    for (const Diagnostic& one : diagnostics.all())
      if (one.code == &code || one.code->number == code.number) found.push_back(one.message);
    return found;
  }
  std::string pointer(const Code& code) const {
    for (const Diagnostic& one : diagnostics.all())
      if (one.code->number == code.number) return one.place.pointer;
    return {};
  }
};

Result checked(const std::string& path) {
  Result result;
  pipeline::CheckRequest request;
  request.paths_to_check = {path};
  const auto files = pipeline::check(request, result.diagnostics);
  REQUIRE(files.size() == 1);
  result.file = files.front();
  return result;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// glTF node of the zero above a control.
int zero_of(const gltf::Rig& rig, int control) {
  for (scene::NodeId id : rig.scene.nodes())
    if (rig.nodes[id.index] == control) return rig.nodes[rig.scene[id].parent.index];
  return -1;
}

}  // namespace

TEST_CASE("pipeline check: a rig as it was built has nothing to report") {
  const Result result = checked(test::door("check_good"));
  INFO(render(result.diagnostics, false));
  CHECK(result.file.kind == "rig");
  CHECK(result.diagnostics.all().empty());
  REQUIRE(result.file.facts.size() == 1);
  CHECK(has(result.file.facts[0], "rig 0"));
  CHECK(has(result.file.facts[0], "2 controls"));
}

TEST_CASE("pipeline check: channels that have no effect, or another than their keys say") {
  const std::string path = test::door("check_clips");
  const gltf::Rig rig = test::door_rig(path);
  const int hinge = test::control_of(rig, "hinge"), handle = test::control_of(rig, "handle");
  const int zero = zero_of(rig, handle);
  REQUIRE(zero >= 0);
  const Result result = checked(
      test::with_clip(path, {test::attribute_keys(handle, "stif", {0, 1}),
                             test::keys(zero, Path::translation, 3, {0, 0, 0, 0, 1, 0}),
                             test::keys(handle, Path::translation, 3, {0, 0, 0, 0, 0, 0.3f}),
                             test::keys(hinge, Path::rotation, 4, {0, 0, 0, 1, 0, 1, 0, 0})}));
  INFO(render(result.diagnostics, false));
  CHECK(result.file.errors == 0);
  const auto missing = result.messages(codes::kNoAttributeKeyed);
  REQUIRE(missing.size() == 1);
  CHECK(has(missing[0], "\"stif\""));
  CHECK(has(missing[0], "handle_control"));
  CHECK(has(result.pointer(codes::kNoAttributeKeyed), "/animations/0/channels/"));
  CHECK(result.messages(codes::kNotAControl).size() == 1);
  const auto outside = result.messages(codes::kOutsideLimits);
  REQUIRE(outside.size() == 2);
  CHECK(std::any_of(outside.begin(), outside.end(), [](const std::string& message) {
    return has(message, "1 of 2 keys are outside of the limits of translate, first at 0.1 s");
  }));
  CHECK(std::any_of(outside.begin(), outside.end(), [](const std::string& message) {
    return has(message, "of rotate") && has(message, "hinge_control");
  }));
}

TEST_CASE("pipeline check: keys inside of the limits are nothing to talk about") {
  const std::string path = test::door("check_inside");
  const gltf::Rig rig = test::door_rig(path);
  const int handle = test::control_of(rig, "handle");
  const Result result = checked(
      test::with_clip(path, {test::keys(handle, Path::translation, 3, {0, 0, 0, 0, 0, 0.2f})}));
  INFO(render(result.diagnostics, false));
  CHECK(result.diagnostics.all().empty());
}

TEST_CASE("pipeline check: a rotation that the control does not offer") {
  const std::string path = test::door("check_offered");
  const gltf::Rig rig = test::door_rig(path);
  const int handle = test::control_of(rig, "handle");
  const Result result = checked(
      test::with_clip(path, {test::keys(handle, Path::rotation, 4, {0, 0, 0, 1, 0, 1, 0, 0})}));
  INFO(render(result.diagnostics, false));
  const auto found = result.messages(codes::kDrivenKeyed);
  REQUIRE(found.size() == 1);
  CHECK(has(found[0], "keys rotate, which the rig does not offer"));
}

TEST_CASE(
    "pipeline check: nodes that were numbered anew, and nodes that do not say what they are") {
  const std::string path = test::door("check_nodes");
  std::filesystem::create_directories(test::test_out("broken"));
  const gltf::Rig rig = test::door_rig(path);
  const auto control = static_cast<std::size_t>(test::control_of(rig, "handle"));

  test::Character silent = test::load_glb(path);
  silent.json["nodes"][control]["extras"].erase("rigc");
  const std::string silent_path = test::test_out("broken/check_silent.glb");
  test::save_glb(silent, silent_path);
  const Result no_identity = checked(silent_path);
  INFO(render(no_identity.diagnostics, false));
  CHECK(no_identity.messages(codes::kNoIdentity).size() == 1);
  CHECK(no_identity.pointer(codes::kNoIdentity) == "/extensions/RIGC_rig/rigs/0");
  CHECK(no_identity.messages(codes::kNodesMoved).empty());

  test::Character moved = test::load_glb(path);
  auto& nodes = moved.json["extensions"]["RIGC_rig"]["rigs"][0]["nodes"];
  std::size_t changed = 0;
  for (auto& node : nodes) {
    if (!node.contains("node") || node["node"] != test::control_of(rig, "handle")) continue;
    node["node"] = test::control_of(rig, "hinge");
    ++changed;
  }
  REQUIRE(changed == 1);
  const std::string moved_path = test::test_out("broken/check_moved.glb");
  test::save_glb(moved, moved_path);
  const Result renumbered = checked(moved_path);
  INFO(render(renumbered.diagnostics, false));
  CHECK(renumbered.file.errors == 0);
  const auto messages = renumbered.messages(codes::kNodesMoved);
  REQUIRE(messages.size() == 1);
  CHECK(has(messages[0], "1 nodes of rig 0"));
}

TEST_CASE("pipeline check: which template and map fit a model") {
  const std::string fits = test::corpus_file("mixamo_Xbot_blender/Xbot.glb");
  if (!fits.empty()) {
    const Result result = checked(fits);
    INFO(render(result.diagnostics, false));
    CHECK(result.file.kind == "model");
    CHECK(result.file.errors == 0);
    REQUIRE(!result.file.facts.empty());
    CHECK(has(result.file.facts[0], "biped fits with map \"mixamo\""));
  }
  const std::string odd = test::corpus_file("khronos_SimpleSkin/SimpleSkin.gltf");
  if (odd.empty()) return;
  const Result result = checked(odd);
  INFO(render(result.diagnostics, false));
  CHECK(result.file.errors == 0);
  CHECK(result.messages(codes::kNothingFits).size() == 1);
  CHECK(has(result.pointer(codes::kNothingFits), "/nodes/"));
}

}  // namespace rigc
