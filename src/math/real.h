// SPDX-License-Identifier: MIT
// What formulas need of a number beyond + - * /: `R` is double here, a Pack of doubles in pack.h. A
// formula that is written with these has no branch that depends on a value, and gives each number
// of a pack the bits that a double alone gets. Test: tests/math/pack_test.cpp
#pragma once

#include <cstdint>

// Formulas are inlined wherever they are used, so that a file that is compiled for one instruction
// set leaves no function behind that the linker could take for another's.
#define RIGC_INLINE [[gnu::always_inline]] inline

namespace rigc::math {

/// a where the condition holds, else b; both are computed.
RIGC_INLINE double select(bool condition, double a, double b) { return condition ? a : b; }
RIGC_INLINE bool any(bool condition) { return condition; }

RIGC_INLINE double root(double x) { return __builtin_sqrt(x); }  ///< correctly rounded; x >= 0
RIGC_INLINE double magnitude(double x) { return __builtin_fabs(x); }
/// `size` (>= 0) with the sign of `sign`, also of a zero.
RIGC_INLINE double with_sign(double size, double sign) { return __builtin_copysign(size, sign); }

RIGC_INLINE std::uint64_t bits_of(double x) { return __builtin_bit_cast(std::uint64_t, x); }
RIGC_INLINE double of_bits(double, std::uint64_t bits) { return __builtin_bit_cast(double, bits); }

/// table[index] for whole numbers.
RIGC_INLINE double lookup(const double* table, double index) {
  return table[static_cast<int>(index)];
}
/// The remainder of a / b with the sign of a, exact.
RIGC_INLINE double remainder(double a, double b) { return __builtin_fmod(a, b); }

template <class R>
RIGC_INLINE bool none(R condition) {
  return !any(condition);
}

/// The largest whole number not above x, as std::floor.
template <class R>
RIGC_INLINE R floored(R x) {
  // Above 2^52 there are no fractions; adding it rounds to a whole number.
  const R near = with_sign((magnitude(x) + 0x1p52) - 0x1p52, x);
  const R below = near - select(near > x, R(1.0), R(0.0));
  return select(magnitude(x) < 0x1p52, with_sign(magnitude(below), x), x);
}

/// 2^k for whole k in -1022..1023.
template <class R>
RIGC_INLINE R power_of_two(R k) {
  // Of a number near 1.5 * 2^52 the lowest bits are the whole number.
  return of_bits(k, (bits_of((k + 1023.0) + 0x1.8p52)) << 52);
}

/// x * 2^k for whole k in -2000..2000, rounded once.
template <class R>
RIGC_INLINE R scaled_by_power(R x, R k) {
  const R half = floored(k * 0.5);
  return x * power_of_two(half) * power_of_two(k - half);
}

/// x = mantissa * 2^exponent, mantissa in 1/2..1; x positive and finite.
template <class R>
struct Parts {
  R mantissa, exponent;
};

template <class R>
RIGC_INLINE Parts<R> parts_of(R x) {
  const auto small = x < 0x1p-1022;
  const R normal = select(small, x * 0x1p54, x);
  const auto bits = bits_of(normal);
  constexpr std::uint64_t kMantissa = 0x000fffffffffffff, kHalf = 0x3fe0000000000000,
                          kTwo52 = 0x4330000000000000;
  const R exponent = (of_bits(x, (bits >> 52) | kTwo52) - 0x1p52) - 1022.0;
  return {of_bits(x, (bits & kMantissa) | kHalf), exponent - select(small, R(54.0), R(0.0))};
}

}  // namespace rigc::math
