// SPDX-License-Identifier: MIT
// Begins to write to the disk what is written to a file. Test: tests/base/bytes_test.cpp
#include "base/early_flush.h"

#include <fcntl.h>

#include <system_error>

namespace rigc {
namespace {

constexpr std::uint64_t kBig = std::uint64_t{1} << 25;
constexpr std::uint64_t kStep = std::uint64_t{1} << 23;

}  // namespace

EarlyFlush::EarlyFlush(int descriptor, std::uint64_t final_size) : descriptor_(descriptor) {
  if (final_size < kBig) return;
  try {
    thread_ = std::thread([this] { run(); });
  } catch (const std::system_error&) {
    // No thread to be had: the flush at the end takes longer.
  }
}

EarlyFlush::~EarlyFlush() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void EarlyFlush::wrote(std::uint64_t count) {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    written_ += count;
  }
  changed_.notify_one();
}

void EarlyFlush::run() {
  std::uint64_t begun = 0;
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return ends_ || written_ - begun >= kStep; });
    if (ends_) return;
    const std::uint64_t end = written_;
    lock.unlock();
    ::sync_file_range(descriptor_, static_cast<off_t>(begun), static_cast<off_t>(end - begun),
                      SYNC_FILE_RANGE_WRITE);
    begun = end;
    lock.lock();
  }
}

}  // namespace rigc
