// SPDX-License-Identifier: MIT
// fingertip_ik: the tip of a finger goes to its control, in the plane in which the finger bends.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

struct Shape {
  int phalanges = 3;
  bool tips = true, hand = true, metacarpals = false;
  double bent = 8;  ///< degrees of each finger joint at rest, to the palm
  bool ik = true;   ///< the feature
};

/// Both hands of a character in T-pose, palms down, with two fingers and a thumb.
class Hands {
 public:
  explicit Hands(const Shape& shape) : shape_(shape) {
    joint("root", "", {0, 0, 0}, "root", "root", "{command: root, with: {drive: on}}");
    for (const std::string side : {"l", "r"}) {
      side_ = side;
      std::string tags = "{command: control, with: {}}";
      if (shape.hand)
        tags += fmt::format(
            ", {{command: hand, with: {{thumb: \"thumb_{0}[*]/fk_chain\","
            " index: \"index_{0}[*]/fk_chain\", pinky: \"pinky_{0}[*]/fk_chain\"}}}}",
            side);
      joint("wrist", "root", {0.7, 1.4, 0}, "arm_" + side, "wrist", tags);
      add("index", {0.79, 1.4, 0.02}, {1, 0, 0.05}, {0, 0, -1});
      add("pinky", {0.79, 1.4, -0.02}, {1, 0, -0.08}, {0, 0, -1});
      add("thumb", {0.725, 1.388, 0.024}, {0.63, -0.25, 0.73}, {0.3, 1, 0.1});
    }
  }
  std::string text() const { return test::template_of(text_); }

 private:
  void add(const std::string& name, Vec3 at, Vec3 along, Vec3 axis) {
    std::string parent = "wrist";
    const bool metacarpal = shape_.metacarpals && name != "thumb";
    if (metacarpal) {
      joint(name + "0", parent, {0.72, 1.4, at.z * 0.6}, name + "_" + side_, "", tags(name));
      parent = name + "0";
    }
    const int last = shape_.phalanges + (shape_.tips ? 1 : 0);
    for (int i = 1; i <= last; ++i) {
      const std::string own = name + std::to_string(i);
      const bool tip = i > shape_.phalanges;
      joint(own, parent, at, name + (tip ? "_tip_" : "_") + side_, "",
            i == 1 && !metacarpal ? tags(name) : "");
      const math::Quat bend =
          math::axis_angle(math::normalised(axis), math::radians(shape_.bent * (i - 1)));
      at = at + math::rotate(bend, math::normalised(along)) * (0.05 - 0.01 * i);
      parent = own;
    }
  }

  std::string tags(const std::string& finger) const {
    std::string text =
        fmt::format("{{command: fk_chain, with: {{joints: \"{}_{}[*]\"}}}}", finger, side_);
    if (shape_.ik)
      text += fmt::format(
          ", {{command: fingertip_ik, with: {{controls: \"{0}_{1}[*]/fk_chain\","
          " tip: \"{0}_tip_{1}?\"}}}}",
          finger, side_);
    return text;
  }

  void joint(const std::string& name, const std::string& parent, Vec3 at, const std::string& local,
             const std::string& label, const std::string& tags) {
    const std::string end = side_.empty() ? "" : "_" + side_;
    text_ += fmt::format("  - {{name: {}{}, at: [{}, {}, {}], local: {}", name, end,
                         side_ == "r" ? -at.x : at.x, at.y, at.z, local);
    if (!parent.empty()) text_ += ", parent: " + parent + (parent == "root" ? "" : end);
    if (!label.empty()) text_ += ", label: " + label;
    if (!tags.empty()) text_ += ", tags: [" + tags + "]";
    text_ += "}\n";
  }

  const Shape shape_;
  std::string side_, text_ = "joints:\n";
};

std::string control(const std::string& finger, int last = 2) {
  return fmt::format("{}[{}]/fingertip_ik.ik", finger, last);
}
const std::string kIndex = control("index_l");

