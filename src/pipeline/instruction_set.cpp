// SPDX-License-Identifier: MIT
// Which instruction set evaluation uses. Test: tests/cli/isa_test.cpp
#include "pipeline/instruction_set.h"

#include <fmt/format.h>

#include <cstdlib>

#include "base/text.h"
#include "eval/isa.h"

namespace rigc::pipeline {

std::string_view instruction_set() { return eval::name(eval::default_isa()); }

std::string instruction_set_problem() {
  const char* wanted = std::getenv("RIGC_ISA");
  if (!wanted || !*wanted || eval::find_isa(wanted)) return {};
  std::string names;
  for (const eval::Isa isa : eval::available_isas())
    names += (names.empty() ? "" : " or ") + std::string(eval::name(isa));
  return fmt::format("RIGC_ISA is \"{}\"; this machine runs {}", printable(wanted), names);
}

}  // namespace rigc::pipeline
