// SPDX-License-Identifier: MIT
// Joints and their tags in RIGC_rig. Test: tests/gltf/rig_json_test.cpp
#pragma once

#include "base/json.h"
#include "gltf/rig_places.h"
#include "tags/tags.h"

namespace rigc::gltf {

/// `local`, `label`, and `global` where it is not the rig's.
void write_identifiers(json::Writer& writer, const Identifiers& ids, const std::string& global);
void read_identifiers(const json::Value& object, JsonReader& reader, const std::string& global,
                      Identifiers& out);

/// `translation`, `rotation`, `scale` where they are not those of the identity.
void write_rest(json::Writer& writer, const math::Trs& rest);

void write_joints(json::Writer& writer, const tags::TaggedSkeleton& skeleton, PlaceWriter& places);
void read_joints(const json::Value& rig, JsonReader& reader, PlaceReader& places,
                 tags::TaggedSkeleton& out);

}  // namespace rigc::gltf
