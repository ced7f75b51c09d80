// SPDX-License-Identifier: MIT
// state_machine: several remaps of one input, each in an interval of its own, with smooth
// hand-over: the weights of all states add up to 1 everywhere.
// Test: tests/modules/state_machine_test.cpp
#include <fmt/format.h>

#include "modules/attributes/plugs.h"
#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/utilities/utilities.h"

namespace rigc::modules {
namespace {

bool check_bounds(Builder& b, const std::vector<double>& bounds, std::size_t states) {
  std::string wrong;
  if (bounds.size() + 1 != states)
    wrong = fmt::format("{} bounds between {} states", bounds.size(), states);
  for (std::size_t i = 1; i < bounds.size(); ++i)
    if (bounds[i] <= bounds[i - 1]) wrong = "the bounds do not rise";
  if (wrong.empty()) return true;
  b.fail(codes::kTable, "bounds", wrong);
  return false;
}

bool check_values(Builder& b, std::size_t states, std::size_t driven) {
  const auto& rows = b.with().table("values");
  if (rows.size() == states && rows.front().size() == driven) return true;
  b.fail(codes::kTable, "values",
         fmt::format("{} rows of {} for {} states and {} driven plugs", rows.size(),
                     rows.front().size(), states, driven));
  return false;
}

/// Each driven plug gets its column of `values`, weighted.
void drive(Builder& b, const std::vector<Plug>& weights) {
  const std::vector<Plug>& driven = b.with().plugs("driven");
  if (!b.with().has("values")) {
    b.fail(codes::kTable, "driven", "`values` says nothing of what it gets");
    return;
  }
  if (!check_values(b, weights.size(), driven.size())) return;
  for (std::size_t i = 0; i < driven.size(); ++i) {
    if (!check_input(b, driven[i], "driven") || !check_number(b, driven[i], "driven")) return;
    std::string sum;
    for (std::size_t state = 0; state < weights.size(); ++state)
      sum += fmt::format("{}${} * {}", state ? " + " : "", state,
                         literal(b.with().table("values")[state][i]));
    b.connect(formula(b, {}, "state", sum, weights), driven[i]);
  }
}

}  // namespace

void state_machine(Builder& b) {
  const Parameters& with = b.with();
  const Plug input = with.plug("input");
  const std::vector<double>& bounds = with.numbers("bounds");
  const std::vector<std::string>& names = with.texts("names");
  if (!check_number(b, input, "input") || !check_names(b, names)) return;
  if (!check_bounds(b, bounds, names.size())) return;
  const double half = with.number("overlap") / 2;
  std::string program;
  // Steps that are passed one after the other: what lies between two of them is a state.
  for (std::size_t i = 0; i < bounds.size(); ++i)
    program += fmt::format(" _s{} = smoothstep({}, {}, _x);", i, literal(bounds[i] - half),
                           literal(bounds[i] + half));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string above = i == 0 ? "1" : fmt::format("_s{}", i - 1);
    const std::string below = i == bounds.size() ? "0" : fmt::format("_s{}", i);
    program += fmt::format(" out {} = {} - {};", names[i], above, below);
  }
  const Computed made = make_utility(b, {{"_x", input}}, program);
  if (!with.has("driven")) return;
  std::vector<Plug> weights;
  for (const std::string& name : names) weights.push_back(made[name]);
  drive(b, weights);
}

}  // namespace rigc::modules
