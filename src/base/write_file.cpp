// SPDX-License-Identifier: MIT
// Replaces a file atomically: whatever happens, its name stands for the old content or the new.
// Test: tests/base/write_file_test.cpp
#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>

#include "base/codes.h"
#include "base/early_flush.h"
#include "base/files.h"
#include "base/ids.h"
#include "base/posix.h"
#include "base/trace.h"

namespace rigc {
namespace {

constexpr std::size_t kMostPerWrite = std::size_t{1} << 30;
constexpr std::uint64_t kBlock = std::uint64_t{1} << 18;
constexpr std::uint64_t kSmall = std::uint64_t{1} << 15;
constexpr std::uint64_t kMostPerCopy = std::uint64_t{1} << 22;
constexpr time_t kStaleSeconds = 600;

std::atomic<unsigned> temporary_counter{0};

/// What is to be replaced.
struct Target {
  std::string path;  ///< with the symbolic links at its end followed
  bool exists = false;
  struct stat status {};
};

/// A temporary file beside its target, removed again unless it became the target.
class Temporary {
 public:
  explicit Temporary(const std::string& target);
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  posix::Descriptor& file() { return file_; }
  /// Gives the file the target's name.
  bool become(const std::string& target) {
    if (::rename(path_.c_str(), target.c_str()) != 0) return false;
    path_.clear();
    return true;
  }

