// SPDX-License-Identifier: MIT
// hand: attributes that curl, spread and cup fingers and make a fist, under the FK controls that
// each finger has already. Test: tests/modules/hand_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "modules/layers.h"
#include "modules/limbs/palm.h"
#include "modules/registry.h"

namespace rigc::modules {
namespace {

namespace transform = scene::transform;
using math::Quat;
using math::Vec3;

constexpr std::array<const char*, 4> kFingers = {"index", "middle", "ring", "pinky"};

/// Curls of a finger: a little beyond straight, a little beyond a fist.
constexpr double kStraighter = -0.4, kTighter = 1.15;

/// How far the middles of thumb and fingers lie apart where they touch, in lengths of the first
/// phalanx next to the thumb.
constexpr double kThickness = 0.38;
/// Where on that phalanx the thumb lies, and how far to its own side its last joint.
constexpr double kUnderThumb = 0.5, kBeside = 0.1;

struct Attributes {
  Plug fist, curl, spread, cup;
};

struct Hand {
  NodeId wrist, control;
  Palm palm;
  Attributes attributes;
};

Plug attribute(Builder& b, const Hand& hand, const std::string& name, double least) {
  return add_to(b, hand.control, {.name = name, .min = least, .max = 1}, "control");
}

/// A control above the back of the hand that rides on the wrist.
NodeId make_settings(Builder& b, const Hand& hand) {
  const Palm& palm = hand.palm;
  const double sign = is_mirrored(b, hand.wrist) ? -1 : 1;
  const Vec3 y = palm.inward * -sign, z = palm.along * sign;
  const Vec3 middle = (position(b, hand.wrist) + palm.knuckles) * 0.5;
  ControlSpec spec;
  spec.joint = hand.wrist;
  spec.role = "settings";
  spec.suffix = "hand";
  spec.frame = {{math::cross(y, z), y, z}, middle - palm.inward * b.with().number("distance")};
  spec.axes = AxesFrom::bone;
  spec.space = hand.wrist;
  spec.shape = b.with().text("shape");
  spec.size = b.with().number("size");
  spec.color = side_color(b, hand.wrist, "color");
  spec.translate = spec.rotate = false;
  return make_control(b, spec).control;
}

/// The rest axes of what a finger's n-th control hangs under.
math::Mat3 axes_above(const Builder& b, const Finger& finger, std::size_t n) {
  return math::orthonormal(rest(b, b.scene()[finger.controls[n]].parent).linear);
}

/// Statements of one finger, and what they name. Each turn is that of a layer above a control.
class Layers {
 public:
  Layers(Builder& b, const Finger& finger) : b_(b), finger_(finger) {}

  void give(const char* name, const Plug& plug) { given_.emplace_back(name, plug); }
  void let(const std::string& statement) { text_ += statement; }

  /// A turn of the n-th joint about an axis of rig space, by degrees that a statement gives.
  void turn(std::size_t n, Vec3 axis, const std::string& degrees) {
    const std::string name = fmt::format("axis{}", given_.size());
    given_.emplace_back(name, scene::Value(math::transposed(axes_above(b_, finger_, n)) * axis));
    add(n, fmt::format("axis_angle({}, {})", name, degrees));
  }

  /// A part of a turn of rig space.
  void turn(std::size_t n, Quat whole, const std::string& part) {
    const Quat axes = math::quaternion(axes_above(b_, finger_, n));
    const std::string name = fmt::format("whole{}", given_.size());
    given_.emplace_back(name, scene::Value(math::conjugate(axes) * whole * axes));
    add(n, fmt::format("slerp(axis_angle(vector(1, 0, 0), 0), {}, {})", name, part));
  }

  void connect() {
    for (const auto& [n, product] : turns_) text_ += fmt::format("out turn{} = {};", n, product);
    const Computed turned = compute(b_, finger_.joints[finger_.knuckle], "hand", given_, text_);
    for (const auto& [n, product] : turns_) {
      const NodeId layer = make_layer(b_, finger_.controls[n], "hand");
      b_.connect(turned[fmt::format("turn{}", n)], {layer, transform::kRotation});
    }
  }

 private:
  void add(std::size_t n, const std::string& factor) {
    std::string& product = turns_[n];
    product += product.empty() ? factor : " * " + factor;
  }

