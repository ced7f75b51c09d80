// SPDX-License-Identifier: MIT
// Which control says which joint. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_plan.h"

#include <algorithm>
#include <map>
#include <set>

#include "bake/joints.h"
#include "bake/transfer_order.h"
#include "bake/transfer_own.h"
#include "bake/transfer_plugs.h"
#include "base/trace.h"
#include "eval/evaluate.h"
#include "scene/hierarchy.h"

namespace rigc::bake {
namespace {

using scene::Kind;
using scene::NodeId;
using scene::Plug;
namespace transform = scene::transform;
namespace constraint = scene::constraint;
namespace ik2 = scene::ik2;

/// How far joints may be off because transforms of their own are left out, in sizes of the
/// character: with rounding it stays below 1e-5.
constexpr double kLeftOut = 4e-6;

/// A control that something is fixed to, and where that is seen from it.
struct Carrier {
  NodeId control;
  math::Affine offset;
};

/// What a constraint takes from one of its targets.
struct Followed {
  Plug source;  ///< a world
  math::Affine offset;
};

/// A joint's rotation as a two-bone solver gives it.
struct Solved {
  NodeId solver;
  int start = -1, middle = -1;  ///< indices of aims
};

class Planner {
 public:
  Planner(const scene::Scene& scene, const std::vector<int>& nodes, const std::vector<Aim>& aims,
          const std::vector<SwitchValue>& switches, Diagnostics& diagnostics)
      : scene_(scene), nodes_(nodes), aims_(aims), diagnostics_(diagnostics) {
    for (const SwitchValue& value : switches) settings_.push_back({value.attribute, value.value});
    stay_ = negligible(scene, aims, kLeftOut * extent(scene, aims));
  }

  std::optional<TransferPlan> plan() {
    const std::size_t errors = diagnostics_.errors();
    for (std::size_t i = 0; i < aims_.size(); ++i) bind(static_cast<int>(i));
    for (const auto& [index, solved] : solvers_) bind_limb(solved);
    if (diagnostics_.errors() != errors) return std::nullopt;
    TransferPlan plan{std::move(unknowns_), 0};
    plan.levels = order(scene_, plan.unknowns);
    return plan;
  }

 private:
  bool is_driven(NodeId id, std::uint16_t attribute) const {
    return bake::is_driven(scene_, {id, attribute});
  }

  /// Up from a node over transforms that are fixed to their parents, to a control of the file.
  std::optional<Carrier> carrier(NodeId id) const {
    Carrier out{id, {}};
    for (; out.control.valid(); out.control = scene::transform_above(scene_, out.control)) {
      const Kind kind = scene_[out.control].kind;
      if (kind == Kind::control && nodes_[out.control.index] >= 0) return out;
      const bool fixed = kind != Kind::joint && !is_driven(out.control, transform::kTranslate) &&
                         !is_driven(out.control, transform::kRotation) &&
                         !is_driven(out.control, transform::kScale);
      if (!fixed) return std::nullopt;
      out.offset = math::compose(scene_.local(out.control)) * out.offset;
    }
    return std::nullopt;
  }

  /// The target that has all the weight.
  std::optional<Followed> followed(NodeId node) {
    const std::size_t count = scene_[node].attributes[constraint::kTargets].size();
    std::vector<Plug> weights;
    for (std::size_t i = 0; i < count; ++i)
      weights.push_back({node, constraint::kWeights, static_cast<std::int32_t>(i)});
    std::size_t strongest = 0;
    if (count == 0) return std::nullopt;
    if (count > 1) {
      const auto values = eval::evaluate(scene_, weights, settings_, diagnostics_);
      if (!values) return std::nullopt;
      for (std::size_t i = 1; i < count; ++i)
        if (std::get<double>((*values)[i]) > std::get<double>((*values)[strongest])) strongest = i;
    }
    const auto element = static_cast<std::int32_t>(strongest);
    const auto source = scene_.source({node, constraint::kTargets, element});
    if (!source) return std::nullopt;
    return Followed{*source,
                    std::get<math::Affine>(scene_.value({node, constraint::kOffsets, element}))};
  }

