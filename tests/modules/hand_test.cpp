// SPDX-License-Identifier: MIT
// hand: fingers that close, spread and fold by attributes, as their own controls go on top.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

struct Shape {
  std::vector<std::string> fingers{"index", "middle", "ring", "pinky"};
  int phalanges = 3;
  bool thumb = true, metacarpals = false;
  double bent = 0;  ///< degrees of every finger joint at rest
  double thumb_size = 1;
};

/// Both hands of a character in T-pose, palms down.
class Hands {
 public:
  explicit Hands(const Shape& shape) : shape_(shape) {
    text_ +=
        "  - {name: root, at: [0, 0, 0], local: root, label: root,"
        " tags: [{command: root, with: {drive: on}}]}\n";
    for (const std::string side : {"l", "r"}) add_hand(side);
  }
  std::string text() const { return test::template_of(text_); }

 private:
  void add_hand(const std::string& side) {
    side_ = side;
    std::string with;
    for (const std::string& finger : shape_.fingers) with += argument(finger);
    if (shape_.thumb) with += argument("thumb");
    joint("wrist", "root", {0.7, 1.4, 0}, "arm_" + side, "wrist",
          "{command: control, with: {}}, {command: hand, with: {" + with.substr(2) + "}}");
    for (std::size_t i = 0; i < shape_.fingers.size(); ++i) {
      const double z = 0.026 - 0.02 * static_cast<double>(i);
      add_finger(shape_.fingers[i], {0.79, 1.4, z}, {1, 0, 0.05 - 0.04 * static_cast<double>(i)});
    }
    if (shape_.thumb) add_thumb();
  }

  std::string argument(const std::string& finger) const {
    return fmt::format(", {0}: \"{0}_{1}[*]/fk_chain\"", finger, side_);
  }

  void add_finger(const std::string& name, Vec3 at, Vec3 along) {
    std::string parent = "wrist";
    if (shape_.metacarpals) {
      joint(name + "0", parent, {0.73, 1.4, at.z * 0.6}, name + "_" + side_, "", chain(name));
      parent = name + "0";
    }
    double bend = 0;
    for (int i = 1; i <= shape_.phalanges + 1; ++i) {
      const std::string own = name + std::to_string(i);
      const bool first = i == 1 && !shape_.metacarpals;
      const bool tip = i == shape_.phalanges + 1;
      joint(own, parent, at, tip ? "" : name + "_" + side_, "", first ? chain(name) : "");
      bend += shape_.bent;
      const math::Quat down = math::from_euler_degrees({0, 0, -bend});
      at = at + math::rotate(down, math::normalised(along)) * (0.045 - 0.009 * i);
      parent = own;
    }
  }

  void add_thumb() {
    const Vec3 places[] = {
        {0.725, 1.388, 0.024}, {0.752, 1.376, 0.058}, {0.776, 1.37, 0.08}, {0.797, 1.366, 0.095}};
    std::string parent = "wrist";
    for (int i = 0; i < 4; ++i) {
      const std::string own = "thumb" + std::to_string(i + 1);
      const Vec3 at = places[0] + (places[i] - places[0]) * shape_.thumb_size;
      joint(own, parent, at, i == 3 ? "" : "thumb_" + side_, "", i == 0 ? chain("thumb") : "");
      parent = own;
    }
  }

  std::string chain(const std::string& finger) const {
    return fmt::format("{{command: fk_chain, with: {{joints: \"{}_{}[*]\"}}}}", finger, side_);
  }

  void joint(const std::string& name, const std::string& parent, Vec3 at, const std::string& local,
             const std::string& label, const std::string& tags) {
    const double x = side_ == "l" ? at.x : -at.x;
    const std::string above = parent == "root" ? parent : parent + "_" + side_;
    text_ += fmt::format("  - {{name: {}_{}, parent: {}, at: [{}, {}, {}]", name, side_, above, x,
                         at.y, at.z);
    if (!local.empty()) text_ += ", local: " + local;
    if (!label.empty()) text_ += ", label: " + label;
    if (!tags.empty()) text_ += ", tags: [" + tags + "]";
    text_ += "}\n";
  }

