// SPDX-License-Identifier: MIT
// The lower bound in vectors of 32 bytes; bench/CMakeLists.txt has the flags.
#include "bench/lower_bound_steps.h"

namespace {

typedef double Doubles __attribute__((vector_size(32)));
typedef float Floats __attribute__((vector_size(32)));

}  // namespace

void rigc::bench::lower_bound_avx2(const BoundHierarchy<double>& hierarchy) {
  run<Doubles>(hierarchy);
}

void rigc::bench::lower_bound_avx2(const BoundHierarchy<float>& hierarchy) {
  run<Floats>(hierarchy);
}
