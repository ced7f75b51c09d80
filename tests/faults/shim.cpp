// SPDX-License-Identifier: MIT
// Preloaded into a program under test: counts the calls of the file layer that concern one folder,
// and makes one of them fail, kills the process there, or has another program do something first.
//   RIGC_FAULT_FOLDER  calls for it and paths below it count, and for files opened by such paths
//   RIGC_FAULT_LOG     file that each counted call is appended to: its name and its path
//   RIGC_FAULT_AT      number of the call, from 1
//   RIGC_FAULT_KIND    an errno; `short`: half of what was asked for; `kill`; `remove`: the file
//                      RIGC_FAULT_FILE goes; `put`: it gets other bytes; `swap`: RIGC_FAULT_FROM is
//                      renamed to it
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

const char* setting(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

constexpr std::size_t kMostDescriptors = 4096;
constexpr std::size_t kMostPath = 512;

std::atomic<int> counter{0};
/// Paths of the descriptors that count, empty for others.
std::array<std::array<char, kMostPath>, kMostDescriptors> opened{};

bool concerns(const char* path) {
  const char* folder = setting("RIGC_FAULT_FOLDER");
  const std::size_t length = std::strlen(folder);
  if (!path || length == 0 || std::strncmp(path, folder, length) != 0) return false;
  return path[length] == '/' || path[length] == '\0';
}

const char* path_of(int descriptor) {
  const bool known = descriptor >= 0 && static_cast<std::size_t>(descriptor) < kMostDescriptors;
  return known ? opened[static_cast<std::size_t>(descriptor)].data() : "";
}

void remember(int descriptor, const char* path) {
  if (descriptor < 0 || static_cast<std::size_t>(descriptor) >= kMostDescriptors) return;
  std::snprintf(opened[static_cast<std::size_t>(descriptor)].data(), kMostPath, "%s", path);
}

void log_call(const char* call, const char* path) {
  const char* file = setting("RIGC_FAULT_LOG");
  if (!*file) return;
  const int descriptor =
      real<int(const char*, int, ...)>("open")(file, O_WRONLY | O_CREAT | O_APPEND, 0600);
  char line[kMostPath + 64];
  const int length = std::snprintf(line, sizeof line, "%s %s\n", call, path);
  real<ssize_t(int, const void*, std::size_t)>("write")(descriptor, line,
                                                        static_cast<std::size_t>(length));
  real<int(int)>("close")(descriptor);
}

/// What the other program does.
void disturb(const char* kind) {
  const char* file = setting("RIGC_FAULT_FILE");
  if (std::strcmp(kind, "remove") == 0) real<int(const char*)>("unlink")(file);
  if (std::strcmp(kind, "swap") == 0)
    real<int(const char*, const char*)>("rename")(setting("RIGC_FAULT_FROM"), file);
  if (std::strcmp(kind, "put") != 0) return;
  constexpr char kTheirs[] = "theirs";
  const int descriptor = real<int(const char*, int, ...)>("open")(file, O_WRONLY | O_TRUNC);
  real<ssize_t(int, const void*, std::size_t)>("write")(descriptor, kTheirs, sizeof kTheirs - 1);
  real<int(int)>("close")(descriptor);
}

enum class Verdict { pass, fail, halve };

/// Counts a call; where it is the one, says what becomes of it, with errno set.
Verdict judge(const char* call, const char* path) {
  if (!path || !*path) return Verdict::pass;
  log_call(call, path);
  if (++counter != std::atoi(setting("RIGC_FAULT_AT"))) return Verdict::pass;
  const char* kind = setting("RIGC_FAULT_KIND");
  if (std::strcmp(kind, "kill") == 0) ::kill(::getpid(), SIGKILL);
  if (std::strcmp(kind, "short") == 0) return Verdict::halve;
  disturb(kind);
  errno = std::atoi(kind);
  return errno != 0 ? Verdict::fail : Verdict::pass;
}

Verdict judge_path(const char* call, const char* path) {
  return concerns(path) ? judge(call, path) : Verdict::pass;
}

int open_as(const char* name, const char* path, int flags, mode_t mode) {
  if (judge_path("open", path) == Verdict::fail) return -1;
  const int descriptor = real<int(const char*, int, ...)>(name)(path, flags, mode);
  remember(descriptor, concerns(path) ? path : "");
  return descriptor;
}

/// A call that moves bytes: `length` of them at most.
template <class Call>
ssize_t transfer(const char* name, int descriptor, std::size_t length, Call call) {
  const Verdict verdict = judge(name, path_of(descriptor));
  if (verdict == Verdict::fail) return -1;
  return call(verdict == Verdict::halve && length > 1 ? length / 2 : length);
}

}  // namespace

