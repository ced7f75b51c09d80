// SPDX-License-Identifier: MIT
// fingertip_ik: a control that the tip of a finger goes to, from the pose that the finger's FK
// controls give it. Test: tests/modules/fingertip_ik_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "modules/codes.h"
#include "modules/layers.h"
#include "modules/limbs/palm.h"
#include "modules/made.h"
#include "modules/registry.h"

namespace rigc::modules {
namespace {

namespace constraint = scene::constraint;
namespace transform = scene::transform;
using math::Vec3;
using scene::Kind;
using scene::Value;

/// How far the last joint folds for each degree that three bones folding alike would need.
constexpr double kShare = 0.7;
/// Squared, in lengths of the finger: goals nearer than this to where FK has the tip are there. A
/// straight finger would turn the rounding of numbers into angles of 1e-8.
constexpr double kSlack = 1e-11;
/// In lengths of the finger: how far the tip goes at least until the last joint has lost the bend
/// that FK gave it beyond its share.
constexpr double kFade = 0.25;
/// The last bone, in lengths of the one before: the range in which vertices are believed.
constexpr double kShortest = 0.35, kLongest = 1.4, kUsual = 0.8;
/// How far a joint folds where there is one instead of two.
constexpr double kAlone = 1.15;
/// Weight above which the last joint moves a vertex.
constexpr double kMoved = 0.5;

// What follows computes in the space of the zero above the first of these controls. `f0`, `p0` and
// so on are how FK has the controls. The finger keeps its FK pose, but for three turns: `aim` of
// the first bone, the shortest way; `turn1` and `turn2` about the hinges, which FK moves along.

/// The goal, and how far away it is: squared, and held between a folded and a straight finger.
constexpr const char* kGoal = R"(
wanted = inverse(base) * goal.origin - p0;
reach0 = dot(tip0, tip0);
nearer = reach0 - dot(wanted, wanted);
reach = max(reach0 - (nearer - clamp(nearer, 0 - slack, slack)), min(closed, reach0));
)";

/// The bend of the last joint is known before that of the middle one: its share of the angle `c` by
/// which both joints would bend alike to reach as far, where the law of cosines is a quadratic
/// equation; and what FK has beyond that, as long as the goal is near FK's.
constexpr const char* kFold = R"(
even0 = acos((sqrt(lengths.y * lengths.y - lengths.x * (lengths.z - reach0)) - lengths.y)
             / lengths.x);
even = acos((sqrt(lengths.y * lengths.y - lengths.x * (lengths.z - reach)) - lengths.y)
            / lengths.x);
own = atan2(dot(cross(second, third0), hinge2), dot(second, third0)) - share * even0;
inward = sqrt(reach0) - sqrt(reach);
faded = clamp(max(inward, 0) / max(sqrt(reach0) - sqrt(closed), fade), 0, 1)
      + clamp(max(0 - inward, 0) / (longest - sqrt(reach0)), 0, 1);
turn2 = axis_angle(hinge2, share * (even - even0) - own * faded);
)";

/// The bend of the next joint, by the law of cosines about its hinge, is that with which the tip is
/// as far away as the goal. A finger that is bent backward comes through straight as it folds.
constexpr const char* kBend = R"(
folded = first + along;
flat = 2 * length(first - hinge1 * dot(first, hinge1))
     * length(along - hinge1 * dot(along, hinge1));
stays = dot(first, first) + dot(along, along) + 2 * dot(first, hinge1) * dot(along, hinge1);
bent = acos((dot(folded, folded) - stays) / flat);
more = acos((reach - stays) / flat) - bent;
over = dot(cross(first, along), hinge1) >= 0 ? more
     : more >= 0 ? more + 2 * bent * smoothstep(0, 3 * bent, more) : 0 - more;
turn1 = axis_angle(hinge1, over);
)";

/// What the program needs of a finger at rest.
struct Tip {
  std::vector<NodeId> controls;  ///< of the phalanges, first to last
  NodeId zero;                   ///< above the first
  NodeId ik;
  Vec3 at;    ///< rig space
  Vec3 axis;  ///< about which it bends, rig space
};

/// The FK controls of the finger that a node belongs to.
std::vector<NodeId> controls_of(const Builder& b, NodeId control) {
  return Made(b, control).with_role("fk");
}

