// SPDX-License-Identifier: MIT
// Worlds of transforms that a constraint drives, without a way through the parent's space.
//
// A constraint gives its driven transform values in the parent's space: decompose(P^-1 * T * O) of
// parent P, target T and offset O, which the transform's world then takes back: P * compose(...).
// Where P and T are similarities (rotation, one positive factor, origin) this is T * O, turned and
// scaled as the transform is: decompose takes the rotation of a similarity off the left of a
// matrix unchanged, and P only turns, moves and stretches evenly what means are taken of, so that
// means by lerp and slerp are the same in the world as in the parent's space. The difference is
// rounding, except where two targets are a half turn apart: which way round is nearer is then
// rounding's choice in either space.
//
// It is done where all of this holds, else the general path is taken:
// - the rotation comes whole from one constraint or aim, with no limit, lock or component between,
//   whose parent is the transform's own;
// - parent and targets are similarities for certain (Definition::factor): where anything above is
//   scaled unevenly, or by what may be negative or 0, they are not;
// - offsets span space (mirrored and uneven ones may);
// - of several targets: all would give the transform the same constant size.
// Test: tests/eval/direct_test.cpp
#pragma once

#include <optional>

#include "eval/worlds.h"

namespace rigc::eval {

/// The world of a transform that something drives, where it needs no parent space; else nothing.
std::optional<Operand> emit_driven(Emitter& emitter, const Placement& placement,
                                   std::uint32_t node);

}  // namespace rigc::eval
