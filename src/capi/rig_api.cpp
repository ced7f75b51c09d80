// SPDX-License-Identifier: MIT
// The functions of rigc_eval.h for rigs and their diagnostics. Test: tests/capi/capi_test.cpp
#include "capi/handles.h"

using namespace rigc;
using namespace rigc::capi;

uint32_t rigc_eval_abi(void) { return RIGC_EVAL_ABI; }
const char* rigc_eval_version(void) { return RIGC_VERSION; }

const char* rigc_status_text(rigc_status status) {
  switch (status) {
    case RIGC_OK:
      return "done";
    case RIGC_ERROR_ARGUMENT:
      return "an argument is null, has an unknown struct_size, or names something twice";
    case RIGC_ERROR_INDEX:
      return "there is no such rig, control, channel, joint or frame";
    case RIGC_ERROR_VALUE:
      return "a value is not finite or beyond 1e30";
    case RIGC_ERROR_SELECTION:
      return "the program was not compiled for this channel or joint, or cannot be";
    case RIGC_ERROR_NOT_FINITE:
      return "the values are so large that a joint is not finite";
    case RIGC_ERROR_RIG:
      return "the bytes are no rig that can be evaluated";
    case RIGC_ERROR_MEMORY:
      return "there is not enough memory";
    case RIGC_ERROR_INTERNAL:
      return "a mistake of the library";
    default:
      return "no status of this library";
  }
}

rigc_diagnostics* rigc_diagnostics_create(void) { return new (std::nothrow) rigc_diagnostics; }
void rigc_diagnostics_destroy(rigc_diagnostics* diagnostics) { delete diagnostics; }

uint32_t rigc_diagnostics_count(const rigc_diagnostics* diagnostics) {
  return diagnostics ? static_cast<uint32_t>(diagnostics->entries.size()) : 0;
}

const char* rigc_diagnostics_text(const rigc_diagnostics* diagnostics) {
  return diagnostics ? diagnostics->text.c_str() : "";
}

rigc_status rigc_diagnostics_get(const rigc_diagnostics* diagnostics, uint32_t index,
                                 rigc_diagnostic* diagnostic) {
  if (!diagnostics) return RIGC_ERROR_ARGUMENT;
  if (index >= diagnostics->entries.size()) return RIGC_ERROR_INDEX;
  const rigc_diagnostics::Entry& entry = diagnostics->entries[index];
  rigc_diagnostic out = {};
  out.code = entry.code;
  out.is_error = entry.is_error ? 1 : 0;
  out.place = entry.place.c_str();
  out.message = entry.message.c_str();
  out.hint = entry.hint.c_str();
  return hand_out(out, diagnostic);
}

rigc_status rigc_rig_open(const void* bytes, size_t size, const rigc_open_options* options,
                          rigc_diagnostics* diagnostics, rigc_rig** rig) {
  if (!rig) return RIGC_ERROR_ARGUMENT;
  *rig = nullptr;
  rigc_open_options chosen;
  if ((!bytes && size > 0) || !take_in(options, chosen)) return RIGC_ERROR_ARGUMENT;
  return guarded([&] {
    Reporting reporting(diagnostics);
    const std::string_view memory(static_cast<const char*>(bytes), size);
    auto opened = open({Bytes(memory), chosen.name ? chosen.name : "memory", chosen.rig},
                       reporting.diagnostics);
    reporting.hand_over();
    if (!opened) return reporting.diagnostics.ok() ? RIGC_ERROR_INDEX : RIGC_ERROR_RIG;
    *rig = new rigc_rig{std::move(opened)};
    return RIGC_OK;
  });
}

void rigc_rig_destroy(rigc_rig* rig) { delete rig; }

rigc_status rigc_rig_get_info(const rigc_rig* rig, rigc_rig_info* info) {
  return rig ? hand_out(rig->rig->info, info) : RIGC_ERROR_ARGUMENT;
}

rigc_status rigc_rig_get_control(const rigc_rig* rig, uint32_t control, rigc_control_info* info) {
  if (!rig) return RIGC_ERROR_ARGUMENT;
  if (control >= rig->rig->controls.size()) return RIGC_ERROR_INDEX;
  return hand_out(rig->rig->controls[control].info, info);
}

rigc_status rigc_rig_get_channel(const rigc_rig* rig, uint32_t control, uint32_t channel,
                                 rigc_channel_info* info) {
  if (!rig) return RIGC_ERROR_ARGUMENT;
  const Channel* found = rig->rig->channel(control, channel);
  return found ? hand_out(found->info, info) : RIGC_ERROR_INDEX;
}

rigc_status rigc_rig_get_joint(const rigc_rig* rig, uint32_t joint, rigc_joint_info* info) {
  if (!rig) return RIGC_ERROR_ARGUMENT;
  if (joint >= rig->rig->joints.size()) return RIGC_ERROR_INDEX;
  return hand_out(rig->rig->joints[joint].info, info);
}

namespace {

rigc_status find(const std::map<std::string, uint32_t, std::less<>>& numbers, const char* identity,
                 uint32_t* number) {
  const auto found = numbers.find(std::string_view(identity));
  if (found == numbers.end()) return RIGC_ERROR_INDEX;
  *number = found->second;
  return RIGC_OK;
}

}  // namespace

rigc_status rigc_rig_find_control(const rigc_rig* rig, const char* identity, uint32_t* control) {
  if (!rig || !identity || !control) return RIGC_ERROR_ARGUMENT;
  return find(rig->rig->control_numbers, identity, control);
}

rigc_status rigc_rig_find_joint(const rigc_rig* rig, const char* identity, uint32_t* joint) {
  if (!rig || !identity || !joint) return RIGC_ERROR_ARGUMENT;
  return find(rig->rig->joint_numbers, identity, joint);
}

rigc_status rigc_rig_find_channel(const rigc_rig* rig, uint32_t control, const char* name,
                                  uint32_t* channel) {
  if (!rig || !name || !channel) return RIGC_ERROR_ARGUMENT;
  for (uint32_t i = 0; const Channel* found = rig->rig->channel(control, i); ++i) {
    if (std::strcmp(found->info.name, name) != 0) continue;
    *channel = i;
    return RIGC_OK;
  }
  return RIGC_ERROR_INDEX;
}