/// The layers that a `hand` command put above the finger's controls, if there is one.
NodeId layer_of_hand(const Builder& b, const std::vector<NodeId>& controls) {
  for (NodeId control : controls) {
    for (NodeId at = b.scene()[control].parent; at.valid(); at = b.scene()[at].parent) {
      if (b.scene()[at].module == "hand" && b.scene()[at].identity.role == "driver") return at;
      if (b.scene()[at].identity.role == "zero") break;
    }
  }
  return {};
}

/// The FK controls that hang under the layers of a hand, finger by finger.
std::vector<std::vector<NodeId>> fingers_below(const Builder& b, const Made& hand) {
  std::vector<std::vector<NodeId>> fingers;
  for (NodeId layer : hand.with_role("driver")) {
    if (b.scene()[layer].kind != Kind::transform) continue;
    NodeId at = layer;
    while (b.scene()[at].kind != Kind::control && !b.scene()[at].children.empty())
      at = b.scene()[at].children.front();
    const std::vector<NodeId> controls = controls_of(b, at);
    if (!controls.empty() && (fingers.empty() || fingers.back() != controls))
      fingers.push_back(controls);
  }
  return fingers;
}

/// Whether the first finger of a hand is a thumb: it has a curl of its own then.
bool has_thumb(const Builder& b, const Made& hand) {
  const NodeId bends = hand.first(Kind::compute);
  const auto fist = b.scene().source({bends, scene::compute::kNumbers, 0});
  return fist && b.scene().find_plug(fist->node, "thumb_curl").has_value();
}

/// The phalanges of a finger, and the axis about which they bend: toward the palm of the hand that
/// closes it, or of a hand that has this finger alone.
std::pair<Finger, Vec3> bending(const Builder& b, const std::vector<NodeId>& controls) {
  const NodeId layer = layer_of_hand(b, controls);
  if (!layer.valid()) {
    const NodeId first = owner(b, controls.front()), above = b.scene()[first].parent;
    const Finger finger = finger_from(b, controls, above);
    return {finger,
            bend_axis(finger, palm_from(b, above.valid() ? above : first, {finger}).inward)};
  }
  const Made hand(b, layer);
  const NodeId wrist = b.index().joint(b.scene()[layer].identity.holder);
  std::vector<Finger> fingers;
  bool thumb = has_thumb(b, hand), is_thumb = false;
  for (const std::vector<NodeId>& finger : fingers_below(b, hand)) {
    if (!thumb) fingers.push_back(finger_from(b, finger, wrist));
    if (thumb) is_thumb = std::count(finger.begin(), finger.end(), controls.back()) > 0;
    thumb = false;
  }
  const Palm palm = palm_from(b, wrist, fingers);
  const Finger finger = finger_from(b, controls, is_thumb ? NodeId{} : wrist);
  return {finger, bend_axis(finger, is_thumb ? thumb_inward(palm) : palm.inward)};
}

/// Where a finger ends: at its tip joint, else as far along the last bone as the vertices of the
/// model that it moves, else at the length that is usual.
Vec3 tip_of(const Builder& b, const Finger& finger) {
  if (b.with().has("tip")) return position(b, b.with().node("tip"));
  const NodeId last = finger.joints.back();
  const Vec3 bone = finger.bones.back(), from = position(b, last);
  const double usual = bone_length(b, finger, finger.joints.size() - 1);
  double length = 0;
  for (const tags::BoundVertex& vertex : b.vertices({last}))
    if (vertex.weight > kMoved) length = std::max(length, math::dot(vertex.at - from, bone));
  const double before = usual / kUsual;
  const bool believed = length > kShortest * before && length < kLongest * before;
  return from + bone * (believed ? length : usual);
}

NodeId make_ik(Builder& b, const Finger& finger, Vec3 tip) {
  const Parameters& with = b.with();
  ControlSpec spec;
  spec.joint = finger.joints.back();
  spec.role = "ik";
  spec.axes = AxesFrom::bone;
  spec.frame = {math::orthonormal(rest(b, finger.controls.back()).linear), tip};
  spec.space = space_from(b, "parent", space_of(b, finger.joints.front()));
  spec.shape = with.text("shape");
  spec.size = with.number("size");
  spec.color =
      with.has("color")
          ? with.vec3("color")
          : std::get<Vec3>(b.scene().value({finger.controls.back(), scene::control::kColor}));
  return b.failed() ? NodeId{} : make_control(b, spec).control;
}

