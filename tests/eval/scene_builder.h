// SPDX-License-Identifier: MIT
// Scenes in a few words, for tests of the compiler.
#pragma once

#include <string>

#include "eval/evaluate.h"
#include "scene/edit.h"

namespace rigc::test {

struct SceneBuilder {
  scene::Scene scene;
  scene::Journal journal;
  scene::Edit edit{scene, journal, nullptr};

  scene::NodeId make(scene::Kind kind, const std::string& name, scene::NodeId parent = {}) {
    scene::Node node;
    node.kind = kind;
    node.name = name;
    node.parent = parent;
    return edit.make(std::move(node));
  }
  scene::NodeId transform(const std::string& name, scene::NodeId parent = {}) {
    return make(scene::Kind::transform, name, parent);
  }

  /// An expression over plugs.
  scene::Plug formula(const std::string& code, const std::vector<scene::Plug>& inputs) {
    const scene::NodeId node = make(scene::Kind::expression, "expression");
    edit.set({node, scene::expression::kCode}, code);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      edit.connect(inputs[i], {node, scene::expression::kInputs, static_cast<std::int32_t>(i)});
    }
    return {node, scene::expression::kOutput};
  }

  scene::Value value(const scene::Plug& plug,
                     const std::vector<eval::Setting>& settings = {}) const {
    Diagnostics diagnostics;
    const auto got = eval::evaluate(scene, {plug}, settings, diagnostics);
    return got ? got->front() : scene::Value(std::string("error"));
  }
  double number(const scene::Plug& plug, const std::vector<eval::Setting>& settings = {}) const {
    return std::get<double>(value(plug, settings));
  }
};

}  // namespace rigc::test