std::string joint(const std::string& finger, int i) { return fmt::format("{}[{}]", finger, i); }
std::string fk(const std::string& finger, int i) { return joint(finger, i) + "/fk_chain"; }

constexpr double kLength = 0.04 + 0.03 + 0.02;
const Vec3 kForward = math::normalised(Vec3{1, 0, 0.05}), kDown{0, -1, 0};

/// Degrees by which bone `i` of the left index finger is bent from the one before, to the palm:
/// about the hinge at its joint, which the bone before carries along.
double bend(const test::Rig& rig, const test::Pose& pose, int i) {
  const auto at = [&](int n) {
    return pose.position(n == 3 ? "index_tip_l" : joint("index_l", n));
  };
  const std::string carrier = joint("index_l", i - 1);
  const Vec3 hinge = pose.world(carrier).linear * math::transposed(rig.rest(carrier).linear) *
                     math::cross(kForward, kDown);
  const Vec3 before = at(i) - at(i - 1), bone = at(i + 1) - at(i);
  return math::degrees(
      std::atan2(math::dot(math::cross(before, bone), hinge), math::dot(before, bone)));
}

/// Where the tip of the left index finger goes to, seen from its knuckle: degrees down to the palm
/// and to the side, lengths of the finger.
Vec3 place(const test::Rig& rig, double down, double side, double far) {
  const math::Quat turn = math::axis_angle({0, 1, 0}, math::radians(side)) *
                          math::axis_angle({0, 0, -1}, math::radians(down));
  return rig.rest("index_l[0]").origin + math::rotate(turn, kForward) * (far * kLength);
}

test::Pose reaching(const test::Rig& rig, Vec3 goal) {
  test::Pose pose(rig);
  pose.set(kIndex + "@ik_fk", 1.0).move_to(kIndex, goal);
  return pose;
}

/// Largest angle in degrees by which a joint is turned between two poses.
double turned(const std::vector<math::Affine>& a, const std::vector<math::Affine>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto change = math::quaternion(math::orthonormal(a[i].linear) *
                                         math::transposed(math::orthonormal(b[i].linear)));
    const Vec3 axis{change.x, change.y, change.z};
    most = std::max(most, 2 * math::degrees(std::atan2(math::length(axis), std::abs(change.w))));
  }
  return most;
}

}  // namespace

TEST_CASE("modules fingertip_ik: at rest nothing moves, in IK too, however the fingers rest") {
  for (const double bent : {-4.0, 0.0, 0.3, 8.0, 35.0}) {
    for (const Shape& shape : {Shape{}, Shape{2}, Shape{1}, Shape{3, false}, Shape{3, true, false},
                               Shape{3, true, true, true}}) {
      CAPTURE(bent);
      CAPTURE(shape.phalanges);
      Shape with = shape;
      with.bent = bent;
      const test::Rig rig(Hands(with).text());
      INFO(test::text(rig.diagnostics));
      REQUIRE(rig.clean());
      CHECK(test::rest_error(rig) < 1e-9);
      test::Pose pose(rig), plain(rig);
      for (const char* finger : {"index_l", "pinky_r", "thumb_l"}) {
        const bool thumb = finger[0] == 't';
        const int last = shape.phalanges - 1 + (shape.metacarpals && !thumb ? 1 : 0);
        pose.set(control(finger, last) + "@ik_fk", 1.0);
      }
      CHECK(test::largest_difference(pose.joints(), plain.joints(), kLength) < 1e-9);
    }
  }
}

TEST_CASE("modules fingertip_ik: the tip is at its control, and no joint bends backward") {
  for (const double bent : {0.0, 8.0, 25.0}) {
    CAPTURE(bent);
    Shape shape;
    shape.bent = bent;
    const test::Rig rig(Hands(shape).text());
    const auto lengths = test::bone_lengths(rig, test::Pose(rig).joints());
    for (double down = -40; down <= 100; down += 10) {
      for (double side = -30; side <= 30; side += 15) {
        for (double far = 0.6; far < 0.9999; far += 0.049) {
          CAPTURE(down);
          CAPTURE(side);
          CAPTURE(far);
          const Vec3 goal = place(rig, down, side, far);
          const test::Pose pose = reaching(rig, goal);
          CHECK(test::distance(pose.position("index_tip_l"), goal) < 1e-6 * kLength);
          for (int i : {1, 2}) {
            CHECK(bend(rig, pose, i) > -1e-6);
            CHECK(bend(rig, pose, i) < 125);
          }
          const auto joints = pose.joints();
          CHECK(test::largest_difference(test::bone_lengths(rig, joints), lengths) < 1e-12);
        }
      }
    }
  }
}

