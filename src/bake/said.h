// SPDX-License-Identifier: MIT
// Reads what a rig says about itself in nodes that only hold data (scene::match, scene::spaces):
// connections that name nodes and attributes, and words. Test: tests/bake/match_test.cpp
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace rigc::bake {

/// What is missing or of another kind is noticed, and some plug of the node stands for it.
class SaidReader {
 public:
  SaidReader(const scene::Scene& scene, scene::NodeId node) : scene_(scene), node_(node) {}

  /// An input of the node.
  struct Input {
    std::uint16_t attribute;
    std::int32_t element = -1;  ///< of an array
  };

  std::string text(std::uint16_t attribute) const;
  /// Of a text, with blanks between them.
  std::vector<std::string> words(std::uint16_t attribute) const;
  /// What is connected there: anything, the world of a transform, an attribute for animators.
  scene::Plug plug(const Input& input);
  scene::NodeId transform(const Input& input);
  scene::Plug attribute(const Input& input);

  bool complete() const { return complete_; }

 private:
  const scene::Scene& scene_;
  scene::NodeId node_;
  bool complete_ = true;
};

}  // namespace rigc::bake
