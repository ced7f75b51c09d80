// SPDX-License-Identifier: MIT
// Which control says which joint. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_plan.h"

#include <algorithm>
#include <map>
#include <set>

#include "bake/joints.h"
#include "bake/match.h"
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
  math::Affine offset;  ///< from `turned` where that is valid
  NodeId turned;        ///< see Unknown
  math::Affine before;
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
    limbs_ = find_match_limbs(scene);
    stay_ = negligible(scene, aims, kLeftOut * extent(scene, aims));
  }

  std::optional<TransferPlan> plan() {
    const std::size_t errors = diagnostics_.errors();
    for (std::size_t i = 0; i < aims_.size(); ++i) bind(static_cast<int>(i));
    for (const auto& [index, solved] : solvers_) bind_limb(solved);
    for (const MatchLimb& limb : limbs_) bind_lengths(limb);
    if (diagnostics_.errors() != errors) return std::nullopt;
    TransferPlan plan{std::move(unknowns_), 0, false};
    plan.levels = order(scene_, plan.unknowns, plan.feedback);
    return plan;
  }

 private:
  bool is_driven(NodeId id, std::uint16_t attribute) const {
    return bake::is_driven(scene_, {id, attribute});
  }

  /// Whether a transform's value comes from where controls are, not from their attributes alone,
  /// which stay as they are.
  bool moves_with_controls(NodeId id, std::uint16_t attribute) const {
    std::vector<Plug> open{{id, attribute}};
    std::set<Plug> seen(open.begin(), open.end());
    while (!open.empty()) {
      const Plug plug = open.back();
      open.pop_back();
      const bool of_transform = scene::spec(scene_[plug.node].kind).is_transform;
      if (of_transform && plug.node != id && plug.attribute < transform::kCount) return true;
      for (const Plug& need : needs_of(scene_, plug))
        if (seen.insert(need).second) open.push_back(need);
    }
    return false;
  }

  /// Up from a node over transforms that are fixed to their parents, to a control of the file.
  std::optional<Carrier> carrier(NodeId id) const {
    Carrier out{id, {}, {}, {}};
    for (; out.control.valid(); out.control = scene::transform_above(scene_, out.control)) {
      const NodeId at = out.control;
      const Kind kind = scene_[at].kind;
      if (kind == Kind::control && nodes_[at.index] >= 0) return out;
      const auto stays = [&](std::uint16_t attribute) {
        return !is_driven(at, attribute) || !moves_with_controls(at, attribute);
      };
      if (kind == Kind::joint || !stays(transform::kTranslate) || !stays(transform::kScale))
        return std::nullopt;
      math::Trs local = scene_.local(at);
      if (!stays(transform::kRotation)) {
        if (out.turned.valid() || !turns_as_control(at)) return std::nullopt;
        out.turned = at;
        out.offset = math::compose({{}, {}, local.scale}) * out.offset;
        local = {local.translation, {}, {1, 1, 1}};
      }
      math::Affine& seen = out.turned.valid() ? out.before : out.offset;
      seen = math::compose(local) * seen;
    }
    return std::nullopt;
  }

  /// Whether a control's own rotation is a transform's.
  bool turns_as_control(NodeId id) const {
    const auto source = scene_.source({id, transform::kRotation});
    return source && scene_[source->node].kind == Kind::control &&
           source->attribute == transform::kRotation && source->component < 0;
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
    if (by) return follow(index, path, *by, by->offset * target->offset);
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

  /// What a control carries for several reasons is seen from one place.
  static bool set_carrier(Unknown& u, const Carrier& by) {
    const bool bound = u.turn_aim >= 0 || u.move_aim >= 0 || u.solver.valid();
    if (bound && u.turned != by.turned) return false;
    u.turned = by.turned;
    u.before = by.before;
    return true;
  }

  void follow(int index, std::uint16_t path, const Carrier& by, const math::Affine& offset) {
    Unknown& u = unknown(by.control, Unknown::Rule::follow);
    if (!set_carrier(u, by)) return;
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

  /// What a limb's end stays behind its goal by is nothing while the limb is at true length.
  NodeId goal_above(NodeId solver, NodeId goal) const {
    const bool has_options = std::any_of(limbs_.begin(), limbs_.end(), [&](const MatchLimb& limb) {
      return limb.solver == solver && limb.by.contains("soft");
    });
    const auto moved = scene_.source({goal, transform::kTranslate});
    const bool stays_behind = has_options && moved && scene_[moved->node].kind == Kind::compute;
    return stays_behind ? scene::transform_above(scene_, goal) : goal;
  }

  /// Goal and pole of a limb that a solver moves.
  void bind_limb(const Solved& solved) {
    if (solved.start < 0 || solved.middle < 0) return;
    const auto goal = scene_.source({solved.solver, ik2::kGoal});
    const auto pole = scene_.source({solved.solver, ik2::kPole});
    if (const auto by = goal ? carrier(goal_above(solved.solver, goal->node)) : std::nullopt) {
      Unknown& u = unknown(by->control, Unknown::Rule::follow);
      if (!set_carrier(u, *by)) return;
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
    u.swivels = swivels(solved);
  }

  /// Whether the limb is turned from the side of its pole, and its bones back, by how far its goal
  /// is away: see two_bone.cpp of the modules.
  bool swivels(const Solved& solved) const {
    return scene_.source({solved.solver, ik2::kTwist}).has_value();
  }

  /// The one attribute that turns a bone about itself; what lies between must be linear.
  void bind_twist(const Solved& solved, std::uint16_t twist) {
    const Plug plug{solved.solver, twist}, swivel{solved.solver, ik2::kTwist};
    auto found = attributes_behind(scene_, {plug});
    for (const Plug& other : attributes_behind(scene_, {swivel})) found.erase(other);
    if (found.size() != 1 || nodes_[found.begin()->node.index] < 0) return;
    double turns[2];
    for (const int value : {0, 1}) {
      const auto turn = eval::evaluate(
          scene_, {plug, swivel}, {{*found.begin(), static_cast<double>(value)}}, diagnostics_);
      if (!turn) return;
      turns[value] = std::get<double>(turn->front());
      if (swivels(solved)) turns[value] += std::get<double>(turn->back());
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
    u.swivels = swivels(solved);
  }

  bool is_above(NodeId above, NodeId id) const {
    while (id.valid() && id != above) id = scene::transform_above(scene_, id);
    return id.valid();
  }

  int aim_of(NodeId joint) const {
    for (std::size_t i = 0; i < aims_.size(); ++i)
      if (aims_[i].id == joint) return static_cast<int>(i);
    return -1;
  }

  /// What lengthens the bones of a limb, in FK or in IK as it stands.
  void bind_lengths(const MatchLimb& limb) {
    const auto solved = solvers_.find(limb.solver.index);
    const bool ik = solved != solvers_.end() && solved->second.start >= 0;
    bind_length(limb, ik ? "upper_length" : "fk_upper_length", 0);
    bind_length(limb, ik ? "lower_length" : "fk_lower_length", 1);
  }

  void bind_length(const MatchLimb& limb, std::string_view meaning, std::size_t bone) {
    const auto found = limb.by.find(meaning);
    if (found == limb.by.end() || nodes_[found->second.node.index] < 0) return;
    const NodeId before = limb.joints[bone], joint = limb.joints[bone + 1];
    const int upper = aim_of(before), lower = aim_of(joint);
    if (upper < 0 || lower < 0 || bake::is_driven(scene_, found->second)) return;
    if (!is_above(before, joint)) return;  // it hangs elsewhere, and is moved from there
    Unknown& u = unknowns_.emplace_back();
    u.node = found->second.node;
    u.rule = Unknown::Rule::length;
    u.attribute = found->second;
    u.upper = upper;
    u.lower = lower;
    u.bone = math::inverse(scene_.rest_world(before)) * scene_.rest_world(joint).origin;
    const auto& attribute = scene_[u.node].user[u.attribute.attribute - scene::kUserAttributes];
    u.least = attribute.min.value_or(0);
    u.is_single = scene::transform_above(scene_, joint) == before;
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
  std::vector<MatchLimb> limbs_;
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
