// SPDX-License-Identifier: MIT
// lock: attributes of controls that animators may not key, or do not see.
// Test: tests/modules/lock_test.cpp
#include <fmt/format.h>

#include "modules/attributes/plugs.h"
#include "modules/codes.h"
#include "modules/registry.h"
#include "scene/access.h"

namespace rigc::modules {
namespace {

namespace control = scene::control;

bool check_lockable(Builder& b, const Plug& plug) {
  const bool on_control = b.scene()[plug.node].kind == scene::Kind::control;
  const bool added = plug.attribute >= scene::kUserAttributes;
  if (on_control && (added || scene::component_bits(plug) != 0)) return true;
  const bool part = plug.attribute == scene::transform::kRotation;
  b.fail(codes::kNotLockable, "attributes",
         fmt::format("{} of {} is not for animators", b.scene().plug_name(plug),
                     traversal::describe(b.scene(), plug.node)),
         !on_control ? "name an attribute of a control"
         : part      ? "name an angle, for example rotate.x"
                     : "");
  return false;
}

/// Adds bits to a control's mask.
void add_bits(Builder& b, NodeId node, std::uint16_t attribute, unsigned bits) {
  b.set({node, attribute}, static_cast<double>(scene::bits_at(b.scene(), node, attribute) | bits));
}

/// An attribute of which nothing is left to key is not keyable.
void update_keyable(Builder& b, NodeId node) {
  const unsigned free = scene::keyable_bits(b.scene(), node);
  const int keyable = (free & scene::kTranslateBits ? 1 : 0) + (free & scene::kRotateBits ? 2 : 0) +
                      (free & scene::kScaleBits ? 4 : 0);
  b.set({node, control::kKeyable}, static_cast<double>(keyable));
}

}  // namespace

void lock(Builder& b) {
  const Parameters& with = b.with();
  const std::string& mode = with.text("mode");
  const bool locks = mode != "hide", hides = mode != "lock";
  for (const Plug& plug : with.plugs("attributes")) {
    if (!check_lockable(b, plug)) continue;
    if (with.has("value") && !(b.check_free(plug, "attributes") && give_value(b, plug, "value")))
      continue;
    if (plug.attribute >= scene::kUserAttributes) {
      const auto& user = b.scene()[plug.node].user[plug.attribute - scene::kUserAttributes];
      b.set_access(plug, user.keyable && !locks, user.hidden || hides);
      continue;
    }
    const unsigned bits = scene::component_bits(plug);
    if (hides) add_bits(b, plug.node, control::kHidden, bits);
    if (!locks) continue;
    add_bits(b, plug.node, control::kLocked, bits);
    update_keyable(b, plug.node);
  }
}

}  // namespace rigc::modules
