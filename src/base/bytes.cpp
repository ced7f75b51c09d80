// SPDX-License-Identifier: MIT
// Bytes in memory or in an open file.
// Test: tests/base/bytes_test.cpp
#include "base/bytes.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>

#include "base/codes.h"
#include "base/posix.h"

namespace rigc {
namespace {

/// Up to here a file is read at once: many small reads would take longer, and a model may name more
/// small files than can be open at a time.
constexpr std::uint64_t kSmall = std::uint64_t{1} << 16;
constexpr std::uint64_t kCompared = std::uint64_t{1} << 20;

std::int64_t nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

}  // namespace

FileVersion posix::version_of(const struct stat& status) {
  FileVersion version;
  version.device = status.st_dev;
  version.inode = status.st_ino;
  version.size = static_cast<std::uint64_t>(status.st_size);
  version.modified = nanoseconds(status.st_mtim);
  version.changed = nanoseconds(status.st_ctim);
  version.mode = status.st_mode & 07777;
  return version;
}

std::shared_ptr<const OpenFile> OpenFile::open(const std::string& path, Diagnostics& diagnostics) {
  auto file = std::make_shared<OpenFile>();
  file->path_ = path;
  file->descriptor_ = posix::open_regular(path, file->status_, diagnostics);
  return file->descriptor_ ? file : nullptr;
}

bool OpenFile::read(std::uint64_t offset, std::size_t length, char* to,
                    Diagnostics& diagnostics) const {
  while (length > 0) {
    const ssize_t got = ::pread(descriptor_.get(), to, length, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      diagnostics.report(codes::kCannotRead, path_, "cannot read: " + posix::text_of_error(errno));
      return false;
    }
    if (got == 0) return report_change(diagnostics), false;
    const auto done = static_cast<std::size_t>(got);
    offset += done;
    to += done;
    length -= done;
  }
  return true;
}

bool OpenFile::check_unchanged(Diagnostics& diagnostics) const {
  struct stat now {};
  const bool same = ::fstat(descriptor_.get(), &now) == 0 && now.st_size == status_.st_size &&
                    nanoseconds(now.st_mtim) == nanoseconds(status_.st_mtim);
  if (!same) report_change(diagnostics);
  return same;
}

void OpenFile::report_change(Diagnostics& diagnostics) const {
  diagnostics.report(codes::kFileChanged, path_, "the file was changed while it was being read",
                     "try again when nobody else writes to it");
}

Bytes::Bytes(std::string&& memory)
    : owned_(std::make_shared<const std::string>(std::move(memory))),
      memory_(*owned_),
      size_(owned_->size()) {}

std::optional<Bytes> Bytes::open(const std::string& path, std::uint64_t limit,
                                 Diagnostics& diagnostics) {
  auto file = OpenFile::open(path, diagnostics);
  if (!file) return std::nullopt;
  if (file->size() > limit) {
    diagnostics.report(codes::kFileTooLarge, path,
                       fmt::format("the file has {} bytes, more than {}", file->size(), limit));
    return std::nullopt;
  }
  Bytes bytes;
  bytes.size_ = file->size();
  bytes.version_ = std::make_shared<const FileVersion>(file->version());
  bytes.file_ = std::move(file);
  if (bytes.size_ > kSmall) return bytes;
  auto text = bytes.text(diagnostics);
  if (!text) return std::nullopt;
  Bytes small(*std::move(text));
  small.version_ = std::move(bytes.version_);
  return small;
}

Bytes Bytes::part(std::uint64_t begin, std::uint64_t length) const {
  Bytes result = *this;
  begin = std::min(begin, size_);
  result.size_ = std::min(length, size_ - begin);
  if (file_)
    result.offset_ += begin;
  else
    result.memory_ = memory_.substr(begin, result.size_);
  return result;
}

bool Bytes::read(std::uint64_t begin, std::size_t length, char* to,
                 Diagnostics& diagnostics) const {
  assert(begin <= size_ && length <= size_ - begin);
  if (file_) return file_->read(offset_ + begin, length, to, diagnostics);
  if (length != 0) std::memcpy(to, memory_.data() + begin, length);
  return true;
}

std::optional<std::string> Bytes::text(Diagnostics& diagnostics) const {
  std::string text(size_, '\0');
  if (!read(0, text.size(), text.data(), diagnostics)) return std::nullopt;
  return text;
}

bool same_bytes(const Bytes& a, const Bytes& b, Diagnostics& diagnostics) {
  if (a.size() != b.size()) return false;
  for (std::uint64_t at = 0; at < a.size(); at += kCompared) {
    const auto left = a.part(at, kCompared).text(diagnostics);
    const auto right = b.part(at, kCompared).text(diagnostics);
    if (!left || left != right) return false;
  }
  return true;
}

}  // namespace rigc
