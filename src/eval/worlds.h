// SPDX-License-Identifier: MIT
// Worlds of transforms in as few instructions as they need. Constants that meet under what moves
// are multiplied when compiling, so that a static chain under a moving parent costs one
// instruction. Values change by rounding alone. Test: tests/eval/worlds_test.cpp
#pragma once

#include <optional>

#include "eval/emitter.h"

namespace rigc::eval {

/// The operands of one transform: its parent's world, if it hangs under anything, and its own
/// values.
struct Placement {
  std::optional<Operand> parent;
  Operand translate, rotation, scale;
};

/// The world of a transform. `node`: index of its scene node.
Operand emit_world(Emitter& emitter, const Placement& placement, std::uint32_t node);

/// T * R * S.
Operand emit_compose(Emitter& emitter, const Placement& placement, std::uint32_t node);

/// a * b.
Operand emit_product(Emitter& emitter, const Operand& a, const Operand& b, std::uint32_t node);

/// A matrix whose linear part is that of `turned` times `linear` and whose origin is `parent` times
/// `translate`.
Operand emit_hang(Emitter& emitter, const Operand& parent, const Operand& turned,
                  const math::Mat3& linear, const Operand& translate, std::uint32_t node);

}  // namespace rigc::eval
