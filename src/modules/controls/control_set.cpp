// SPDX-License-Identifier: MIT
// control_set: a named set of controls, for tools that select, key or mirror them together.
// Test: tests/modules/control_set_test.cpp
#include <fmt/format.h>

#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/steps_groups.h"

namespace rigc::modules {
namespace {

namespace attribute = scene::control_set;

NodeId find_set(const Builder& b, const std::string& name) {
  return find_group(b, scene::Kind::control_set, attribute::kSet, name);
}

std::string parent_of(const Builder& b, NodeId set) {
  return std::get<std::string>(b.scene().value({set, attribute::kParent}));
}

NodeId find_or_make(Builder& b, const std::string& name, const std::string& role) {
  if (const NodeId found = find_set(b, name); found.valid()) return found;
  const NodeId made = b.make({.kind = scene::Kind::control_set,
                              .role = role,
                              .joint = {},
                              .parent = {},
                              .suffix = name + "_set"});
  b.set({made, attribute::kSet}, name);
  return made;
}

/// Whether `set` may be put into `parent`; fails where it is in another one, or contains it.
bool check_parent(Builder& b, NodeId set, const std::string& name, const std::string& parent) {
  const std::string now = parent_of(b, set);
  if (!now.empty() && now != parent) {
    b.fail(codes::kSettingsDiffer, "parent",
           fmt::format("the set \"{}\" is in the set \"{}\" already", name, now));
    return false;
  }
  std::string path = name;
  for (std::string at = parent; !at.empty();) {
    path += " in " + at;
    if (at == name) {
      b.fail(codes::kSetInItself, "parent", fmt::format("the set \"{}\" would be in itself", name),
             path);
      return false;
    }
    const NodeId above = find_set(b, at);
    at = above.valid() ? parent_of(b, above) : std::string();
  }
  return true;
}

}  // namespace

void control_set(Builder& b) {
  const Parameters& with = b.with();
  const bool named = check_group_name(b, "set");
  const bool nested = with.has("parent");
  if (!named || (nested && !check_group_name(b, "parent"))) return;
  const auto members = group_members(b);
  if (!members) return;
  const std::string& name = with.text("set");
  const NodeId set = find_or_make(b, name, "set");
  if (nested) {
    const std::string& parent = with.text("parent");
    if (!check_parent(b, set, name, parent)) return;
    find_or_make(b, parent, "parent");
    b.set({set, attribute::kParent}, parent);
  }
  add_members(b, set, attribute::kMembers, *members);
}

}  // namespace rigc::modules
