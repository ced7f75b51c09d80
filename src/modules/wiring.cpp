// SPDX-License-Identifier: MIT
// Attributes, formulas and places. Test: tests/modules/ik_fk_limb_test.cpp
#include "modules/wiring.h"

#include <cassert>
#include <cstdio>
#include <cstdlib>

#include "scene/formula.h"
#include "scene/formula_types.h"

namespace rigc::modules {

Plug add_number(Builder& b, NodeId control, const NumberAttribute& attribute) {
  scene::UserAttribute user;
  user.name = attribute.name;
  user.flavour = attribute.flavour;
  user.value = user.initial = attribute.value;
  user.min = attribute.min;
  user.max = attribute.max;
  return b.add_attribute(control, std::move(user));
}

Plug formula(Builder& b, NodeId joint, const std::string& suffix, const std::string& code,
             const std::vector<Plug>& inputs, const std::string& role) {
  namespace expression = scene::expression;
  const NodeId node = b.make({.kind = scene::Kind::expression,
                              .role = role,
                              .joint = joint,
                              .parent = {},
                              .suffix = suffix});
  b.set({node, expression::kCode}, code);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Plug input{node, expression::kInputs, static_cast<std::int32_t>(i)};
    if (inputs[i].attribute >= scene::kUserAttributes) b.set(input, b.scene().number(inputs[i]));
    b.connect(inputs[i], input);
  }
  return {node, expression::kOutput};
}

namespace {

scene::Type type_of(const Builder& b, const Given& given) {
  const auto* plug = std::get_if<Plug>(&given.from);
  return plug ? *b.scene().type(*plug) : scene::type_of(std::get<scene::Value>(given.from));
}

std::string declared(const Builder& b, const std::vector<Given>& given) {
  std::string text;
  for (const Given& each : given) {
    text += text.empty() ? "in " : ", ";
    text += each.name + ": ";
    text += scene::formula_type(type_of(b, each));
  }
  return text.empty() ? text : text + "; ";
}

/// A module's program that does not parse is a bug in the module.
[[noreturn]] void refuse(const Diagnostics& wrong) {
  for (const Diagnostic& each : wrong.all()) std::fprintf(stderr, "%s\n", each.message.c_str());
  std::abort();
}

}  // namespace

Plug Computed::operator[](std::string_view name) const {
  for (const auto& [known, plug] : outputs_) {
    if (known == name) return plug;
  }
  assert(false && "the program gives nothing of this name");
  return {};
}

Computed compute(Builder& b, NodeId joint, const std::string& suffix,
                 const std::vector<Given>& given, const std::string& program,
                 const std::string& role) {
  namespace compute = scene::compute;
  const NodeId node = b.make(
      {.kind = scene::Kind::compute, .role = role, .joint = joint, .parent = {}, .suffix = suffix});
  const std::string code = declared(b, given) + program;
  b.set({node, compute::kCode}, code);
  Diagnostics wrong;
  const auto formula = scene::parse_program(code, {}, wrong);
  if (!formula) refuse(wrong);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const scene::Formula::Named& input = formula->inputs[i];
    const Plug to{node, compute::input_of(input.type), input.element};
    if (const auto* value = std::get_if<scene::Value>(&given[i].from)) {
      b.set(to, *value);
    } else {
      b.connect(std::get<Plug>(given[i].from), to);
    }
  }
  std::vector<std::pair<std::string, Plug>> outputs;
  for (const scene::Formula::Named& out : formula->outputs)
    outputs.emplace_back(out.name, Plug{node, compute::output_of(out.type), out.element});
  return Computed(std::move(outputs));
}

Given now(const Builder& b, std::string name, const Plug& plug) {
  if (const auto source = b.scene().source(plug)) return {std::move(name), *source};
  return {std::move(name), b.scene().value(plug)};
}

NodeId make_place(Builder& b, NodeId joint, const std::string& suffix, NodeId space,
                  const math::Affine& frame) {
  const NodeId place = b.make({.kind = scene::Kind::transform,
                               .role = "space",
                               .joint = joint,
                               .parent = {},
                               .suffix = suffix});
  hang(b, place, space, frame);
  return place;
}

void follow_world(Builder& b, const Plug& input, NodeId node) {
  b.set(input, rest(b, node));
  b.connect(world_of(node), input);
}

}  // namespace rigc::modules
