// SPDX-License-Identifier: MIT
// Says which command would make what a selector names but does not find: one that runs later, or
// one that is switched off. Only asked when a selector failed. Test:
// tests/traversal/forecast_test.cpp
#pragma once

#include <string>

#include "base/diagnostics.h"
#include "processor/command_list.h"
#include "selector/selector.h"
#include "traversal/resolve.h"

namespace rigc::processor {

/// `made by "control" on joint "elbow", which runs later, biped.yaml:88; ...`; empty where no
/// command would make it. `command` is the index of the one whose selector found nothing.
std::string forecast(const tags::TaggedSkeleton& skeleton, const CommandList& commands,
                     std::size_t command, const selector::Choice& choice,
                     const traversal::Context& context, const Sources& sources);

}  // namespace rigc::processor
