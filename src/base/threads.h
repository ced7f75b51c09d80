// SPDX-License-Identifier: MIT
// Works on the items of a list over several threads: files, clips, ranges of frames.
// Test: tests/base/threads_test.cpp
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace rigc {

/// So many threads and no more, however deep the loops are nested: where the clips of a file have
/// all been taken, threads that are free help with the frames of the last.
class Threads {
 public:
  /// `jobs`: threads that work at a time, the caller's among them; 0: one for each processor.
  explicit Threads(unsigned jobs = 0);
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

  /// Calls `work(index)` once for every index below `count`, in their order, and returns when all
  /// are done. Calls run at the same time, so what one writes must be its own. An exception ends
  /// the loop: that of the lowest index is thrown here. `work` may loop itself.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& work);

  unsigned jobs() const { return jobs_; }

 private:
  class Loop;
  bool take_spare();

  unsigned jobs_;
  std::atomic<unsigned> spare_;  ///< threads that may be begun
};

}  // namespace rigc