TEST_CASE("modules fingertip_ik: out of reach the finger is straight and points at the control") {
  for (const int phalanges : {1, 2, 3}) {
    CAPTURE(phalanges);
    Shape shape;
    shape.phalanges = phalanges;
    const test::Rig rig(Hands(shape).text());
    const Vec3 base = rig.rest("index_l[0]").origin;
    for (const double down : {-30.0, 0.0, 45.0, 80.0}) {
      CAPTURE(down);
      const Vec3 goal = place(rig, down, 10, 1.4);
      test::Pose pose(rig);
      pose.set(control("index_l", phalanges - 1) + "@ik_fk", 1.0)
          .move_to(control("index_l", phalanges - 1), goal);
      const Vec3 along = math::normalised(goal - base);
      double length = 0;
      for (int i = 0; i < phalanges; ++i) length += 0.04 - 0.01 * i;
      CHECK(test::distance(pose.position("index_tip_l"), base + along * length) < 1e-6 * kLength);
    }
  }
}

TEST_CASE("modules fingertip_ik: a near goal closes the finger, and the tip stays before it") {
  const test::Rig rig(Hands({}).text());
  const Vec3 base = rig.rest("index_l[0]").origin;
  const auto folded = reaching(rig, place(rig, 60, 0, 0.3)).joints();
  const auto nearer = reaching(rig, place(rig, 60, 0, 0.1));
  CHECK(test::largest_difference(nearer.joints(), folded, kLength) < 1e-9);
  CHECK(bend(rig, nearer, 1) == doctest::Approx(112).epsilon(0.05));
  CHECK(bend(rig, nearer, 2) == doctest::Approx(70).epsilon(0.05));
  const Vec3 tip = nearer.position("index_tip_l") - base;
  CHECK(math::dot(math::normalised(tip), math::normalised(place(rig, 60, 0, 1) - base)) > 1 - 1e-9);
}

TEST_CASE("modules fingertip_ik: neighbouring goals have neighbouring poses") {
  for (const double bent : {-4.0, 0.0, 8.0}) {
    CAPTURE(bent);
    Shape shape;
    shape.bent = bent;
    const test::Rig rig(Hands(shape).text());
    // Round and in and out, also through what is out of reach and too near.
    const auto at = [&](double t) {
      return place(rig, 45 + 70 * std::sin(5 * t), 25 * std::sin(3 * t + 1),
                   0.7 + 0.45 * std::sin(7 * t + 2));
    };
    auto before = reaching(rig, at(0)).joints();
    Vec3 last = at(0);
    const double step = 0.002;
    for (double t = step; t < 3; t += step) {
      const auto joints = reaching(rig, at(t)).joints();
      // Into straight joints turn by the square root of the way.
      const double way = test::distance(at(t), last) / kLength;
      CAPTURE(t);
      CHECK(turned(joints, before) < 250 * std::sqrt(way));
      before = joints;
      last = at(t);
    }
  }
}

