// SPDX-License-Identifier: MIT
// Keys of a control whose zero turned: the motion that it makes is compared, not the numbers.
#include "update/convert.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/skeletons.h"

namespace rigc {
namespace {

using anim::Curve;
using anim::Interpolation;
using anim::Path;
using math::Mat3;
using math::Quat;
using math::Vec3;
using test::Random;
using update::Conversion;
using update::Frame;

Frame frame_of(const Mat3& space) { return {space, {}}; }
Mat3 times(const Mat3& m, double s) { return {m.x * s, m.y * s, m.z * s}; }

Quat rotation_about(Vec3 axis, double degrees) {
  return math::axis_angle(math::normalised(axis), degrees * math::kPi / 180);
}

double difference(const Mat3& a, const Mat3& b) {
  return std::max({length(a.x - b.x), length(a.y - b.y), length(a.z - b.z)});
}

Curve random_curve(Random& random, Path path, Interpolation interpolation, const Vec3& rest = {}) {
  Curve curve;
  curve.interpolation = interpolation;
  curve.width = path == Path::rotation ? 4 : 3;
  curve.times = std::make_shared<const std::vector<float>>(std::vector<float>{0, 1, 2.5f, 3});
  const bool cubic = interpolation == Interpolation::cubic;
  for (std::size_t key = 0; key < 4; ++key) {
    for (int part = 0; part < (cubic ? 3 : 1); ++part) {
      const bool tangent = cubic && part != 1;
      if (path == Path::rotation) {
        Quat q = random.rotation();
        if (tangent) q = {q.x * 0.3, q.y * 0.3, q.z * 0.3, q.w * 0.3};
        for (const double n : {q.x, q.y, q.z, q.w}) curve.values.push_back(static_cast<float>(n));
        continue;
      }
      const Vec3 v = random.vector(1) + (tangent ? Vec3{} : rest);
      for (std::size_t i = 0; i < 3; ++i) curve.values.push_back(static_cast<float>(v[i]));
    }
  }
  return curve;
}

Vec3 vector_at(const Curve& curve, double time) {
  double n[4];
  anim::sample(curve, false, time, n);
  return {n[0], n[1], n[2]};
}

Quat rotation_at(const Curve& curve, double time) {
  double n[4];
  anim::sample(curve, true, time, n);
  return {n[0], n[1], n[2], n[3]};
}

/// How a rotation in a frame turns what is seen in rig space, away from the frame's rest.
Mat3 turn_in_rig(const Frame& frame, const Quat& value) {
  const Quat away = value * conjugate(frame.rest.rotation);
  return frame.space * math::matrix(math::normalised(away)) * math::inverse(frame.space);
}

Vec3 move_in_rig(const Frame& frame, const Vec3& value) {
  return frame.space * (value - frame.rest.translation);
}

/// Largest difference of the motion in rig space, between the keys too.
double motion_difference(const Frame& before, const Frame& now, Path path,
                         Interpolation interpolation, Random& random) {
  const Curve old = random_curve(random, path, interpolation, before.rest.translation);
  Curve fresh = old;
  CHECK(Conversion(before, now).apply(path, fresh));
  double largest = 0;
  for (double time = -0.5; time <= 3.5; time += 0.07) {
    const double step = path == Path::rotation
                            ? difference(turn_in_rig(before, rotation_at(old, time)),
                                         turn_in_rig(now, rotation_at(fresh, time)))
                            : length(move_in_rig(before, vector_at(old, time)) -
                                     move_in_rig(now, vector_at(fresh, time)));
    largest = std::max(largest, step);
  }
  return largest;
}

constexpr Interpolation kAll[] = {Interpolation::step, Interpolation::linear, Interpolation::cubic};

}  // namespace

TEST_CASE("convert: between random axes the interpolated motion stays, for all interpolations") {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Frame before = frame_of(math::matrix(random.rotation()));
    const Frame now = frame_of(math::matrix(random.rotation()));
    CHECK(!Conversion(before, now).is_identity());
    for (const Interpolation interpolation : kAll)
      for (const Path path : {Path::translation, Path::rotation})
        CHECK(motion_difference(before, now, path, interpolation, random) < 2e-6);
  }
}

TEST_CASE("convert: a mirrored parent, and parents of other sizes") {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const Mat3 mirror{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const Frame before = frame_of(times(math::matrix(random.rotation()), random.number(0.5, 2)));
    const Frame now =
        frame_of(times(math::matrix(random.rotation()) * mirror, random.number(0.5, 2)));
    for (const Interpolation interpolation : kAll)
      for (const Path path : {Path::translation, Path::rotation})
        CHECK(motion_difference(before, now, path, interpolation, random) < 5e-6);
  }
}