  Unknown& unknown(NodeId node, Unknown::Rule rule) {
    const auto [at, fresh] = by_node_.emplace(node, unknowns_.size());
    if (fresh) {
      unknowns_.emplace_back().node = node;
      unknowns_.back().rule = rule;
    }
    return unknowns_[at->second];
  }

  /// What turns, moves and scales one joint.
  void bind(int index) {
    const Aim& aim = aims_[static_cast<std::size_t>(index)];
    bind_path(index, transform::kRotation);
    bind_path(index, transform::kTranslate);
    bind_path(index, transform::kScale);
    const bool converted = aim.animated() && !aim.direct;
    if (!bake::is_driven(scene_, aim.id) && !converted) return;
    Unknown own;
    own.moves = is_own(index, anim::Path::translation);
    own.turns = is_own(index, anim::Path::rotation);
    own.scales = is_own(index, anim::Path::scale);
    if (!own.moves && !own.turns && !own.scales) return;
    own.node = aim.id;
    own.rule = Unknown::Rule::own;
    own.turn_aim = index;
    own.plays = aim.direct;
    unknowns_.push_back(own);
  }

  /// Whether a joint needs a channel of its own.
  bool is_own(int index, anim::Path path) const {
    const NodeId joint = aims_[static_cast<std::size_t>(index)].id;
    return !bake::is_driven(scene_, plug_of(joint, path)) && !stay_.contains({index, path});
  }

  void bind_path(int index, std::uint16_t path) {
    const NodeId joint = aims_[static_cast<std::size_t>(index)].id;
    const auto source = scene_.source({joint, path});
    if (!source) return;
    const NodeId node = source->node;
    const Kind kind = scene_[node].kind;
    if (kind == Kind::aim_constraint) return bind_look(index, node);
    if (kind != Kind::parent_constraint && kind != Kind::orient_constraint &&
        kind != Kind::scale_constraint)
      return;
    const auto target = followed(node);
    if (!target) return;
    if (scene_[target->source.node].kind == Kind::ik_two_bone) {
      Solved& solved = solvers_[target->source.node.index];
      solved.solver = target->source.node;
      (target->source.attribute == ik2::kStartWorld ? solved.start : solved.middle) = index;
      return;
    }
    if (target->source.attribute != transform::kWorld) return;
    const auto by = carrier(target->source.node);
    if (by) return follow(index, path, by->control, by->offset * target->offset);
    if (path == transform::kTranslate) bind_relay(index, target->source.node, target->offset);
  }

  /// A joint follows a transform that takes its translation from a control.
  void bind_relay(int index, NodeId relay, const math::Affine& offset) {
    const auto source = scene_.source({relay, transform::kTranslate});
    const bool fixed =
        !is_driven(relay, transform::kRotation) && !is_driven(relay, transform::kScale);
    if (!source || source->attribute != transform::kTranslate || source->component >= 0 || !fixed)
      return;
    const NodeId control = source->node;
    if (scene_[control].kind != Kind::control || nodes_[control.index] < 0) return;
    Unknown& u = unknown(control, Unknown::Rule::follow);
    if (u.move_aim >= 0) return;
    u.moves = true;
    u.move_aim = index;
    u.relay = relay;
    const math::Trs local = scene_.local(relay);
    u.control_point = math::compose({{}, local.rotation, local.scale}).linear * offset.origin;
  }

  void follow(int index, std::uint16_t path, NodeId control, const math::Affine& offset) {
    Unknown& u = unknown(control, Unknown::Rule::follow);
    if (path == transform::kTranslate) {
      if (u.move_aim >= 0) return;
      u.moves = true;
      u.move_aim = index;
      u.control_point = offset.origin;
      return;
    }
    if (u.turn_aim >= 0 && u.turn_aim != index) return;
    u.turn_aim = index;
    u.offset = offset;
    (path == transform::kScale ? u.scales : u.turns) = true;
  }

