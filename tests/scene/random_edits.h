// SPDX-License-Identifier: MIT
// Random changes to a scene, through an Edit: for property tests.
#pragma once

#include <fmt/format.h>

#include "scene/edit.h"
#include "tests/math/random.h"

namespace rigc::test {

class RandomEdits {
 public:
  /// `plain`: only values that a rig file takes.
  RandomEdits(scene::Scene& scene, std::uint64_t seed, bool plain = false)
      : scene_(scene), random_(seed), plain_(plain) {}

  /// `count` changes, as one command makes them.
  void run(scene::Journal& journal, scene::Observer* observer, int count, std::uint32_t command) {
    scene::Edit edit(scene_, journal, observer);
    for (int i = 0; i < count; ++i) change(edit, command);
  }

 private:
  scene::NodeId any() { return {static_cast<std::uint32_t>(random_.below(scene_.size()))}; }

  void change(scene::Edit& edit, std::uint32_t command) {
    const std::size_t what = scene_.size() < 3 ? 0 : random_.below(10);
    if (what < 3) return make(edit, command);
    if (what == 3) return reparent(edit);
    if (what == 4) return add_attribute(edit);
    if (what < 8) return set(edit);
    if (what == 8) return connect(edit);
    const scene::Node& node = scene_[any()];
    if (!node.inputs.empty()) edit.disconnect(node.inputs[random_.below(node.inputs.size())].to);
  }

  void make(scene::Edit& edit, std::uint32_t command) {
    scene::Node node;
    do {
      node.kind =
          static_cast<scene::Kind>(random_.below(static_cast<std::size_t>(scene::Kind::count)));
    } while (plain_ && node.kind == scene::Kind::mesh);
    node.name = fmt::format("node_{}", random_.below(50));
    node.ids.local = fmt::format("group_{}", random_.below(3));
    node.identity.owner.uid = random_.bits();
    node.command = command;
    if (scene_.size() > 0 && random_.chance(70)) node.parent = any();
    edit.make(std::move(node));
  }

  void reparent(scene::Edit& edit) {
    const scene::NodeId node = any();
    const scene::NodeId parent = random_.chance(20) ? scene::NodeId{} : any();
    for (scene::NodeId at = parent; at.valid(); at = scene_[at].parent) {
      if (at == node) return;
    }
    edit.reparent(node, parent);
  }

  void add_attribute(scene::Edit& edit) {
    const scene::NodeId node = any();
    scene::UserAttribute attribute;
    attribute.name = fmt::format("attribute_{}", scene_[node].user.size());
    attribute.value = random_.between(-1, 1);
    attribute.flavour = static_cast<scene::UserAttribute::Flavour>(random_.below(4));
    if (random_.chance(50)) attribute.min = -1;
    edit.add_attribute(node, attribute);
  }

  scene::Plug plug(scene::NodeId node) {
    const std::size_t own = scene::spec(scene_[node].kind).attributes.size();
    const std::size_t which = random_.below(own + scene_[node].user.size());
    if (which >= own)
      return {node, static_cast<std::uint16_t>(scene::kUserAttributes + which - own)};
    scene::Plug plug{node, static_cast<std::uint16_t>(which)};
    const scene::AttributeSpec& attribute = scene::spec(scene_[node].kind).attributes[which];
    if (attribute.array) {
      plug.element =
          static_cast<std::int32_t>(random_.below(scene_[node].attributes[which].size() + 1));
    }
    if (attribute.type == scene::Type::vec3 && random_.chance(40)) {
      plug.component = static_cast<std::int8_t>(random_.below(3));
    }
    return plug;
  }

  scene::Value value(scene::Type type) {
    switch (type) {
      case scene::Type::number:
        return random_.between(-10, 10);
      case scene::Type::vec3:
        return random_.vector(10);
      case scene::Type::quat:
        return random_.rotation();
      case scene::Type::matrix:
        return math::compose(random_.trs(false));
      case scene::Type::text:
        return fmt::format("text {}", random_.below(1000));
      default:
        return std::vector<double>{random_.between(0, 1), random_.between(0, 1)};
    }
  }

  void set(scene::Edit& edit) {
    const scene::Plug to = plug(any());
    if (to.attribute >= scene::kUserAttributes && random_.chance(30)) {
      const bool keyable = random_.chance(50);
      return edit.set_access(to, keyable, random_.chance(50));
    }
    if (scene_.role(to) == scene::Role::output || (plain_ && has_form(to))) return;
    edit.set(to, value(*scene_.type(to)));
  }

  /// Whether a rig file asks more of the value than its type.
  bool has_form(const scene::Plug& to) const {
    namespace control = scene::control;
    if (scene_[to.node].kind != scene::Kind::control) return false;
    return to.attribute > control::kShape && to.attribute != control::kColor;
  }

  void connect(scene::Edit& edit) {
    for (int attempt = 0; attempt < 20; ++attempt) {
      const scene::Plug from = plug(any());
      const scene::Plug to = plug(any());
      if (scene_.role(to) != scene::Role::input || scene_.type(from) != scene_.type(to)) continue;
      edit.connect(from, to);
      return;
    }
  }

  scene::Scene& scene_;
  Random random_;
  bool plain_;
};

}  // namespace rigc::test
