// SPDX-License-Identifier: MIT
// Asks eval for the program of a selection. Test: tests/capi/capi_test.cpp
#include "capi/program.h"

#include <set>
#include <utility>

namespace rigc::capi {
namespace {

scene::Plug world_of(scene::NodeId id) { return {id, scene::transform::kWorld}; }

std::size_t place_of(const Rig& rig, rigc_channel channel) {
  return rig.controls[channel.control].first_channel + channel.channel;
}

/// Output of each joint's base, added to the request where it is none of the joints.
std::vector<int> add_bases(const Rig& rig, const std::vector<std::uint32_t>& joints,
                           eval::Request& request) {
  std::vector<int> outputs(rig.scene.size(), -1);  // by scene node
  for (std::size_t i = 0; i < joints.size(); ++i)
    outputs[rig.joints[joints[i]].id.index] = static_cast<int>(i);
  std::vector<int> bases;
  for (const std::uint32_t number : joints) {
    const scene::NodeId base = rig.joints[number].base;
    if (base.valid() && outputs[base.index] < 0) {
      outputs[base.index] = static_cast<int>(request.outputs.size());
      request.outputs.push_back(world_of(base));
    }
    bases.push_back(base.valid() ? outputs[base.index] : -1);
  }
  return bases;
}

}  // namespace

Selection everything(const Rig& rig) {
  Selection all;
  for (std::uint32_t control = 0; control < rig.controls.size(); ++control) {
    for (std::uint32_t c = 0; c < rig.controls[control].info.channel_count; ++c)
      if (rig.channel(control, c)->info.keyable != 0) all.inputs.push_back({control, c});
  }
  for (std::uint32_t joint = 0; joint < rig.joints.size(); ++joint)
    if (rig.joints[joint].info.is_bone) all.joints.push_back(joint);
  return all;
}

rigc_status check(const Rig& rig, const Selection& selection) {
  std::set<std::size_t> channels;
  for (const rigc_channel& input : selection.inputs) {
    const Channel* channel = rig.channel(input.control, input.channel);
    if (!channel) return RIGC_ERROR_INDEX;
    if (channel->info.keyable == 0) return RIGC_ERROR_SELECTION;
    if (!channels.insert(place_of(rig, input)).second) return RIGC_ERROR_ARGUMENT;
  }
  std::set<std::uint32_t> joints;
  for (const std::uint32_t joint : selection.joints) {
    if (joint >= rig.joints.size()) return RIGC_ERROR_INDEX;
    if (!joints.insert(joint).second) return RIGC_ERROR_ARGUMENT;
  }
  return RIGC_OK;
}

std::shared_ptr<const Program> compile(const std::shared_ptr<const Rig>& rig,
                                       const Selection& selection, Diagnostics& diagnostics) {
  auto out = std::make_shared<Program>();
  out->rig = rig;
  out->joints = selection.joints;
  out->input_of_channel.assign(rig->channels.size(), -1);
  out->output_of_joint.assign(rig->joints.size(), -1);
  eval::Request request;
  for (const rigc_channel& channel : selection.inputs) {
    const Channel& input = rig->channels[place_of(*rig, channel)];
    out->input_of_channel[place_of(*rig, channel)] = static_cast<int>(out->inputs.size());
    out->inputs.push_back({channel, input.info.width, out->input_width});
    out->input_width += input.info.width;
    request.inputs.push_back(input.plug);
  }
  for (const std::uint32_t joint : selection.joints) {
    out->output_of_joint[joint] = static_cast<int>(request.outputs.size());
    request.outputs.push_back(world_of(rig->joints[joint].id));
  }
  out->base_outputs = add_bases(*rig, selection.joints, request);
  auto program = eval::compile(rig->scene, request, diagnostics);
  if (!program) return nullptr;
  out->program = *std::move(program);
  return out;
}

}  // namespace rigc::capi
