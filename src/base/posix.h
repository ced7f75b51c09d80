// SPDX-License-Identifier: MIT
// What files.cpp, bytes.cpp, write_file.cpp and paths.cpp share; nobody else includes it.
// Test: tests/base/files_test.cpp
#pragma once

#include <sys/stat.h>
#include <sys/types.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "base/bytes.h"
#include "base/diagnostics.h"

namespace rigc::posix {

/// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor();
  int get() const { return number_; }
  int release() { return std::exchange(number_, -1); }
  /// Closes now and says whether the system agreed: some report a failed write only here.
  bool close();
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_;
};

/// open() with O_CLOEXEC and O_NOCTTY, again after signals.
Descriptor open(const std::string& path, int flags, mode_t mode = 0);

/// Opens an existing regular file for reading; empty if that failed, which is reported.
Descriptor open_regular(const std::string& path, struct stat& status, Diagnostics& diagnostics);

FileVersion version_of(const struct stat& status);

/// What the system says about an error number, in English whatever the locale.
std::string text_of_error(int error);

/// "a folder", "a FIFO", "a socket", "a device".
const char* kind_of(mode_t mode);

bool has_nul(const std::string& path);

/// Where a symbolic link points; nothing if `path` is none.
std::optional<std::string> read_link(const std::string& path);

/// Whether a file name is one of the temporary names that write_file uses.
bool is_temporary_name(const std::string& name);

}  // namespace rigc::posix

namespace rigc {

/// A regular file held open for reading. Others may write to it meanwhile: what is read is what was
/// there at opening only if check_unchanged() says so afterwards.
class OpenFile {
 public:
  static std::shared_ptr<const OpenFile> open(const std::string& path, Diagnostics& diagnostics);
  int descriptor() const { return descriptor_.get(); }
  std::uint64_t size() const { return static_cast<std::uint64_t>(status_.st_size); }
  FileVersion version() const { return posix::version_of(status_); }
  bool read(std::uint64_t offset, std::size_t length, char* to, Diagnostics& diagnostics) const;
  /// Size and time of the last change are those of the opening; else that is reported.
  bool check_unchanged(Diagnostics& diagnostics) const;
  void report_change(Diagnostics& diagnostics) const;

 private:
  posix::Descriptor descriptor_;
  std::string path_;
  struct stat status_ {};
};

}  // namespace rigc