 private:
  std::string path_;
  posix::Descriptor file_;
};

std::string file_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

std::string temporary_prefix(const std::string& target) {
  std::string name = file_name(target);
  // A file name has at most 255 bytes; this one needs some for itself.
  if (name.size() > 180) name = name.substr(0, 150) + '-' + hex16(hash64(name));
  return '.' + name + ".rigc-";
}

Temporary::Temporary(const std::string& target) {
  const std::string prefix = join_path(folder_of(target), temporary_prefix(target));
  for (int i = 0; i < 100; ++i) {
    std::string path = fmt::format("{}{}-{}.tmp", prefix, ::getpid(), temporary_counter++);
    file_ = posix::open(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, 0666);
    if (file_) {
      // The lock tells others that this file is not a leftover.
      ::flock(file_.get(), LOCK_EX | LOCK_NB);
      path_ = std::move(path);
    }
    if (file_ || errno != EEXIST) return;
  }
}

/// Removes what killed processes left beside the target: our names, old, and locked by nobody.
void remove_leftovers(const std::string& target, time_t now) {
  const std::string folder = folder_of(target), prefix = temporary_prefix(target);
  DIR* const listing = ::opendir(folder.c_str());
  if (!listing) return;
  while (const dirent* entry = ::readdir(listing)) {
    const std::string name = entry->d_name;
    if (!name.starts_with(prefix) || !posix::is_temporary_name(name)) continue;
    const std::string path = join_path(folder, name);
    const posix::Descriptor file = posix::open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
    struct stat status {};
    if (!file || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
    if (status.st_mtime + kStaleSeconds > now) continue;
    if (::flock(file.get(), LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
  }
  ::closedir(listing);
}

bool refuse(const std::string& path, const char* step, int error, Diagnostics& diagnostics) {
  diagnostics.report(codes::kCannotWrite, path,
                     fmt::format("cannot {}: {}", step, posix::text_of_error(error)));
  return false;
}

/// Follows links by hand, because the last one may point to what does not exist yet.
bool find_target(const std::string& path, Target& target, Diagnostics& diagnostics) {
  if (path.empty() || path.back() == '/' || posix::has_nul(path)) {
    diagnostics.report(codes::kCannotWrite, path, "this is no path of a file");
    return false;
  }
  target.path = path;
  for (int links = 0; const auto next = posix::read_link(target.path); ++links) {
    if (links == 40) return refuse(path, "write", ELOOP, diagnostics);
    target.path = join_path(folder_of(target.path), *next);
  }
  if (::lstat(target.path.c_str(), &target.status) == 0)
    target.exists = true;
  else if (errno != ENOENT)
    return refuse(path, "write", errno, diagnostics);
  return true;
}

bool check_target(const std::string& path, const Target& target, Diagnostics& diagnostics) {
  const std::string folder = folder_of(target.path);
  if (!folder_exists(folder)) {
    diagnostics.report(codes::kNoSuchFolder, path, fmt::format("there is no folder \"{}\"", folder),
                       "create the folder first");
    return false;
  }
  if (!target.exists) return true;
  if (!S_ISREG(target.status.st_mode)) {
    diagnostics.report(
        codes::kNotRegularFile, path,
        fmt::format("this is {}, which is not replaced", posix::kind_of(target.status.st_mode)));
    return false;
  }
  if (::access(target.path.c_str(), W_OK) != 0) {
    diagnostics.report(codes::kWriteProtected, path, "the file to be replaced is read-only");
    return false;
  }
  if (target.status.st_nlink > 1)
    diagnostics.report(codes::kHardLink, path,
                       fmt::format("the file has {} more hard links, which keep the old content",
                                   target.status.st_nlink - 1));
  return true;
}

bool write_all(int descriptor, std::string_view piece) {
  while (!piece.empty()) {
    const ssize_t done =
        ::write(descriptor, piece.data(), std::min<std::size_t>(piece.size(), kMostPerWrite));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) return false;
    piece.remove_prefix(static_cast<std::size_t>(done));
  }
  return true;
}

/// Writes pieces one after another; where that fails, it is reported.
class Appender {
 public:
  Appender(int to, std::uint64_t size, const std::string& path, Diagnostics& diagnostics)
      : to_(to), early_(to, size), path_(path), diagnostics_(diagnostics) {}

  bool add(const Bytes& piece) {
    if (piece.file()) return flush() && copy(piece);
    if (piece.size() >= kSmall) return flush() && write(piece.memory());
    // A changed document is thousands of small pieces.
    small_ += piece.memory();
    return small_.size() < kBlock || flush();
  }

  /// What was kept back until there is enough of it.
  bool flush() {
    const bool done = write(small_);
    small_.clear();
    return done;
  }

 private:
  bool write(std::string_view text) {
    if (!write_all(to_, text)) return refuse(path_, "write", errno, diagnostics_);
    early_.wrote(text.size());
    return true;
  }

  bool copy(const Bytes& piece) {
    std::uint64_t done = 0;
    while (done < piece.size()) {
      auto from = static_cast<off_t>(piece.offset() + done);
      const ssize_t copied = ::copy_file_range(piece.file()->descriptor(), &from, to_, nullptr,
                                               std::min(piece.size() - done, kMostPerCopy), 0);
      if (copied < 0 && errno == EINTR) continue;
      if (copied <= 0) break;  // not between these file systems, or the end: reading tells which
      done += static_cast<std::uint64_t>(copied);
      early_.wrote(static_cast<std::uint64_t>(copied));
    }
    std::string block;
    for (; done < piece.size(); done += block.size()) {
      block.resize(std::min(piece.size() - done, kBlock));
      if (!piece.read(done, block.size(), block.data(), diagnostics_) || !write(block))
        return false;
    }
    return true;
  }

  int to_;
  EarlyFlush early_;
  std::string small_;
  const std::string& path_;
  Diagnostics& diagnostics_;
};

bool append_all(const std::vector<Bytes>& pieces, int to, const std::string& path,
                Diagnostics& diagnostics) {
  std::uint64_t size = 0;
  for (const Bytes& piece : pieces) size += piece.size();
  Appender appender(to, size, path, diagnostics);
  return std::all_of(pieces.begin(), pieces.end(),
                     [&](const Bytes& piece) { return appender.add(piece); }) &&
         appender.flush();
}

bool flush(int descriptor) {
  const trace::Span span("flush");
  while (::fsync(descriptor) != 0) {
    // Some file systems cannot flush folders; there is nothing to be done about it.
    if (errno == EINVAL || errno == ENOTSUP || errno == ENOSYS) return true;
    if (errno != EINTR) return false;
  }
  return true;
}

/// Whether the target is what was read, also if the links on the way to it changed meanwhile.
bool is_expected(const std::string& path, const Target& target, const FileVersion& expected) {
  struct stat named {
  }, replaced{};
  return ::stat(path.c_str(), &named) == 0 && ::lstat(target.path.c_str(), &replaced) == 0 &&
         posix::version_of(named) == expected && posix::version_of(replaced) == expected;
}

bool refuse_other(const std::string& path, Diagnostics& diagnostics) {
  diagnostics.report(codes::kFileReplaced, path,
                     file_exists(path)
                         ? "the file was changed after it was read; it is not replaced"
                         : "the file has vanished after it was read");
  return false;
}

/// Gives the new file the owner (where that is allowed) and the mode of the one that it replaces.
bool copy_mode(int descriptor, const struct stat& status) {
  const bool is_owner_kept = ::fchown(descriptor, status.st_uid, status.st_gid) == 0;
  const mode_t mode = status.st_mode & (is_owner_kept ? 07777 : 0777);
  return ::fchmod(descriptor, mode) == 0;
}

bool set_mode(int descriptor, const Target& target, std::optional<unsigned> mode_if_new) {
  if (target.exists) return copy_mode(descriptor, target.status);
  return !mode_if_new || ::fchmod(descriptor, *mode_if_new & 0777) == 0;
}

}  // namespace

bool write_file(const std::string& path, const std::vector<Bytes>& pieces, Diagnostics& diagnostics,
                const WriteSettings& settings) {
  Target target;
  if (!find_target(path, target, diagnostics)) return false;
  if (!check_target(path, target, diagnostics)) return false;
  const FileVersion* const expected = settings.expected;
  if (expected && !is_expected(path, target, *expected)) return refuse_other(path, diagnostics);
  // Opened before anything changes: after the rename only the flush itself may still fail.
  const posix::Descriptor folder = posix::open(folder_of(target.path), O_RDONLY | O_DIRECTORY);
  Temporary temporary(target.path);
  posix::Descriptor& file = temporary.file();
  if (!file) return refuse(path, "create a file in its folder", errno, diagnostics);
  if (!append_all(pieces, file.get(), path, diagnostics)) return false;
  if (!set_mode(file.get(), target, settings.mode))
    return refuse(path, "set the mode", errno, diagnostics);
  struct stat written {};
  if (!flush(file.get()) || ::fstat(file.get(), &written) != 0)
    return refuse(path, "flush", errno, diagnostics);
  if (!file.close()) return refuse(path, "close", errno, diagnostics);
  for (const Bytes& piece : pieces)
    if (piece.file() && !piece.file()->check_unchanged(diagnostics)) return false;
  if (expected && !is_expected(path, target, *expected)) return refuse_other(path, diagnostics);
  if (!temporary.become(target.path)) return refuse(path, "rename", errno, diagnostics);
  remove_leftovers(target.path, written.st_mtime);
  if (folder && !flush(folder.get()))
    return refuse(path, "flush the folder (the file itself is written)", errno, diagnostics);
  return true;
}

}  // namespace rigc
