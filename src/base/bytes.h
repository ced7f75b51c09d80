// SPDX-License-Identifier: MIT
// Bytes that nobody changes: in memory, or a part of an open file that is read or copied when it is
// needed, so that big files never lie in memory. Test: tests/base/bytes_test.cpp
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/diagnostics.h"

namespace rigc {

/// A regular file held open for reading (base/posix.h).
class OpenFile;

/// Which file it was and when it was last changed: two equal versions are the same bytes.
struct FileVersion {
  std::uint64_t device = 0, inode = 0, size = 0;
  std::int64_t modified = 0;  ///< content, nanoseconds since 1970
  std::int64_t changed = 0;   ///< content, mode, owner or links, nanoseconds since 1970
  unsigned mode = 0;          ///< permissions
  bool operator==(const FileVersion&) const = default;
};

/// Cheap to copy. A file stays open as long as there are bytes of it.
class Bytes {
 public:
  Bytes() = default;
  /// Memory that the caller keeps.
  Bytes(std::string_view memory) : memory_(memory), size_(memory.size()) {}
  Bytes(const std::string& memory) : Bytes(std::string_view(memory)) {}
  Bytes(const char* memory) : Bytes(std::string_view(memory)) {}
  /// Memory that becomes part of the bytes.
  Bytes(std::string&& memory);

  /// All of a regular file with at most `limit` bytes. Folders, devices, FIFOs and symlink loops
  /// are errors.
  static std::optional<Bytes> open(const std::string& path, std::uint64_t limit,
                                   Diagnostics& diagnostics);

  std::uint64_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// `length` bytes from `begin`, or as many of them as there are.
  Bytes part(std::uint64_t begin, std::uint64_t length = UINT64_MAX) const;

  /// Copies `length` bytes from `begin`, which must be there; false where the file cannot be read
  /// or has become shorter, which is reported.
  bool read(std::uint64_t begin, std::size_t length, char* to, Diagnostics& diagnostics) const;
  /// All of them.
  std::optional<std::string> text(Diagnostics& diagnostics) const;

  /// The file that holds the bytes from offset() on; null where memory() does.
  const OpenFile* file() const { return file_.get(); }
  std::uint64_t offset() const { return offset_; }
  std::string_view memory() const { return memory_; }
  /// What the file was when it was opened, also where its bytes are in memory now; null for bytes
  /// that come from no file.
  const FileVersion* version() const { return version_.get(); }

 private:
  std::shared_ptr<const std::string> owned_;
  std::shared_ptr<const OpenFile> file_;
  std::shared_ptr<const FileVersion> version_;
  std::string_view memory_;
  std::uint64_t offset_ = 0;
  std::uint64_t size_ = 0;
};

/// False where they differ, and where one of them cannot be read, which is reported.
bool same_bytes(const Bytes& a, const Bytes& b, Diagnostics& diagnostics);

}  // namespace rigc