#pragma GCC visibility push(default)
extern "C" {

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return open_as("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return open_as("open64", path, flags, mode);
}

DIR* opendir(const char* path) {
  if (judge_path("opendir", path) == Verdict::fail) return nullptr;
  return real<DIR*(const char*)>("opendir")(path);
}

ssize_t read(int descriptor, void* to, std::size_t length) {
  return transfer("read", descriptor, length, [&](std::size_t count) {
    return real<ssize_t(int, void*, std::size_t)>("read")(descriptor, to, count);
  });
}

ssize_t pread(int descriptor, void* to, std::size_t length, off_t offset) {
  return transfer("pread", descriptor, length, [&](std::size_t count) {
    return real<ssize_t(int, void*, std::size_t, off_t)>("pread")(descriptor, to, count, offset);
  });
}

ssize_t pread64(int descriptor, void* to, std::size_t length, off_t offset) {
  return pread(descriptor, to, length, offset);
}

ssize_t write(int descriptor, const void* from, std::size_t length) {
  return transfer("write", descriptor, length, [&](std::size_t count) {
    return real<ssize_t(int, const void*, std::size_t)>("write")(descriptor, from, count);
  });
}

ssize_t copy_file_range(int from, off_t* from_offset, int to, off_t* to_offset, std::size_t length,
                        unsigned flags) {
  return transfer("copy_file_range", to, length, [&](std::size_t count) {
    return real<ssize_t(int, off_t*, int, off_t*, std::size_t, unsigned)>("copy_file_range")(
        from, from_offset, to, to_offset, count, flags);
  });
}

int fsync(int descriptor) {
  if (judge("fsync", path_of(descriptor)) == Verdict::fail) return -1;
  return real<int(int)>("fsync")(descriptor);
}

int close(int descriptor) {
  const bool fails = judge("close", path_of(descriptor)) == Verdict::fail;
  const int error = errno;
  remember(descriptor, "");
  const int result = real<int(int)>("close")(descriptor);
  if (!fails) return result;
  errno = error;
  return -1;
}

int fstat(int descriptor, struct stat* status) {
  if (judge("fstat", path_of(descriptor)) == Verdict::fail) return -1;
  return real<int(int, struct stat*)>("fstat")(descriptor, status);
}

int fchmod(int descriptor, mode_t mode) {
  if (judge("fchmod", path_of(descriptor)) == Verdict::fail) return -1;
  return real<int(int, mode_t)>("fchmod")(descriptor, mode);
}

int fchown(int descriptor, uid_t user, gid_t group) {
  if (judge("fchown", path_of(descriptor)) == Verdict::fail) return -1;
  return real<int(int, uid_t, gid_t)>("fchown")(descriptor, user, group);
}

int flock(int descriptor, int operation) {
  if (judge("flock", path_of(descriptor)) == Verdict::fail) return -1;
  return real<int(int, int)>("flock")(descriptor, operation);
}

int stat(const char* path, struct stat* status) {
  if (judge_path("stat", path) == Verdict::fail) return -1;
  return real<int(const char*, struct stat*)>("stat")(path, status);
}

int lstat(const char* path, struct stat* status) {
  if (judge_path("lstat", path) == Verdict::fail) return -1;
  return real<int(const char*, struct stat*)>("lstat")(path, status);
}

int access(const char* path, int mode) {
  if (judge_path("access", path) == Verdict::fail) return -1;
  return real<int(const char*, int)>("access")(path, mode);
}

int rename(const char* from, const char* to) {
  if (judge_path("rename", from) == Verdict::fail) return -1;
  return real<int(const char*, const char*)>("rename")(from, to);
}

int unlink(const char* path) {
  if (judge_path("unlink", path) == Verdict::fail) return -1;
  return real<int(const char*)>("unlink")(path);
}

int mkdir(const char* path, mode_t mode) {
  if (judge_path("mkdir", path) == Verdict::fail) return -1;
  return real<int(const char*, mode_t)>("mkdir")(path, mode);
}

}  // extern "C"
#pragma GCC visibility pop
