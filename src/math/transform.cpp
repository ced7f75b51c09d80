// SPDX-License-Identifier: MIT
// The formulas of math/generic/transforms.h for one transform. Test: tests/math/transform_test.cpp
#include "math/generic/transforms.h"

#include <cmath>

namespace rigc::math {

Mat3 transposed(const Mat3& a) { return generic::transposed(a); }
double determinant(const Mat3& a) { return generic::determinant(a); }
Mat3 inverse(const Mat3& a) { return generic::inverse(a); }
Affine inverse(const Affine& a) { return generic::inverse(a); }
Affine translation(Vec3 v) { return {{}, v}; }
Affine rotation(Quat q) { return {matrix(q), {}}; }
Mat3 orthonormal(const Mat3& m) { return generic::orthonormal(m); }
Mat3 frame(Vec3 primary, Vec3 secondary) { return generic::frame(primary, secondary); }
Affine compose(const Trs& trs) { return generic::compose(trs); }
Trs decompose(const Affine& a) { return generic::decompose(a); }

double shear(const Affine& a) {
  const Trs parts = decompose(a);
  const Affine rigid = compose(parts);
  double largest = 0, difference = 0;
  for (std::size_t column = 0; column < 3; ++column) {
    const Vec3& of_a = column == 0 ? a.linear.x : column == 1 ? a.linear.y : a.linear.z;
    const Vec3& of_rigid = column == 0   ? rigid.linear.x
                           : column == 1 ? rigid.linear.y
                                         : rigid.linear.z;
    largest = std::fmax(largest, length(of_a));
    for (std::size_t row = 0; row < 3; ++row) {
      difference = std::fmax(difference, std::fabs(of_a[row] - of_rigid[row]));
    }
  }
  return largest > 0 ? difference / largest : 0;
}

}  // namespace rigc::math
