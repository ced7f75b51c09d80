// SPDX-License-Identifier: MIT
// What the tests of the C ABI share: rig files, handles that close themselves, counted allocations.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "capi/rigc_eval.h"
#include "gltf/rig.h"

namespace rigc::capi::test {

template <auto destroy>
struct Destroyer {
  template <class Handle>
  void operator()(Handle* handle) const {
    destroy(handle);
  }
};
using RigHandle = std::unique_ptr<rigc_rig, Destroyer<rigc_rig_destroy>>;
using ProgramHandle = std::unique_ptr<rigc_program, Destroyer<rigc_program_destroy>>;
using InstanceHandle = std::unique_ptr<rigc_instance, Destroyer<rigc_instance_destroy>>;
using DiagnosticsHandle = std::unique_ptr<rigc_diagnostics, Destroyer<rigc_diagnostics_destroy>>;

/// The file of the biped, built once: a .glb.
const std::string& biped();
/// The biped on a character whose bones stand otherwise in their file than in the rig; empty where
/// there is no corpus.
const std::string& biped_on_character();
/// Twelve controls, each under the one before, that may be scaled.
const std::string& tower();
/// The text alone of the biped as a .gltf, whose buffers are files.
std::string biped_text();

/// Fails the test where it cannot be done.
RigHandle open(const std::string& bytes, std::uint32_t rig = 0);
ProgramHandle program(const rigc_rig* rig, const rigc_program_options* options = nullptr);
InstanceHandle instance(const rigc_program* program);

template <class Info>
Info sized() {
  Info info = {};
  info.struct_size = sizeof info;
  return info;
}
rigc_rig_info info_of(const rigc_rig* rig);
rigc_control_info control_at(const rigc_rig* rig, std::uint32_t control);
rigc_channel_info channel_at(const rigc_rig* rig, std::uint32_t control, std::uint32_t channel);
rigc_joint_info joint_at(const rigc_rig* rig, std::uint32_t joint);
/// The one control with this role in this group; fails the test where there is not exactly one.
std::uint32_t control_of(const rigc_rig* rig, const std::string& local, const std::string& role);
std::uint32_t joint_of(const rigc_rig* rig, const std::string& local, const std::string& label);

/// Rows of values for all inputs of a program, none far from rest: [frames][input_width].
std::vector<double> random_rows(const rigc_rig* rig, const rigc_program* program,
                                std::size_t frames, std::uint64_t seed);

/// What rigc itself reads.
gltf::File file_of(const std::string& bytes);
gltf::Rig rig_of(const gltf::File& file);

/// Calls of malloc and its like by any thread while it lives.
class Allocations {
 public:
  Allocations();
  ~Allocations();
  std::size_t count() const;
};

}  // namespace rigc::capi::test