  Builder& b_;
  const Finger& finger_;
  std::vector<Given> given_;
  std::string text_;
  std::map<std::size_t, std::string> turns_;  ///< by joint, the outer factor first
};

/// Degrees of the phalanges in a fist as the parameter gives them, shared out where there are
/// fewer than three.
std::vector<double> fist_angles(const Builder& b, std::size_t phalanges) {
  const Vec3 fist = b.with().vec3("fist");
  if (phalanges == 1) return {fist.x};
  if (phalanges == 2) return {fist.x, fist.y + fist.z / 4};
  return {fist.x, fist.y, fist.z};
}

/// Degrees about `axis` by which each phalanx closes from where it rests to a fist.
std::vector<double> closing(const Builder& b, const Palm& palm, const Finger& finger, Vec3 axis) {
  const std::size_t knuckle = finger.knuckle;
  std::vector<double> angles = fist_angles(b, finger.bones.size() - knuckle);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const Vec3 before = i == 0 ? palm.along : finger.bones[knuckle + i - 1];
    const double already = bend_between(before, finger.bones[knuckle + i], axis);
    angles[i] = std::max(angles[i] - already, 0.0);
  }
  return angles;
}

/// `side`: 1 for the finger next to the thumb, -1 for the last, between them in between.
void bend_finger(Builder& b, const Hand& hand, const Finger& finger, double side,
                 const std::string& name) {
  const Palm& palm = hand.palm;
  const Plug own = attribute(b, hand, name + "_curl", -1);
  if (b.failed()) return;
  Layers layers(b, finger);
  layers.give("fist", hand.attributes.fist);
  layers.give("curl", hand.attributes.curl);
  layers.give("spread", hand.attributes.spread);
  layers.give("cup", hand.attributes.cup);
  layers.give("own", own);
  layers.let(fmt::format("bent = clamp(fist + curl + own, {}, {});", kStraighter, kTighter));
  layers.let("open = spread * (1 - clamp(bent, 0, 1));");

  // The outer fingers fold the palm: their first joint bends and rolls to its middle.
  const double fold = side < 0 ? -side : 0.4 * side, cup = b.with().number("cup");
  layers.turn(0, math::cross(palm.inward, palm.across) * (side < 0 ? 1.0 : -1.0),
              fmt::format("cup * {}", 0.8 * fold * cup));
  layers.turn(0, math::cross(palm.along, palm.inward), fmt::format("cup * {}", fold * cup));

  const std::size_t knuckle = finger.knuckle;
  layers.turn(knuckle, math::cross(palm.along, palm.across),
              fmt::format("open * {}", side * b.with().number("spread")));
  const Vec3 axis = bend_axis(finger, palm.inward);
  const std::vector<double> fist = closing(b, palm, finger, axis);
  for (std::size_t i = 0; i < fist.size(); ++i)
    layers.turn(knuckle + i, axis, fmt::format("bent * {}", fist[i]));
  layers.connect();
}

/// Where a thumb lies on a finger in a fist: on its second phalanx, or its only one, nearer to the
/// end.
Vec3 under_thumb(const Builder& b, const Palm& palm, const Finger& finger) {
  const Vec3 axis = bend_axis(finger, palm.inward);
  const std::vector<double> angles = closing(b, palm, finger, axis);
  Vec3 at = position(b, finger.joints[finger.knuckle]);
  double bent = 0;
  for (std::size_t i = 0;; ++i) {
    const std::size_t n = finger.knuckle + i;
    bent += angles[i];
    const Vec3 bone = math::rotate(math::axis_angle(axis, math::radians(bent)),
                                   finger.bones[n] * bone_length(b, finger, n));
    const bool last = i == 1 || i + 1 == angles.size();
    at = at + bone * (last ? kUnderThumb : 1);
    if (last) return at;
  }
}

/// Where the bones of a thumb point in a fist, from its first phalanx or metacarpal on: the last
/// lies over the second phalanges of the first two fingers, toward the little finger, and those
/// before reach for where it begins. `fingers`: thumb's side first.
std::vector<Vec3> thumb_in_fist(const Builder& b, const Palm& palm, const Finger& thumb,
                                const std::vector<Finger>& fingers) {
  const Finger& near = fingers.front();
  const Finger& over = fingers[std::min<std::size_t>(1, fingers.size() - 1)];
  const double thick = kThickness * bone_length(b, near, near.knuckle);
  const Vec3 outside = palm.inward * thick;
  const Vec3 beside = under_thumb(b, palm, near) + outside + palm.across * (kBeside * thick);
  const Vec3 tip = under_thumb(b, palm, over) + outside;
  Vec3 at = position(b, thumb.joints[thumb.knuckle]);
  std::vector<Vec3> bones;
  const std::size_t count = thumb.bones.size() - thumb.knuckle;
  if (count == 3) {
    const double first = bone_length(b, thumb, thumb.knuckle);
    const double second = bone_length(b, thumb, thumb.knuckle + 1);
    const Vec3 bend = palm.across + palm.along * 0.5 + palm.inward * 0.5;
    bones.push_back(first_of_two(beside - at, first, second, bend));
    at = at + bones.back() * first;
  }
  if (count >= 2) {
    bones.push_back(math::normalised(beside - at, thumb.bones[thumb.knuckle + count - 2]));
    at = at + bones.back() * bone_length(b, thumb, thumb.knuckle + count - 2);
  }
  bones.push_back(math::normalised(tip - at, thumb.bones.back()));
  return bones;
}

/// The thumb has no palm behind it: in a fist its bones turn to where they lie across the fingers.
void bend_thumb(Builder& b, const Hand& hand, const Finger& thumb,
                const std::vector<Finger>& fingers) {
  const Palm& palm = hand.palm;
  const Plug own = attribute(b, hand, "thumb_curl", -1);
  if (b.failed()) return;
  Layers layers(b, thumb);
  layers.give("fist", hand.attributes.fist);
  layers.give("spread", hand.attributes.spread);
  layers.give("cup", hand.attributes.cup);
  layers.give("own", own);
  const std::size_t first = thumb.knuckle, count = thumb.bones.size() - first;
  const Vec3 base = thumb.bones[first];
  layers.turn(first, math::normalised(math::cross(base, palm.across)),
              fmt::format("spread * (1 - fist) * {}", b.with().number("spread")));
  const Vec3 axis = bend_axis(thumb, thumb_inward(palm));
  const std::vector<Vec3> closed = thumb_in_fist(b, palm, thumb, fingers);
  Quat before;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 now = math::rotate(before, thumb.bones[first + i]);
    const Quat turned = math::between(now, closed[i]) * before;
    const char* part = i == 0 ? "clamp(fist + 0.4 * cup * (1 - fist), 0, 1)" : "fist";
    layers.turn(first + i, math::conjugate(before) * turned, part);
    if (i > 0 || count == 1)
      layers.turn(first + i, axis, fmt::format("own * {}", i + 1 == count ? 70 : 45));
    before = turned;
  }
  layers.connect();
}

}  // namespace

