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

bool same_time(const timespec& a, const timespec& b) {
  return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

}  // namespace

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
                    same_time(now.st_mtim, status_.st_mtim);
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
  bytes.file_ = std::move(file);
  if (bytes.size_ > kSmall) return bytes;
  auto text = bytes.text(diagnostics);
  if (!text) return std::nullopt;
  return Bytes(*std::move(text));
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

}  // namespace rigc
