// SPDX-License-Identifier: MIT
// Conjugates keys. Test: tests/update/convert_test.cpp
#include "update/convert.h"

#include <cmath>

namespace rigc::update {
namespace {

using math::Mat3;
using math::Quat;
using math::Vec3;

/// Rests are computed from positions: what differs by less is rounding.
constexpr double kRounding = 1e-9;

double snapped(double x) {
  const double nearest = std::nearbyint(x);
  return std::abs(x - nearest) < kRounding ? nearest : x;
}

/// Right angles exactly, so that keys only change places and signs.
Mat3 snapped(const Mat3& m) {
  Mat3 out = m;
  for (Vec3* column : {&out.x, &out.y, &out.z})
    for (std::size_t i = 0; i < 3; ++i) (*column)[i] = snapped((*column)[i]);
  return out;
}

bool is_permutation(const Mat3& m) {
  for (const Vec3& column : {m.x, m.y, m.z}) {
    int ones = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (std::abs(column[i]) == 1) ++ones;
      if (column[i] != 0 && std::abs(column[i]) != 1) return false;
    }
    if (ones != 1) return false;
  }
  return true;
}

Mat3 times(const Mat3& m, double s) { return {m.x * s, m.y * s, m.z * s}; }

bool near(const math::Trs& a, const math::Trs& b) {
  const Vec3 moved = a.translation - b.translation, scaled = a.scale - b.scale;
  const Quat turned = conjugate(a.rotation) * b.rotation;
  return math::length(moved) < kRounding && math::length(scaled) < kRounding &&
         math::length({turned.x, turned.y, turned.z}) < kRounding;
}

}  // namespace

Conversion::Conversion(const Frame& before, const Frame& now) : before_(before), now_(now) {
  linear_ = snapped(math::inverse(now.space) * before.space);
  const double determinant = math::determinant(linear_);
  if (!(std::abs(determinant) > 1e-12)) return;  // axes without extent say nothing
  sign_ = determinant < 0 ? -1 : 1;
  turn_ = snapped(times(math::orthonormal(times(linear_, sign_)), sign_));
  at_rest_ = before.rest == math::Trs{} && now.rest == math::Trs{};
  permutes_ = is_permutation(turn_);
  identity_ = linear_ == Mat3{} && near(before.rest, now.rest);
}

Vec3 Conversion::vector_part(const Vec3& v) const { return turn_ * v * sign_; }

Vec3 Conversion::translation(const Vec3& value) const {
  if (at_rest_) return linear_ * value;
  return now_.rest.translation + linear_ * (value - before_.rest.translation);
}

Quat Conversion::rotation(const Quat& value) const {
  const auto turned = [&](const Quat& q) {
    const Vec3 v = vector_part({q.x, q.y, q.z});
    return Quat{v.x, v.y, v.z, q.w};
  };
  if (at_rest_) return turned(value);
  return turned(value * conjugate(before_.rest.rotation)) * now_.rest.rotation;
}

Vec3 Conversion::scale(const Vec3& value) const {
  if (!permutes_) return value;
  const auto size = [](const Vec3& v) { return Vec3{std::abs(v.x), std::abs(v.y), std::abs(v.z)}; };
  const Mat3 order{size(turn_.x), size(turn_.y), size(turn_.z)};
  return order * value;
}

bool Conversion::apply(anim::Path path, anim::Curve& curve) const {
  if (identity_ || path == anim::Path::weights || path == anim::Path::attribute) return true;
  const auto width = static_cast<std::size_t>(curve.width);
  const bool cubic = curve.interpolation == anim::Interpolation::cubic;
  if (path == anim::Path::scale && !permutes_) {
    for (std::size_t i = 0; i + width <= curve.values.size(); i += width)
      if (curve.values[i] != curve.values[i + 1] || curve.values[i] != curve.values[i + 2])
        return false;
    return true;
  }
  for (std::size_t i = 0; i + width <= curve.values.size(); i += width) {
    float* const at = curve.values.data() + i;
    // Tangents are differences: they know no rest.
    const bool tangent = cubic && i / width % 3 != 1;
    if (path == anim::Path::rotation) {
      const Quat q = rotation({at[0], at[1], at[2], at[3]});
      const double numbers[] = {q.x, q.y, q.z, q.w};
      for (std::size_t k = 0; k < 4; ++k) at[k] = static_cast<float>(numbers[k]);
      continue;
    }
    const Vec3 value{at[0], at[1], at[2]};
    const Vec3 v = path == anim::Path::scale ? scale(value)
                   : tangent                 ? linear_ * value
                                             : translation(value);
    for (std::size_t k = 0; k < 3; ++k) at[k] = static_cast<float>(v[k]);
  }
  return true;
}

}  // namespace rigc::update
