// SPDX-License-Identifier: MIT
// Reads regular files, and locks them.
// Test: tests/base/files_test.cpp
#include "base/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "base/codes.h"
#include "base/posix.h"

namespace rigc {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 16;

void report_special(const std::string& path, mode_t mode, Diagnostics& diagnostics) {
  diagnostics.report(codes::kNotRegularFile, path,
                     fmt::format("this is {}, not a file", posix::kind_of(mode)));
}

/// Reads until the end or until there is more than `limit`; false if the system refused.
bool read_all(int descriptor, std::uint64_t limit, std::string& text) {
  std::size_t used = 0;
  while (used <= limit) {
    if (used == text.size()) text.resize(used + std::max(used / 2, kPiece));
    const ssize_t got = ::read(descriptor, text.data() + used, text.size() - used);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return false;
    if (got == 0) break;
    used += static_cast<std::size_t>(got);
  }
  text.resize(used);
  return true;
}

}  // namespace

posix::Descriptor posix::open_regular(const std::string& path, struct stat& status,
                                      Diagnostics& diagnostics) {
  if (path.empty() || posix::has_nul(path)) {
    diagnostics.report(codes::kCannotRead, path, "this is no path of a file");
    return posix::Descriptor();
  }
  posix::Descriptor file = posix::open(path, O_RDONLY | O_NONBLOCK);
  if (!file || ::fstat(file.get(), &status) != 0) {
    const int error = errno;
    // Opening a socket or a device without a driver fails before it can be looked at.
    if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
      report_special(path, status.st_mode, diagnostics);
    else
      diagnostics.report(codes::kCannotRead, path, "cannot read: " + posix::text_of_error(error));
    return posix::Descriptor();
  }
  if (S_ISREG(status.st_mode)) return file;
  report_special(path, status.st_mode, diagnostics);
  return posix::Descriptor();
}

std::optional<std::string> read_file(const std::string& path, std::uint64_t limit,
                                     Diagnostics& diagnostics) {
  struct stat status {};
  const posix::Descriptor file = posix::open_regular(path, status, diagnostics);
  if (!file) return std::nullopt;
  const auto size = static_cast<std::uint64_t>(status.st_size);
  std::string text;
  // The size at opening is a hint only: the file may grow or shrink, and /proc says 0.
  if (size <= limit) {
    text.resize(size + 1);
    if (!read_all(file.get(), limit, text)) {
      diagnostics.report(codes::kCannotRead, path, "cannot read: " + posix::text_of_error(errno));
      return std::nullopt;
    }
  }
  if (size > limit || text.size() > limit) {
    diagnostics.report(codes::kFileTooLarge, path,
                       fmt::format("the file has {} bytes, more than {}",
                                   std::max<std::uint64_t>(size, text.size()), limit));
    return std::nullopt;
  }
  return text;
}

std::optional<FileLock> FileLock::take(const std::string& path, Diagnostics& diagnostics,
                                       int patience_ms) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::milliseconds(patience_ms);
  while (true) {
    struct stat locked {
    }, now{};
    if (!posix::has_nul(path) && ::stat(path.c_str(), &now) != 0 && errno == ENOENT)
      return FileLock(-1);
    posix::Descriptor file = posix::open_regular(path, locked, diagnostics);
    if (!file) return std::nullopt;
    if (::flock(file.get(), LOCK_EX | LOCK_NB) == 0) {
      const bool is_same = ::stat(path.c_str(), &now) == 0 && now.st_ino == locked.st_ino &&
                           now.st_dev == locked.st_dev;
      if (is_same) return FileLock(file.release());
    } else if (errno != EWOULDBLOCK && errno != EINTR) {
      // A file system without locks: replacing is atomic all the same.
      return FileLock(-1);
    }
    if (Clock::now() >= end) {
      diagnostics.report(codes::kFileLocked, path, "another rigc is working on this file");
      return std::nullopt;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace rigc
