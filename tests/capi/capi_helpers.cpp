// SPDX-License-Identifier: MIT
// Rig files and handles for the tests of the C ABI.
#include "capi/capi_helpers.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>

#include "base/files.h"
#include "math/random.h"
#include "pipeline/build.h"

namespace rigc::capi::test {
namespace {

constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30;

std::string folder() {
  const std::string path = std::string(RIGC_TEST_OUT) + "/capi";
  std::filesystem::create_directories(path);
  return path;
}

const std::string kSource = RIGC_SOURCE_DIR;

/// Builds a template and gives the bytes of the file.
std::string build(const std::string& template_file, const std::string& out,
                  const std::string& model = {}, const std::string& map = {}) {
  Diagnostics diagnostics;
  pipeline::BuildRequest request;
  request.template_file = template_file;
  request.paths.templates = {kSource + "/templates"};
  request.model = model;
  request.map = map;
  const std::string path = folder() + "/" + out;
  REQUIRE_MESSAGE(pipeline::build(request, path, diagnostics), render(diagnostics, false));
  // For the Khronos validator.
  if (!model.empty()) REQUIRE(write_file(path + ".model", {Bytes(model + "\n")}, diagnostics));
  const auto bytes = read_file(path, kLargestFile, diagnostics);
  REQUIRE(bytes);
  return *bytes;
}

}  // namespace

const std::string& biped() {
  static const std::string bytes = build(kSource + "/templates/biped.yaml", "biped.glb");
  return bytes;
}

const std::string& tower() {
  static const std::string bytes = [] {
    std::string text = "rigc: 1\nname: tower\nversion: 1\njoints:\n";
    for (int i = 0; i < 12; ++i) {
      text += "  - name: j" + std::to_string(i) + "\n";
      if (i > 0) text += "    parent: j" + std::to_string(i - 1) + "\n";
      text += "    at: [0, " + std::to_string(i) + ", 0]\n    local: tower\n    label: j" +
              std::to_string(i) + "\n    tags: [{command: control, with: {scale: true}}]\n";
    }
    Diagnostics diagnostics;
    REQUIRE(write_file(folder() + "/tower.yaml", {Bytes(text)}, diagnostics));
    return build(folder() + "/tower.yaml", "tower.glb");
  }();
  return bytes;
}

std::string biped_text() { return build(kSource + "/templates/biped.yaml", "biped.gltf"); }

const std::string& biped_on_character() {
  static const std::string bytes = [] {
    const char* given = std::getenv("RIGC_CORPUS");
    const std::string model = (given ? std::string(given) : kSource + "/../shared/corpus") +
                              "/gltftransform_RobotExpressive_quant/RobotExpressive.glb";
    if (file_exists(model))
      return build(kSource + "/templates/biped.yaml", "robot.glb", model,
                   kSource + "/tests/maps/robot_expressive.yaml");
    MESSAGE("corpus file not here, part of the test does not run: " << model);
    return std::string();
  }();
  return bytes;
}

RigHandle open(const std::string& bytes, std::uint32_t number) {
  const DiagnosticsHandle diagnostics(rigc_diagnostics_create());
  auto options = sized<rigc_open_options>();
  options.rig = number;
  rigc_rig* rig = nullptr;
  const rigc_status status =
      rigc_rig_open(bytes.data(), bytes.size(), &options, diagnostics.get(), &rig);
  REQUIRE_MESSAGE(status == RIGC_OK, rigc_diagnostics_text(diagnostics.get()));
  return RigHandle(rig);
}

ProgramHandle program(const rigc_rig* rig, const rigc_program_options* options) {
  const DiagnosticsHandle diagnostics(rigc_diagnostics_create());
  rigc_program* program = nullptr;
  const rigc_status status = rigc_program_create(rig, options, diagnostics.get(), &program);
  REQUIRE_MESSAGE(status == RIGC_OK, rigc_diagnostics_text(diagnostics.get()));
  return ProgramHandle(program);
}

InstanceHandle instance(const rigc_program* program) {
  rigc_instance* instance = nullptr;
  REQUIRE(rigc_instance_create(program, &instance) == RIGC_OK);
  return InstanceHandle(instance);
}

rigc_rig_info info_of(const rigc_rig* rig) {
  auto info = sized<rigc_rig_info>();
  REQUIRE(rigc_rig_get_info(rig, &info) == RIGC_OK);
  return info;
}

rigc_control_info control_at(const rigc_rig* rig, std::uint32_t control) {
  auto info = sized<rigc_control_info>();
  REQUIRE(rigc_rig_get_control(rig, control, &info) == RIGC_OK);
  return info;
}

rigc_channel_info channel_at(const rigc_rig* rig, std::uint32_t control, std::uint32_t channel) {
  auto info = sized<rigc_channel_info>();
  REQUIRE(rigc_rig_get_channel(rig, control, channel, &info) == RIGC_OK);
  return info;
}

rigc_joint_info joint_at(const rigc_rig* rig, std::uint32_t joint) {
  auto info = sized<rigc_joint_info>();
  REQUIRE(rigc_rig_get_joint(rig, joint, &info) == RIGC_OK);
  return info;
}

std::uint32_t control_of(const rigc_rig* rig, const std::string& local, const std::string& role) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < info_of(rig).control_count; ++i) {
    const rigc_control_info control = control_at(rig, i);
    if (control.local == local && control.role == role) found.push_back(i);
  }
  REQUIRE(!found.empty());
  return found[0];  // the first that was made
}

std::uint32_t joint_of(const rigc_rig* rig, const std::string& local, const std::string& label) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < info_of(rig).joint_count; ++i) {
    const rigc_joint_info joint = joint_at(rig, i);
    if (joint.local == local && joint.label == label) found.push_back(i);
  }
  REQUIRE(!found.empty());
  return found[0];  // the first that was made
}

std::vector<double> random_rows(const rigc_rig* rig, const rigc_program* program,
                                std::size_t frames, std::uint64_t seed) {
  rigc::test::Random random(seed);
  const double height = info_of(rig).height;
  std::vector<double> rows;
  for (std::size_t frame = 0; frame < frames; ++frame) {
    for (std::uint32_t i = 0; i < rigc_program_input_count(program); ++i) {
      rigc_channel at = {};
      REQUIRE(rigc_program_get_input(program, i, &at, nullptr) == RIGC_OK);
      const rigc_channel_info info = channel_at(rig, at.control, at.channel);
      for (std::uint32_t c = 0; c < info.width; ++c) {
        const double change = random.between(-0.3, 0.3);
        rows.push_back(info.value[c] + change * (at.channel == RIGC_TRANSLATION ? height : 1));
      }
      if (info.kind != RIGC_QUATERNION) continue;
      double* q = rows.data() + rows.size() - 4;
      const math::Quat unit = math::normalised(math::Quat{q[0], q[1], q[2], q[3]});
      q[0] = unit.x, q[1] = unit.y, q[2] = unit.z, q[3] = unit.w;
    }
  }
  return rows;
}

gltf::File file_of(const std::string& bytes) {
  Diagnostics diagnostics;
  auto file = gltf::open("rig.glb", Bytes(bytes), diagnostics, gltf::OtherFiles::left_alone);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  return *std::move(file);
}

gltf::Rig rig_of(const gltf::File& file) {
  Diagnostics diagnostics;
  auto rigs = gltf::read_rigs(file, diagnostics);
  REQUIRE_MESSAGE((rigs && rigs->size() == 1), render(diagnostics, false));
  return std::move(rigs->front());
}

}  // namespace rigc::capi::test
