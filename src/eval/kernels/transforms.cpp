// SPDX-License-Identifier: MIT
// Kernels of transforms. The two hot ones walk row by row with the lanes innermost, so that
// compilers turn them into vector code. Test: tests/eval/transforms_test.cpp
#include <cmath>

#include "eval/kernels/table.h"

namespace rigc::eval {

void compose(const Call& call) {
  const double* __restrict t = call.in(0);
  const double* __restrict q = call.in(1);
  const double* __restrict s = call.in(2);
  double* __restrict out = call.result();
  double unit[4][kLanes];
  for (int lane = 0; lane < kLanes; ++lane) {
    const double x = q[lane], y = q[kLanes + lane], z = q[2 * kLanes + lane];
    const double w = q[3 * kLanes + lane];
    const double squares = x * x + y * y + z * z + w * w;
    // A lost rotation is none, as in math::normalised; `&` because a branch would keep vectors
    // away.
    const bool found = (squares > 1e-60) & (squares < 1e300);
    const double size = std::sqrt(found ? squares : 1.0);
    unit[0][lane] = found ? x / size : 0.0;
    unit[1][lane] = found ? y / size : 0.0;
    unit[2][lane] = found ? z / size : 0.0;
    unit[3][lane] = found ? w / size : 1.0;
  }
  for (int lane = 0; lane < kLanes; ++lane) {
    const double x = unit[0][lane], y = unit[1][lane], z = unit[2][lane], w = unit[3][lane];
    const double sx = s[lane], sy = s[kLanes + lane], sz = s[2 * kLanes + lane];
    out[lane] = (1 - 2 * (y * y + z * z)) * sx;
    out[kLanes + lane] = 2 * (x * y + w * z) * sx;
    out[2 * kLanes + lane] = 2 * (x * z - w * y) * sx;
    out[3 * kLanes + lane] = 2 * (x * y - w * z) * sy;
    out[4 * kLanes + lane] = (1 - 2 * (x * x + z * z)) * sy;
    out[5 * kLanes + lane] = 2 * (y * z + w * x) * sy;
    out[6 * kLanes + lane] = 2 * (x * z + w * y) * sz;
    out[7 * kLanes + lane] = 2 * (y * z - w * x) * sz;
    out[8 * kLanes + lane] = (1 - 2 * (x * x + y * y)) * sz;
  }
  for (int i = 0; i < 3 * kLanes; ++i) out[9 * kLanes + i] = t[i];
}

void multiply(const Call& call) {
  const double* __restrict a = call.in(0);
  const double* __restrict b = call.in(1);
  double* __restrict out = call.result();
  for (int column = 0; column < 4; ++column) {
    const double* __restrict from = b + 3 * column * kLanes;
    for (int r = 0; r < 3; ++r) {
      const double* __restrict ax = a + r * kLanes;
      double* __restrict to = out + (3 * column + r) * kLanes;
      for (int lane = 0; lane < kLanes; ++lane) {
        to[lane] = ax[lane] * from[lane] + ax[3 * kLanes + lane] * from[kLanes + lane] +
                   ax[6 * kLanes + lane] * from[2 * kLanes + lane];
      }
    }
  }
  for (int i = 0; i < 3 * kLanes; ++i) out[9 * kLanes + i] += a[9 * kLanes + i];
}

void gather(const Call& call) {
  double* out = call.result();
  for (std::uint32_t argument = 0; argument < call.argument_count; ++argument) {
    const double* in = call.in(argument);
    const auto count = static_cast<int>(call.arguments[argument].width) * kLanes;
    for (int i = 0; i < count; ++i) out[i] = in[i];
    out += count;
  }
}

void from_euler(const Call& call) {
  for (int lane = 0; lane < kLanes; ++lane) {
    write(call.result(), lane, math::from_euler_degrees(read_vec3(call.in(0), lane)));
  }
}

void to_euler(const Call& call) {
  for (int lane = 0; lane < kLanes; ++lane) {
    write(call.result(), lane, math::to_euler_degrees(read_quat(call.in(0), lane)));
  }
}

}  // namespace rigc::eval
