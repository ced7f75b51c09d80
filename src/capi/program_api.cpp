// SPDX-License-Identifier: MIT
// The functions of rigc_eval.h for programs. Test: tests/capi/capi_test.cpp
#include "capi/handles.h"

using namespace rigc;
using namespace rigc::capi;

namespace {

/// What the options name; false where they are not as the header says.
bool read_selection(const rigc_program_options* options, const Rig& rig, Selection& selection) {
  rigc_program_options chosen;
  if (!take_in(options, chosen)) return false;
  if ((!chosen.inputs && chosen.input_count > 0) || (!chosen.joints && chosen.joint_count > 0))
    return false;
  selection = everything(rig);
  // More than there are name something twice.
  if (chosen.input_count > rig.channels.size() || chosen.joint_count > rig.joints.size())
    return false;
  if (chosen.inputs) selection.inputs.assign(chosen.inputs, chosen.inputs + chosen.input_count);
  if (chosen.joints) selection.joints.assign(chosen.joints, chosen.joints + chosen.joint_count);
  return true;
}

}  // namespace

rigc_status rigc_program_create(const rigc_rig* rig, const rigc_program_options* options,
                                rigc_diagnostics* diagnostics, rigc_program** program) {
  if (!program) return RIGC_ERROR_ARGUMENT;
  *program = nullptr;
  if (!rig) return RIGC_ERROR_ARGUMENT;
  return guarded([&]() -> rigc_status {
    Reporting reporting(diagnostics, rig->rig->sources);
    Selection selection;
    if (!read_selection(options, *rig->rig, selection)) return RIGC_ERROR_ARGUMENT;
    const rigc_status status = check(*rig->rig, selection);
    if (status != RIGC_OK) return status;
    auto compiled = compile(rig->rig, selection, reporting.diagnostics);
    reporting.hand_over();
    if (!compiled) return RIGC_ERROR_RIG;
    *program = new rigc_program{std::move(compiled)};
    return RIGC_OK;
  });
}

void rigc_program_destroy(rigc_program* program) { delete program; }

uint32_t rigc_program_input_count(const rigc_program* program) {
  return program ? static_cast<uint32_t>(program->program->inputs.size()) : 0;
}
uint32_t rigc_program_joint_count(const rigc_program* program) {
  return program ? static_cast<uint32_t>(program->program->joints.size()) : 0;
}
uint32_t rigc_program_input_width(const rigc_program* program) {
  return program ? program->program->input_width : 0;
}

rigc_status rigc_program_get_input(const rigc_program* program, uint32_t index,
                                   rigc_channel* channel, uint32_t* offset) {
  if (!program || !channel) return RIGC_ERROR_ARGUMENT;
  if (index >= program->program->inputs.size()) return RIGC_ERROR_INDEX;
  const Input& input = program->program->inputs[index];
  *channel = input.channel;
  if (offset) *offset = input.offset;
  return RIGC_OK;
}

rigc_status rigc_program_get_joint(const rigc_program* program, uint32_t index, uint32_t* joint) {
  if (!program || !joint) return RIGC_ERROR_ARGUMENT;
  if (index >= program->program->joints.size()) return RIGC_ERROR_INDEX;
  *joint = program->program->joints[index];
  return RIGC_OK;
}
