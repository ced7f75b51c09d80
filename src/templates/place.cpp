// SPDX-License-Identifier: MIT
// Placing: Expanded -> TaggedSkeleton in the template's own proportions. Chains become joints. In a
// mirrored part a joint's frame is the reflected one with all axes turned round: -M R. It is
// right-handed, and a rotation Q of the joint moves the world by (-M R) Q (-M R)^-1 = M (R Q R^-1)
// M, which is the mirror image. Test: tests/templates/place_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/trace.h"
#include "templates/chain.h"
#include "templates/codes.h"
#include "templates/expand.h"

namespace rigc::templates {
namespace {

using math::Affine;
using math::Mat3;
using math::Vec3;

Mat3 times(const Mat3& m, double s) { return {m.x * s, m.y * s, m.z * s}; }

/// Where a part stands: its own space to the outer one, or to the main template's.
struct Space {
  Affine to_main;         ///< with sizes and reflections
  double size = 1;        ///< product of all sizes
  bool mirrored = false;  ///< an odd number of reflections
};

Vec3 reflected(Vec3 v, int axis) {
  v[static_cast<std::size_t>(axis)] = -v[static_cast<std::size_t>(axis)];
  return v;
}

Mat3 reflected(const Mat3& m, int axis) {
  return {reflected(m.x, axis), reflected(m.y, axis), reflected(m.z, axis)};
}

class Placer {
 public:
  Placer(const Expanded& expanded, const Moves& pinned, Diagnostics& diagnostics)
      : expanded_(expanded), pinned_(pinned), diagnostics_(diagnostics) {}
  std::optional<tags::TaggedSkeleton> run();

 private:
  /// What is known of a placed joint; of a chain: of its last one, on which children hang.
  struct Placed {
    bool done = false;
    Affine own;      ///< in the instance's space
    Affine main;     ///< in the main template's space
    int index = -1;  ///< in the result
  };

  void make_spaces();
  void find_first_children();
  Affine to_main(int instance, const Affine& own) const;
  Affine seen_from(int instance, const Affine& main) const;
  bool lies_in(int instance, int outer) const;
  Affine view(int instance, std::size_t joint) const;
  std::optional<Vec3> pinned(std::size_t index, std::uint32_t ordinal, int instance) const;
  std::optional<Vec3> target(std::size_t index) const;
  void note_aim(std::size_t index, tags::Guiding& guide) const;
  math::Trs own_rest(std::size_t index, const Affine& parent);
  Mat3 aimed(const ExpandedJoint& joint, const Orient& orient, Vec3 from, Vec3 to);
  void place_joint(std::size_t index);
  void add(std::size_t index, std::uint32_t ordinal, int parent, const math::Trs& rest,
           const Affine& main);
  math::Trs across(const math::Trs& rest, int instance) const;

