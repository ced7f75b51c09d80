// SPDX-License-Identifier: MIT
// Keys of a node whose zero has turned: conjugated, so that the motion in its parent's space stays.
// Test: tests/update/convert_test.cpp
#pragma once

#include "anim/clip.h"
#include "update/match.h"

namespace rigc::update {

/// How local transforms change. With L the change of axes, a node that was moved by t and turned by
/// q from its rest is moved by L t and turned by L q L^-1; both are linear in the numbers of a key,
/// so that tangents change in the same way and interpolation gives the same motion.
class Conversion {
 public:
  Conversion() = default;  ///< nothing changes
  Conversion(const Frame& before, const Frame& now);

  bool is_identity() const { return identity_; }
  /// Whether scale can be said about the new axes: they are the old ones in another order.
  bool keeps_scale() const { return permutes_; }

  math::Vec3 translation(const math::Vec3& value) const;
  math::Quat rotation(const math::Quat& value) const;
  math::Vec3 scale(const math::Vec3& value) const;
  /// All keys and tangents of a curve on translation, rotation or scale. False where its scale
  /// cannot be said about the new axes; then it stays as it is.
  bool apply(anim::Path path, anim::Curve& curve) const;

 private:
  math::Vec3 vector_part(const math::Vec3& v) const;

  bool identity_ = true;
  bool permutes_ = true;
  bool at_rest_ = true;  ///< both rests are the identity, as those of controls
  math::Mat3 linear_;    ///< old parent's axes as the new parent sees them
  math::Mat3 turn_;      ///< the same without scale: of determinant 1 or -1
  double sign_ = 1;      ///< its determinant
  Frame before_, now_;
};

}  // namespace rigc::update
