// SPDX-License-Identifier: MIT
// Which instruction set evaluation uses. Test: tests/cli/isa_test.cpp
#pragma once

#include <string>
#include <string_view>

namespace rigc::pipeline {

/// "baseline", "avx2".
std::string_view instruction_set();

/// Why what the environment's RIGC_ISA asks for cannot be used; empty where it can.
std::string instruction_set_problem();

}  // namespace rigc::pipeline
