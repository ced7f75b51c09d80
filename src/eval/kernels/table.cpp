// SPDX-License-Identifier: MIT
// Which table of kernels an instruction set has. Test: tests/eval/isa_test.cpp
#include "eval/kernels/table.h"

namespace rigc::eval {

// Each is kernels.cpp, compiled for that instruction set (cmake/kernels.cmake).
namespace baseline {
const KernelRow* kernels();
}
#ifdef RIGC_HAS_AVX2
namespace avx2 {
const KernelRow* kernels();
}
#endif

const KernelRow* kernels(Isa isa) {
#ifdef RIGC_HAS_AVX2
  if (isa == Isa::avx2) return avx2::kernels();
#endif
  (void)isa;
  return baseline::kernels();
}

const KernelRow& row(Op op, Isa isa) { return kernels(isa)[static_cast<std::size_t>(op)]; }

}  // namespace rigc::eval
