// SPDX-License-Identifier: MIT
// morph_targets: numbers of the rig become weights of the model's morph targets.
// Test: tests/modules/morph_targets_test.cpp, tests/pipeline/morphs_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "modules/attributes/plugs.h"
#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/utilities/utilities.h"

namespace rigc::modules {
namespace {

/// The names with a line break between two; fails on what is no name, and on a name twice.
std::string joined(Builder& b, const std::vector<std::string>& names) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool again = std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i),
                                 names[i]) != names.begin() + static_cast<std::ptrdiff_t>(i);
    if (again || names[i].empty() || names[i].find('\n') != std::string::npos)
      b.fail(codes::kNames, "targets",
             again ? "a target is named twice" : "a target's name is empty or has a line break");
    all += (i ? "\n" : "") + names[i];
  }
  return all;
}

}  // namespace

void morph_targets(Builder& b) {
  const Parameters& with = b.with();
  const std::vector<Plug>& plugs = with.plugs("weights");
  const std::vector<std::string>& names = with.texts("targets");
  const std::vector<double> amounts =
      with.has("amounts") ? with.numbers("amounts") : std::vector<double>(plugs.size(), 1.0);
  if (names.size() != plugs.size() || amounts.size() != plugs.size()) {
    b.fail(codes::kTable, names.size() != plugs.size() ? "targets" : "amounts",
           fmt::format("{} targets and {} amounts for {} weights", names.size(), amounts.size(),
                       plugs.size()));
    return;
  }
  const std::string targets = joined(b, names);
  for (const Plug& plug : plugs)
    if (b.failed() || !check_number(b, plug, "weights")) return;
  const NodeId node = b.make(
      {.kind = scene::Kind::morph, .role = "driver", .joint = {}, .parent = {}, .suffix = "morph"});
  b.set({node, scene::morph::kTargets}, targets);
  for (std::size_t i = 0; i < plugs.size(); ++i) {
    const Plug weight{node, scene::morph::kWeights, static_cast<std::int32_t>(i)};
    b.set(weight, 0.0);
    b.connect(amounts[i] == 1 ? plugs[i]
                              : formula(b, {}, "amount", "$0 * " + literal(amounts[i]), {plugs[i]}),
              weight);
  }
}

}  // namespace rigc::modules