  const Shape shape_;
  std::string side_, text_ = "joints:\n";
};

const std::string kHand = "arm_l.wrist/hand.settings";

std::string joint(const std::string& finger, int i) { return fmt::format("{}_l[{}]", finger, i); }

/// Where a joint is turned from how it rests; the template's space.
Vec3 turned(const test::Rig& rig, const test::Pose& pose, const std::string& joint, Vec3 rest,
            const math::Affine& by = {}) {
  const math::Affine motion =
      math::inverse(by) * pose.world(joint) * math::inverse(rig.rest(joint)) * by;
  return math::normalised(motion.linear * rest);
}

double angle(Vec3 a, Vec3 b) {
  return math::degrees(
      std::acos(std::clamp(math::dot(math::normalised(a), math::normalised(b)), -1.0, 1.0)));
}

Vec3 bone(const test::Pose& pose, const std::string& finger, int i) {
  return pose.position(joint(finger, i + 1)) - pose.position(joint(finger, i));
}

}  // namespace

TEST_CASE("modules hand: a fist has the same angles, however the fingers rest") {
  for (const double bent : {0.0, 6.0, 20.0}) {
    CAPTURE(bent);
    Shape shape;
    shape.bent = bent;
    const test::Rig rig(Hands(shape).text());
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    test::Pose pose(rig);
    pose.set(kHand + "@fist", 1.0);
    for (const std::string& finger : shape.fingers) {
      CAPTURE(finger);
      const Vec3 first = bone(pose, finger, 0), second = bone(pose, finger, 1);
      CHECK(angle(first, {1, 0, 0}) == doctest::Approx(82).epsilon(0.05));
      CHECK(angle(first, second) == doctest::Approx(100).epsilon(0.05));
      CHECK(first.y < 0);   // palm down
      CHECK(second.x < 0);  // back to the wrist
    }
  }
}

TEST_CASE("modules hand: in a fist the thumb lies across the fingers, outside of them") {
  const test::Rig rig(Hands({}).text());
  test::Pose pose(rig);
  pose.set(kHand + "@fist", 1.0);
  const Vec3 tip = pose.position("thumb_l[2]");
  const Vec3 last = turned(rig, pose, "thumb_l[2]", {0.021, -0.004, 0.015});
  CHECK(last.z < -0.7);                                  // across, to the little finger
  CHECK(tip.y < pose.position(joint("index", 1)).y);     // below the curled index finger
  CHECK(tip.x > pose.position("arm_l.wrist").x + 0.03);  // before the wrist
}

TEST_CASE("modules hand: a thumb of any length closes over the fingers as they close") {
  for (const double size : {0.8, 1.0, 1.2, 1.4}) {
    for (const double bent : {0.0, 15.0}) {
      CAPTURE(size);
      CAPTURE(bent);
      Shape shape;
      shape.thumb_size = size;
      shape.bent = bent;
      const test::Rig rig(Hands(shape).text());
      REQUIRE(rig.clean());
      test::Pose pose(rig);
      pose.set(kHand + "@fist", 1.0);
      const double phalanx = math::length(bone(pose, "index", 0));
      const Vec3 second = pose.position(joint("index", 1)) + bone(pose, "index", 1) * 0.5;
      const Vec3 last = pose.position("thumb_l[2]");
      // Its last joint is outside of the index finger, no farther than two fingers are thick; from
      // there it lies across the fingers.
      CHECK(last.y < second.y);
      CHECK(test::distance(last, second) < 0.8 * phalanx);
      CHECK(turned(rig, pose, "thumb_l[2]", {0.021, -0.004, 0.015}).z < -0.7);
    }
  }
}

TEST_CASE("modules hand: a finger can stay out of the fist") {
  const test::Rig rig(Hands({}).text());
  test::Pose pose(rig);
  pose.set(kHand + "@fist", 1.0).set(kHand + "@index_curl", -1.0);
  for (int i = 0; i < 3; ++i) {
    CHECK(test::distance(pose.position(joint("index", i)), rig.rest(joint("index", i)).origin) <
          1e-12);
  }
  CHECK(test::distance(pose.position(joint("ring", 2)), rig.rest(joint("ring", 2)).origin) > 0.04);
}