/// From a control up to `top`, which is not among them; empty where it does not hang below that.
std::vector<NodeId> up_to(const Builder& b, NodeId control, NodeId top) {
  std::vector<NodeId> path;
  for (NodeId at = control; at != top; at = b.scene()[at].parent) {
    if (!at.valid()) return {};
    path.push_back(at);
  }
  return path;
}

/// How FK has the control number `n`: `f` turned, `p` where, seen from the zero above the first.
std::string fk_pose(const Builder& b, const std::vector<NodeId>& path, std::size_t n,
                    std::vector<Given>& given) {
  std::string turned = n == 0 ? "" : fmt::format("f{}", n - 1);
  std::string at = n == 0 ? "" : fmt::format("p{}", n - 1);
  const auto give = [&](const char* what, const Plug& plug) {
    std::string name = fmt::format("{}{}_{}", what, n, given.size());
    const bool keyed = b.scene()[plug.node].kind == Kind::control;
    given.push_back(keyed ? Given(name, plug) : now(b, name, plug));
    return name;
  };
  for (std::size_t i = path.size(); i-- > 0;) {
    const std::string place = give("t", {path[i], transform::kTranslate});
    at += turned.empty() ? place : fmt::format(" + {} * {}", turned, place);
    turned += (turned.empty() ? "" : " * ") + give("r", {path[i], transform::kRotation});
  }
  return fmt::format("p{0} = {1};\nf{0} = {2};\n", n, at, turned);
}

/// Lengths of the bones as the zero sees them.
std::vector<double> bone_lengths(const Builder& b, const Tip& tip) {
  const math::Affine inward = math::inverse(rest(b, tip.zero));
  std::vector<double> lengths;
  for (std::size_t i = 0; i < tip.controls.size(); ++i) {
    const bool last = i + 1 == tip.controls.size();
    const Vec3 end = last ? tip.at : position(b, tip.controls[i + 1]);
    lengths.push_back(math::length(inward.linear * (end - position(b, tip.controls[i]))));
  }
  return lengths;
}

/// Squared distance of the tip where each joint is folded by an angle, as a polynomial of its
/// cosine c: x c^2 + 2 y c + z of a finger of three bones.
Vec3 quadratic(const std::vector<double>& l) {
  const double squares = l[0] * l[0] + l[1] * l[1] + l[2] * l[2];
  return {4 * l[0] * l[2], l[1] * (l[0] + l[2]), squares - 2 * l[0] * l[2]};
}

double reach_when_folded(const std::vector<double>& l, double degrees) {
  if (l.size() == 1) return l[0] * l[0];
  const double c = math::cos(math::radians(l.size() == 2 ? kAlone * degrees : degrees));
  if (l.size() == 2) return l[0] * l[0] + l[1] * l[1] + 2 * l[0] * l[1] * c;
  const Vec3 of = quadratic(l);
  return of.x * c * c + 2 * of.y * c + of.z;
}

/// A finger of one bone only aims, one of two has one hinge, one of three two.
std::string program(std::size_t bones) {
  constexpr const char* kNames[] = {"first", "second", "third"};
  const std::size_t last = bones - 1;
  std::string text;
  for (std::size_t i = 0; i < last; ++i)
    text += fmt::format("hinge{1} = f{0} * axis{0};\n{2} = p{1} - p{0};\n", i, i + 1, kNames[i]);
  text += fmt::format("{}0 = f{} * tip;\n", kNames[last], last);
  text += bones == 1   ? "tip0 = first0;\n"
          : bones == 2 ? "tip0 = first + second0;\n"
                       : "tip0 = first + (second + third0);\n";
  text += kGoal;
  if (bones == 1) {
    return text +
           "aim = between(f0 * turn * tip, wanted);\n"
           "out world0 = base * frame(p0, aim * f0 * turn);\n";
  }
  if (bones == 3) text += kFold;
  text +=
      bones == 3 ? "along = second + turn2 * (f2 * turn * tip);\n" : "along = f1 * turn * tip;\n";
  text += kBend;
  text +=
      "aim = between(first + turn1 * along, wanted);\n"
      "out world0 = base * frame(p0, aim * f0);\n";
  if (bones == 2)
    return text + "out world1 = base * frame(p0 + aim * first, aim * turn1 * f1 * turn);\n";
  return text +
         "out world1 = base * frame(p0 + aim * first, aim * turn1 * f1);\n"
         "out world2 = base * frame(p0 + aim * (first + turn1 * second),"
         " aim * turn1 * turn2 * f2 * turn);\n";
}

