// SPDX-License-Identifier: MIT
// Paths, folders, where rigc's data are, and the small system calls that the file code shares.
// Test: tests/base/paths_test.cpp
#include <dirent.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "base/codes.h"
#include "base/files.h"
#include "base/posix.h"
#include "base/text.h"

namespace rigc {
namespace posix {

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

bool Descriptor::close() {
  // Interrupted or not, the descriptor is closed, and what was flushed stays so.
  return ::close(release()) == 0 || errno == EINTR;
}

Descriptor open(const std::string& path, int flags, mode_t mode) {
  int number = -1;
  do {
    number = ::open(path.c_str(), flags | O_CLOEXEC | O_NOCTTY, mode);
  } while (number < 0 && errno == EINTR);
  return Descriptor(number);
}

std::string text_of_error(int error) {
  const char* text = ::strerrordesc_np(error);
  return text ? text : "error " + std::to_string(error);
}

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a FIFO";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

bool has_nul(const std::string& path) { return path.find('\0') != std::string::npos; }

std::optional<std::string> read_link(const std::string& path) {
  std::string target(PATH_MAX, '\0');
  const ssize_t length = ::readlink(path.c_str(), target.data(), target.size());
  if (length <= 0) return std::nullopt;
  target.resize(static_cast<std::size_t>(length));
  return target;
}

bool is_temporary_name(const std::string& name) {
  return name.starts_with('.') && name.ends_with(".tmp") &&
         name.find(".rigc-") != std::string::npos;
}

}  // namespace posix

namespace {

/// Resolves a path step by step; unlike realpath(), what does not exist yet is allowed.
std::optional<std::string> resolve(const std::string& path) {
  std::string resolved;
  std::vector<std::string> steps;  // still to be taken, the next one last
  const auto push = [&](const std::string& text) {
    const std::vector<std::string_view> parts = split(text, '/');
    for (std::size_t i = parts.size(); i-- > 0;) steps.emplace_back(parts[i]);
  };
  if (path.empty() || posix::has_nul(path) || path.size() > PATH_MAX) return std::nullopt;
  push(path);
  if (path[0] != '/') {
    char* const here = ::getcwd(nullptr, 0);
    if (!here) return std::nullopt;
    push(here);
    ::free(here);
  }
  for (int links = 0; !steps.empty();) {
    const std::string step = std::move(steps.back());
    steps.pop_back();
    if (step.empty() || step == ".") continue;
    if (step == "..") {
      resolved.resize(resolved.empty() ? 0 : resolved.rfind('/'));
      continue;
    }
    const auto target = posix::read_link(resolved + '/' + step);
    if (!target) {
      resolved += '/' + step;
      continue;
    }
    if (++links > 40) return std::nullopt;
    if (target->starts_with('/')) resolved.clear();
    push(*target);
  }
  return resolved.empty() ? "/" : resolved;
}

bool has_templates(const std::string& folder) {
  return folder_exists(join_path(folder, "templates"));
}

}  // namespace

bool file_exists(const std::string& path) {
  struct stat status {};
  return !posix::has_nul(path) && ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

bool folder_exists(const std::string& path) {
  struct stat status {};
  return !posix::has_nul(path) && ::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode);
}

std::vector<std::string> list_folder(const std::string& path) {
  Diagnostics unused;
  return list_folder(path, unused).value_or(std::vector<std::string>());
}

std::optional<std::vector<std::string>> list_folder(const std::string& path,
                                                    Diagnostics& diagnostics) {
  std::vector<std::string> names;
  DIR* const listing = posix::has_nul(path) ? nullptr : ::opendir(path.c_str());
  int error = listing ? 0 : errno;
  while (listing) {
    errno = 0;
    const dirent* entry = ::readdir(listing);
    if (!entry) break;
    std::string name = entry->d_name;
    if (name != "." && name != ".." && !posix::is_temporary_name(name))
      names.push_back(std::move(name));
  }
  if (listing) {
    error = errno;
    ::closedir(listing);
  }
  if (error != 0) {
    diagnostics.report(codes::kCannotRead, path,
                       "cannot list the folder: " + posix::text_of_error(error));
    return std::nullopt;
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::optional<std::string> resolved_path(const std::string& path) { return resolve(path); }

std::optional<std::string> confine(const std::string& folder, const std::string& path) {
  struct stat status {};
  const bool known = !posix::has_nul(folder) && ::stat(folder.c_str(), &status) == 0;
  // What the system refuses to say of a folder it refuses again when the file is opened.
  const bool is_missing = known ? !S_ISDIR(status.st_mode) : errno == ENOENT || errno == ENOTDIR;
  if (path.empty() || is_missing) return std::nullopt;
  const auto inside = resolve(folder);
  const auto resolved = resolve(join_path(folder, path));
  if (!inside || !resolved) return std::nullopt;
  if (*inside == "/" || *resolved == *inside || resolved->starts_with(*inside + '/'))
    return resolved;
  return std::nullopt;
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  const std::size_t end = path.find_last_not_of('/', slash);
  return end == std::string::npos ? "/" : path.substr(0, end + 1);
}

std::string join_path(const std::string& folder, const std::string& name) {
  if (folder.empty() || folder == "." || name.starts_with('/')) return name;
  return folder.ends_with('/') ? folder + name : folder + '/' + name;
}

std::string stem_of(const std::string& path) {
  std::string name = path.substr(path.rfind('/') + 1);
  const std::size_t point = name.rfind('.');
  if (point != std::string::npos && point != 0) name.resize(point);
  return name;
}

std::string executable_folder() {
  const auto path = posix::read_link("/proc/self/exe");
  return path ? folder_of(*path) : std::string();
}

std::string data_folder() {
  // An explicit wish is not second-guessed: what is missing there is reported when it is read.
  if (const char* wish = ::getenv("RIGC_DATA"); wish && *wish) return wish;
  std::string folder = executable_folder();
  if (folder.empty()) return {};
  const std::string installed = join_path(folder_of(folder), "share/rigc");
  if (has_templates(installed)) return installed;
  while (true) {
    if (file_exists(join_path(folder, "templates/biped.yaml"))) return folder;
    if (folder == "/") return {};
    folder = folder_of(folder);
  }
}

}  // namespace rigc
