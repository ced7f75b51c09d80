// SPDX-License-Identifier: MIT
// The formulas of math/generic/quaternions.h for one rotation. Test: tests/math/quaternion_test.cpp
#include "math/generic/quaternions.h"

namespace rigc::math {

Quat normalised(Quat q) { return generic::normalised(q); }
Quat slerp(Quat a, Quat b, double t) { return generic::slerp(a, b, t); }
Quat axis_angle(Vec3 unit_axis, double radians) { return generic::axis_angle(unit_axis, radians); }
Quat between(Vec3 a, Vec3 b) { return generic::between(a, b); }
Mat3 matrix(Quat q) { return generic::matrix(q); }
Quat quaternion(const Mat3& m) { return generic::quaternion(m); }
Quat from_euler_degrees(Vec3 degrees) { return generic::from_euler_degrees(degrees); }
Vec3 to_euler_degrees(Quat q) { return generic::to_euler_degrees(q); }

}  // namespace rigc::math
