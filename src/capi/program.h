// SPDX-License-Identifier: MIT
// A rig compiled for what will change and what is wanted. Test: tests/capi/capi_test.cpp
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "capi/rig.h"
#include "eval/program.h"

namespace rigc::capi {

struct Input {
  rigc_channel channel;
  std::uint32_t width = 0;
  std::uint32_t offset = 0;  ///< in a row of inputs
};

/// Immutable. Its program's outputs are worlds: those of the joints, then those of other bases.
struct Program {
  std::shared_ptr<const Rig> rig;
  eval::Program program;
  std::vector<Input> inputs;
  std::uint32_t input_width = 0;
  std::vector<std::uint32_t> joints;  ///< numbers in the rig
  std::vector<int> input_of_channel;  ///< by index in Rig::channels; -1: none
  std::vector<int> output_of_joint;   ///< by number in the rig; -1: none
  std::vector<int> base_outputs;      ///< of each of `joints`; -1: the rig's space
};

/// What a program is for.
struct Selection {
  std::vector<rigc_channel> inputs;
  std::vector<std::uint32_t> joints;
};

/// Every keyable channel, every bone.
Selection everything(const Rig& rig);

/// RIGC_OK where everything exists, can vary, and is named once.
rigc_status check(const Rig& rig, const Selection& selection);

/// `selection` has been checked. Null where the rig cannot be compiled, which is reported.
std::shared_ptr<const Program> compile(const std::shared_ptr<const Rig>& rig,
                                       const Selection& selection, Diagnostics& diagnostics);

}  // namespace rigc::capi
