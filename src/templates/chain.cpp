// SPDX-License-Identifier: MIT
// The joints that a chain becomes. Test: tests/templates/place_test.cpp
#include "templates/chain.h"

#include <fmt/format.h>

#include <cmath>

namespace rigc::templates {
namespace {

bool near(double a, double b, double tolerance) { return a - b < tolerance && b - a < tolerance; }

}  // namespace

tags::TaggedJoint joint_of(const ExpandedJoint& source, std::uint32_t ordinal) {
  const tags::TaggedJoint& first = source.tagged;
  tags::TaggedJoint joint;
  if (ordinal == 0) {
    joint = first;
  } else {
    joint.key = first.key;
    joint.was = first.was;
    joint.ids.global = first.ids.global;
    joint.ids.local = first.ids.local;
    joint.optional = first.optional;
    joint.mirror = first.mirror;
    joint.template_index = first.template_index;
    joint.span = first.span;
  }
  joint.key.ordinal = ordinal;
  for (JointKey& key : joint.was) key.ordinal = ordinal;
  if (joint.mirror.opposite.uid != 0) joint.mirror.opposite.ordinal = ordinal;
  joint.name = source.chain ? fmt::format("{}_{}", first.name, ordinal + 1) : first.name;
  return joint;
}

math::Trs tidy(math::Trs trs) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (near(trs.translation[i], 0, 1e-12)) trs.translation[i] = 0;
    if (near(trs.scale[i], 1, 1e-12)) trs.scale[i] = 1;
  }
  for (double* part : {&trs.rotation.x, &trs.rotation.y, &trs.rotation.z, &trs.rotation.w})
    if (near(*part, 0, 1e-15)) *part = 0;
  return trs;
}

double tidy_length(double length) { return std::nearbyint(length * 1e12) / 1e12; }

}  // namespace rigc::templates
