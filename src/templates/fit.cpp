// SPDX-License-Identifier: MIT
// The driver of fitting, and the skeleton that comes out: the model's hierarchy with the template's
// tags. Test: tests/templates/fit_test.cpp
#include "templates/fit.h"

#include <fmt/format.h>

#include "base/text.h"
#include "base/trace.h"
#include "templates/chain.h"
#include "templates/codes.h"
#include "templates/fit_match.h"

namespace rigc::templates {
namespace {

using math::Affine;
using math::Vec3;

bool is_forest(const tags::ForeignSkeleton& model) {
  const int count = static_cast<int>(model.joints.size());
  std::vector<int> state(model.joints.size(), 0);  // 0 not seen, 1 on the way, 2 ends at a root
  for (int start = 0; start < count; ++start) {
    int at = start;
    while (at >= 0 && at < count && state[static_cast<std::size_t>(at)] == 0) {
      state[static_cast<std::size_t>(at)] = 1;
      at = model.joints[static_cast<std::size_t>(at)].parent;
    }
    if (at >= count || (at >= 0 && state[static_cast<std::size_t>(at)] == 1)) return false;
    for (at = start; at >= 0 && state[static_cast<std::size_t>(at)] == 1;
         at = model.joints[static_cast<std::size_t>(at)].parent)
      state[static_cast<std::size_t>(at)] = 2;
  }
  return true;
}

class Fitter {
 public:
  Fitter(const Expanded& expanded, const tags::ForeignSkeleton& model,
         const tags::TaggedSkeleton& placed, const Matching& matching, const Measured& measured,
         const Bindings* known, Diagnostics& diagnostics)
      : expanded_(expanded),
        model_(model),
        placed_(placed),
        matching_(matching),
        measured_(measured),
        diagnostics_(diagnostics) {
    if (known) know(*known);
  }
  tags::TaggedSkeleton run();

 private:
  void find_included();
  void add_bone(int bone);
  void add_helper(std::size_t index);
  Vec3 helper_position(std::size_t index) const;
  Vec3 along_bone(std::size_t index, std::size_t above, Vec3 offset) const;
  Vec3 bone_at(std::size_t index) const;
  int matched_above(std::size_t index) const;
  int matched_below(std::size_t index) const;
  void know(const Bindings& known);
  JointKey key_of_bone(int bone) const;
  tags::TaggedJoint tagged(int bone) const;
  void set_opposites();
  void set_template_parents();
  Affine placed_world(std::size_t index) const;

