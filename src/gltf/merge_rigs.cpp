// SPDX-License-Identifier: MIT
// Rigs of a merged file: what their texts in RIGC_rig say of the file's nodes and arrays.
// Test: tests/gltf/merge_test.cpp
#include <algorithm>

#include "gltf/merge_places.h"

namespace rigc::gltf {
namespace {

using json::Value;

class RigRemap {
 public:
  RigRemap(const Rig& rig, const Places& places, Edits& edits)
      : rig_(rig), places_(places), edits_(edits) {}

  void run(const Value& item) {
    const auto id = places_.rigs.find(rig_.id);
    if (id != places_.rigs.end()) edits_.replace(item["id"], std::to_string(id->second));
    set_node(item["ancestor"], rig_.ancestor);
    const auto joints = item["joints"].items();
    for (std::size_t i = 0; i < joints.size(); ++i)
      set_node(joints[i]["foreign_node"], rig_.skeleton.joints[i].foreign_node);
    const auto nodes = item["nodes"].items();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      set_node(nodes[i]["node"], rig_.nodes[i]);
      set_identity(nodes[i]["identity"]);
      set_identity(nodes[i]["values"]["opposite"]);
    }
    for (const char* part : {"stays", "goes"})
      for (const auto& [array, runs] : item["owned"][part].members()) set_runs(runs, array);
    for (const Value& skin : item["rebound"]["skins"].items()) {
      set_index(skin["skin"], "skins");
      for (const Value& accessor : skin["matrices"].items()) set_index(accessor, "accessors");
    }
    for (const Value& primitive : item["rebound"]["primitives"].items()) {
      set_index(primitive["mesh"], "meshes");
      for (const auto& [name, accessors] : primitive["attributes"].members())
        for (const Value& accessor : accessors.items()) set_index(accessor, "accessors");
    }
    const auto orphans = item["orphans"].items();
    for (std::size_t i = 0; i < orphans.size(); ++i) {
      // Where one is lost, nobody says which.
      const bool all = rig_.orphans.size() == orphans.size();
      set_node(orphans[i]["node"], all ? rig_.orphans[i].node : -1);
      set_identity(orphans[i]["identity"]);
    }
  }

 private:
  /// `found`: the node that stands for it whatever is written there, -1: the one that is written.
  void set_node(const Value& value, int found) {
    if (!value) return;
    const int now = places_.find("nodes", found >= 0 ? found : value.integer().value_or(-1));
    if (now >= 0) edits_.replace(value, std::to_string(now));
  }

  void set_index(const Value& value, std::string_view array) {
    const int now = places_.find(array, value.integer().value_or(-1));
    if (now >= 0) edits_.replace(value, std::to_string(now));
  }

  void set_identity(const Value& value) {
    const auto text = value.string();
    const auto now = text ? renumbered(*text, places_) : std::nullopt;
    if (now) edits_.replace(value, json::quote(*now));
  }

  void set_runs(const Value& runs, const std::string& array) {
    const auto found = places_.arrays.find(array);
    const auto size =
        static_cast<std::int64_t>(found == places_.arrays.end() ? 0 : found->second.size());
    std::vector<int> indices;
    const auto numbers = runs.items();
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
      const std::int64_t first = numbers[i].integer().value_or(0);
      const std::int64_t count = numbers[i + 1].integer().value_or(0);
      for (std::int64_t at = first; at < std::min(first + count, size); ++at)
        indices.push_back(places_.find(array, at));
      if (static_cast<std::int64_t>(indices.size()) > size) break;  // runs that overlap
    }
    std::sort(indices.begin(), indices.end());
    Slots slots;
    for (const int index : indices) slots.add(index);
    json::Writer writer;
    writer.begin_array();
    for (const Range& run : slots.runs) writer.value(run.first).value(run.count);
    edits_.replace(runs, writer.end_array().take());
  }

  const Rig& rig_;
  const Places& places_;
  Edits& edits_;
};

}  // namespace

void remap_rigs(const File& file, const std::vector<Rig>& rigs, const Places& places,
                Edits& edits) {
  for (const Value& item : file.root()["extensions"]["RIGC_rig"]["rigs"].items())
    for (const Rig& rig : rigs)
      if (item["id"].integer() == static_cast<std::int64_t>(rig.id))
        RigRemap(rig, places, edits).run(item);
}

}  // namespace rigc::gltf
