// SPDX-License-Identifier: MIT
// auto_clavicle: a clavicle that lifts, drops and swings with the arm. It reads where the upper arm
// would point if the clavicle were at rest: in FK from what its controls turn, in IK from a second
// solution that starts at the resting shoulder; FK controls that follow other spaces are read in
// these. So the arm may hang on the clavicle without a cycle. Test:
// tests/modules/auto_clavicle_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "modules/layers.h"
#include "modules/limbs/limb_match.h"
#include "modules/registry.h"

namespace rigc::modules {
namespace {

namespace transform = scene::transform;
using math::Vec3;

struct Arm {
  std::vector<NodeId> joints;  ///< upper arm, forearm and, of an IK/FK limb, hand
  NodeId fk;                   ///< control of the upper arm
  NodeId turned;               ///< what the upper arm follows in FK: that control, or what a gimbal
                               ///< put under it
  LimbParts limb;
  bool has_ik = false;
};

Arm arm_from(Builder& b) {
  const NodeId named = b.with().node("limb");
  const Made made(b, named);
  Arm arm;
  if (made.module() == "fk_chain") {
    const std::vector<NodeId> controls = made.with_role("fk");
    for (NodeId control : controls) arm.joints.push_back(owner(b, control));
    arm.fk = controls.front();
    const auto driver = b.scene().source({arm.joints[0], transform::kRotation});
    arm.turned = b.scene().source({driver->node, scene::constraint::kTargets, 0})->node;
    return arm;
  }
  arm.limb = limb_from(b, "limb");
  if (b.failed()) return arm;
  arm.joints.assign(arm.limb.joints.begin(), arm.limb.joints.end());
  arm.fk = arm.limb.fk[0];
  arm.turned = b.scene().source({arm.limb.blends[0], scene::constraint::kTargets, 0})->node;
  arm.has_ik = true;
  return arm;
}

/// Directions of the character as the clavicle's zero sees them: across the shoulder to the arm's
/// side, up, forward.
struct Axes {
  Vec3 out, up, forward;
};

/// Statements that give `lift` and `push` of a direction: degrees by which the clavicle turns up
/// and forward. How far the arm has turned up or forward from sideways is the turn vector of the
/// shortest turn that leads there; it fades where the arm points to the other side, where there is
/// no shortest one.
std::string response(const std::string& name) {
  return fmt::format(
      "{0}_normal = cross(out_axis, {0});"
      "{0}_angle = atan2(length({0}_normal), dot(out_axis, {0}));"
      "{0}_turn = normalise({0}_normal) * {0}_angle; {0}_part = 1 - smoothstep(100, 180, "
      "{0}_angle);"
      "{0}_up = dot({0}_turn, up_turn); {0}_forward = dot({0}_turn, forward_turn);"
      "{0}_lift = {0}_part * (smoothstep(0, 90, {0}_up) * up - smoothstep(0, 90, -{0}_up) * down);"
      "{0}_ahead = smoothstep(0, 90, {0}_forward) * forward;"
      "{0}_push = {0}_part * ({0}_ahead - smoothstep(0, 90, -{0}_forward) * back);",
      name);
}

/// Statements that give the direction of the upper arm that reaches from the resting shoulder for
/// a point: law of cosines, bent toward a second point. Both seen from the clavicle's zero.
std::string reaching(const std::string& name, const std::string& goal, const std::string& pole) {
  return fmt::format(
      "{0}_reach = {1} - shoulder; {0}_bend = {2} - shoulder;"
      "{0}_far = clamp(length({0}_reach), least, most); {0}_way = normalise({0}_reach);"
      "{0}_side = normalise({0}_bend - {0}_way * dot({0}_bend, {0}_way));"
      "{0}_cosine = ({0}_far * {0}_far + upper * upper - lower * lower) / (2 * upper * {0}_far);"
      "{0} = {0}_way * {0}_cosine + {0}_side * sqrt(1 - {0}_cosine * {0}_cosine);",
      name, goal, pole);
}

/// What the FK controls turn the upper arm by, in the space of the zero of the first: controls, and
/// what turns with a control.
std::string fk_turn(const Builder& b, const Arm& arm, std::vector<Given>& given) {
  std::string product;
  for (NodeId at = arm.turned; at.valid() && b.scene()[at].identity.role != "zero";
       at = b.scene()[at].parent) {
    const Plug own{at, transform::kRotation};
    const Plug plug = b.scene().source(own).value_or(own);
    if (b.scene()[plug.node].kind != scene::Kind::control) continue;
    const std::string name = fmt::format("turn{}", given.size());
    given.emplace_back(name, plug);
    product = product.empty() ? name : name + " * " + product;
  }
  return product;
}

constexpr int kMostFollowed = 8;

/// What a node follows by a constraint on its rotation.
struct Followed {
  NodeId constraint;  ///< invalid: nothing
  std::vector<NodeId> spaces;
};

Followed followed_by(const Builder& b, NodeId node) {
  const auto source = b.scene().source({node, transform::kRotation});
  if (!source || b.scene()[source->node].kind != scene::Kind::parent_constraint) return {};
  Followed out{source->node, {}};
  const auto& targets = b.scene()[source->node].attributes[scene::constraint::kTargets];
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Plug target{out.constraint, scene::constraint::kTargets, static_cast<std::int32_t>(i)};
    if (const auto space = b.scene().source(target)) out.spaces.push_back(space->node);
  }
  return out;
}

/// Whether a node hangs below a joint or its control, or follows what does. Constraints may go
/// round in a circle, which is found when the rig is compiled.
bool is_carried(const Builder& b, NodeId node, NodeId joint, NodeId control, int depth = 0) {
  for (NodeId at = node; at.valid(); at = b.scene()[at].parent) {
    if (at == joint || at == control) return true;
    if (depth == kMostFollowed || b.scene()[at].kind == scene::Kind::joint) continue;
    for (const NodeId space : followed_by(b, at).spaces)
      if (is_carried(b, space, joint, control, depth + 1)) return true;
  }
  return false;
}

/// The same spaces as if the clavicle rested: what it carries stays with its zero, of which these
/// are seen. The constraint that turns what the node would be turned like.
NodeId still(Builder& b, NodeId node, const Followed& followed, NodeId zero, NodeId control) {
  namespace constraint = scene::constraint;
  const NodeId joint = owner(b, control);
  std::vector<Target> targets;
  for (NodeId space : followed.spaces) {
    if (is_carried(b, space, joint, control))
      space = make_place(b, joint, "still_space", zero, rest(b, space));
    targets.push_back(target(b, space));
  }
  const NodeId place = make_place(b, joint, "still", zero, rest(b, node));
  const NodeId made =
      make_constraint(b, scene::Kind::parent_constraint, place, targets, {}, true, "space", joint);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const auto element = static_cast<std::int32_t>(i);
    const Plug weight{followed.constraint, constraint::kWeights, element};
    b.set({made, constraint::kWeights, element}, b.scene().value(weight));
    if (const auto source = b.scene().source(weight))
      b.connect(*source, {made, constraint::kWeights, element});
  }
  return made;
}