  const Expanded& expanded_;
  const Moves& pinned_;
  Diagnostics& diagnostics_;
  std::vector<Space> spaces_;
  std::vector<Placed> placed_;
  std::vector<int> first_child_;
  tags::TaggedSkeleton out_;
  double lowest_ = 0, highest_ = 0;
};

void Placer::make_spaces() {
  for (const Instance& instance : expanded_.instances) {
    Space space;
    if (instance.outer >= 0) {
      const Space& outer = spaces_[static_cast<std::size_t>(instance.outer)];
      Affine here{times(math::matrix(instance.rotation), instance.size), instance.at};
      if (instance.mirror) {
        here.linear = reflected(here.linear, *instance.mirror);
        here.origin = reflected(here.origin, *instance.mirror);
      }
      space.to_main = outer.to_main * here;
      space.size = outer.size * instance.size;
      space.mirrored = outer.mirrored != instance.mirror.has_value();
    }
    spaces_.push_back(space);
  }
}

void Placer::find_first_children() {
  first_child_.assign(expanded_.joints.size(), -1);
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i) {
    const int parent = expanded_.joints[i].tagged.parent;
    if (parent >= 0 && first_child_[static_cast<std::size_t>(parent)] < 0)
      first_child_[static_cast<std::size_t>(parent)] = static_cast<int>(i);
  }
}

Affine Placer::to_main(int instance, const Affine& own) const {
  const Space& space = spaces_[static_cast<std::size_t>(instance)];
  const double turn = (space.mirrored ? -1 : 1) / space.size;
  return {times(space.to_main.linear * own.linear, turn), space.to_main * own.origin};
}

/// The inverse: a joint of the main template's space as the instance sees it.
Affine Placer::seen_from(int instance, const Affine& main) const {
  if (instance == 0) return main;
  const Space& space = spaces_[static_cast<std::size_t>(instance)];
  const Affine from_main = inverse(space.to_main);
  const double turn = (space.mirrored ? -1 : 1) * space.size;
  return {times(from_main.linear * main.linear, turn), from_main * main.origin};
}

bool Placer::lies_in(int instance, int outer) const {
  for (; instance >= 0; instance = expanded_.instances[static_cast<std::size_t>(instance)].outer)
    if (instance == outer) return true;
  return false;
}

/// A placed joint's frame in the space of an instance. A part that hangs on a joint outside of it
/// sees that joint's frame as it is and not mirrored: both arms see one and the same chest.
Affine Placer::view(int instance_index, std::size_t index) const {
  const ExpandedJoint& joint = expanded_.joints[index];
  if (joint.instance == instance_index) return placed_[index].own;
  if (lies_in(joint.instance, instance_index))
    return seen_from(instance_index, placed_[index].main);
  const Instance& instance = expanded_.instances[static_cast<std::size_t>(instance_index)];
  Affine frame = view(instance.outer, index);
  if (instance.mirror) {
    frame.origin = reflected(frame.origin, *instance.mirror);
    const bool outer_mirrored = spaces_[static_cast<std::size_t>(instance.outer)].mirrored;
    if (lies_in(joint.instance, instance.outer) && joint.tagged.mirror.mirrored != outer_mirrored)
      frame.linear = times(reflected(frame.linear, *instance.mirror), -1);
  }
  const math::Quat back = conjugate(instance.rotation);
  return {math::matrix(back) * frame.linear,
          rotate(back, frame.origin - instance.at) * (1 / instance.size)};
}

/// Where guides put a joint, in the space of an instance.
std::optional<Vec3> Placer::pinned(std::size_t index, std::uint32_t ordinal, int instance) const {
  if (pinned_.empty()) return std::nullopt;
  JointKey key = expanded_.joints[index].tagged.key;
  key.ordinal = ordinal;
  const auto found = pinned_.find(key);
  if (found == pinned_.end()) return std::nullopt;
  return inverse(spaces_[static_cast<std::size_t>(instance)].to_main) * found->second;
}

/// Where `orient` of a joint points to, in the space of its instance.
std::optional<Vec3> Placer::target(std::size_t index) const {
  const ExpandedJoint& joint = expanded_.joints[index];
  const bool to_end = joint.chain && joint.chain->steps.empty();
  if (joint.toward < 0 && to_end) {
    const auto last = static_cast<std::uint32_t>(joint.chain->count.value - 1);
    const auto moved = last > 0 ? pinned(index, last, joint.instance) : std::nullopt;
    return moved.value_or(joint.chain->to);
  }
  const int at = joint.toward >= 0 ? joint.toward : first_child_[index];
  if (at < 0) return std::nullopt;
  if (const auto moved = pinned(static_cast<std::size_t>(at), 0, joint.instance)) return moved;
  const ExpandedJoint& other = expanded_.joints[static_cast<std::size_t>(at)];
  Vec3 point;
  if (other.placement.space == Placement::Space::model)
    point = other.placement.position;
  else if (placed_[static_cast<std::size_t>(at)].done)
    point = placed_[static_cast<std::size_t>(at)].own.origin;
  else
    return std::nullopt;
  if (other.instance == joint.instance) return point;
  const Vec3 main = spaces_[static_cast<std::size_t>(other.instance)].to_main * point;
  return inverse(spaces_[static_cast<std::size_t>(joint.instance)].to_main) * main;
}

/// For guides over the rig file: what turns the joint when joints are moved.
void Placer::note_aim(std::size_t index, tags::Guiding& guide) const {
  const ExpandedJoint& joint = expanded_.joints[index];
  if (!joint.placement.orient) return;
  const int at = joint.toward >= 0 ? joint.toward : first_child_[index];
  if (joint.toward < 0 && joint.chain && joint.chain->steps.empty()) {
    guide.toward = joint.tagged.key;
    guide.toward.ordinal = static_cast<std::uint32_t>(joint.chain->count.value - 1);
  } else if (at >= 0) {
    guide.toward = expanded_.joints[static_cast<std::size_t>(at)].tagged.key;
  }
  const Space& space = spaces_[static_cast<std::size_t>(joint.instance)];
  guide.up = space.to_main.linear * joint.placement.orient->up_toward * (1 / space.size);
}

Mat3 Placer::aimed(const ExpandedJoint& joint, const Orient& orient, Vec3 from, Vec3 to) {
  const Vec3 bone = to - from;
  if (!(length(bone) > 1e-9)) {
    diagnostics_.report(
        codes::kNowhereToAim, orient.span,
        fmt::format("the joint {} and what it aims at lie in one place", joint.tagged.name),
        "name another joint in `toward:`");
    return {};
  }
  const Vec3 along = normalised(bone);
  if (length(cross(along, orient.up_toward)) < 1e-4) {
    diagnostics_.report(codes::kUpAlongBone, orient.span,
                        fmt::format("the bone of {} points along `up_toward`", joint.tagged.name),
                        "choose an `up_toward` across the bone");
    return {};
  }
  const Mat3 wanted = math::frame(along, orient.up_toward);
  const Mat3 axes = math::frame(orient.aim, orient.up);
  return wanted * transposed(axes);
}

math::Trs Placer::own_rest(std::size_t index, const Affine& parent) {
  const ExpandedJoint& joint = expanded_.joints[index];
  const Placement& placement = joint.placement;
  math::Trs rest;
  rest.scale = placement.scale;
  rest.translation = placement.space == Placement::Space::parent
                         ? placement.position
                         : inverse(parent) * placement.position;
  if (const auto moved = pinned(index, 0, joint.instance))
    rest.translation = inverse(parent) * *moved;
  rest.rotation = placement.rotation;
  if (!placement.orient) return rest;
  const auto to = target(index);
  if (!to) {
    diagnostics_.report(codes::kNowhereToAim, placement.orient->span,
                        fmt::format("the joint {} has nothing to aim at", joint.tagged.name),
                        "name a joint that has an `at` in `toward:`");
    return rest;
  }
  const Mat3 frame = aimed(joint, *placement.orient, parent * rest.translation, *to);
  rest.rotation = math::quaternion(transposed(math::orthonormal(parent.linear)) * frame);
  return rest;
}

/// A rest below a parent of the same instance, as it is outside: larger, and reflected by turning
/// round.
math::Trs Placer::across(const math::Trs& rest, int instance) const {
  const Space& space = spaces_[static_cast<std::size_t>(instance)];
  math::Trs out = rest;
  if (space.size != 1) out.translation = out.translation * space.size;
  if (space.mirrored) out.translation = Vec3{} - out.translation;
  return out;
}

void Placer::add(std::size_t index, std::uint32_t ordinal, int parent, const math::Trs& rest,
                 const Affine& main) {
  tags::TaggedJoint joint = joint_of(expanded_.joints[index], ordinal);
  joint.parent = parent;
  joint.rest = tidy(rest);
  lowest_ = out_.joints.empty() ? main.origin.y : std::min(lowest_, main.origin.y);
  highest_ = out_.joints.empty() ? main.origin.y : std::max(highest_, main.origin.y);
  out_.joints.push_back(std::move(joint));
}

void Placer::place_joint(std::size_t index) {
  const ExpandedJoint& joint = expanded_.joints[index];
  const int parent = joint.tagged.parent;
  const Affine parent_own =
      parent < 0 ? Affine{} : view(joint.instance, static_cast<std::size_t>(parent));
  math::Trs rest = own_rest(index, parent_own);
  Affine own = parent_own * compose(rest);
  Affine main = to_main(joint.instance, own);

  const bool same_space =
      parent < 0 ? joint.instance == 0
                 : expanded_.joints[static_cast<std::size_t>(parent)].instance == joint.instance;
  if (same_space)
    rest = across(rest, joint.instance);
  else if (parent < 0)
    rest = decompose(main);
  else
    rest = decompose(inverse(placed_[static_cast<std::size_t>(parent)].main) * main);
  Placed& placed = placed_[index];
  int above = parent < 0 ? -1 : placed_[static_cast<std::size_t>(parent)].index;
  add(index, 0, above, rest, main);
  note_aim(index, out_.joints.back().guide);

  const int count = joint.chain ? joint.chain->count.value : 1;
  const Vec3 first = own.origin;
  for (int i = 1; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    math::Trs step;
    if (joint.chain->steps.empty())
      step.translation = inverse(own) * lerp(first, joint.chain->to, share);
    else
      step = joint.chain->steps[static_cast<std::size_t>(i) - 1];
    if (const auto moved = pinned(index, static_cast<std::uint32_t>(i), joint.instance))
      step.translation = inverse(own) * *moved;
    own = own * compose(step);
    main = to_main(joint.instance, own);
    above = static_cast<int>(out_.joints.size()) - 1;
    add(index, static_cast<std::uint32_t>(i), above, across(step, joint.instance), main);
  }
  placed = {true, own, main, static_cast<int>(out_.joints.size()) - 1};
}

std::optional<tags::TaggedSkeleton> Placer::run() {
  const std::size_t errors_before = diagnostics_.errors();
  make_spaces();
  find_first_children();
  placed_.resize(expanded_.joints.size());
  out_ = expanded_.skeleton;
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i) place_joint(i);
  if (diagnostics_.errors() != errors_before) return std::nullopt;
  const double height = tidy_length(highest_ - lowest_);
  out_.aims = true;
  out_.character.height = height > 1e-6 ? height : 1;
  return std::move(out_);
}

}  // namespace

std::optional<tags::TaggedSkeleton> place(const Expanded& expanded, Diagnostics& diagnostics) {
  const trace::Span span("place");
  const Moves nothing;
  return Placer(expanded, nothing, diagnostics).run();
}

std::optional<tags::TaggedSkeleton> place_pinned(const Expanded& expanded, const Moves& pinned,
                                                 Diagnostics& diagnostics) {
  const trace::Span span("place");
  return Placer(expanded, pinned, diagnostics).run();
}

}  // namespace rigc::templates
