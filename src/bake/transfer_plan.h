// SPDX-License-Identifier: MIT
// What a transfer solves: which control says which joint, and in which order. Nothing here knows
// modules: only constraints, solvers and what they are connected to.
// Test: tests/bake/transfer_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "bake/transfer.h"
#include "bake/transfer_targets.h"

namespace rigc::bake {

/// A control, or a joint's own transform, that is solved in each frame.
struct Unknown {
  enum class Rule : std::uint8_t {
    own,     ///< a joint: what the rig does not drive of it
    follow,  ///< a control that joints follow at a fixed offset, or that a limb reaches for
    pole,    ///< a control that says the plane of a two-bone limb
    twist,   ///< an attribute of a control that turns a bone of such a limb about itself
    length,  ///< an attribute of a control that lengthens a bone of such a limb, 1 at rest
    look     ///< a control that a joint looks at
  };
  scene::NodeId node;
  Rule rule = Rule::follow;
  bool moves = false, turns = false, scales = false;  ///< what of it is solved
  bool plays = false;   ///< of `own`: what the file plays is it, whatever is above the joint
  int level = 0;        ///< those below must be solved before
  int turn_aim = -1;    ///< joint that it turns (indices of aims); of `own` and `look` the joint
  math::Affine offset;  ///< that joint seen from the control, or from `turned`
  int move_aim = -1;    ///< joint that it moves
  math::Vec3 control_point;  ///< where that joint is to be, seen as `offset`
  /// A transform under the control whose rotation is that of another control, a gimbal; what
  /// follows the control follows both. Invalid: the control alone.
  scene::NodeId turned;
  math::Affine before;  ///< of `turned` without that rotation, seen from the control
  /// A transform that has the control's translation and moves the joint; invalid: the control does.
  scene::NodeId relay;
  /// Of a pole, and of a control that a limb's end reaches for: what solves the limb.
  scene::NodeId solver;
  int start = -1, middle = -1;  ///< joints of that limb
  bool swivels = false;  ///< of a pole and a twist: that limb turns from the side of its pole
  math::Quat
      bone_offset;  ///< the joint's rest rotation seen from its bone's (look: the eye's) frame
  /// Of a length: joints at the ends of the bone, and where the second rests, seen from the first.
  int upper = -1, lower = -1;
  math::Vec3 bone;
  double least = 0;       ///< its value at least
  bool is_single = true;  ///< nothing lies between the two that may turn by itself
  /// Of a twist or a length.
  scene::Plug attribute;
  bool of_middle = false;         ///< of the lower bone
  math::Quat joint_offset;        ///< as bone_offset, of the bone that it turns
  double per_degree = 1, at = 0;  ///< value that gives a turn: `at` + degrees * `per_degree`
  double distance = 0;            ///< of the pole from the middle joint, of the target from the eye
};

inline bool solves(const Unknown& u, anim::Path path) {
  return path == anim::Path::translation ? u.moves
         : path == anim::Path::rotation  ? u.turns
                                         : u.scales;
}

inline bool is_length(const Unknown& u) { return u.rule == Unknown::Rule::length; }

/// Whether it is an attribute, not a transform.
inline bool is_number(const Unknown& u) { return u.rule == Unknown::Rule::twist || is_length(u); }

struct TransferPlan {
  std::vector<Unknown> unknowns;  ///< by level
  int levels = 0;
  bool feedback = false;  ///< an unknown's parent moves with what hangs on the unknown
};

/// `switches`: values that hold in every frame.
std::optional<TransferPlan> make_plan(const scene::Scene& scene, const std::vector<int>& nodes,
                                      const std::vector<Aim>& aims,
                                      const std::vector<SwitchValue>& switches,
                                      Diagnostics& diagnostics);

}  // namespace rigc::bake
