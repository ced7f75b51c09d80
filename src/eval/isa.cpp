// SPDX-License-Identifier: MIT
// Which instruction sets there are. Test: tests/eval/isa_test.cpp
#include "eval/isa.h"

#include <cstdlib>

namespace rigc::eval {

std::string_view name(Isa isa) { return isa == Isa::avx2 ? "avx2" : "baseline"; }

std::vector<Isa> available_isas() {
  std::vector<Isa> found{Isa::baseline};
#ifdef RIGC_HAS_AVX2
  if (__builtin_cpu_supports("avx2")) found.push_back(Isa::avx2);
#endif
  return found;
}

std::optional<Isa> find_isa(std::string_view wanted) {
  for (const Isa isa : available_isas())
    if (name(isa) == wanted) return isa;
  return std::nullopt;
}

Isa default_isa() {
  static const Isa chosen = [] {
    const char* wanted = std::getenv("RIGC_ISA");
    return (wanted ? find_isa(wanted) : std::nullopt).value_or(available_isas().back());
  }();
  return chosen;
}

}  // namespace rigc::eval
