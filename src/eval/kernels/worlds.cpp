// SPDX-License-Identifier: MIT
// Kernels of transforms with constants folded into them: row by row, lanes innermost, as in
// transforms.cpp. Test: tests/eval/worlds_kernels_test.cpp
#include <cmath>

#include "eval/kernels/table.h"

namespace rigc::eval {

namespace {

using Row = double[kLanes];

// A rotation at unit length; a lost one is none, as in math::normalised.
void read_unit(const double* __restrict q, Row* __restrict unit) {
  for (int lane = 0; lane < kLanes; ++lane) {
    const double x = q[lane], y = q[kLanes + lane], z = q[2 * kLanes + lane];
    const double w = q[3 * kLanes + lane];
    const double squares = x * x + y * y + z * z + w * w;
    const bool found = (squares > 1e-60) & (squares < 1e300);
    const double size = std::sqrt(found ? squares : 1.0);
    unit[0][lane] = found ? x / size : 0.0;
    unit[1][lane] = found ? y / size : 0.0;
    unit[2][lane] = found ? z / size : 0.0;
    unit[3][lane] = found ? w / size : 1.0;
  }
}

void write_rotation(const Row* __restrict q, double* __restrict out) {
  for (int lane = 0; lane < kLanes; ++lane) {
    const double x = q[0][lane], y = q[1][lane], z = q[2][lane], w = q[3][lane];
    out[lane] = 1 - 2 * (y * y + z * z);
    out[kLanes + lane] = 2 * (x * y + w * z);
    out[2 * kLanes + lane] = 2 * (x * z - w * y);
    out[3 * kLanes + lane] = 2 * (x * y - w * z);
    out[4 * kLanes + lane] = 1 - 2 * (x * x + z * z);
    out[5 * kLanes + lane] = 2 * (y * z + w * x);
    out[6 * kLanes + lane] = 2 * (x * z + w * y);
    out[7 * kLanes + lane] = 2 * (y * z - w * x);
    out[8 * kLanes + lane] = 1 - 2 * (x * x + y * y);
  }
}

// out = linear part of a * (x, y, z), rows of a being kLanes apart.
void turn(const double* __restrict a, double x, double y, double z, double* __restrict out) {
  for (int r = 0; r < 3; ++r) {
    const double* __restrict row = a + r * kLanes;
    for (int lane = 0; lane < kLanes; ++lane) {
      out[r * kLanes + lane] =
          row[lane] * x + row[3 * kLanes + lane] * y + row[6 * kLanes + lane] * z;
    }
  }
}

void copy_linear(const double* __restrict from, double* __restrict out) {
  for (int i = 0; i < 9 * kLanes; ++i) out[i] = from[i];
}

void add_origin(const double* __restrict parent, double* __restrict out) {
  for (int i = 9 * kLanes; i < 12 * kLanes; ++i) out[i] += parent[i];
}

}  // namespace

void compose_rigid(const Call& call) {
  const double* __restrict t = call.in(0);
  double* __restrict out = call.result();
  Row unit[4];
  read_unit(call.in(1), unit);
  write_rotation(unit, out);
  for (int i = 0; i < 3 * kLanes; ++i) out[9 * kLanes + i] = t[i];
}

void compose_under(const Call& call) {
  const double* __restrict t = call.in(0);
  double* __restrict out = call.result();
  const math::Vec3 origin{call.data[0], call.data[1], call.data[2]};
  const math::Quat a{call.data[3], call.data[4], call.data[5], call.data[6]};
  const math::Mat3 m = math::matrix(a);
  Row unit[4], product[4];
  read_unit(call.in(1), unit);
  for (int lane = 0; lane < kLanes; ++lane) {
    const math::Quat q = a * math::Quat{unit[0][lane], unit[1][lane], unit[2][lane], unit[3][lane]};
    product[0][lane] = q.x;
    product[1][lane] = q.y;
    product[2][lane] = q.z;
    product[3][lane] = q.w;
  }
  write_rotation(product, out);
  for (int lane = 0; lane < kLanes; ++lane)
    write(out + 9 * kLanes, lane, m * read_vec3(t, lane) + origin);
}

void hang(const Call& call) {
  const double* __restrict parent = call.in(0);
  const double* __restrict turned = call.in(1);
  double* __restrict out = call.result();
  const double* n = call.data;
  for (int column = 0; column < 3; ++column)
    turn(turned, n[3 * column], n[3 * column + 1], n[3 * column + 2], out + 3 * column * kLanes);
  turn(parent, n[9], n[10], n[11], out + 9 * kLanes);
  add_origin(parent, out);
}

void hang_straight(const Call& call) {
  const double* __restrict parent = call.in(0);
  double* __restrict out = call.result();
  copy_linear(call.in(1), out);
  turn(parent, call.data[0], call.data[1], call.data[2], out + 9 * kLanes);
  add_origin(parent, out);
}

void place(const Call& call) {
  const double* __restrict parent = call.in(0);
  const double* __restrict t = call.in(2);
  double* __restrict out = call.result();
  copy_linear(call.in(1), out);
  for (int lane = 0; lane < kLanes; ++lane)
    write(out + 9 * kLanes, lane, read_affine(parent, lane) * read_vec3(t, lane));
}

}  // namespace rigc::eval
