// SPDX-License-Identifier: MIT
// The rotation that best takes one set of points to another, from their correlation.
// Test: tests/math/rotation_fit_test.cpp
#include <array>
#include <cmath>

#include "math/math.h"

namespace rigc::math {
namespace {

using Symmetric = std::array<std::array<double, 4>, 4>;

constexpr int kSweeps = 12;         // Jacobi converges quadratically; 6 are enough for doubles
constexpr double kLeastGap = 1e-6;  // between the two largest eigenvalues, of the largest

/// Horn's matrix: q^T N q is the trace that a rotation q gives.
Symmetric horn(const Mat3& m) {
  // m's columns are sums of to * from.x and so on: s.x.y is from x to y.
  const Vec3 x = m.x, y = m.y, z = m.z;
  Symmetric n{};
  n[0] = {x.x + y.y + z.z, y.z - z.y, z.x - x.z, x.y - y.x};
  n[1] = {0, x.x - y.y - z.z, x.y + y.x, z.x + x.z};
  n[2] = {0, 0, -x.x + y.y - z.z, y.z + z.y};
  n[3] = {0, 0, 0, -x.x - y.y + z.z};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j) n[i][j] = n[j][i];
  return n;
}

/// One rotation in the plane of axes p and q that makes n[p][q] zero.
void rotate_plane(Symmetric& n, Symmetric& vectors, std::size_t p, std::size_t q) {
  if (n[p][q] == 0) return;
  const double theta = (n[q][q] - n[p][p]) / (2 * n[p][q]);
  const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + sqrt(theta * theta + 1));
  const double c = 1 / sqrt(t * t + 1), s = t * c;
  const auto turn = [&](double& a, double& b) {
    const double old = a;
    a = c * old - s * b;
    b = s * old + c * b;
  };
  for (std::size_t k = 0; k < 4; ++k) turn(n[k][p], n[k][q]);
  for (std::size_t k = 0; k < 4; ++k) turn(n[p][k], n[q][k]);
  for (std::size_t k = 0; k < 4; ++k) turn(vectors[k][p], vectors[k][q]);
}

}  // namespace

std::optional<Quat> fit_rotation(const Mat3& correlation) {
  Symmetric n = horn(correlation);
  Symmetric vectors{};
  for (std::size_t i = 0; i < 4; ++i) vectors[i][i] = 1;
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::size_t p = 0; p < 3; ++p)
      for (std::size_t q = p + 1; q < 4; ++q) rotate_plane(n, vectors, p, q);
  std::size_t best = 0;
  for (std::size_t i = 1; i < 4; ++i)
    if (n[i][i] > n[best][best]) best = i;
  for (std::size_t i = 0; i < 4; ++i)
    if (i != best && !(n[best][best] - n[i][i] > kLeastGap * n[best][best])) return std::nullopt;
  return normalised(Quat{vectors[1][best], vectors[2][best], vectors[3][best], vectors[0][best]});
}

}  // namespace rigc::math
