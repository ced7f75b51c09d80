// SPDX-License-Identifier: MIT
// Any bytes as a rig for the C ABI: what opens is listed, compiled and evaluated, at rest and with
// values far from it. Matrices are finite, and refused values change nothing.
#include <cmath>
#include <cstdint>
#include <vector>

#include "capi/rigc_eval.h"
#include "tests/fuzz/fuzz.h"

namespace {

void list(const rigc_rig* rig) {
  rigc_rig_info info = {};
  info.struct_size = sizeof info;
  rigc::fuzz::expect(rigc_rig_get_info(rig, &info) == RIGC_OK, "a rig has its numbers");
  for (std::uint32_t i = 0; i < info.control_count; ++i) {
    rigc_control_info control = {};
    control.struct_size = sizeof control;
    rigc::fuzz::expect(rigc_rig_get_control(rig, i, &control) == RIGC_OK, "controls are there");
    for (std::uint32_t c = 0; c < control.channel_count; ++c) {
      rigc_channel_info channel = {};
      channel.struct_size = sizeof channel;
      rigc::fuzz::expect(rigc_rig_get_channel(rig, i, c, &channel) == RIGC_OK, "and channels");
    }
  }
  for (std::uint32_t i = 0; i < info.joint_count; ++i) {
    rigc_joint_info joint = {};
    joint.struct_size = sizeof joint;
    rigc::fuzz::expect(rigc_rig_get_joint(rig, i, &joint) == RIGC_OK, "and joints");
  }
}

void evaluate(const rigc_program* program, double value) {
  rigc_instance* instance = nullptr;
  rigc::fuzz::expect(rigc_instance_create(program, &instance) == RIGC_OK, "an instance is made");
  const std::vector<double> row(rigc_program_input_width(program) + 1, value);
  std::vector<double> matrices(std::size_t{16} * rigc_program_joint_count(program) + 1);
  const rigc_status status = rigc_instance_evaluate(instance, 1, row.data(), matrices.data());
  rigc::fuzz::expect(status == RIGC_OK || status == RIGC_ERROR_NOT_FINITE, "it is evaluated");
  for (const double number : matrices)
    rigc::fuzz::expect(std::isfinite(number), "matrices are finite");
  for (std::uint32_t i = 0; i < rigc_program_joint_count(program); ++i) {
    std::uint32_t joint = 0;
    rigc_trs local;
    rigc::fuzz::expect(rigc_program_get_joint(program, i, &joint) == RIGC_OK, "joints are named");
    rigc_instance_get_local(instance, 0, joint, &local);
    rigc::fuzz::expect(std::isfinite(local.translation[0] + local.rotation[3] + local.scale[2]),
                       "local transforms are finite");
  }
  rigc_instance_destroy(instance);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rigc_diagnostics* diagnostics = rigc_diagnostics_create();
  rigc_rig* rig = nullptr;
  rigc_program* program = nullptr;
  const rigc_status opened = rigc_rig_open(data, size, nullptr, diagnostics, &rig);
  rigc::fuzz::expect(opened == RIGC_OK || opened == RIGC_ERROR_RIG || opened == RIGC_ERROR_INDEX,
                     "bytes are a rig or are not");
  rigc::fuzz::expect(opened != RIGC_ERROR_RIG || rigc_diagnostics_count(diagnostics) > 0,
                     "what is refused is explained");
  if (rig) {
    list(rig);
    if (rigc_program_create(rig, nullptr, diagnostics, &program) == RIGC_OK) {
      for (const double value : {0.0, 0.7, 1e30}) evaluate(program, value);
    }
  }
  rigc_program_destroy(program);
  rigc_rig_destroy(rig);
  rigc_diagnostics_destroy(diagnostics);
  return 0;
}
