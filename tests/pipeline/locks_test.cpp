// SPDX-License-Identifier: MIT
// Keys on what is locked have no effect and are said; limits hold in what bake writes.
#include "pipeline/locks.h"

#include <doctest/doctest.h>

#include <cmath>

#include "gltf/clips.h"
#include "pipeline/bake_file.h"
#include "pipeline/character_helpers.h"
#include "pipeline/codes.h"
#include "pipeline/door_helpers.h"

namespace rigc {
namespace {

using anim::Path;

struct Baked {
  Diagnostics diagnostics;
  std::string path;
};

Baked baked_file(const std::string& keyed) {
  Baked out;
  out.path = keyed.substr(0, keyed.size() - 4) + "_baked.glb";
  pipeline::BakeRequest request;
  request.file = keyed;
  REQUIRE_MESSAGE(pipeline::bake_file(request, out.path, out.diagnostics),
                  render(out.diagnostics, false));
  return out;
}

/// What was said about locks.
std::vector<std::string> said(const Diagnostics& diagnostics) {
  std::vector<std::string> out;
  for (const Diagnostic& diagnostic : diagnostics.all())
    if (diagnostic.code->number == pipeline::codes::kLockedKeys.number)
      out.push_back(diagnostic.message);
  return out;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

math::Affine joint(const std::string& path, const std::string& name, double seconds) {
  const auto json = test::load_glb(path).json;
  for (std::size_t i = 0; i < json["nodes"].size(); ++i)
    if (json["nodes"][i].value("name", "") == name) return test::play(path, "test", seconds)[i];
  FAIL("no joint " << name);
  return {};
}

double degrees_about_y(const math::Affine& a) {
  return math::to_euler_degrees(math::quaternion(a.linear)).y;
}

const float kHalf = 0.70710678f;  // of a quarter turn

}  // namespace

TEST_CASE("pipeline locks: limits hold in the baked motion, the keys between them play") {
  const std::string path = test::door("limits_bake");
  const gltf::Rig rig = test::door_rig(path);
  // 0, 90, 180 degrees about y; the handle 0, 0.1, 1 along z.
  const auto turned = test::keys(test::control_of(rig, "hinge"), Path::rotation, 4,
                                 {0, 0, 0, 1, 0, kHalf, 0, kHalf, 0, 1, 0, 0});
  const auto pushed = test::keys(test::control_of(rig, "handle"), Path::translation, 3,
                                 {0, 0, 0, 0, 0, 0.1f, 0, 0, 1});
  const Baked baked = baked_file(test::with_clip(path, {turned, pushed}));
  CHECK(said(baked.diagnostics).empty());
  CHECK(std::abs(degrees_about_y(joint(baked.path, "hinge", 0.05)) - 45) < 0.5);
  for (const double time : {0.1, 0.15, 0.2})
    CHECK(std::abs(degrees_about_y(joint(baked.path, "hinge", time)) - 90) < 1e-4);
  // The handle lies 0.8 from the hinge, and moves along what was z.
  CHECK(std::abs(joint(baked.path, "handle", 0.1).origin.x - 0.1) < 1e-5);
  CHECK(std::abs(joint(baked.path, "handle", 0.2).origin.x - 0.2) < 1e-5);
}

TEST_CASE("pipeline locks: keys that would change what is locked are named and have no effect") {
  const std::string path = test::door("locks_bake");
  const gltf::Rig rig = test::door_rig(path);
  const int hinge = test::control_of(rig, "hinge"), handle = test::control_of(rig, "handle");
  const Baked baked = baked_file(test::with_clip(
      path, {test::keys(hinge, Path::translation, 3, {0, 0, 0, 0, 2, 0}),
             test::keys(hinge, Path::rotation, 4, {0, 0, 0, 1, 0.5f, 0.5f, 0.5f, 0.5f}),
             test::keys(handle, Path::translation, 3, {0, 0, 0, 3, 0, 0.1f}),
             test::attribute_keys(handle, "stiff", {2, 5})}));
  const auto messages = said(baked.diagnostics);
  REQUIRE(messages.size() == 2);
  CHECK(has(messages[0], "rotate.x, rotate.z, translate.y of \"hinge_control\", which are locked"));
  CHECK(has(messages[1], "stiff, translate.x of \"handle_control\", which are locked"));
  CHECK(std::abs(joint(baked.path, "hinge", 0.1).origin.y - 1) < 1e-6);
  const math::Affine turned = joint(baked.path, "hinge", 0.1);
  CHECK(std::abs(turned.linear.y.y - 1) < 1e-6);  // about y alone
}

TEST_CASE("pipeline locks: keys that say what the lock says are nothing to talk about") {
  const std::string path = test::door("locks_same");
  const gltf::Rig rig = test::door_rig(path);
  const int hinge = test::control_of(rig, "hinge"), handle = test::control_of(rig, "handle");
  const Baked baked = baked_file(test::with_clip(
      path, {test::keys(hinge, Path::translation, 3, {0, 0, 0, 0, 0, 1e-7f}),
             test::keys(hinge, Path::rotation, 4, {0, 0, 0, 1, 0, -kHalf, 0, -kHalf}),
             test::keys(handle, Path::scale, 3, {1, 1, 1, 2, 2, 2}),
             test::attribute_keys(handle, "stiff", {2, 2}),
             test::attribute_keys(handle, "sound", {0, 1})}));
  CHECK(said(baked.diagnostics).empty());
}

TEST_CASE("pipeline locks: cubic keys count by their values, not by their tangents") {
  const std::string path = test::door("locks_cubic");
  const gltf::Rig rig = test::door_rig(path);
  anim::Channel channel =
      test::keys(test::control_of(rig, "handle"), Path::translation, 3, {0, 0, 0, 0, 0, 0.1f});
  channel.curve.interpolation = anim::Interpolation::cubic;
  channel.curve.values = {9, 9, 9, 0, 0, 0, 9, 9, 9, 9, 9, 9, 0, 0, 0.1f, 9, 9, 9};
  CHECK(said(baked_file(test::with_clip(path, {channel})).diagnostics).empty());
}

TEST_CASE("pipeline locks: what another program set on a locked control does not count") {
  const std::string path = test::door("locks_moved");
  const int hinge = test::control_of(test::door_rig(path), "hinge");
  test::Character changed = test::load_glb(path);
  auto& node = changed.json["nodes"][static_cast<std::size_t>(hinge)];
  node["translation"] = {1, 2, 3};
  node["rotation"] = {0, 0.25881905, 0, 0.96592583};  // 30 degrees about y
  node["scale"] = {2, 1, 1};
  test::save_glb(changed, path);
  Diagnostics diagnostics;
  const auto file = gltf::open(path, diagnostics);
  REQUIRE(file);
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  REQUIRE(rigs);
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].code->number == 745);
  const gltf::Rig& rig = rigs->front();
  for (scene::NodeId id : rig.scene.nodes()) {
    if (rig.nodes[id.index] != hinge) continue;
    const math::Trs local = rig.scene.local(id);
    CHECK(local.translation == math::Vec3{});
    CHECK(std::abs(math::to_euler_degrees(local.rotation).y - 30) < 1e-4);
    CHECK(local.scale == math::Vec3{2, 1, 1});
  }
}

}  // namespace rigc