TEST_CASE("modules hand: curl leaves the thumb, spread opens the fan, cup folds the palm") {
  Shape shape;
  shape.metacarpals = true;
  const test::Rig rig(Hands(shape).text());
  REQUIRE(rig.clean());
  const auto at = [&](const std::string& attribute, const std::string& where) {
    test::Pose pose(rig);
    pose.set(kHand + "@" + attribute, 1.0);
    return pose.position(where) - rig.rest(where).origin;
  };
  CHECK(math::length(at("curl", "thumb_l[2]")) < 1e-12);
  CHECK(at("curl", "middle_l[3]").x < -0.03);
  CHECK(at("spread", "index_l[3]").z > 0.01);
  CHECK(at("spread", "pinky_l[3]").z < -0.01);
  CHECK(at("spread", "thumb_l[2]").z > 0.005);
  CHECK(std::abs(at("spread", "index_l[3]").y) < 1e-3);
  CHECK(at("cup", "pinky_l[1]").y < -0.01);
  CHECK(at("cup", "ring_l[1]").y < -0.002);
  CHECK(at("cup", "pinky_l[1]").y < at("cup", "ring_l[1]").y);
  CHECK(at("thumb_curl", "thumb_l[2]").z < -0.005);
}

TEST_CASE("modules hand: a finger's controls go on top") {
  const test::Rig rig(Hands({}).text());
  test::Pose pose(rig), plain(rig);
  plain.set(kHand + "@fist", 0.6);
  pose.set(kHand + "@fist", 0.6).rotate("index_l[1]/fk_chain", {10, 0, 25});
  const math::Mat3 expected = plain.world("index_l[1]/fk_chain").linear *
                              math::matrix(math::from_euler_degrees({10, 0, 25}));
  CHECK(test::difference({pose.world("index_l[1]/fk_chain").linear, {}}, {expected, {}}, 1) < 1e-9);
}

TEST_CASE("modules hand: hands of three and four fingers, with joints missing, without a thumb") {
  const std::vector<Shape> shapes{{{"index", "middle", "ring"}, 3, true, false, 5},
                                  {{"index", "pinky"}, 2, true, false, 0},
                                  {{"middle"}, 1, false, false, 0},
                                  {{"index", "middle", "ring", "pinky"}, 2, false, true, 0}};
  for (const Shape& shape : shapes) {
    CAPTURE(shape.fingers.size());
    const test::Rig rig(Hands(shape).text());
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    test::Pose pose(rig);
    pose.set(kHand + "@fist", 1.0);
    for (const std::string& finger : shape.fingers) {
      const Vec3 first = turned(rig, pose, joint(finger, shape.metacarpals ? 1 : 0), {1, 0, 0});
      CHECK(first.y < -0.9);
      if (shape.phalanges == 1) continue;
      const Vec3 second = turned(rig, pose, joint(finger, shape.metacarpals ? 2 : 1), {1, 0, 0});
      CHECK(second.x < -0.7);
    }
  }
}

TEST_CASE("modules hand: the same on every model, mirrored on both sides") {
  const auto closed = [](test::Pose& pose, const std::string& s) {
    const std::string hand = "arm_" + s + ".wrist/hand.settings";
    pose.set(hand + "@fist", 0.7).set(hand + "@spread", 0.5).set(hand + "@cup", 0.8);
    pose.set(hand + "@ring_curl", 0.2).set(hand + "@thumb_curl", 0.3);
  };
  const test::Rig plain(Hands({}).text(), test::mirror_right_side);
  test::Pose expected(plain);
  for (const char* s : {"l", "r"}) closed(expected, s);
  const auto motion = test::motion(plain, expected);
  CHECK(test::motion_difference(plain, motion, test::mirror_image(plain, motion)) < 1e-9);
  const test::Rig same(Hands({}).text());
  test::Pose left(same);
  closed(left, "l");
  const auto moved = test::motion(same, left);
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(Hands({}).text(), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    test::Pose pose(rig);
    closed(pose, "l");
    CHECK(test::motion_difference(rig, test::motion(rig, pose), test::mapped(model.by, moved)) <
          1e-9);
  }
}