  const Expanded& expanded_;
  const tags::ForeignSkeleton& model_;
  const tags::TaggedSkeleton& placed_;
  const Matching& matching_;
  const Measured& measured_;
  Diagnostics& diagnostics_;
  struct Role {
    int joint = -1;  ///< expanded joint that the bone stands for
    std::uint32_t ordinal = 0;
  };
  std::vector<Role> roles_;        ///< by bone
  std::vector<bool> included_;     ///< by bone
  std::vector<int> bone_index_;    ///< by bone: index in the result
  std::vector<int> joint_index_;   ///< by expanded joint: index of its last joint in the result
  std::vector<Affine> rest_;       ///< by index in the result, rig space
  std::map<int, JointKey> known_;  ///< of bones that no joint of the template stands for, by node
  std::set<JointKey> taken_keys_;  ///< of an earlier fit
  double worst_shear_ = 1e-4;
  std::string sheared_;
  tags::TaggedSkeleton out_;
};

/// Matched bones, bones in a skin, and all that lie between two of them.
void Fitter::find_included() {
  const std::size_t count = model_.joints.size();
  roles_.resize(count);
  included_.assign(count, false);
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i)
    for (std::size_t k = 0; k < matching_.bones[i].size(); ++k)
      roles_[static_cast<std::size_t>(matching_.bones[i][k])] = {static_cast<int>(i),
                                                                 static_cast<std::uint32_t>(k)};
  for (std::size_t i = 0; i < count; ++i)
    included_[i] = model_.joints[i].in_skin || roles_[i].joint >= 0;
  const std::vector<bool> ends = included_;
  std::vector<bool> walked(count, false);  // every bone is walked over once
  for (std::size_t i = 0; i < count; ++i) {
    if (!ends[i]) continue;
    std::vector<std::size_t> between;
    int at = model_.joints[i].parent;
    while (at >= 0 && !walked[static_cast<std::size_t>(at)] &&
           !ends[static_cast<std::size_t>(at)]) {
      walked[static_cast<std::size_t>(at)] = true;
      between.push_back(static_cast<std::size_t>(at));
      at = model_.joints[static_cast<std::size_t>(at)].parent;
    }
    if (at >= 0 && included_[static_cast<std::size_t>(at)])
      for (const std::size_t bone : between) included_[bone] = true;
  }
}

void Fitter::know(const Bindings& known) {
  std::set<std::uint64_t> own;
  for (const ExpandedJoint& joint : expanded_.joints) own.insert(joint.tagged.key.uid);
  for (const auto& [key, node] : known.nodes) {
    taken_keys_.insert(key);
    if (own.count(key.uid) == 0) known_.emplace(node, key);
  }
}

/// A bone that is in the rig because others hang on it keeps the key of the fit before, whatever
/// bones there are now.
JointKey Fitter::key_of_bone(int bone) const {
  const auto known = known_.find(model_.joints[static_cast<std::size_t>(bone)].node);
  if (known != known_.end()) return known->second;
  std::string bytes = "foreign";
  bytes.push_back('\0');
  bytes += fmt::format("{}", bone);
  JointKey key;
  for (key.uid = hash64(bytes); taken_keys_.count(key) != 0; key.uid = hash64(bytes)) bytes += '+';
  return key;
}

tags::TaggedJoint Fitter::tagged(int bone) const {
  const Role& role = roles_[static_cast<std::size_t>(bone)];
  const tags::ForeignJoint& foreign = model_.joints[static_cast<std::size_t>(bone)];
  tags::TaggedJoint joint;
  if (role.joint >= 0) {
    joint = joint_of(expanded_.joints[static_cast<std::size_t>(role.joint)], role.ordinal);
  } else {
    joint.key = key_of_bone(bone);
    joint.ids.global = out_.global;
  }
  if (!foreign.name.empty()) joint.name = foreign.name;
  if (joint.name.empty()) joint.name = fmt::format("joint_{}", bone);
  joint.foreign_node = foreign.node;
  return joint;
}

void Fitter::add_bone(int bone) {
  std::vector<int> way;
  for (int at = bone; at >= 0 && included_[static_cast<std::size_t>(at)] &&
                      bone_index_[static_cast<std::size_t>(at)] < 0;
       at = model_.joints[static_cast<std::size_t>(at)].parent)
    way.push_back(at);
  for (; !way.empty(); way.pop_back()) {
    const int at = way.back();
    const tags::ForeignJoint& foreign = model_.joints[static_cast<std::size_t>(at)];
    tags::TaggedJoint joint = tagged(at);
    const int parent = foreign.parent;
    joint.parent = parent >= 0 && included_[static_cast<std::size_t>(parent)]
                       ? bone_index_[static_cast<std::size_t>(parent)]
                       : -1;
    const Affine local =
        joint.parent < 0 ? foreign.rest
                         : inverse(rest_[static_cast<std::size_t>(joint.parent)]) * foreign.rest;
    if (const double shear = math::shear(local); shear > worst_shear_) {
      worst_shear_ = shear;
      sheared_ = joint.name;
    }
    joint.rest = tidy(decompose(local));
    bone_index_[static_cast<std::size_t>(at)] = static_cast<int>(out_.joints.size());
    const Role& role = roles_[static_cast<std::size_t>(at)];
    if (role.joint >= 0)
      joint_index_[static_cast<std::size_t>(role.joint)] = static_cast<int>(out_.joints.size());
    rest_.push_back(foreign.rest);
    out_.joints.push_back(std::move(joint));
  }
}

int Fitter::matched_above(std::size_t index) const {
  int at = expanded_.joints[index].tagged.parent;
  while (at >= 0 && !matching_.has(static_cast<std::size_t>(at)))
    at = expanded_.joints[static_cast<std::size_t>(at)].tagged.parent;
  return at;
}

int Fitter::matched_below(std::size_t index) const {
  std::vector<bool> below(expanded_.joints.size(), false);
  below[index] = true;
  for (std::size_t i = index + 1; i < expanded_.joints.size(); ++i) {
    const int parent = expanded_.joints[i].tagged.parent;
    if (parent < 0 || !below[static_cast<std::size_t>(parent)]) continue;
    if (matching_.has(i)) return static_cast<int>(i);
    below[i] = true;
  }
  return -1;
}

/// Rest of an expanded joint in the template's own proportions.
Affine Fitter::placed_world(std::size_t index) const {
  return placed_.world(static_cast<std::size_t>(placed_.find(expanded_.joints[index].tagged.key)));
}

Vec3 Fitter::bone_at(std::size_t index) const {
  const int bone = matching_.bones[index].back();
  return model_.joints[static_cast<std::size_t>(bone)].rest.origin;
}

/// An offset below the joint `above`, given in rig space and the template's proportions: turned and
/// lengthened as the way to the matched joint below is in the model, so that a knee that has to be
/// made lies between hip and ankle; at the end of a limb as the bone that leads to `above` is, so
/// that a hand lies in line with its forearm.
Vec3 Fitter::along_bone(std::size_t index, std::size_t above, Vec3 offset) const {
  const int below = matched_below(index);
  const int first = below >= 0 ? static_cast<int>(above) : matched_above(above);
  if (expanded_.joints[index].helper || first < 0) return offset;
  const auto first_index = static_cast<std::size_t>(first);
  const std::size_t last = below >= 0 ? static_cast<std::size_t>(below) : above;
  const int last_bone = below >= 0 ? matching_.bones[last].front() : matching_.bones[last].back();
  const tags::Character& character = measured_.character;
  const math::Mat3 axes{character.left, character.up, character.forward};
  const Vec3 own =
      axes * (placed_world(last).origin - placed_world(first_index).origin) * character.unit;
  const Vec3 bone =
      model_.joints[static_cast<std::size_t>(last_bone)].rest.origin - bone_at(first_index);
  if (!(length(own) > 1e-9 * character.height) || !(length(bone) > 1e-9 * character.height))
    return offset;
  const math::Quat turn = math::between(normalised(own), normalised(bone));
  return math::rotate(turn, offset) * (length(bone) / length(own));
}

/// As far from its anchor as in the template: the joint above, else the one below, but then as high
/// above ground.
Vec3 Fitter::helper_position(std::size_t index) const {
  const tags::Character& character = measured_.character;
  const math::Mat3 axes{character.left, character.up, character.forward};
  const auto in_rig = [&](Vec3 metres) { return axes * metres * character.unit; };
  const Vec3 own = placed_world(index).origin;
  const int above = matched_above(index);
  const int anchor = above >= 0 ? above : matched_below(index);
  if (anchor < 0) return in_rig(own);
  const auto anchor_index = static_cast<std::size_t>(anchor);
  const Vec3 offset = in_rig(own - placed_world(anchor_index).origin);
  if (above >= 0) return bone_at(anchor_index) + along_bone(index, anchor_index, offset);
  const int below = matching_.bones[anchor_index].front();
  const Vec3 moved = model_.joints[static_cast<std::size_t>(below)].rest.origin + offset;
  const double wanted = measured_.lowest + (own.y - measured_.template_lowest) * character.unit;
  return moved + character.up * (wanted - dot(moved, character.up));
}

void Fitter::add_helper(std::size_t index) {
  const tags::Character& character = measured_.character;
  tags::TaggedJoint joint = joint_of(expanded_.joints[index], 0);
  int above = expanded_.joints[index].tagged.parent;
  while (above >= 0 && joint_index_[static_cast<std::size_t>(above)] < 0)
    above = expanded_.joints[static_cast<std::size_t>(above)].tagged.parent;
  joint.parent = above < 0 ? -1 : joint_index_[static_cast<std::size_t>(above)];
  const math::Mat3 axes{character.left, character.up, cross(character.left, character.up)};
  const Affine own = placed_world(index);
  const Affine rest{math::orthonormal(axes) * math::orthonormal(own.linear),
                    helper_position(index)};
  const Affine local =
      joint.parent < 0 ? rest : inverse(rest_[static_cast<std::size_t>(joint.parent)]) * rest;
  joint.rest = tidy(decompose(local));
  joint_index_[index] = static_cast<int>(out_.joints.size());
  rest_.push_back(rest);
  out_.joints.push_back(std::move(joint));
}

/// Opposites that were dropped, or whose chain is shorter here, are none.
void Fitter::set_opposites() {
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i) {
    const int other = expanded_.joints[i].opposite;
    if (other < 0) continue;
    const auto other_index = static_cast<std::size_t>(other);
    const std::size_t count = matching_.has(other_index)       ? matching_.bones[other_index].size()
                              : joint_index_[other_index] >= 0 ? 1
                                                               : 0;
    for (std::size_t k = count; k < matching_.bones[i].size(); ++k) {
      const int index = bone_index_[static_cast<std::size_t>(matching_.bones[i][k])];
      out_.joints[static_cast<std::size_t>(index)].mirror.opposite = {};
    }
    if (count == 0 && !matching_.has(i) && joint_index_[i] >= 0)
      out_.joints[static_cast<std::size_t>(joint_index_[i])].mirror.opposite = {};
  }
}

