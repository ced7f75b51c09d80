// SPDX-License-Identifier: MIT
// Orphans of a rig in RIGC_rig, and the nodes that hold them. Test: tests/gltf/rig_orphans_test.cpp
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/json.h"
#include "gltf/rig.h"
#include "gltf/rig_json_reader.h"
#include "gltf/slim.h"

namespace rigc::gltf {

/// Member `orphans` of an open object; left out where there are none.
void write_orphans(json::Writer& writer, const Rig& rig);
/// What is held is not in RIGC_rig but on the nodes: see find_orphans().
void read_orphans(const json::Value& object, JsonReader& reader, Rig& rig);

/// `orphan:` and an identity: `extras.rigc` of a node that holds an orphan.
std::string orphan_mark(const Identity& identity);

/// Sets the nodes that hold a rig's orphans, and what they hold; orphans whose node is gone are
/// reported and dropped. `taken`: nodes that stand for something already.
void find_orphans(const File& file, const Slim& slim, const std::vector<json::Value>& nodes,
                  Rig& rig, std::set<int>& taken, Diagnostics& diagnostics);

/// The node that holds an orphan.
std::string orphan_text(const Rig& rig, const Orphan& orphan);

}  // namespace rigc::gltf