TEST_CASE("modules fingertip_ik: it starts from the pose that FK and hand give the finger") {
  const test::Rig rig(Hands({}).text());
  const auto posed = [&](double ik) {
    test::Pose pose(rig);
    pose.set("arm_l.wrist/hand.settings@curl", 0.4).set("arm_l.wrist/hand.settings@spread", 0.6);
    pose.rotate(fk("index_l", 0), {7, 12, -5}).rotate(fk("index_l", 1), {3, 4, -9});
    pose.rotate(fk("index_l", 2), {0, 0, 6});
    pose.move_to(kIndex, pose.position("index_tip_l"));
    return pose.set(kIndex + "@ik_fk", ik).joints();
  };
  CHECK(test::largest_difference(posed(1), posed(0), kLength) < 1e-6);
  CHECK(test::largest_difference(posed(0.5), posed(0), kLength) < 1e-6);

  // At one place of the tip the curl is the bend of the last joint.
  const auto curled = [&](double degrees) {
    test::Pose pose = reaching(rig, place(rig, 30, 0, 0.85));
    pose.turn_in_world(fk("index_l", 2), math::axis_angle({0, 0, -1}, math::radians(degrees)));
    return bend(rig, pose, 2);
  };
  CHECK(curled(20) > curled(0) + 10);
  CHECK(curled(0) > curled(-20) + 10);
}

TEST_CASE("modules fingertip_ik: turning the control turns the last bone, the tip stays") {
  const test::Rig rig(Hands({}).text());
  const Vec3 goal = place(rig, 40, 5, 0.75);
  const test::Pose plain = reaching(rig, goal);
  for (const Vec3 by : {Vec3{0, 0, 20}, Vec3{0, 0, -20}, Vec3{30, 0, 0}, Vec3{0, 15, 0}}) {
    CAPTURE(by.x);
    CAPTURE(by.y);
    CAPTURE(by.z);
    test::Pose pose = reaching(rig, goal);
    pose.rotate(kIndex, by);
    CHECK(test::distance(pose.position("index_tip_l"), goal) < 1e-6 * kLength);
    const auto seen = [](const test::Pose& p) {
      return math::transposed(p.world("index_l[1]").linear) * p.world("index_l[2]").linear;
    };
    const math::Affine change{seen(pose) * math::transposed(seen(plain)), {}};
    CHECK(turned({change}, {math::Affine{}}) == doctest::Approx(math::length(by)).epsilon(1e-6));
  }
}

TEST_CASE("modules fingertip_ik: at 0 FK has the finger to the last bit, between them it blends") {
  Shape without;
  without.ik = false;
  const test::Rig rig(Hands({}).text()), plain(Hands(without).text());
  const auto key = [](test::Pose& pose) {
    pose.set("arm_l.wrist/hand.settings@fist", 0.37).rotate(fk("index_l", 1), {3, 14, -9});
    pose.rotate("arm_l.wrist/control", {20, 30, 40});
  };
  test::Pose expected(plain), pose(rig);
  key(expected);
  key(pose);
  pose.translate(kIndex, {0.01, -0.02, 0.003});
  CHECK(test::largest_difference(pose.joints(), expected.joints(), kLength) == 0);
  auto before = pose.joints();
  for (double share = 0.01; share < 1.005; share += 0.01) {
    CAPTURE(share);
    const auto joints = pose.set(kIndex + "@ik_fk", share).joints();
    CHECK(turned(joints, before) < 3);
    before = joints;
  }
}

TEST_CASE("modules fingertip_ik: a finger that rests bent backward closes to the palm") {
  Shape shape;
  shape.bent = -4;
  const test::Rig rig(Hands(shape).text());
  REQUIRE(rig.clean());
  for (double far = 0.9; far > 0.6; far -= 0.02) {
    CAPTURE(far);
    const Vec3 goal = place(rig, 30, 0, far);
    const test::Pose pose = reaching(rig, goal);
    CHECK(test::distance(pose.position("index_tip_l"), goal) < 1e-6 * kLength);
    CHECK(bend(rig, pose, 1) > 0);
    CHECK(bend(rig, pose, 2) > 0);
  }
}

