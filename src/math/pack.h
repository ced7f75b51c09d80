// SPDX-License-Identifier: MIT
// Several doubles that are computed with at once, as wide as the vector registers of the
// instruction set that a file is compiled for. Written with the vector types of gcc and clang, so
// that any processor has them. Test: tests/math/pack_test.cpp
#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "math/real.h"

namespace rigc::math {

/// The compiler's vectors of W numbers.
template <int W>
struct VectorsOf;
template <>
struct VectorsOf<2> {
  typedef double Numbers __attribute__((vector_size(16)));
  typedef std::int64_t Conditions __attribute__((vector_size(16)));
  typedef std::uint64_t Bits __attribute__((vector_size(16)));
};
template <>
struct VectorsOf<4> {
  typedef double Numbers __attribute__((vector_size(32)));
  typedef std::int64_t Conditions __attribute__((vector_size(32)));
  typedef std::uint64_t Bits __attribute__((vector_size(32)));
};

/// A condition for each number of a pack.
template <int W>
struct Mask {
  typename VectorsOf<W>::Conditions m;

  RIGC_INLINE friend Mask operator&(Mask a, Mask b) { return {a.m & b.m}; }
  RIGC_INLINE friend Mask operator|(Mask a, Mask b) { return {a.m | b.m}; }
  RIGC_INLINE friend Mask operator!(Mask a) { return {~a.m}; }
};

template <int W>
struct Pack {
  static constexpr int width = W;
  using V = typename VectorsOf<W>::Numbers;
  V v{};

  Pack() = default;
  RIGC_INLINE Pack(double x) : v(x - V{}) {}  // in all places; 0 - V{} would lose the sign of -0
  RIGC_INLINE explicit Pack(V vector) : v(vector) {}

  RIGC_INLINE static Pack load(const double* from) {
    Pack p;
    __builtin_memcpy(&p.v, from, sizeof p.v);
    return p;
  }
  RIGC_INLINE void store(double* to) const { __builtin_memcpy(to, &v, sizeof v); }

  RIGC_INLINE friend Pack operator+(Pack a, Pack b) { return Pack(a.v + b.v); }
  RIGC_INLINE friend Pack operator-(Pack a, Pack b) { return Pack(a.v - b.v); }
  RIGC_INLINE friend Pack operator*(Pack a, Pack b) { return Pack(a.v * b.v); }
  RIGC_INLINE friend Pack operator/(Pack a, Pack b) { return Pack(a.v / b.v); }
  RIGC_INLINE friend Pack operator-(Pack a) { return Pack(-a.v); }
  RIGC_INLINE friend Mask<W> operator<(Pack a, Pack b) { return {a.v < b.v}; }
  RIGC_INLINE friend Mask<W> operator<=(Pack a, Pack b) { return {a.v <= b.v}; }
  RIGC_INLINE friend Mask<W> operator>(Pack a, Pack b) { return {a.v > b.v}; }
  RIGC_INLINE friend Mask<W> operator>=(Pack a, Pack b) { return {a.v >= b.v}; }
  RIGC_INLINE friend Mask<W> operator==(Pack a, Pack b) { return {a.v == b.v}; }
  RIGC_INLINE friend Mask<W> operator!=(Pack a, Pack b) { return {a.v != b.v}; }
};

template <int W>
RIGC_INLINE Pack<W> select(Mask<W> condition, Pack<W> a, Pack<W> b) {
  return Pack<W>(condition.m ? a.v : b.v);
}

template <int W>
RIGC_INLINE bool any(Mask<W> condition) {
#if defined(__AVX__)
  if constexpr (W == 4) return _mm256_movemask_pd(reinterpret_cast<__m256d>(condition.m)) != 0;
#endif
#if defined(__SSE2__)
  if constexpr (W == 2) return _mm_movemask_pd(reinterpret_cast<__m128d>(condition.m)) != 0;
#endif
  bool found = false;
  for (int i = 0; i < W; ++i) found |= condition.m[i] != 0;
  return found;
}

template <int W>
RIGC_INLINE Pack<W> root(Pack<W> x) {
#if defined(__AVX__)
  if constexpr (W == 4) return Pack<W>(_mm256_sqrt_pd(x.v));
#endif
#if defined(__SSE2__)
  if constexpr (W == 2) return Pack<W>(_mm_sqrt_pd(x.v));
#endif
  for (int i = 0; i < W; ++i) x.v[i] = __builtin_sqrt(x.v[i]);
  return x;
}

template <int W>
struct Bits {
  using U = typename VectorsOf<W>::Bits;
  U u;

  RIGC_INLINE friend Bits operator&(Bits a, std::uint64_t b) { return {a.u & b}; }
  RIGC_INLINE friend Bits operator|(Bits a, std::uint64_t b) { return {a.u | b}; }
  RIGC_INLINE friend Bits operator|(Bits a, Bits b) { return {a.u | b.u}; }
  RIGC_INLINE friend Bits operator<<(Bits a, int by) { return {a.u << by}; }
  RIGC_INLINE friend Bits operator>>(Bits a, int by) { return {a.u >> by}; }
};

template <int W>
RIGC_INLINE Bits<W> bits_of(Pack<W> x) {
  return {reinterpret_cast<typename Bits<W>::U>(x.v)};
}
template <int W>
RIGC_INLINE Pack<W> of_bits(Pack<W>, Bits<W> bits) {
  return Pack<W>(reinterpret_cast<typename Pack<W>::V>(bits.u));
}

inline constexpr std::uint64_t kSignBit = std::uint64_t{1} << 63;

template <int W>
RIGC_INLINE Pack<W> magnitude(Pack<W> x) {
  return of_bits(x, bits_of(x) & ~kSignBit);
}
template <int W>
RIGC_INLINE Pack<W> with_sign(Pack<W> size, Pack<W> sign) {
  return of_bits(size, bits_of(size) | (bits_of(sign) & kSignBit));
}

template <int W>
RIGC_INLINE Pack<W> lookup(const double* table, Pack<W> index) {
  Pack<W> found;
  for (int i = 0; i < W; ++i) found.v[i] = table[static_cast<int>(index.v[i])];
  return found;
}

template <int W>
RIGC_INLINE Pack<W> remainder(Pack<W> a, Pack<W> b) {
  for (int i = 0; i < W; ++i) a.v[i] = __builtin_fmod(a.v[i], b.v[i]);
  return a;
}

}  // namespace rigc::math
