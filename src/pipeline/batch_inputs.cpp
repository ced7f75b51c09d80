// SPDX-License-Identifier: MIT
// Finds the files of a batch. Test: tests/pipeline/batch_inputs_test.cpp
#include "pipeline/batch_inputs.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/files.h"
#include "base/text.h"
#include "base/trace.h"
#include "pipeline/batch_codes.h"

namespace rigc::pipeline {
namespace {

constexpr std::uint64_t kLargestList = std::uint64_t{1} << 26;

bool is_searched(const std::string& name) {
  return ends_with(name, ".glb") || ends_with(name, ".gltf") || ends_with(name, ".vrm");
}

bool is_hidden(std::string_view name) { return starts_with(name, "."); }

bool has_wildcard(std::string_view text) {
  return text.find_first_of("*?[") != std::string_view::npos;
}

std::string name_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

std::string below(const std::string& place, const std::string& name) {
  return place.empty() ? name : join_path(place, name);
}

bool is_link(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_symlink(path, ignored);
}

/// A pattern cut at its slashes, behind the folder that it begins in.
struct Pattern {
  std::string folder;
  std::vector<std::string> parts;
};

Pattern parse_pattern(const std::string& text) {
  Pattern pattern;
  bool begun = false;
  for (std::string_view part : split(text, '/')) {
    begun = begun || has_wildcard(part);
    if (!begun) {
      pattern.folder += std::string(part) + '/';
      continue;
    }
    const bool repeats = part == "**" && !pattern.parts.empty() && pattern.parts.back() == "**";
    if (!part.empty() && !repeats) pattern.parts.emplace_back(part);
  }
  if (pattern.folder.size() > 1) pattern.folder.pop_back();
  if (pattern.folder.empty()) pattern.folder = ".";
  return pattern;
}

class Finder {
 public:
  Finder(const std::vector<std::string>& left_out, Diagnostics& diagnostics)
      : diagnostics_(diagnostics) {
    for (const std::string& folder : left_out)
      if (const auto path = resolved_path(folder)) left_out_.insert(*path);
  }

  void add_argument(const std::string& argument) {
    const std::size_t before = seen_, errors = diagnostics_.errors();
    if (starts_with(argument, "@"))
      add_list(argument.substr(1));
    else if (folder_exists(argument))
      search_folder(argument, {});
    else if (!file_exists(argument) && has_wildcard(argument))
      match(parse_pattern(argument));
    else
      add(argument, name_of(argument));
    if (seen_ == before && diagnostics_.errors() == errors)
      diagnostics_.report(codes::kNoInputs, argument, "there are no files here to work on");
  }

  std::vector<BatchInput> take() { return std::move(found_); }

 private:
  void add(const std::string& path, const std::string& place) {
    ++seen_;
    const auto resolved = resolved_path(path);
    if (!resolved || files_.insert(*resolved).second) found_.push_back({path, place});
  }

  void search_folder(const std::string& folder, const std::string& place) {
    folders_.clear();
    search(folder, place);
  }

  void search(const std::string& folder, const std::string& place) {
    const auto resolved = resolved_path(folder);
    // A link may lead back to a folder above it.
    if (!resolved || left_out_.count(*resolved) || !folders_.insert(*resolved).second) return;
    const auto names = list_folder(folder, diagnostics_);
    if (!names) return;
    for (const std::string& name : *names) {
      if (is_hidden(name)) continue;
      const std::string path = join_path(folder, name);
      if (folder_exists(path))
        search(path, below(place, name));
      else if (is_searched(name))
        add(path, below(place, name));
    }
  }

  void match(const Pattern& pattern) {
    folders_.clear();
    match(pattern, 0, pattern.folder, {});
  }

  void match(const Pattern& pattern, std::size_t index, const std::string& folder,
             const std::string& place) {
    const std::string& part = pattern.parts[index];
    const bool last = index + 1 == pattern.parts.size();
    const bool any_folders = part == "**";
    if (any_folders && last) return search(folder, place);
    if (!folder_exists(folder)) return;
    if (any_folders) match(pattern, index + 1, folder, place);
    const auto names = list_folder(folder, diagnostics_);
    if (!names) return;
    for (const std::string& name : *names) {
      const std::string path = join_path(folder, name);
      const bool is_folder = folder_exists(path);
      if (any_folders) {
        const bool enters = is_folder && !is_hidden(name) && !is_link(path) && !is_left_out(path);
        if (enters) match(pattern, index, path, below(place, name));
        continue;
      }
      if (::fnmatch(part.c_str(), name.c_str(), FNM_PERIOD) != 0) continue;
      if (is_folder && !is_left_out(path))
        last ? search(path, below(place, name))
             : match(pattern, index + 1, path, below(place, name));
      else if (last && !is_folder && is_searched(name))
        add(path, below(place, name));
    }
  }

  bool is_left_out(const std::string& folder) const {
    const auto resolved = resolved_path(folder);
    return !resolved || left_out_.count(*resolved) != 0;
  }

  void add_list(const std::string& list) {
    const auto text = read_file(list, kLargestList, diagnostics_);
    if (!text) return;
    for (std::string_view line : split(*text, '\n')) {
      const std::string entry(trim(line));
      if (entry.empty() || starts_with(entry, "#")) continue;
      const bool absolute = starts_with(entry, "/");
      const std::string path = absolute ? entry : join_path(folder_of(list), entry);
      if (folder_exists(path))
        search_folder(path, place_of(entry));
      else
        add(path, place_of(entry));
    }
  }

  /// Where an entry of a list is mirrored: as it is written, unless that would leave the folder.
  static std::string place_of(const std::string& entry) {
    const std::string normal = std::filesystem::path(entry).lexically_normal().string();
    const bool leaves = starts_with(normal, "/") || normal == ".." || starts_with(normal, "../");
    if (leaves) return name_of(entry);
    return normal == "." ? std::string() : normal;
  }

  Diagnostics& diagnostics_;
  std::vector<BatchInput> found_;
  std::size_t seen_ = 0;
  std::set<std::string> files_;     ///< resolved paths of found_
  std::set<std::string> folders_;   ///< resolved paths of those that this argument has searched
  std::set<std::string> left_out_;  ///< resolved
};

}  // namespace

std::optional<std::vector<BatchInput>> find_inputs(const std::vector<std::string>& arguments,
                                                   const std::vector<std::string>& left_out,
                                                   Diagnostics& diagnostics) {
  const trace::Span span("find files");
  const std::size_t errors = diagnostics.errors();
  Finder finder(left_out, diagnostics);
  for (const std::string& argument : arguments) finder.add_argument(argument);
  if (diagnostics.errors() != errors) return std::nullopt;
  return finder.take();
}

}  // namespace rigc::pipeline