class Program {
 public:
  Program(Builder& b, const Arm& arm, NodeId zero, NodeId control)
      : b_(b), arm_(arm), zero_(zero), control_(control) {
    to_zero_ = math::inverse(rest(b, zero));
    for (NodeId joint : arm.joints) at_.push_back(to_zero_ * position(b, joint));
  }

  /// The turn of the clavicle by `amount` of its response, seen from its zero.
  Plug turn(const Plug& amount) {
    give_constants();
    given_.emplace_back("amount", amount);
    text_ = "up_turn = cross(out_axis, up_axis); forward_turn = cross(out_axis, forward_axis);";
    add_fk();
    if (arm_.has_ik) add_ik();
    const std::string blend = arm_.has_ik ? "lerp(fk_{0} - rest_{0}, ik_{0} - still_{0}, ik_weight)"
                                          : "fk_{0} - rest_{0}";
    text_ += "raised = up_turn * (" + fmt::format(fmt::runtime(blend), "lift") + ") + ";
    text_ += "forward_turn * (" + fmt::format(fmt::runtime(blend), "push") + ");";
    text_ += "out turn = axis_angle(raised, length(raised) * amount);";
    return compute(b_, owner(b_, zero_), "auto_clavicle", given_, text_)["turn"];
  }

 private:
  void give_constants() {
    const Parameters& with = b_.with();
    const Vec3 arm = at_[1] - at_[0];
    const Vec3 left = seen(b_.character().left);
    given_.emplace_back("out_axis", scene::Value(math::dot(at_[0], left) < 0 ? -left : left));
    given_.emplace_back("up_axis", scene::Value(seen(b_.character().up)));
    given_.emplace_back("forward_axis", scene::Value(seen(b_.character().forward)));
    for (const char* extreme : {"up", "down", "forward", "back"})
      given_.emplace_back(extreme, scene::Value(with.number(extreme)));
    given_.emplace_back("rest", scene::Value(math::normalised(arm)));
  }

