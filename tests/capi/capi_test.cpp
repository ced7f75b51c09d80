// SPDX-License-Identifier: MIT
// The C ABI says what the rig's file says, and gives what eval gives, bit for bit.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "capi/capi_helpers.h"
#include "eval/evaluate.h"
#include "gltf/slim.h"

namespace rigc::capi::test {
namespace {

using scene::NodeId;

std::vector<NodeId> of_kind(const scene::Scene& scene, scene::Kind kind) {
  std::vector<NodeId> found;
  for (const NodeId id : scene.nodes())
    if (scene[id].kind == kind) found.push_back(id);
  return found;
}

/// The plug that a channel stands for.
scene::Plug plug_of(const scene::Scene& scene, rigc_channel at) {
  const NodeId control = of_kind(scene, scene::Kind::control)[at.control];
  if (at.channel >= RIGC_FIRST_ATTRIBUTE)
    return {control,
            static_cast<std::uint16_t>(scene::kUserAttributes + at.channel - RIGC_FIRST_ATTRIBUTE)};
  const std::uint16_t attributes[] = {scene::transform::kTranslate, scene::transform::kRotation,
                                      scene::transform::kScale};
  return {control, attributes[at.channel]};
}

/// A row of inputs as settings of a scene.
std::vector<eval::Setting> settings_of(const scene::Scene& scene, const rigc_program* program,
                                       const double* row) {
  std::vector<eval::Setting> settings;
  for (std::uint32_t i = 0; i < rigc_program_input_count(program); ++i) {
    rigc_channel at = {};
    std::uint32_t offset = 0;
    REQUIRE(rigc_program_get_input(program, i, &at, &offset) == RIGC_OK);
    const double* n = row + offset;
    const scene::Plug plug = plug_of(scene, at);
    if (at.channel == RIGC_ROTATION)
      settings.push_back({plug, math::Quat{n[0], n[1], n[2], n[3]}});
    else if (at.channel < RIGC_FIRST_ATTRIBUTE)
      settings.push_back({plug, math::Vec3{n[0], n[1], n[2]}});
    else
      settings.push_back({plug, n[0]});
  }
  return settings;
}

math::Affine affine(const double* m) {
  CHECK(m[3] == 0);
  CHECK(m[7] == 0);
  CHECK(m[11] == 0);
  CHECK(m[15] == 1);
  return {{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}, {m[12], m[13], m[14]}};
}

/// Nodes of the joints of a program.
std::vector<NodeId> joints_of(const scene::Scene& scene, const rigc_program* program) {
  const auto joints = of_kind(scene, scene::Kind::joint);
  std::vector<NodeId> out;
  for (std::uint32_t i = 0; i < rigc_program_joint_count(program); ++i) {
    std::uint32_t joint = 0;
    REQUIRE(rigc_program_get_joint(program, i, &joint) == RIGC_OK);
    out.push_back(joints[joint]);
  }
  return out;
}

double distance(const math::Affine& a, const math::Affine& b) {
  const math::Vec3 columns[] = {a.linear.x - b.linear.x, a.linear.y - b.linear.y,
                                a.linear.z - b.linear.z, a.origin - b.origin};
  double most = 0;
  for (const math::Vec3& column : columns) most = std::max(most, math::length(column));
  return most;
}

}  // namespace

TEST_CASE("capi: controls and joints are those of the file") {
  const RigHandle rig = open(biped());
  const gltf::File file = file_of(biped());
  const gltf::Rig expected = rig_of(file);
  const rigc_rig_info info = info_of(rig.get());
  CHECK(info.name == std::string("biped"));
  CHECK(info.global == expected.skeleton.global);
  CHECK(info.rig_count == 1);
  CHECK(info.space == expected.ancestor);
  CHECK(info.height == expected.skeleton.character.height);
  CHECK(info.metre == 1);

  const auto controls = of_kind(expected.scene, scene::Kind::control);
  REQUIRE(info.control_count == controls.size());
  for (std::uint32_t i = 0; i < info.control_count; ++i) {
    const scene::Node& node = expected.scene[controls[i]];
    const rigc_control_info control = control_at(rig.get(), i);
    CHECK(control.identity == to_text(node.identity));
    CHECK(control.node == expected.nodes[controls[i].index]);
    CHECK(control.role == node.identity.role);
    CHECK(control.channel_count == RIGC_FIRST_ATTRIBUTE + node.user.size());
    std::uint32_t found = UINT32_MAX;
    CHECK(rigc_rig_find_control(rig.get(), control.identity, &found) == RIGC_OK);
    CHECK(found == i);
  }
  const auto joints = of_kind(expected.scene, scene::Kind::joint);
  REQUIRE(info.joint_count == joints.size());
  for (std::uint32_t i = 0; i < info.joint_count; ++i) {
    const rigc_joint_info joint = joint_at(rig.get(), i);
    CHECK(joint.identity == to_text(expected.scene[joints[i]].identity));
    CHECK(joint.node == expected.nodes[joints[i].index]);
    CHECK(affine(joint.rest) == expected.scene.rest_world(joints[i]));
    std::uint32_t found = UINT32_MAX;
    CHECK(rigc_rig_find_joint(rig.get(), joint.identity, &found) == RIGC_OK);
    CHECK(found == i);
  }
}

TEST_CASE("capi: controls and joints know what they hang under, and their other side") {
  const RigHandle rig = open(biped());
  const std::uint32_t elbow = joint_of(rig.get(), "arm_l", "elbow");
  const std::uint32_t wrist = joint_of(rig.get(), "arm_l", "wrist");
  CHECK(joint_at(rig.get(), wrist).is_bone == 1);
  int above = joint_at(rig.get(), wrist).parent;
  while (above >= 0 && above != static_cast<int>(elbow))
    above = joint_at(rig.get(), static_cast<std::uint32_t>(above)).parent;
  CHECK(above == static_cast<int>(elbow));
  const rigc_control_info hand = control_at(rig.get(), control_of(rig.get(), "arm_l", "ik"));
  std::uint32_t other = 0;
  CHECK(rigc_rig_find_control(rig.get(), hand.opposite, &other) == RIGC_OK);
  CHECK(other == control_of(rig.get(), "arm_r", "ik"));
}

TEST_CASE("capi: channels say what they hold, between what, and who may set it") {
  const RigHandle rig = open(biped());
  const std::uint32_t hand = control_of(rig.get(), "arm_l", "ik");
  const rigc_channel_info translation = channel_at(rig.get(), hand, RIGC_TRANSLATION);
  CHECK(translation.name == std::string("translation"));
  CHECK(translation.kind == RIGC_VECTOR);
  CHECK(translation.width == 3);
  CHECK(translation.keyable == 7);
  CHECK(translation.driven == 0);
  CHECK(translation.value[1] == 0);
  CHECK(translation.maximum == HUGE_VAL);
  const rigc_channel_info rotation = channel_at(rig.get(), hand, RIGC_ROTATION);
  CHECK(rotation.kind == RIGC_QUATERNION);
  CHECK(rotation.width == 4);
  CHECK(rotation.value[3] == 1);
  CHECK(channel_at(rig.get(), hand, RIGC_SCALE).keyable == 0);
  const std::uint32_t settings = control_of(rig.get(), "arm_l", "settings");
  std::uint32_t channel = 0;
  REQUIRE(rigc_rig_find_channel(rig.get(), settings, "ik_fk", &channel) == RIGC_OK);
  CHECK(channel >= RIGC_FIRST_ATTRIBUTE);
  const rigc_channel_info ik_fk = channel_at(rig.get(), settings, channel);
  CHECK(ik_fk.kind == RIGC_NUMBER);
  CHECK(ik_fk.width == 1);
  CHECK(ik_fk.keyable == 1);
  CHECK(ik_fk.minimum == 0);
  CHECK(ik_fk.maximum == 1);
  CHECK(channel_at(rig.get(), settings, RIGC_TRANSLATION).keyable == 0);
}

TEST_CASE("capi: what animators set without keying it is the value, what was built the initial") {
  // The hand of the biped, moved in its file.
  const RigHandle built = open(biped());
  const rigc_control_info hand = control_at(built.get(), control_of(built.get(), "arm_l", "ik"));
  const gltf::File file = file_of(biped());
  gltf::Patch patch(file);
  patch.set_member("nodes", hand.node, "translation", "[0,0.25,0]");
  Diagnostics diagnostics;
  const auto output = patch.finish(true, diagnostics);
  REQUIRE(output);
  std::string bytes;
  for (const Bytes& piece : output->pieces) bytes += piece.text(diagnostics).value_or("");

  const RigHandle posed = open(bytes);
  const std::uint32_t control = control_of(posed.get(), "arm_l", "ik");
  const rigc_channel_info channel = channel_at(posed.get(), control, RIGC_TRANSLATION);
  CHECK(channel.value[1] == 0.25);
  CHECK(channel.initial[1] == 0);
}

TEST_CASE("capi: frames of any count are what eval gives, bit for bit") {
  for (const std::string* bytes : {&biped(), &biped_on_character()}) {
    if (bytes->empty()) continue;
    const RigHandle rig = open(*bytes);
    const ProgramHandle all = program(rig.get());
    const InstanceHandle one = instance(all.get());
    constexpr std::size_t kFrames = 19;  // two blocks and a part of one
    const auto rows = random_rows(rig.get(), all.get(), kFrames, 1);
    const std::size_t joints = rigc_program_joint_count(all.get());
    std::vector<double> matrices(kFrames * joints * 16);
    std::vector<float> floats(matrices.size());
    REQUIRE(rigc_instance_evaluate(one.get(), kFrames, rows.data(), matrices.data()) == RIGC_OK);
    REQUIRE(rigc_instance_evaluate_f(one.get(), kFrames, rows.data(), floats.data()) == RIGC_OK);
    for (std::size_t i = 0; i < floats.size(); ++i)
      CHECK(floats[i] == static_cast<float>(matrices[i]));

    const gltf::File file = file_of(*bytes);
    const gltf::Rig expected = rig_of(file);
    const auto nodes = joints_of(expected.scene, all.get());
    REQUIRE(nodes.size() > 20);
    for (const std::size_t frame : {0, 7, 8, 18}) {
      const double* row = rows.data() + frame * rigc_program_input_width(all.get());
      const auto worlds =
          eval::worlds(expected.scene, nodes, settings_of(expected.scene, all.get(), row));
      REQUIRE(worlds.size() == joints);
      for (std::size_t j = 0; j < joints; ++j)
        CHECK(affine(matrices.data() + (frame * joints + j) * 16) == worlds[j]);
    }
  }
}

TEST_CASE("capi: channels set one by one, frames apart, values that stay, reset") {
  const RigHandle rig = open(biped());
  const ProgramHandle all = program(rig.get());
  const InstanceHandle one = instance(all.get());
  const std::uint32_t hand = control_of(rig.get(), "arm_l", "ik");
  const std::uint32_t settings = control_of(rig.get(), "arm_l", "settings");
  const std::uint32_t wrist = joint_of(rig.get(), "arm_l", "wrist");
  std::uint32_t ik_fk = 0;
  REQUIRE(rigc_rig_find_channel(rig.get(), settings, "ik_fk", &ik_fk) == RIGC_OK);
  const double on = 1, up[3] = {0, 0.05, 0}, down[3] = {0, -0.05, 0};
  const auto height = [&](std::uint32_t frame) {
    double m[16];
    REQUIRE(rigc_instance_get_world(one.get(), frame, wrist, m) == RIGC_OK);
    return m[13];
  };
  REQUIRE(rigc_instance_set(one.get(), RIGC_ALL_FRAMES, settings, ik_fk, &on) == RIGC_OK);
  REQUIRE(rigc_instance_run(one.get()) == RIGC_OK);
  const double rest = height(0);
  REQUIRE(rigc_instance_set(one.get(), 2, hand, RIGC_TRANSLATION, up) == RIGC_OK);
  REQUIRE(rigc_instance_set(one.get(), 5, hand, RIGC_TRANSLATION, down) == RIGC_OK);
  CHECK(height(2) == rest);  // nothing ran yet
  for (int again = 0; again < 3; ++again) {
    REQUIRE(rigc_instance_run(one.get()) == RIGC_OK);
    CHECK(height(0) == rest);
    CHECK(height(2) == doctest::Approx(rest + 0.05).epsilon(1e-9));
    CHECK(height(5) == doctest::Approx(rest - 0.05).epsilon(1e-9));
    CHECK(height(7) == rest);
  }
  REQUIRE(rigc_instance_reset(one.get()) == RIGC_OK);
  REQUIRE(rigc_instance_run(one.get()) == RIGC_OK);
  CHECK(height(2) == height(0));
  double m[16];
  float f[16];
  REQUIRE(rigc_instance_get_world(one.get(), 0, wrist, m) == RIGC_OK);
  REQUIRE(rigc_instance_get_world_f(one.get(), 0, wrist, f) == RIGC_OK);
  for (int i = 0; i < 16; ++i) CHECK(f[i] == static_cast<float>(m[i]));
}

TEST_CASE("capi: fewer inputs and joints give the same for what is left") {
  const RigHandle rig = open(biped());
  const ProgramHandle all = program(rig.get());
  const rigc_channel inputs[] = {{control_of(rig.get(), "arm_l", "ik"), RIGC_ROTATION},
                                 {control_of(rig.get(), "arm_l", "ik"), RIGC_TRANSLATION}};
  const std::uint32_t joints[] = {joint_of(rig.get(), "arm_l", "wrist"),
                                  joint_of(rig.get(), "arm_l", "elbow")};
  auto options = sized<rigc_program_options>();
  options.inputs = inputs;
  options.input_count = 2;
  options.joints = joints;
  options.joint_count = 2;
  const ProgramHandle few = program(rig.get(), &options);
  CHECK(rigc_program_input_width(few.get()) == 7);
  CHECK(rigc_program_joint_count(few.get()) == 2);
  const InstanceHandle with_all = instance(all.get()), with_few = instance(few.get());
  const auto rows = random_rows(rig.get(), few.get(), 1, 2);
  REQUIRE(rigc_instance_set_rows(with_few.get(), 1, rows.data()) == RIGC_OK);
  REQUIRE(rigc_instance_set(with_all.get(), 0, inputs[0].control, RIGC_ROTATION, rows.data()) ==
          RIGC_OK);
  REQUIRE(rigc_instance_set(with_all.get(), 0, inputs[1].control, RIGC_TRANSLATION,
                            rows.data() + 4) == RIGC_OK);
  REQUIRE(rigc_instance_run(with_few.get()) == RIGC_OK);
  REQUIRE(rigc_instance_run(with_all.get()) == RIGC_OK);
  double matrices[32];
  REQUIRE(rigc_instance_get_worlds(with_few.get(), 0, matrices) == RIGC_OK);
  for (int i = 0; i < 2; ++i) {
    double m[16];
    REQUIRE(rigc_instance_get_world(with_all.get(), 0, joints[i], m) == RIGC_OK);
    // What is constant is folded, which rounds elsewhere.
    for (int k = 0; k < 16; ++k) CHECK(std::abs(m[k] - matrices[16 * i + k]) < 1e-12);
  }
  options.input_count = 0;  // a rig that stands still
  const ProgramHandle none = program(rig.get(), &options);
  CHECK(rigc_program_input_width(none.get()) == 0);
  const InstanceHandle still = instance(none.get());
  double twice[2 * 32];
  REQUIRE(rigc_instance_set_rows(still.get(), 1, nullptr) == RIGC_OK);
  REQUIRE(rigc_instance_run(still.get()) == RIGC_OK);
  REQUIRE(rigc_instance_get_worlds(still.get(), 0, matrices) == RIGC_OK);
  REQUIRE(rigc_instance_evaluate(still.get(), 2, nullptr, twice) == RIGC_OK);
  for (int k = 0; k < 64; ++k) CHECK(twice[k] == matrices[k % 32]);
}

TEST_CASE("capi: local transforms put on the file's nodes give the worlds") {
  for (const std::string* bytes : {&biped(), &biped_on_character()}) {
    if (bytes->empty()) continue;
    const RigHandle rig = open(*bytes);
    const ProgramHandle all = program(rig.get());
    const InstanceHandle one = instance(all.get());
    const auto rows = random_rows(rig.get(), all.get(), 1, 3);
    REQUIRE(rigc_instance_set_rows(one.get(), 1, rows.data()) == RIGC_OK);
    REQUIRE(rigc_instance_run(one.get()) == RIGC_OK);

    Diagnostics diagnostics;
    const gltf::File file = file_of(*bytes);
    auto slim = gltf::read_slim(file, diagnostics);
    REQUIRE(slim);
    const math::Affine space = slim->world(info_of(rig.get()).space);
    std::vector<std::pair<int, math::Affine>> expected;
    for (std::uint32_t i = 0; i < rigc_program_joint_count(all.get()); ++i) {
      std::uint32_t joint = 0;
      REQUIRE(rigc_program_get_joint(all.get(), i, &joint) == RIGC_OK);
      const rigc_joint_info info = joint_at(rig.get(), joint);
      rigc_trs local;
      double m[16];
      REQUIRE(rigc_instance_get_local(one.get(), 0, joint, &local) == RIGC_OK);
      REQUIRE(rigc_instance_get_world(one.get(), 0, joint, m) == RIGC_OK);
      const double* t = local.translation;
      const double* r = local.rotation;
      const double* s = local.scale;
      slim->nodes[static_cast<std::size_t>(info.node)].matrix =
          math::compose({{t[0], t[1], t[2]}, {r[0], r[1], r[2], r[3]}, {s[0], s[1], s[2]}});
      expected.emplace_back(info.node, space * affine(m));
    }
    for (const int node : slim->preorder) {
      gltf::SlimNode& at = slim->nodes[static_cast<std::size_t>(node)];
      at.world = slim->world(at.parent) * at.matrix;
    }
    const double height = info_of(rig.get()).height;
    for (const auto& [node, world] : expected)
      CHECK(distance(slim->node(node).world, world) < 1e-9 * std::max(height, 1.0));
  }
}

TEST_CASE("capi: the text of a .gltf opens without the files beside it") {
  const std::string text = biped_text();
  REQUIRE(text[0] == '{');
  const RigHandle rig = open(text);
  CHECK(info_of(rig.get()).joint_count == info_of(open(biped()).get()).joint_count);
}

TEST_CASE("capi: handles may go in any order") {
  RigHandle rig = open(biped());
  ProgramHandle all = program(rig.get());
  const InstanceHandle one = instance(all.get());
  const std::uint32_t wrist = joint_of(rig.get(), "arm_l", "wrist");
  rig.reset();
  all.reset();
  double m[16];
  CHECK(rigc_instance_run(one.get()) == RIGC_OK);
  CHECK(rigc_instance_get_world(one.get(), 0, wrist, m) == RIGC_OK);
}

TEST_CASE("capi: versions") {
  CHECK(rigc_eval_abi() == RIGC_EVAL_ABI);
  CHECK(std::string(rigc_eval_version()).find('.') != std::string::npos);
  CHECK(rigc_block_frames() == 8);
}

}  // namespace rigc::capi::test