void hand(Builder& b) {
  const Parameters& with = b.with();
  std::vector<Finger> fingers;
  std::vector<const char*> names;
  for (const char* name : kFingers) {
    if (with.nodes(name).empty()) continue;
    fingers.push_back(finger_from(b, with.nodes(name), b.joint()));
    names.push_back(name);
  }
  if (fingers.empty()) return;
  Hand hand;
  hand.wrist = b.joint();
  hand.palm = palm_from(b, hand.wrist, fingers);
  hand.control = with.has("control") ? with.node("control") : make_settings(b, hand);
  if (b.failed()) return;
  hand.attributes.fist = attribute(b, hand, "fist", 0);
  if (!b.failed()) hand.attributes.curl = attribute(b, hand, "curl", -1);
  if (!b.failed()) hand.attributes.spread = attribute(b, hand, "spread", -1);
  if (!b.failed()) hand.attributes.cup = attribute(b, hand, "cup", 0);
  if (b.failed()) return;
  if (!with.nodes("thumb").empty())
    bend_thumb(b, hand, finger_from(b, with.nodes("thumb")), fingers);
  for (std::size_t i = 0; i < fingers.size() && !b.failed(); ++i) {
    const double last = static_cast<double>(fingers.size() - 1);
    const double side = last == 0 ? 0 : 1 - 2 * static_cast<double>(i) / last;
    bend_finger(b, hand, fingers[i], side, names[i]);
  }
}

}  // namespace rigc::modules