  void add_fk() {
    const NodeId base = zero_of(b_, arm_.fk);
    const math::Mat3 frame =
        math::orthonormal(to_zero_.linear) * math::orthonormal(rest(b_, base).linear);
    given_.emplace_back("fk_frame", scene::Value(math::quaternion(frame)));
    given_.push_back(fk_zero(base, frame));
    const std::string turn = fk_turn(b_, arm_, given_);
    text_ += "fk = fk_zero * (" + turn + ") * inverse(fk_frame) * rest;";
    text_ += response("fk") + response("rest");
  }

  /// How the zero of the first FK control is turned, seen from the clavicle's zero: as it rests
  /// where the clavicle carries it, else as the spaces say that it follows.
  Given fk_zero(NodeId base, const math::Mat3& at_rest) {
    const Followed followed = followed_by(b_, base);
    const NodeId joint = owner(b_, control_);
    for (const NodeId space : followed.spaces)
      if (!is_carried(b_, space, joint, control_))
        return {"fk_zero",
                Plug{still(b_, base, followed, zero_, control_), scene::constraint::kRotation}};
    return {"fk_zero", scene::Value(math::quaternion(at_rest))};
  }

  void add_ik() {
    const double upper = math::length(at_[1] - at_[0]), lower = math::length(at_[2] - at_[1]);
    // Short of straight, so that a straight arm that moves by a rounding error moves nothing.
    constexpr double kStraight = 1 - 1e-6;
    given_.emplace_back("upper", scene::Value(upper));
    given_.emplace_back("lower", scene::Value(lower));
    given_.emplace_back("least", scene::Value(std::abs(upper - lower) + 1e-6 * upper));
    given_.emplace_back("most", scene::Value((upper + lower) * kStraight));
    given_.emplace_back("shoulder", scene::Value(at_[0]));
    given_.emplace_back("hand", scene::Value(at_[2]));
    given_.emplace_back("pole_rest", scene::Value(to_zero_ * position(b_, arm_.limb.pole)));
    const NodeId goal = arm_.limb.goal;
    given_.emplace_back("in_goal",
                        scene::Value(math::inverse(rest(b_, goal)) * position(b_, arm_.joints[2])));
    given_.emplace_back("zero", zero_);
    given_.emplace_back("goal", goal);
    given_.emplace_back("pole", arm_.limb.pole);
    given_.emplace_back("ik_weight", arm_.limb.ik_weight);
    text_ += "seen = inverse(zero);";
    text_ += reaching("ik", "seen * (goal * in_goal)", "seen * pole.origin");
    text_ += reaching("still", "hand", "pole_rest") + response("ik") + response("still");
  }

  Vec3 seen(Vec3 direction) const { return math::normalised(to_zero_.linear * direction); }

  Builder& b_;
  const Arm& arm_;
  NodeId zero_, control_;  ///< of the clavicle
  math::Affine to_zero_;
  std::vector<Vec3> at_;  ///< rest positions of the arm's joints, seen from the zero
  std::vector<Given> given_;
  std::string text_;
};

}  // namespace

void auto_clavicle(Builder& b) {
  const Parameters& with = b.with();
  const NodeId control = with.node("control");
  const Arm arm = arm_from(b);
  if (b.failed() || !check_order(b, arm.joints, "limb")) return;
  const Plug amount =
      add_number(b, control, {.name = "auto", .value = with.number("auto"), .min = 0, .max = 1});
  const Plug turn = Program(b, arm, zero_of(b, control), control).turn(amount);
  b.connect(turn, {make_layer(b, control, "auto"), transform::kRotation});
  if (arm.has_ik) add_held(b, arm.limb.match, control);
}

}  // namespace rigc::modules
