// SPDX-License-Identifier: MIT
// Vectors, quaternions, transforms, and elementary functions that give the same bits on every
// machine. Right-handed, Y up, column vectors, quaternions x y z w, radians unless a name says
// degrees. Test: tests/math/*_test.cpp
#pragma once

#include <optional>

#include "math/types.h"

namespace rigc::math {

inline constexpr double kPi = 3.14159265358979323846;

double length(Vec3 a);
/// `a` at unit length, or `fallback` where it is shorter than 1e-30.
Vec3 normalised(Vec3 a, Vec3 fallback = {1, 0, 0});
/// Any unit vector at right angles to unit vector `a`, the same for the same `a`.
Vec3 perpendicular(Vec3 a);

Mat3 transposed(const Mat3& a);
double determinant(const Mat3& a);
/// Inverse; the zero matrix where `a` is singular (its columns span less than 1e-14 of their box).
Mat3 inverse(const Mat3& a);

Affine inverse(const Affine& a);
Affine translation(Vec3 v);
Affine rotation(Quat q);

/// Unit length, identity where `q` is shorter than 1e-30.
Quat normalised(Quat q);
/// The nearer way round; `t` in 0..1. Source: Shoemake 1985.
Quat slerp(Quat a, Quat b, double t);
Quat axis_angle(Vec3 unit_axis, double radians);
/// The shortest rotation that takes unit vector `a` to unit vector `b`; half turns about
/// perpendicular(a).
Quat between(Vec3 a, Vec3 b);

/// Of a quaternion of any length, identity where it is shorter than 1e-30.
Mat3 matrix(Quat q);
/// Rotation of an orthonormal right-handed matrix, w >= 0. Source: Shepperd 1978.
Quat quaternion(const Mat3& m);
/// Applied X first, then Y, then Z, about fixed axes: R = Rz * Ry * Rx. Degrees.
Quat from_euler_degrees(Vec3 degrees);
/// The inverse; at +-90 degrees of Y, Z is 0.
Vec3 to_euler_degrees(Quat q);

/// The orthonormal right-handed frame nearest to `m` by Gram-Schmidt on x, then y: what "rotation
/// of a matrix" means throughout rigc. Columns of zero length and mirrored matrices (z is flipped)
/// are handled.
Mat3 orthonormal(const Mat3& m);
/// A right-handed frame whose x is `primary` (unit) and whose y is `secondary` made perpendicular
/// to it; where they are parallel, perpendicular(primary).
Mat3 frame(Vec3 primary, Vec3 secondary);

/// The rotation R with the smallest sum of |to - R * from|^2, where column i of `correlation` is
/// the sum of to * from[i]. Empty where there is no single one, as for points on a line. Source:
/// Horn 1987, "Closed-form solution of absolute orientation using unit quaternions".
std::optional<Quat> fit_rotation(const Mat3& correlation);

Affine compose(const Trs& trs);
/// T, R = orthonormal(linear), S = diagonal of R^T * linear: exact where there is no shear,
/// negative z scale where mirrored.
Trs decompose(const Affine& a);
/// Largest entry of linear(a) - R*S of decompose(a), relative to the largest scale: 0 where there
/// is no shear.
double shear(const Affine& a);

/// Elementary functions: the same bits on every machine, within some ulp of the true value (which
/// is in math/generic/{trigonometry,exponential}.h). Every argument gives a finite result: NaN is
/// read as 0, infinities as the largest number.
double sqrt(double x);  ///< correctly rounded; 0 for negative x
double cbrt(double x);  ///< of either sign
double sin(
    double radians);  ///< |x| up to 1e6; above, of the remainder by the nearest double to 2 pi
double cos(double radians);
double tan(double radians);
double atan(double x);
double atan2(double y, double x);
double asin(double x);  ///< x is clamped to -1..1
double acos(double x);
double exp(double x);
double log(double x);            ///< of the smallest positive number where x <= 0
double pow(double x, double y);  ///< for x < 0 only integer y, else 0; 0 to a negative power is 0
double sin_degrees(double degrees);  ///< exact at multiples of 90
double cos_degrees(double degrees);
double tan_degrees(double degrees);  ///< 0 at odd multiples of 90

inline double radians(double degrees) { return degrees * (kPi / 180); }
inline double degrees(double radians) { return radians * (180 / kPi); }

}  // namespace rigc::math
