// SPDX-License-Identifier: MIT
// What models do to a skeleton: other axes, sizes, facings, mirrored and scaled spaces.
#include "support/skeletons.h"

#include <cmath>

namespace rigc::test {

using math::Affine;
using math::Mat3;
using math::Vec3;

double Random::number(double low, double high) {
  const double unit = static_cast<double>(engine_() >> 11) * 0x1p-53;
  return low + (high - low) * unit;
}

Vec3 Random::vector(double extent) {
  const double x = number(-extent, extent);
  const double y = number(-extent, extent);
  const double z = number(-extent, extent);
  return {x, y, z};
}

math::Quat Random::rotation() {
  const Vec3 axis = vector(1);
  const double angle = number(-math::kPi, math::kPi);
  return math::axis_angle(math::normalised(axis), angle);
}

std::vector<Affine> worlds(const tags::TaggedSkeleton& skeleton) {
  std::vector<Affine> out;
  for (const tags::TaggedJoint& joint : skeleton.joints) {
    const Affine local = math::compose(joint.rest);
    out.push_back(joint.parent < 0 ? local : out[static_cast<std::size_t>(joint.parent)] * local);
  }
  return out;
}

void set_worlds(tags::TaggedSkeleton& skeleton, const std::vector<Affine>& worlds) {
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    tags::TaggedJoint& joint = skeleton.joints[j];
    joint.rest = math::decompose(
        joint.parent < 0
            ? worlds[j]
            : math::inverse(worlds[static_cast<std::size_t>(joint.parent)]) * worlds[j]);
  }
}

namespace {

Mat3 times(const Mat3& m, double s) { return {m.x * s, m.y * s, m.z * s}; }

}  // namespace

void turn_axes(tags::TaggedSkeleton& skeleton, std::uint64_t seed) {
  Random random(seed);
  std::vector<Affine> at = worlds(skeleton);
  for (Affine& world : at) world.linear = world.linear * math::matrix(random.rotation());
  set_worlds(skeleton, at);
}

void transform(tags::TaggedSkeleton& skeleton, const Affine& by) {
  const double determinant = math::determinant(by.linear);
  const double size = math::cbrt(std::abs(determinant));
  const Mat3 turn = times(by.linear, (determinant < 0 ? -1 : 1) / size);
  std::vector<Affine> at = worlds(skeleton);
  for (Affine& world : at) {
    // The frame turns by the rotation, or by the reflection with its axes turned round.
    world = {turn * world.linear, by * world.origin};
  }
  set_worlds(skeleton, at);
  tags::Character& c = skeleton.character;
  for (Vec3* direction : {&c.up, &c.left, &c.forward}) {
    *direction = math::normalised(by.linear * *direction);
  }
  c.height *= size;
  c.unit *= size;
}

void scale_root_joint(tags::TaggedSkeleton& skeleton, double scale) {
  tags::TaggedJoint& root = skeleton.joints.front();
  root.rest.scale = root.rest.scale * scale;
  for (tags::TaggedJoint& joint : skeleton.joints) {
    if (joint.parent != 0) continue;
    joint.rest.translation = joint.rest.translation * (1 / scale);
    joint.rest.scale = joint.rest.scale * (1 / scale);
  }
}

void scale_hierarchy(tags::TaggedSkeleton& skeleton, double scale) {
  std::vector<Affine> at = worlds(skeleton);
  for (std::size_t j = 0; j < at.size(); ++j) {
    int root = static_cast<int>(j);
    while (skeleton.joints[static_cast<std::size_t>(root)].parent >= 0) {
      root = skeleton.joints[static_cast<std::size_t>(root)].parent;
    }
    if (root == 0) at[j].linear = times(at[j].linear, scale);
  }
  set_worlds(skeleton, at);
}

Affine similarity(double scale, math::Quat rotation, int mirror_axis) {
  Mat3 linear = math::matrix(rotation);
  if (mirror_axis >= 0) {
    Mat3 reflection;
    Vec3& column = mirror_axis == 0 ? reflection.x : mirror_axis == 1 ? reflection.y : reflection.z;
    column = -column;
    linear = reflection * linear;
  }
  return {times(linear, scale), {}};
}

}  // namespace rigc::test
