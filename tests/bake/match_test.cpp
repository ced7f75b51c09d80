// SPDX-License-Identifier: MIT
// Poses of limbs go from FK to IK and back, whatever their options say.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bake/match_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;
using test::Keys;

namespace {

namespace transform = scene::transform;

/// Random poses of an arm with every option, and of what it hangs on.
anim::Clip random_poses(const test::Rig& rig, const std::string& group, std::size_t count,
                        std::uint64_t seed) {
  test::Random random(seed);
  std::vector<float> times;
  for (std::size_t i = 0; i < count; ++i) times.push_back(static_cast<float>(i) * 0.25f);
  Keys keys(rig, times);
  const double unit = rig.skeleton.character.height / 1.4;
  keys.number("root/root.world@master_scale", random, 0.3, 3, 1);
  keys.translate("torso.chest/control", random, 0.2 * unit);
  keys.turn("torso.chest/control", random);
  const std::string limb = group + "/ik_fk_limb";
  for (const char* joint : {".upper", ".lower", ".end"})
    keys.turn(group + joint + "/ik_fk_limb.fk", random);
  keys.number(group + ".upper/ik_fk_limb.fk@length", random, 0.4, 2, 1);
  keys.number(group + ".lower/ik_fk_limb.fk@length", random, 0.4, 2, 1);
  keys.translate(limb + ".ik", random, 0.7 * unit);
  keys.turn(limb + ".ik", random);
  keys.translate(limb + ".pole", random, 0.4 * unit);
  keys.number(limb + ".ik@upper_twist", random, -170, 170, 0);
  keys.number(limb + ".ik@lower_twist", random, -170, 170, 0);
  keys.number(limb + ".ik@upper_length", random, 0.4, 2, 1);
  keys.number(limb + ".ik@lower_length", random, 0.4, 2, 1);
  keys.number(limb + ".ik@stretch", random, 0, 1, 1);
  keys.number(limb + ".ik@stretch_max", random, 1, 2, 3);
  keys.number(limb + ".ik@squash", random, 0, 1, 0);
  keys.number(limb + ".ik@soft", random, 0, 0.5, 0);
  keys.number(limb + ".ik@slide", random, -1, 1, 0);
  keys.number(limb + ".ik@wrist", random, 0, 1, 0);
  keys.number(limb + ".pole@pin", random, 0, 1, 0);
  keys.number(limb + ".settings@ik_fk", random, 0, 1, random.chance(0.5) ? 0 : 1);
  return keys.clip;
}

double angle_between(const math::Affine& a, const math::Affine& b) {
  const math::Quat q =
      math::quaternion(math::orthonormal(a.linear) * math::transposed(math::orthonormal(b.linear)));
  return math::degrees(2 * math::atan2(math::length({q.x, q.y, q.z}), std::abs(q.w)));
}

struct Worst {
  double distance = 0;  ///< lengths of the limb
  double degrees = 0;   ///< where it is bent by more than two
  std::size_t poses = 0, straight = 0;
};

void compare(const std::vector<math::Affine>& a, const std::vector<math::Affine>& b, Worst& worst) {
  const Vec3 upper = a[1].origin - a[0].origin, lower = a[2].origin - a[1].origin;
  const double length = math::length(upper) + math::length(lower);
  for (std::size_t i = 0; i < 3; ++i)
    worst.distance = std::max(worst.distance, test::distance(a[i].origin, b[i].origin) / length);
  ++worst.poses;
  const double bend =
      math::degrees(math::atan2(math::length(math::cross(upper, lower)), math::dot(upper, lower)));
  if (bend < 2) {
    ++worst.straight;
    return;
  }
  for (std::size_t i = 0; i < 3; ++i)
    worst.degrees = std::max(worst.degrees, angle_between(a[i], b[i]));
}

anim::Clip matched(const test::Rig& rig, const bake::MatchLimb& limb, const anim::Clip& clip,
                   const bake::MatchOptions& options) {
  const auto nodes = test::nodes_of(rig.scene());
  Diagnostics diagnostics;
  bake::MatchReport report;
  const auto solved = bake::solve_match(rig.scene(), nodes, clip, limb, options, diagnostics);
  REQUIRE_MESSAGE(solved, test::text(diagnostics));
  return bake::with_keys(rig.scene(), nodes, clip, *solved, options, report);
}

bake::MatchOptions at_keys(const test::Rig& rig, const anim::Clip& clip, bool to_ik) {
  Diagnostics diagnostics;
  const auto times =
      bake::match_times(rig.scene(), test::nodes_of(rig.scene()), clip, {}, diagnostics);
  REQUIRE(times);
  return {to_ik, *times, true, true};
}

}  // namespace