  void bind_look(int index, NodeId node) {
    const auto source = scene_.source({node, scene::aim::kTargets, 0});
    if (!source || scene_[node].attributes[scene::aim::kTargets].size() != 1) return;
    if (source->attribute != transform::kWorld) return;
    const NodeId control = source->node;
    if (scene_[control].kind != Kind::control || nodes_[control.index] < 0) return;
    Unknown& u = unknown(control, Unknown::Rule::look);
    if (u.turn_aim >= 0) return;
    u.moves = true;
    u.turn_aim = index;
    u.bone_offset = std::get<math::Quat>(scene_.value({node, scene::aim::kOffset}));
    u.distance = math::length(scene_.rest_world(control).origin -
                              scene_.rest_world(aims_[static_cast<std::size_t>(index)].id).origin);
  }

  /// Goal and pole of a limb that a solver moves.
  void bind_limb(const Solved& solved) {
    if (solved.start < 0 || solved.middle < 0) return;
    const auto goal = scene_.source({solved.solver, ik2::kGoal});
    const auto pole = scene_.source({solved.solver, ik2::kPole});
    if (const auto by = goal ? carrier(goal->node) : std::nullopt) {
      Unknown& u = unknown(by->control, Unknown::Rule::follow);
      u.moves = true;
      u.control_point =
          by->offset * std::get<math::Vec3>(scene_.value({solved.solver, ik2::kGoalOffset}));
      set_limb(u, solved);
    }
    bind_twist(solved, ik2::kStartTwist);
    bind_twist(solved, ik2::kMiddleTwist);
    const bool keyed =
        pole && scene_[pole->node].kind == Kind::control && nodes_[pole->node.index] >= 0;
    if (!keyed) return;
    Unknown& u = unknown(pole->node, Unknown::Rule::pole);
    u.moves = true;
    u.bone_offset = bone_offset(solved, 0);
    u.distance =
        math::length(scene_.rest_world(pole->node).origin -
                     scene_.rest_world(aims_[static_cast<std::size_t>(solved.middle)].id).origin);
    set_limb(u, solved);
  }

  /// The one attribute that turns a bone about itself; what lies between must be linear.
  void bind_twist(const Solved& solved, std::uint16_t twist) {
    const Plug plug{solved.solver, twist};
    const auto found = attributes_behind(scene_, {plug});
    if (found.size() != 1 || nodes_[found.begin()->node.index] < 0) return;
    double turns[2];
    for (const int value : {0, 1}) {
      const auto turn = eval::evaluate(
          scene_, {plug}, {{*found.begin(), static_cast<double>(value)}}, diagnostics_);
      if (!turn) return;
      turns[value] = std::get<double>(turn->front());
    }
    if (turns[0] == turns[1]) return;
    Unknown& u = unknowns_.emplace_back();
    u.node = found.begin()->node;
    u.rule = Unknown::Rule::twist;
    u.attribute = *found.begin();
    u.of_middle = twist == ik2::kMiddleTwist;
    u.per_degree = 1 / (turns[1] - turns[0]);
    u.at = -turns[0] * u.per_degree;
    u.bone_offset = bone_offset(solved, 0);
    u.joint_offset = bone_offset(solved, u.of_middle ? 1 : 0);
    set_limb(u, solved);
  }

  /// Rest rotation of a limb's joint seen from its bone's frame.
  math::Quat bone_offset(const Solved& solved, std::int32_t joint) const {
    return std::get<math::Quat>(scene_.value({solved.solver, ik2::kOffsets, joint}));
  }

  static void set_limb(Unknown& u, const Solved& solved) {
    u.solver = solved.solver;
    u.start = solved.start;
    u.middle = solved.middle;
  }

  const scene::Scene& scene_;
  const std::vector<int>& nodes_;
  const std::vector<Aim>& aims_;
  Diagnostics& diagnostics_;
  std::set<std::pair<int, anim::Path>> stay_;  // of joints' own transforms
  std::vector<eval::Setting> settings_;
  std::vector<Unknown> unknowns_;
  std::map<NodeId, std::size_t> by_node_;
  std::map<std::uint32_t, Solved> solvers_;  // by index of the solver
};

}  // namespace

std::optional<TransferPlan> make_plan(const scene::Scene& scene, const std::vector<int>& nodes,
                                      const std::vector<Aim>& aims,
                                      const std::vector<SwitchValue>& switches,
                                      Diagnostics& diagnostics) {
  const trace::Span span("plan");
  return Planner(scene, nodes, aims, switches, diagnostics).plan();
}

}  // namespace rigc::bake
