// SPDX-License-Identifier: MIT
// Random templates for property tests: random skeletons whose joints hold random commands of many
// modules with valid parameters, so that the whole list builds without an error.
#pragma once

#include <cstdint>
#include <string>

namespace rigc::test {

struct RandomTemplateOptions {
  std::size_t chains = 5;     ///< chains of joints, each a local group of its own
  std::size_t longest = 6;    ///< joints in a chain, at least 3
  std::size_t commands = 12;  ///< besides those that make every chain controllable
};

/// A template's text; the same for the same seed everywhere. Builds without an error (commands
/// whose optional selectors find nothing are skipped with a warning) and compiles without a cycle.
std::string random_template(std::uint64_t seed, const RandomTemplateOptions& options = {});

}  // namespace rigc::test
