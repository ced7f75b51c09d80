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

/// a, b -> a * b
struct Multiply {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, lanes.affine(0) * lanes.affine(1));
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