TEST_CASE("bake match: any pose of one side is one of the other") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::arms(), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    const auto limbs = bake::find_match_limbs(rig.scene());
    REQUIRE(limbs.size() == 2);
    for (const std::string group : {"arm_l", "arm_r"}) {
      CAPTURE(group);
      const bake::MatchLimb& limb = test::find(limbs, group);
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const anim::Clip clip = random_poses(rig, group, 24, seed * 77);
        anim::Clip now = clip;
        Worst worst;
        // To one side, from there to the other, and back.
        for (const bool to_ik : {seed % 2 == 0, seed % 2 == 1, seed % 2 == 0}) {
          const bake::MatchOptions options = at_keys(rig, clip, to_ik);
          const anim::Clip next = matched(rig, limb, now, options);
          for (const double time : options.times)
            compare(test::joints_at(rig, limb, clip, time), test::joints_at(rig, limb, next, time),
                    worst);
          now = next;
        }
        CHECK(worst.distance < 1e-5);
        CHECK(worst.degrees < 1e-3);
        CHECK(worst.straight < worst.poses / 3);
      }
    }
  }
}

TEST_CASE(
    "bake match: an arm that rests bent a little to the wrong side is matched as it swivels") {
  const test::Rig rig(test::arms(0.026));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  REQUIRE(test::rest_error(rig) < 1e-9);
  const auto limbs = bake::find_match_limbs(rig.scene());
  const bake::MatchLimb& limb = test::find(limbs, "arm_l");
  test::Random random(19);
  std::vector<float> times;
  for (int i = 0; i < 40; ++i) times.push_back(static_cast<float>(i) * 0.25f);
  Keys keys(rig, times);
  keys.turn("arm_l.upper/ik_fk_limb.fk", random);
  keys.add("arm_l.lower/ik_fk_limb.fk@rotation", 4, [&] {
    const Vec3 turn = random.vector(0.3);
    const math::Quat q = math::axis_angle(math::normalised(turn), math::length(turn));
    return std::vector<double>{q.x, q.y, q.z, q.w};
  });
  keys.add("arm_l/ik_fk_limb.settings@ik_fk", 1, [] { return std::vector<double>{0}; });
  const anim::Clip in_ik = matched(rig, limb, keys.clip, at_keys(rig, keys.clip, true));
  const anim::Clip back = matched(rig, limb, in_ik, at_keys(rig, in_ik, false));
  Worst worst;
  for (const float time : times) {
    const auto wanted = test::joints_at(rig, limb, keys.clip, static_cast<double>(time));
    for (const anim::Clip* clip : {&in_ik, &back})
      compare(wanted, test::joints_at(rig, limb, *clip, static_cast<double>(time)), worst);
  }
  CHECK(worst.distance < 1e-5);
  CHECK(worst.degrees < 1e-3);
  CHECK(worst.straight < worst.poses / 3);
}

