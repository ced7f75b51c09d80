// SPDX-License-Identifier: MIT
// What a rig says about itself. Test: tests/bake/match_test.cpp
#include "bake/said.h"

#include "base/text.h"

namespace rigc::bake {

using scene::NodeId;
using scene::Plug;

std::string SaidReader::text(std::uint16_t attribute) const {
  return std::get<std::string>(scene_.value({node_, attribute}));
}

std::vector<std::string> SaidReader::words(std::uint16_t attribute) const {
  const std::string all = text(attribute);
  std::vector<std::string> out;
  for (const std::string_view word : split(all, ' '))
    if (!word.empty()) out.emplace_back(word);
  return out;
}

Plug SaidReader::plug(const Input& input) {
  const bool exists = input.element < 0 || static_cast<std::size_t>(input.element) <
                                               scene_[node_].attributes[input.attribute].size();
  const auto source =
      exists ? scene_.source({node_, input.attribute, input.element}) : std::nullopt;
  complete_ = complete_ && source;
  return source.value_or(Plug{node_, 0});
}

NodeId SaidReader::transform(const Input& input) {
  const Plug world = plug(input);
  complete_ = complete_ && scene::spec(scene_[world.node].kind).is_transform &&
              world.attribute == scene::transform::kWorld;
  return world.node;
}

Plug SaidReader::attribute(const Input& input) {
  const Plug user = plug(input);
  complete_ = complete_ && user.attribute >= scene::kUserAttributes;
  return user;
}

}  // namespace rigc::bake
