// SPDX-License-Identifier: MIT
// Kernels of transforms. Test: tests/eval/transforms_test.cpp
#pragma once

#include "eval/kernels/lanes.h"

namespace rigc::eval {
namespace {

/// translation, rotation (of any length), scale -> T * R * S
struct Compose {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const Mat3 r = generic::matrix(lanes.quat(1));
    const Vec3 scale = lanes.vec3(2);
    lanes.put(0, Affine{{r.x * scale.x, r.y * scale.y, r.z * scale.z}, lanes.vec3(0)});
  }
};

/// translation, rotation (of any length) -> T * R; the bits of Compose with scale 1
struct ComposeRigid {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, Affine{generic::matrix(lanes.quat(1)), lanes.vec3(0)});
  }
};

/// translation, rotation; data: t, unit q -> translation(t) * rotation(q) * T * R
struct ComposeUnder {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const Quat above = quat_at(lanes.data() + 3);
    lanes.put(0, Affine{generic::matrix(above * generic::moderate(lanes.quat(1))),
                        rotate(above, lanes.vec3(0)) + vec3_at(lanes.data())});
  }
};

/// a, b -> a * b
struct Multiply {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, lanes.affine(0) * lanes.affine(1));
  }
};

// Worlds of joints whose rests are constants: `turned` is a matrix that has the joint's rotation,
// `parent` the one whose space its place is in.

/// parent, turned; data: 9 numbers L, t -> linear of turned * L, origin parent * t
struct Hang {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const Affine own = affine_at(lanes.data());
    lanes.put(0, Affine{lanes.affine(1).linear * own.linear, lanes.affine(0) * own.origin});
  }
};

/// parent, turned; data: t -> linear of turned, origin parent * t
struct HangStraight {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, Affine{lanes.affine(1).linear, lanes.affine(0) * vec3_at(lanes.data())});
  }
};

/// parent, turned, t -> linear of turned, origin parent * t
struct Place {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, Affine{lanes.affine(1).linear, lanes.affine(0) * lanes.vec3(2)});
  }
};

/// any registers -> one after the other
struct Gather {
  RIGC_INLINE static void run(const Lanes& lanes) {
    std::size_t out = 0;
    for (std::size_t argument = 0; argument < lanes.count(); ++argument) {
      for (std::size_t row = 0; row < lanes.width(argument); ++row)
        lanes.put(out++, lanes.number(argument, row));
    }
  }
};

struct FromEuler {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, generic::from_euler_degrees(lanes.vec3(0)));
  }
};

struct ToEuler {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, generic::to_euler_degrees(lanes.quat(0)));
  }
};

}  // namespace
}  // namespace rigc::eval
