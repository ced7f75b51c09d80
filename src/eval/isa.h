// SPDX-License-Identifier: MIT
// The instruction sets that kernels are compiled for; all give the same bits.
// Test: tests/eval/isa_test.cpp
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace rigc::eval {

enum class Isa : std::uint8_t {
  baseline,  ///< what every processor of the kind has (x86-64: SSE2)
  avx2
};

/// "baseline", "avx2".
std::string_view name(Isa isa);

/// Those that this build has and this machine runs, widest last.
std::vector<Isa> available_isas();

/// The one of that name; empty for another name and for what is not available.
std::optional<Isa> find_isa(std::string_view name);

/// What instances run unless told otherwise: the environment's RIGC_ISA if it names one that is
/// available, else the widest. Read once.
Isa default_isa();

}  // namespace rigc::eval
