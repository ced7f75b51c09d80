// SPDX-License-Identifier: MIT
// Parameters and outside groups of a part are bound to what its user gives.
// Test: tests/templates/expand_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "templates/codes.h"
#include "templates/expander.h"

namespace rigc::templates {

bool Expander::bind_argument(Use& use, const Use& outer, const tags::Argument& argument) {
  const catalog::Parameter* parameter = use.source->find_parameter(argument.name);
  if (!parameter) {
    std::vector<std::string> names;
    for (const catalog::Parameter& candidate : use.source->parameters)
      names.push_back(candidate.name);
    diagnostics_.report(codes::kUnknownPartParameter, argument.span,
                        fmt::format("the part {} has no parameter \"{}\"", use.source->name,
                                    printable(argument.name, 60)),
                        suggest(argument.name, names));
    return false;
  }
  Literal value = argument.value;
  if (!substitute(value, outer.environment))
    to_metres(*parameter, outer.source->metres_per_unit, value);
  if (!check_value(*parameter, value, diagnostics_)) return false;
  use.environment[argument.name] = std::move(value);
  return true;
}

bool Expander::bind_parameters(int index) {
  Use& use = uses_[static_cast<std::size_t>(index)];
  bool ok = true;
  if (use.part) {
    const Use& outer = uses_[static_cast<std::size_t>(use.outer)];
    for (const tags::Argument& argument : use.part->with) ok &= bind_argument(use, outer, argument);
    check_groups(use);
  }
  for (const catalog::Parameter& parameter : use.source->parameters) {
    if (use.environment.contains(parameter.name)) continue;
    if (parameter.default_value) {
      use.environment[parameter.name] = *parameter.default_value;
      continue;
    }
    if (!ok) continue;  // its value was given and refused
    diagnostics_.report(
        codes::kMissingArgument, use.part ? use.part->span : use.source->span,
        fmt::format("the template {} needs the parameter \"{}\"", use.source->name, parameter.name),
        use.part ? "write it in `with:`" : "it is made to be a part of others");
    ok = false;
  }
  return ok;
}

void Expander::check_groups(const Use& use) {
  const Part& part = *use.part;
  const std::vector<std::string>& needs = use.source->needs;
  for (const std::string& need : needs) {
    const bool bound = std::any_of(part.groups.begin(), part.groups.end(),
                                   [&](const auto& pair) { return pair.first == need; });
    if (bound) continue;
    diagnostics_.report(
        codes::kUnboundGroup, part.groups_span,
        fmt::format("the part {} needs the group \"{}\"", use.source->name, need),
        fmt::format("say which group of this template that is: groups: {{{}: ...}}", need));
  }
  for (const auto& pair : part.groups) {
    if (std::find(needs.begin(), needs.end(), pair.first) != needs.end()) continue;
    diagnostics_.report(codes::kNotNeeded, part.groups_span,
                        fmt::format("the part {} needs no group \"{}\"", use.source->name,
                                    printable(pair.first, 60)),
                        suggest(pair.first, needs));
  }
}

}  // namespace rigc::templates
