// SPDX-License-Identifier: MIT
// A tagged skeleton as the joints of a template: chains put together again, names that a template
// can have, and for one that was fitted the template's space in place of the model's.
// Test: tests/templates/write_test.cpp
#pragma once

#include <string>
#include <vector>

#include "tags/tags.h"

namespace rigc::templates {

/// One entry of `joints:`.
struct WrittenJoint {
  std::string name;
  int parent = -1;                            ///< index into the written joints
  const tags::TaggedJoint* source = nullptr;  ///< of a chain: its first joint
  math::Trs rest;                             ///< below the parent
  bool chain = false;
  std::vector<math::Trs> steps;  ///< of a chain: its joints after the first
  math::Vec3 end;                ///< of a chain: place of its last joint, model space
  bool helper = false;
  int opposite = -1;              ///< index of the joint on the other side; -1: none
  bool opposite_by_name = false;  ///< what the names say of `opposite` is right
};

bool was_fitted(const tags::TaggedSkeleton& skeleton);

/// Joints parents first. Of a skeleton that was fitted to a model, bones that no joint of the
/// template stands for are left out. `worlds`: as in WriteOptions.
std::vector<WrittenJoint> written_joints(const tags::TaggedSkeleton& skeleton,
                                         const std::vector<math::Affine>& worlds);

}  // namespace rigc::templates