/// Where the IK brings what the controls bring in FK.
std::vector<Plug> solve(Builder& b, const Tip& tip) {
  const std::size_t bones = tip.controls.size();
  std::vector<Given> given{{"base", tip.zero}, {"goal", tip.ik}};
  std::string text;
  for (std::size_t i = 0; i < bones; ++i) {
    const auto path = up_to(b, tip.controls[i], i == 0 ? tip.zero : tip.controls[i - 1]);
    if (path.empty()) {
      b.fail(codes::kNoFkChain, "controls",
             fmt::format("{} does not hang under the control before it",
                         traversal::describe(b.scene(), tip.controls[i])));
      return {};
    }
    text += fk_pose(b, path, i, given);
    if (i + 1 == bones) break;
    const math::Mat3 axes = math::orthonormal(rest(b, tip.controls[i]).linear);
    given.emplace_back(fmt::format("axis{}", i), Value(math::transposed(axes) * tip.axis));
  }
  const std::vector<double> lengths = bone_lengths(b, tip);
  double longest = 0;
  for (double length : lengths) longest += length;
  given.emplace_back("turn", Plug{tip.ik, transform::kRotation});
  given.emplace_back("tip", Value(math::inverse(rest(b, tip.controls.back())) * tip.at));
  given.emplace_back("closed", Value(reach_when_folded(lengths, b.with().number("fold"))));
  given.emplace_back("slack", Value(kSlack * longest * longest));
  if (bones == 3) {
    given.emplace_back("lengths", Value(quadratic(lengths)));
    given.emplace_back("longest", Value(longest));
    given.emplace_back("share", Value(kShare));
    given.emplace_back("fade", Value(kFade * longest));
  }
  const Computed solved =
      compute(b, owner(b, tip.controls.back()), "fingertip", given, text + program(bones));
  std::vector<Plug> worlds;
  for (std::size_t i = 0; i < bones; ++i) worlds.push_back(solved[fmt::format("world{}", i)]);
  return worlds;
}

/// Lets what brings a joint to its control bring it to another world too.
void blend(Builder& b, NodeId control, const Plug& world, const Plug& fk, const Plug& ik) {
  const NodeId joint = owner(b, control);
  const NodeId follows = Made(b, control).first(Kind::parent_constraint, "driver", joint);
  if (!follows.valid()) {
    b.fail(codes::kNoFkChain, "controls",
           fmt::format("{} moves no joint", traversal::describe(b.scene(), control)));
    return;
  }
  const math::Affine at = rest(b, control);
  b.set({follows, constraint::kTargets, 1}, at);
  b.set({follows, constraint::kWeights, 1}, b.scene().number(ik));
  b.set({follows, constraint::kOffsets, 1}, math::inverse(at) * rest(b, joint));
  b.connect(world, {follows, constraint::kTargets, 1});
  b.connect(fk, {follows, constraint::kWeights, 0});
  b.connect(ik, {follows, constraint::kWeights, 1});
}

}  // namespace

void fingertip_ik(Builder& b) {
  const std::vector<NodeId>& controls = b.with().nodes("controls");
  if (controls.empty()) return;
  const auto [finger, axis] = bending(b, controls);
  Tip tip;
  tip.controls.assign(controls.begin() + static_cast<std::ptrdiff_t>(finger.knuckle),
                      controls.end());
  tip.zero = zero_of(b, tip.controls.front());
  if (!tip.zero.valid()) {
    b.fail(codes::kNoZero, "controls",
           fmt::format("{} has no zero", traversal::describe(b.scene(), tip.controls.front())));
    return;
  }
  tip.at = tip_of(b, finger);
  tip.axis = axis;
  tip.ik = make_ik(b, finger, tip.at);
  if (b.failed()) return;
  const Plug ik = add_number(
      b, tip.ik, {.name = "ik_fk", .value = b.with().number("ik_fk"), .min = 0, .max = 1});
  const std::vector<Plug> worlds = solve(b, tip);
  if (b.failed()) return;
  const Plug fk = formula(b, finger.joints.back(), "fk_weight", "1 - $0", {ik});
  for (std::size_t i = 0; i < worlds.size() && !b.failed(); ++i)
    blend(b, tip.controls[i], worlds[i], fk, ik);
}

}  // namespace rigc::modules