TEST_CASE("bake match: in a range the other side has the pose, outside nothing changes") {
  const test::Rig rig(test::arms());
  const auto limbs = bake::find_match_limbs(rig.scene());
  const bake::MatchLimb& limb = test::find(limbs, "arm_l");
  const auto nodes = test::nodes_of(rig.scene());
  for (const bool to_ik : {false, true}) {
    CAPTURE(to_ik);
    anim::Clip clip = random_poses(rig, "arm_l", 8, 5);
    anim::Channel& mode = clip.channels.back();
    REQUIRE(mode.attribute == "ik_fk");
    std::fill(mode.curve.values.begin(), mode.curve.values.end(), to_ik ? 0.0f : 1.0f);
    // What the clip does not key is given keys that give it back.
    std::erase_if(clip.channels, [&](const anim::Channel& channel) {
      return channel.attribute == (to_ik ? "upper_length" : "length");
    });
    Diagnostics diagnostics;
    const auto times = bake::match_times(rig.scene(), nodes, clip, {0, 0.6, 1.3}, diagnostics);
    REQUIRE(times);
    CHECK(times->size() == 5);  // 0.6, 0.75, 1, 1.25, 1.3
    const bake::MatchOptions options{to_ik, *times, false, false};
    const anim::Clip now = matched(rig, limb, clip, options);
    Worst inside, outside;
    for (const double time : *times)
      compare(test::joints_at(rig, limb, clip, time), test::joints_at(rig, limb, now, time),
              inside);
    for (const double time : {0.0, 0.1, 0.25, 0.4, 0.59, 0.5999, 1.3001, 1.31, 1.5, 1.6, 2.0}) {
      const auto a = test::joints_at(rig, limb, clip, time),
                 b = test::joints_at(rig, limb, now, time);
      outside.distance = std::max(outside.distance, test::largest_difference(a, b, 1));
    }
    CHECK(inside.distance < 1e-5);
    CHECK(inside.degrees < 1e-3);
    CHECK(outside.distance < 1e-6);
    for (const anim::Channel& channel : now.channels)
      if (channel.attribute == "ik_fk") {
        double value = 0;
        anim::sample(channel.curve, false, 1, &value);
        CHECK(value == (to_ik ? 1 : 0));
      }
  }
}

TEST_CASE("bake match: options that do nothing to the pose stay, others become 0") {
  const test::Rig rig(test::arms());
  const auto limbs = bake::find_match_limbs(rig.scene());
  const bake::MatchLimb& limb = test::find(limbs, "arm_l");
  Keys keys(rig, {0});
  const auto constant = [&](const std::string& plug, double value) {
    keys.add(plug, 1, [&] { return std::vector<double>{value}; });
  };
  const std::string ik = "arm_l/ik_fk_limb.ik@";
  constant(ik + "soft", 0.1);
  constant(ik + "slide", 0.5);
  constant(ik + "stretch", 0.25);
  constant("arm_l/ik_fk_limb.settings@ik_fk", 0);
  keys.add("arm_l.lower/ik_fk_limb.fk@rotation", 4, [] {
    return std::vector<double>{0, 0.6, 0, 0.8};
  });
  const anim::Clip now = matched(rig, limb, keys.clip, at_keys(rig, keys.clip, true));
  const auto value = [&](const std::string& name) {
    for (const anim::Channel& channel : now.channels)
      if (channel.attribute == name) return channel.curve.values.front();
    return -1.0f;
  };
  CHECK(value("soft") == 0.1f);  // the arm is bent: far from the zone
  CHECK(value("stretch") == 0.25f);
  CHECK(value("slide") == 0);
  CHECK(value("ik_fk") == 1);
  CHECK(value("squash") == -1);  // no key for what nobody touched
}

TEST_CASE("bake match: a bone that the clip scales is not one that got longer") {
  const test::Rig rig(test::arms());
  const auto limbs = bake::find_match_limbs(rig.scene());
  const bake::MatchLimb& limb = test::find(limbs, "arm_l");
  test::Random random(3);
  Keys keys(rig, {0, 0.5, 1});
  for (const char* joint : {".upper", ".lower", ".end"})
    keys.turn("arm_l" + std::string(joint) + "/ik_fk_limb.fk", random);
  anim::Channel scale;
  scale.node = static_cast<int>(limb.joints[0].index);
  scale.path = anim::Path::scale;
  scale.curve.width = 3;
  scale.curve.times = std::make_shared<const std::vector<float>>(std::vector<float>{0});
  scale.curve.values = {1.3f, 1.3f, 1.3f};
  keys.clip.channels.push_back(scale);
  const bake::MatchOptions options = at_keys(rig, keys.clip, true);
  const anim::Clip now = matched(rig, limb, keys.clip, options);
  Worst worst;
  for (const double time : options.times)
    compare(test::joints_at(rig, limb, keys.clip, time), test::joints_at(rig, limb, now, time),
            worst);
  CHECK(worst.distance < 1e-5);
  CHECK(worst.degrees < 1e-3);
  for (const anim::Channel& channel : now.channels)
    CHECK(channel.attribute.find("length") == std::string::npos);
}
