// SPDX-License-Identifier: MIT
// Files: only regular ones are read, all are written atomically (temporary file beside the target,
// flushed, renamed, folder flushed). Who reads a file in order to replace it holds its FileLock.
// Test: tests/base/files_test.cpp
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/bytes.h"
#include "base/diagnostics.h"

namespace rigc {

/// Reads a whole regular file of at most `limit` bytes. Folders, devices, FIFOs and symlink loops
/// are errors.
std::optional<std::string> read_file(const std::string& path, std::uint64_t limit,
                                     Diagnostics& diagnostics);

struct WriteSettings {
  /// What was read from the path: if it is no longer exactly that, it is left alone, which is an
  /// error. Null: whatever is there is replaced.
  const FileVersion* expected = nullptr;
  /// Permissions of a file that is new. Without: by the umask.
  std::optional<unsigned> mode;
};

/// Writes pieces as one file, atomically; on failure nothing is left behind and the old file stays.
/// Pieces of files are copied inside the system where it can do that; a file that was changed since
/// it was opened is an error.
/// A symbolic link stays and what it points to is replaced; mode and, if possible, owner stay too.
bool write_file(const std::string& path, const std::vector<Bytes>& pieces, Diagnostics& diagnostics,
                const WriteSettings& settings = {});

/// An exclusive lock (flock) of an existing file, held until destroyed, from before the file is
/// read until after it is written. A path where there is no file yet gives a lock that locks
/// nothing.
class FileLock {
 public:
  /// Waits at most `patience_ms`, then reports that the file is in use. The lock is of the inode
  /// that `path` names when this returns, even if another process replaced the file meanwhile.
  static std::optional<FileLock> take(const std::string& path, Diagnostics& diagnostics,
                                      int patience_ms = 10'000);
  FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileLock& operator=(FileLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

bool file_exists(const std::string& path);
bool folder_exists(const std::string& path);
/// Names (not paths) in a folder, sorted bytewise; temporary files of ours are skipped.
std::vector<std::string> list_folder(const std::string& path);
/// The same for a folder that must be readable.
std::optional<std::vector<std::string>> list_folder(const std::string& path,
                                                    Diagnostics& diagnostics);

/// `path` from the root on, with `..` and symbolic links resolved, whether or not there is such a
/// file: equal ones name the same file. Nothing for a loop of links.
std::optional<std::string> resolved_path(const std::string& path);

/// `path` inside `folder`, with `..`, symbolic links and absolute paths resolved; nothing if it
/// leaves the folder.
std::optional<std::string> confine(const std::string& folder, const std::string& path);

std::string folder_of(const std::string& path);
std::string join_path(const std::string& folder, const std::string& name);
/// The last part of a path without its extension.
std::string stem_of(const std::string& path);

/// Folder of the running executable; empty if unknown.
std::string executable_folder();
/// rigc's data folder: option, environment RIGC_DATA, <exe>/../share/rigc, then beside its build
/// folder (compiled in relative).
std::string data_folder();

}  // namespace rigc
