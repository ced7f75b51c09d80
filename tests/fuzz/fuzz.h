// SPDX-License-Identifier: MIT
// What the fuzz targets share. A target takes any bytes and must neither crash nor break a promise;
// tools/fuzz runs one for people, .ci/run all of them. Kept inputs: tests/fuzz/seeds.
#pragma once

#include <cstdio>
#include <cstdlib>

#include "base/diagnostics.h"

namespace rigc::fuzz {

/// A promise that does not hold is a crash, so that libFuzzer keeps the input.
inline void expect(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

/// Watches one stage: its result is empty exactly when it reported an error.
class Stage {
 public:
  explicit Stage(const Diagnostics& diagnostics)
      : diagnostics_(diagnostics), errors_(diagnostics.errors()) {}
  /// Whether there is a result, to go on with.
  bool ended(bool has_result, const char* name) const {
    const bool reported = diagnostics_.errors() != errors_;
    if (has_result == reported)
      std::fprintf(stderr, "%s\n", render(diagnostics_, false, 5).c_str());
    expect(has_result != reported, name);
    return has_result;
  }

 private:
  const Diagnostics& diagnostics_;
  std::size_t errors_;
};

}  // namespace rigc::fuzz
