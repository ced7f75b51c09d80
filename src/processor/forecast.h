// SPDX-License-Identifier: MIT
// Says which command would make what a selector names but does not find: one that runs later, or
// one that is switched off. Only asked when a selector failed. Test:
// tests/processor/forecast_test.cpp
#pragma once

#include <optional>
#include <string>

#include "base/diagnostics.h"
#include "processor/command_list.h"
#include "selector/selector.h"
#include "traversal/resolve.h"

namespace rigc::processor {

/// What a forecast looks at: the whole list, and the command whose selector found nothing.
struct Outlook {
  const tags::TaggedSkeleton& skeleton;
  const CommandList& commands;
  const catalog::Catalogue& catalogue;
  std::size_t command = 0;  ///< index in the list
  const Sources& sources;
};

/// `made by "control" on joint "elbow", which runs later, biped.yaml:88; ...`; empty where no
/// command would make it.
std::string forecast(const Outlook& outlook, const selector::Choice& choice,
                     const traversal::Context& context);

/// The feature that is off and whose command would make what an optional selector does not find.
/// Nothing where no command would: a model without such a joint, a command that is off by itself.
std::optional<std::string> missing_feature(const Outlook& outlook,
                                           const selector::Selector& selector,
                                           const traversal::Context& context);

}  // namespace rigc::processor
