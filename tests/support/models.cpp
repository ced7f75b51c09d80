// SPDX-License-Identifier: MIT
// The models that a rig must behave the same on.
#include "support/models.h"

#include <doctest/doctest.h>

#include <algorithm>

namespace rigc::test {

using math::Affine;
using math::Mat3;
using math::Vec3;

namespace {

Model moved(std::string name, const Affine& by, std::uint64_t turn_seed = 0) {
  return {std::move(name), by, [by, turn_seed](tags::TaggedSkeleton& skeleton) {
            transform(skeleton, by);
            if (turn_seed != 0) turn_axes(skeleton, turn_seed);
          }};
}

std::vector<Model> make_models() {
  const math::Quat about_face{0, 1, 0, 0};
  const math::Quat z_up = math::from_euler_degrees({90, 0, 0});
  std::vector<Model> models{moved("as it is", {}),
                            moved("turned axes 1", {}, 1),
                            moved("turned axes 2", {}, 2),
                            moved("100 times as large", similarity(100, {})),
                            moved("100 times smaller", similarity(0.01, {})),
                            moved("facing -Z", similarity(1, about_face)),
                            moved("Z up", similarity(1, z_up)),
                            moved("mirrored", similarity(1, {}, 0)),
                            moved("mirrored front to back", similarity(1, {}, 2))};
  Affine everything = similarity(0.01, math::from_euler_degrees({20, 130, -40}), 1);
  everything.origin = {0.3, -0.2, 0.1};
  models.push_back(moved("mirrored, tilted, small, turned axes", everything, 3));
  models.push_back({"scaled root joint", {}, [](tags::TaggedSkeleton& skeleton) {
                      turn_axes(skeleton, 4);
                      scale_root_joint(skeleton, 100);
                    }});
  models.push_back({"scaled hierarchy", {}, [](tags::TaggedSkeleton& skeleton) {
                      turn_axes(skeleton, 5);
                      scale_hierarchy(skeleton, 0.01);
                    }});
  return models;
}

}  // namespace

const std::vector<Model>& models() {
  static const std::vector<Model> kModels = make_models();
  return kModels;
}

math::Quat mapped(const Affine& by, math::Quat rotation) {
  return math::quaternion(
      math::orthonormal(by.linear * math::matrix(rotation) * math::inverse(by.linear)));
}

std::vector<Affine> motion(const Rig& rig, const Pose& pose) {
  std::vector<Affine> moved = pose.joints();
  for (std::size_t j = 0; j < moved.size(); ++j) {
    moved[j] = moved[j] * math::inverse(rig.skeleton.world(j));
  }
  return moved;
}

std::vector<Affine> mapped(const Affine& by, std::vector<Affine> motion) {
  const Affine back = math::inverse(by);
  for (Affine& one : motion) one = by * one * back;
  return motion;
}

double motion_difference(const Rig& rig, const std::vector<Affine>& a,
                         const std::vector<Affine>& b) {
  REQUIRE(a.size() == b.size());
  const double height = rig.skeleton.character.height;
  double most = 0;
  for (std::size_t j = 0; j < a.size(); ++j) {
    const Vec3 at = rig.skeleton.world(j).origin;
    for (const Vec3 off : {Vec3{}, Vec3{0.1, 0, 0}, Vec3{0, 0.1, 0}, Vec3{0, 0, 0.1}}) {
      const Vec3 point = at + off * height;
      most = std::max(most, distance(a[j] * point, b[j] * point) / height);
    }
  }
  return most;
}

namespace {

Mat3 reflection(Vec3 normal) {
  const auto column = [&](Vec3 v) { return v - normal * (2 * math::dot(normal, v)); };
  return {column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1})};
}

}  // namespace

void mirror_right_side(tags::TaggedSkeleton& skeleton) {
  std::vector<Affine> at = worlds(skeleton);
  const Mat3 mirror = reflection(skeleton.character.left);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    tags::TaggedJoint& joint = skeleton.joints[j];
    if (!joint.name.ends_with("_r")) continue;
    const int other = skeleton.find(joint.mirror.opposite);
    REQUIRE(other >= 0);
    joint.mirror.mirrored = true;
    const Mat3 reflected = mirror * at[static_cast<std::size_t>(other)].linear;
    at[j].linear = {-reflected.x, -reflected.y, -reflected.z};
  }
  set_worlds(skeleton, at);
}

std::vector<Affine> mirror_image(const Rig& rig, const std::vector<Affine>& motion) {
  const Affine mirror{reflection(rig.skeleton.character.left), {}};
  std::vector<Affine> out = motion;
  for (std::size_t j = 0; j < motion.size(); ++j) {
    const int other = rig.skeleton.find(rig.skeleton.joints[j].mirror.opposite);
    const std::size_t from = other < 0 ? j : static_cast<std::size_t>(other);
    out[j] = mirror * motion[from] * mirror;
  }
  return out;
}

}  // namespace rigc::test