TEST_CASE("modules fingertip_ik: both sides mirror") {
  const test::Rig rig(Hands({}).text(), test::mirror_right_side);
  test::Pose pose(rig);
  for (const std::string side : {"l", "r"}) {
    for (const std::string finger : {"index_", "pinky_", "thumb_"}) {
      const std::string ik = control(finger + side);
      pose.set(ik + "@ik_fk", 0.8).rotate(ik, {5, -8, 12});
      pose.rotate(fk(finger + side, 1), {2, 3, -6});
      Vec3 goal = rig.rest(joint(finger + "l", 1)).origin + Vec3{0.02, -0.02, 0.01};
      if (side == "r") goal.x = -goal.x;
      pose.move_to(ik, goal);
    }
    pose.set("arm_" + side + ".wrist/hand.settings@curl", 0.5);
  }
  const auto motion = test::motion(rig, pose);
  CHECK(test::motion_difference(rig, motion, test::mirror_image(rig, motion)) < 1e-9);
}

TEST_CASE("modules fingertip_ik: the same on every model, of any size") {
  const test::Rig plain(Hands({}).text());
  const auto reach = [&](test::Pose& pose, const math::Affine& by) {
    const auto turn = [&](Vec3 axis, double degrees) {
      return test::mapped(by, math::axis_angle(axis, math::radians(degrees)));
    };
    for (const std::string finger : {"index_l", "pinky_l", "thumb_l"}) {
      pose.set(control(finger) + "@ik_fk", 0.8);
      pose.move_to(control(finger),
                   by * (plain.rest(joint(finger, 1)).origin + Vec3{0.02, -0.02, 0.01}));
      pose.turn_in_world(control(finger), turn({0, 0, 1}, -12));
      pose.turn_in_world(fk(finger, 1), turn({0, 0, 1}, -6));
    }
    pose.set("arm_l.wrist/hand.settings@curl", 0.5);
  };
  test::Pose expected(plain);
  reach(expected, {});
  const auto moved = test::motion(plain, expected);
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(Hands({}).text(), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    test::Pose pose(rig);
    reach(pose, model.by);
    CHECK(test::motion_difference(rig, test::motion(rig, pose), test::mapped(model.by, moved)) <
          1e-9);
    // The size of the character changes nothing else.
    const auto sized = [&](double ik) {
      test::Pose large(rig);
      large.set("root.root/root.world@master_scale", 1.7).set(kIndex + "@ik_fk", ik);
      return test::motion(rig, large);
    };
    CHECK(test::motion_difference(rig, sized(1), sized(0)) < 1e-9);
  }
}

TEST_CASE("modules fingertip_ik: without a tip the finger ends where its vertices do") {
  Shape shape;
  shape.bent = 0;
  shape.tips = false;
  const auto of_model = [](tags::TaggedSkeleton& skeleton) {
    for (std::size_t i = 0; i < skeleton.joints.size(); ++i)
      skeleton.joints[i].foreign_node = static_cast<int>(i);
  };
  const test::Rig rig(Hands(shape).text(), of_model, false);
  REQUIRE(rig.listed());
  // Where the farthest vertex of the last joint is, and how long the last bone is then; the one
  // before is 0.03 long.
  for (const auto& lengths : {std::pair{0.021, 0.021}, std::pair{0.3, 0.024}}) {
    const double far = lengths.first, length = lengths.second;
    CAPTURE(far);
    tags::Geometry geometry;
    geometry.vertices = [far](const std::vector<int>&) {
      return std::vector<tags::BoundVertex>{
          {kForward * 0.01, 1}, {kForward * far + Vec3{0, 0.004, 0}, 0.8}, {kForward * 0.04, 0.3}};
    };
    processor::Processor run(rig.skeleton, rig.commands, test::catalogue(), 0, geometry);
    Diagnostics diagnostics;
    REQUIRE(run.run(diagnostics));
    std::size_t found = 0;
    for (const scene::NodeId id : run.scene().nodes()) {
      const scene::Node& node = run.scene()[id];
      if (node.identity.role != "ik" || node.ids.local != "index_l") continue;
      ++found;
      const Vec3 tip = run.scene().rest_world(id).origin;
      const Vec3 from = Vec3{0.79, 1.4, 0.02} + kForward * 0.07;
      CHECK(test::distance(tip, from + kForward * length) < 1e-12);
    }
    CHECK(found == 1);
  }
}
