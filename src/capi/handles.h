// SPDX-License-Identifier: MIT
// What stands behind the handles of rigc_eval.h, and how each of its functions is entered.
// Test: tests/capi
#pragma once

#ifdef __SSE2__
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "capi/instance.h"
#include "capi/program.h"
#include "capi/rig.h"
#include "capi/rigc_eval.h"

struct rigc_rig {
  std::shared_ptr<const rigc::capi::Rig> rig;
};
struct rigc_program {
  std::shared_ptr<const rigc::capi::Program> program;
};
struct rigc_instance {
  std::shared_ptr<const rigc::capi::Program> program;
  rigc::capi::Instance instance;
};

struct rigc_diagnostics {
  struct Entry {
    int code;
    bool is_error;
    std::string place, message, hint;
  };
  std::vector<Entry> entries;
  std::string text;
};

namespace rigc::capi {

/// Rounding to nearest, no flushing of small numbers to zero, no traps: what law 1 rests on, and
/// what a caller may have changed. As it was when destroyed.
class FloatEnvironment {
 public:
#ifdef __SSE2__
  // Many times as fast as <cfenv>, which also saves what no double goes through.
  FloatEnvironment() : before_(_mm_getcsr()) {
    if ((before_ & ~kRaised) != kDefault) _mm_setcsr(kDefault);
  }
  ~FloatEnvironment() {
    if ((before_ & ~kRaised) != kDefault) _mm_setcsr(before_);
  }

 private:
  static constexpr unsigned kRaised = 0x3f;     // what has happened, not what is to happen
  static constexpr unsigned kDefault = 0x1f80;  // everything masked, to nearest, nothing flushed
  unsigned before_;
#else
  FloatEnvironment() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~FloatEnvironment() { std::fesetenv(&before_); }

 private:
  std::fenv_t before_;
#endif
 public:
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;
};

/// Runs what may throw: nothing leaves it but a status.
template <class Work>
rigc_status guarded(const Work& work) noexcept {
  try {
    const FloatEnvironment defaults;
    return work();
  } catch (const std::bad_alloc&) {
    return RIGC_ERROR_MEMORY;
  } catch (...) {
    return RIGC_ERROR_INTERNAL;
  }
}

/// Fills those members of a caller's struct that the caller knows of.
template <class Info>
rigc_status hand_out(Info info, Info* to) {
  if (!to || to->struct_size < sizeof(std::size_t)) return RIGC_ERROR_ARGUMENT;
  info.struct_size = to->struct_size;
  std::memcpy(to, &info, std::min(to->struct_size, sizeof info));
  return RIGC_OK;
}

/// Options with defaults where the caller knows less, or none; false for an unknown struct_size.
template <class Options>
bool take_in(const Options* from, Options& options) {
  options = Options{};
  if (!from) return true;
  if (from->struct_size < sizeof(std::size_t)) return false;
  std::memcpy(&options, from, std::min(from->struct_size, sizeof options));
  return true;
}

/// What is reported between its begin and its end goes to the caller's diagnostics, if there are.
class Reporting {
 public:
  /// `sources`: what the places of a rig point into.
  explicit Reporting(rigc_diagnostics* to, const Sources& sources = {})
      : diagnostics(sources), to_(to) {
    if (to_) *to_ = {};
  }
  Diagnostics diagnostics;
  void hand_over() const;

 private:
  rigc_diagnostics* to_;
};

}  // namespace rigc::capi
