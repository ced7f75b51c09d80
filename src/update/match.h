// SPDX-License-Identifier: MIT
// Which node of a new rig takes the keys of which node of the old one. Test:
// tests/update/match_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "catalog/catalogue.h"
#include "scene/scene.h"
#include "tags/tags.h"

namespace rigc::update {

/// Where transforms of a node are seen from.
struct Frame {
  math::Mat3 space;  ///< axes of its parent at rest, rig space
  math::Trs rest;    ///< its rest in that space
};
Frame frame_of(const scene::Scene& built, scene::NodeId node);

/// Something that may have keys: a node of the old rig, or what an earlier update could not place.
struct Source {
  Identity identity;
  std::string name;
  Identifiers ids;
  scene::Kind kind = scene::Kind::control;
  std::string module;  ///< that made it; empty: joint of the skeleton
  Frame frame;
  scene::NodeId node;  ///< of the old scene; invalid: an orphan
};

/// Every node of a rig that may have a place in its file. `built`: the scene as it was built.
std::vector<Source> sources_of(const scene::Scene& built);

/// How a node was found, in the order in which the rules count.
enum class Rule : std::uint8_t {
  identity,  ///< the same joint, command and role
  was,       ///< the new template says what the joint, part, template or command was
  replaces,  ///< the new module says which role of another module it succeeds
  label,     ///< the only one of the local group with this label, kind and role
};
std::string_view name_of(Rule rule);

struct Match {
  scene::NodeId to;
  Rule rule = Rule::identity;
};

/// By source: the node of `fresh` that it became, or nothing. No node is given to two sources but
/// those of one identity; but an orphan keeps no node of the old rig from its place, and both have
/// it then. The rig's number does not count.
std::vector<std::optional<Match>> match(const std::vector<Source>& sources,
                                        const scene::Scene& fresh,
                                        const tags::TaggedSkeleton& skeleton,
                                        const catalog::Catalogue& catalogue);

}  // namespace rigc::update
