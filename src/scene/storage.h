// SPDX-License-Identifier: MIT
// How values lie in nodes: shared by the readers and the editor of a scene, nobody else.
// Test: tests/scene/scene_test.cpp
#pragma once

#include "scene/kinds.h"
#include "scene/value.h"

namespace rigc::scene {

/// The value that an attribute has before anybody sets it.
Value initial_value(const AttributeSpec& attribute);

/// One number of a vec3 or quat.
double component(const Value& value, int index);
void set_component(Value& value, int index, double number);

}  // namespace rigc::scene