/// Which joint a joint hangs under in the template, where the model hangs it elsewhere.
void Fitter::set_template_parents() {
  const auto is_above = [&](int above, int joint) {
    while (joint >= 0 && joint != above)
      joint = out_.joints[static_cast<std::size_t>(joint)].parent;
    return joint >= 0;
  };
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i) {
    int before = -1;  // in the template's order, index in the result
    for (int at = expanded_.joints[i].tagged.parent; at >= 0 && before < 0;
         at = expanded_.joints[static_cast<std::size_t>(at)].tagged.parent)
      before = joint_index_[static_cast<std::size_t>(at)];
    std::vector<int> own;
    for (const int bone : matching_.bones[i])
      own.push_back(bone_index_[static_cast<std::size_t>(bone)]);
    if (own.empty() && joint_index_[i] >= 0) own.push_back(joint_index_[i]);
    for (const int joint : own) {
      if (before >= 0 && !is_above(before, joint) && !is_above(joint, before))
        out_.joints[static_cast<std::size_t>(joint)].template_parent =
            out_.joints[static_cast<std::size_t>(before)].key;
      before = joint;
    }
  }
}

tags::TaggedSkeleton Fitter::run() {
  out_ = expanded_.skeleton;
  out_.character = measured_.character;
  find_included();
  bone_index_.assign(model_.joints.size(), -1);
  joint_index_.assign(expanded_.joints.size(), -1);
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i) {
    for (const int bone : matching_.bones[i]) add_bone(bone);
    if (matching_.made[i]) add_helper(i);
  }
  for (std::size_t i = 0; i < model_.joints.size(); ++i)
    if (included_[i]) add_bone(static_cast<int>(i));
  set_opposites();
  set_template_parents();
  if (!sheared_.empty())
    diagnostics_.report(codes::kSheared, Place(model_.file),
                        fmt::format("the rest of {} is sheared by {:.2f} %, the most of all joints",
                                    printable(sheared_, 60), worst_shear_ * 100));
  return std::move(out_);
}

}  // namespace

std::optional<tags::TaggedSkeleton> fit(const Expanded& expanded,
                                        const tags::ForeignSkeleton& model, const Map& map,
                                        FitReport& report, Diagnostics& diagnostics,
                                        const Bindings* known) {
  const trace::Span span("fit");
  report.map = map.name;
  if (!is_forest(model)) {
    diagnostics.report(codes::kBadModel, Place(model.file),
                       "the joints of the model's skeleton do not form a forest");
    return std::nullopt;
  }
  const auto placed = place(expanded, diagnostics);
  if (!placed) return std::nullopt;
  const auto matching = match(expanded, model, map, report, diagnostics, known);
  if (!matching) return std::nullopt;
  const Measured measured = measure(expanded, *placed, model, *matching, report, diagnostics);
  return Fitter(expanded, model, *placed, *matching, measured, known, diagnostics).run();
}

}  // namespace rigc::templates
