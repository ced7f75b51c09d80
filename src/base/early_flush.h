// SPDX-License-Identifier: MIT
// Sends a big file to the disk while it is still being written, so that the flush at its end has
// little to wait for. Test: tests/base/bytes_test.cpp
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace rigc {

/// Works in a thread of its own until it is destroyed. It only hints: nothing depends on it.
class EarlyFlush {
 public:
  /// Does nothing for a file that will be small. The descriptor stays open as long as this.
  EarlyFlush(int descriptor, std::uint64_t final_size);
  EarlyFlush(const EarlyFlush&) = delete;
  EarlyFlush& operator=(const EarlyFlush&) = delete;
  ~EarlyFlush();
  /// So many bytes more have been written.
  void wrote(std::uint64_t count);

 private:
  void run();

  int descriptor_;
  std::uint64_t written_ = 0;
  bool ends_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread thread_;
};

}  // namespace rigc