TEST_CASE("convert: rests that are not the identity") {
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    Frame before = frame_of(math::matrix(random.rotation()));
    Frame now = frame_of(math::matrix(random.rotation()));
    before.rest = {random.vector(1), random.rotation(), {1, 1, 1}};
    now.rest = {random.vector(1), random.rotation(), {1, 1, 1}};
    const Conversion conversion(before, now);
    CHECK(length(conversion.translation(before.rest.translation) - now.rest.translation) < 1e-12);
    CHECK(std::abs(dot(conversion.rotation(before.rest.rotation), now.rest.rotation)) > 1 - 1e-12);
    for (const Interpolation interpolation : kAll)
      for (const Path path : {Path::translation, Path::rotation})
        CHECK(motion_difference(before, now, path, interpolation, random) < 5e-6);
  }
}

TEST_CASE("convert: right angles change places and signs of numbers and nothing else") {
  Random random(4);
  const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vec3& axis : axes) {
    for (const double degrees : {90.0, 180.0, -90.0}) {
      const Frame before = frame_of(math::matrix(random.rotation()));
      const Frame now = frame_of(before.space * math::matrix(rotation_about(axis, degrees)));
      const Conversion there(before, now), back(now, before);
      CHECK(there.keeps_scale());
      for (const Interpolation interpolation : kAll) {
        for (const Path path : {Path::translation, Path::rotation, Path::scale}) {
          const Curve curve = random_curve(random, path, interpolation);
          Curve changed = curve;
          REQUIRE(there.apply(path, changed));
          std::vector<float> a = curve.values, b = changed.values;
          for (std::vector<float>* values : {&a, &b}) {
            for (float& value : *values) value = std::abs(value);
            std::sort(values->begin(), values->end());
          }
          CHECK(a == b);
          REQUIRE(back.apply(path, changed));
          CHECK(changed.values == curve.values);
        }
      }
    }
  }
}

TEST_CASE("convert: scale goes along where the axes are the old ones in another order") {
  Frame now;
  now.space = math::matrix(rotation_about({0, 0, 1}, 90));  // x where y was
  const Conversion conversion(Frame{}, now);
  CHECK(conversion.scale({2, 3, 4}) == Vec3{3, 2, 4});
  Curve curve;
  curve.width = 3;
  curve.times = std::make_shared<const std::vector<float>>(std::vector<float>{0});
  curve.values = {2, 3, 4};
  CHECK(conversion.apply(Path::scale, curve));
  CHECK(curve.values == std::vector<float>{3, 2, 4});
}

TEST_CASE("convert: scale that the new axes cannot say stays as it is and is told") {
  Frame now;
  now.space = math::matrix(rotation_about({0, 0, 1}, 30));
  const Conversion conversion(Frame{}, now);
  CHECK(!conversion.keeps_scale());
  Curve curve;
  curve.width = 3;
  curve.times = std::make_shared<const std::vector<float>>(std::vector<float>{0, 1});
  curve.values = {2, 2, 2, 1, 1, 1};
  CHECK(conversion.apply(Path::scale, curve));
  curve.values = {2, 2, 2, 2, 3, 2};
  CHECK(!conversion.apply(Path::scale, curve));
  CHECK(curve.values == std::vector<float>{2, 2, 2, 2, 3, 2});
}

TEST_CASE("convert: nothing changes between equal frames, whatever their rest") {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    Frame frame = frame_of(math::matrix(random.rotation()));
    frame.rest = {random.vector(1), random.rotation(), {1, 2, 1}};
    const Conversion conversion(frame, frame);
    CHECK(conversion.is_identity());
    const Curve curve = random_curve(random, Path::rotation, Interpolation::cubic);
    Curve changed = curve;
    CHECK(conversion.apply(Path::rotation, changed));
    CHECK(changed.values == curve.values);
  }
}

TEST_CASE("convert: rests that differ by what can be seen do count") {
  Frame before, now;
  now.rest.rotation = rotation_about({1, 2, 3}, 1e-5);
  CHECK(!Conversion(before, now).is_identity());
  now.rest.rotation = -before.rest.rotation;  // the same rotation
  CHECK(Conversion(before, now).is_identity());
  now.rest.translation = {0, 1e-6, 0};
  CHECK(!Conversion(before, now).is_identity());
}

TEST_CASE("convert: axes without extent leave keys alone") {
  Frame flat;
  flat.space = {{1, 0, 0}, {0, 0, 0}, {0, 0, 1}};
  for (const auto& [before, now] : {std::pair{Frame{}, flat}, std::pair{flat, Frame{}}}) {
    const Conversion conversion(before, now);
    CHECK(conversion.is_identity());
    Curve curve;
    curve.width = 3;
    curve.times = std::make_shared<const std::vector<float>>(std::vector<float>{0});
    curve.values = {2, 3, 4};
    CHECK(conversion.apply(Path::translation, curve));
    CHECK(curve.values == std::vector<float>{2, 3, 4});
  }
}

}  // namespace rigc
