// SPDX-License-Identifier: MIT
// The tagged skeleton and the settings of a rig in RIGC_rig. Test: tests/gltf/rig_json_test.cpp
#pragma once

#include "base/json.h"
#include "gltf/rig_places.h"
#include "tags/tags.h"

namespace rigc::gltf {

/// Members `name`, `global`, `templates`, `module_pins`, `features`, `shapes`, `groups`,
/// `character`, `aims`, `joints` of an open object.
void write_skeleton(json::Writer& writer, const tags::TaggedSkeleton& skeleton,
                    PlaceWriter& places);
void read_skeleton(const json::Value& rig, JsonReader& reader, PlaceReader& places,
                   tags::TaggedSkeleton& out);

void write_settings(json::Writer& writer, const tags::Settings& settings);
void read_settings(const json::Value& rig, JsonReader& reader, tags::Settings& out);

/// Member `templates`.
std::vector<tags::TemplateReference> read_template_references(const json::Value& rig,
                                                              JsonReader& reader);

/// `[{"name": ..., "version": ...}]`
void write_versions(json::Writer& writer, const std::vector<std::pair<std::string, int>>& modules);
std::vector<std::pair<std::string, int>> read_versions(const json::Value& object,
                                                       std::string_view key, JsonReader& reader);

}  // namespace rigc::gltf
