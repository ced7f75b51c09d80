// SPDX-License-Identifier: MIT
// Transforms that commands put around a control that exists: a layer between it and its zero, which
// moves it without touching what animators key, and attributes. Test: tests/modules/pivot_test.cpp
#pragma once

#include <string>

#include "modules/wiring.h"

namespace rigc::modules {

/// The transform above a control that holds its rest placement, past all layers.
NodeId zero_of(const Builder& b, NodeId control);

/// A transform at identity between a control and what it hangs under now. `suffix` ends its name.
NodeId make_layer(Builder& b, NodeId control, const std::string& suffix);

/// Adds an attribute to a control that another command made; fails where it has one of this name.
Plug add_to(Builder& b, NodeId control, const NumberAttribute& attribute,
            std::string_view parameter);

}  // namespace rigc::modules
