// SPDX-License-Identifier: MIT
// The small nodes and attributes that modules put between controls and joints: what an animator can
// key, values computed from others, places that move with something.
// Test: tests/modules/ik_fk_limb_test.cpp
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "modules/steps.h"

namespace rigc::modules {

/// A number that an animator keys on a control.
struct NumberAttribute {
  std::string name;
  double value = 0;  ///< at rest
  std::optional<double> min = {}, max = {};
  scene::UserAttribute::Flavour flavour = scene::UserAttribute::Flavour::number;
};
Plug add_number(Builder& b, NodeId control, const NumberAttribute& attribute);

/// What a formula gives, in a node of `joint`; $0, $1... stand for the inputs. `suffix` ends the
/// node's name.
Plug formula(Builder& b, NodeId joint, const std::string& suffix, const std::string& code,
             const std::vector<Plug>& inputs, const std::string& role = "driver");

/// What a program takes under a name: a plug, the world of a node, or a value that stays.
struct Given {
  Given(std::string as, const Plug& plug) : name(std::move(as)), from(plug) {}
  Given(std::string as, NodeId node) : Given(std::move(as), world_of(node)) {}
  Given(std::string as, scene::Value value) : name(std::move(as)), from(std::move(value)) {}
  std::string name;
  std::variant<Plug, scene::Value> from;
};

/// What a program gives, by name; a name that it does not give is a bug and asserts.
class Computed {
 public:
  explicit Computed(std::vector<std::pair<std::string, Plug>> outputs)
      : outputs_(std::move(outputs)) {}
  Plug operator[](std::string_view name) const;

 private:
  std::vector<std::pair<std::string, Plug>> outputs_;
};

/// A node of `joint` that computes: `program` as scene::parse_program takes it, without its `in`
/// statements, which `given` stands for. Each output is computed for itself: one may depend on what
/// another drives.
Computed compute(Builder& b, NodeId joint, const std::string& suffix,
                 const std::vector<Given>& given, const std::string& program,
                 const std::string& role = "driver");

/// What a plug has now: its source, or where nothing is connected its value. For commands that put
/// something between.
Given now(const Builder& b, std::string name, const Plug& plug);

/// A transform of `joint` at `frame` (rig space) that moves with `space`.
NodeId make_place(Builder& b, NodeId joint, const std::string& suffix, NodeId space,
                  const math::Affine& frame);

/// Lets a matrix input follow the world of a node, and hold where that rests.
void follow_world(Builder& b, const Plug& input, NodeId node);

}  // namespace rigc::modules
