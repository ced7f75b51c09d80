// SPDX-License-Identifier: MIT
// The functions that the table of rules is made of; the meaning of each is in rules.h.
// Test: tests/eval/compile_test.cpp
#pragma once

#include "eval/rules.h"
#include "scene/formula.h"

namespace rigc::eval {

using Plugs = std::vector<scene::Plug>;
using Operands = std::vector<Operand>;

// rules_constraints.cpp
Plugs constraint_reads(const scene::Scene& scene, scene::NodeId node);
std::optional<Operand> constraint_emit(Emitter& emitter, const scene::Scene& scene,
                                       scene::NodeId node, const Operands& arguments,
                                       Diagnostics& diagnostics);
OutputPlace constraint_place(const scene::Plug& output);
Plugs aim_reads(const scene::Scene& scene, scene::NodeId node);
std::optional<Operand> aim_emit(Emitter& emitter, const scene::Scene& scene, scene::NodeId node,
                                const Operands& arguments, Diagnostics& diagnostics);
OutputPlace aim_place(const scene::Plug& output);

// rules_ik.cpp
Plugs two_bone_reads(const scene::Scene& scene, scene::NodeId node);
std::optional<Operand> two_bone_emit(Emitter& emitter, const scene::Scene& scene,
                                     scene::NodeId node, const Operands& arguments,
                                     Diagnostics& diagnostics);
OutputPlace two_bone_place(const scene::Plug& output);
Plugs chain_reads(const scene::Scene& scene, scene::NodeId node);
std::optional<Operand> chain_emit(Emitter& emitter, const scene::Scene& scene, scene::NodeId node,
                                  const Operands& arguments, Diagnostics& diagnostics);
OutputPlace chain_place(const scene::Plug& output);

// rules_compute.cpp
Plugs compute_reads(const scene::Scene& scene, const scene::Plug& output);
Plugs compute_reads_with(Programs& programs, const scene::Scene& scene, const scene::Plug& output);
std::optional<Operand> compute_emit(Emitter& emitter, Programs& programs, const scene::Scene& scene,
                                    const scene::Plug& output, const Operands& arguments,
                                    Diagnostics& diagnostics);
/// The instructions of the steps of a formula that `step` needs; `inputs`: of each input step, by
/// the step's index.
Operand emit_steps(Emitter& emitter, const scene::Formula& formula, int step,
                   const Operands& inputs, std::uint32_t node);

// rules_spline.cpp
Plugs spline_reads(const scene::Scene& scene, scene::NodeId node);
std::optional<Operand> spline_emit(Emitter& emitter, const scene::Scene& scene, scene::NodeId node,
                                   const Operands& arguments, Diagnostics& diagnostics);
OutputPlace spline_place(const scene::Plug& output);

// rules_numbers.cpp
Plugs expression_reads(const scene::Scene& scene, scene::NodeId node);
std::optional<Operand> expression_emit(Emitter& emitter, const scene::Scene& scene,
                                       scene::NodeId node, const Operands& arguments,
                                       Diagnostics& diagnostics);
Plugs remap_reads(const scene::Scene& scene, scene::NodeId node);
std::optional<Operand> remap_emit(Emitter& emitter, const scene::Scene& scene, scene::NodeId node,
                                  const Operands& arguments, Diagnostics& diagnostics);
OutputPlace number_place(const scene::Plug& output);

/// Elements that an array attribute has.
std::size_t element_count(const scene::Scene& scene, scene::NodeId node, std::uint16_t attribute);
/// Appends the numbers of an attribute's value, of all elements where it is an array; rotations at
/// unit length.
void append(std::vector<double>& data, const scene::Scene& scene, scene::NodeId node,
            std::uint16_t attribute);
/// Reports kBadNode; gives nothing, so that rules can return it.
std::nullopt_t bad_node(const scene::Scene& scene, scene::NodeId node, const std::string& message,
                        Diagnostics& diagnostics);

}  // namespace rigc::eval
