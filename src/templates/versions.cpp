// SPDX-License-Identifier: MIT
// Finds the template files below folders and answers which version of a name is the newest.
// Test: tests/templates/versions_test.cpp
#include "templates/versions.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <tuple>

#include "base/files.h"
#include "base/ids.h"
#include "base/text.h"
#include "templates/codes.h"

namespace rigc::templates {
namespace {

constexpr std::uint64_t kMostBytes = 4u << 20;
constexpr std::size_t kMostFiles = 20'000;
constexpr int kMostDeep = 16;

bool is_path(const std::string& text) {
  return text.find('/') != std::string::npos || ends_with(text, ".yaml") || ends_with(text, ".yml");
}

/// Walks template folders. A folder that several links lead to is visited once.
class Walk {
 public:
  Walk(std::vector<TemplateVersion>& out, Diagnostics& refused) : out_(out), refused_(refused) {}

  void visit(const std::string& folder, std::size_t place, bool part = false, int depth = 0) {
    std::error_code error;
    const std::string path_of_folder = folder.empty() ? "." : folder;
    const auto real = std::filesystem::canonical(path_of_folder, error);
    const bool is_missing =
        error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory;
    if (is_missing || depth > kMostDeep) return;
    if (!error && !visited_.insert(real).second) return;
    const auto names = list_folder(path_of_folder, refused_);
    if (!names) return;
    for (const std::string& name : *names) {
      if (name.starts_with('.') || files_ == kMostFiles) continue;
      const std::string path = join_path(folder, name);
      if (ends_with(name, ".yaml")) {
        ++files_;
        add(path, place, part);
      } else if (name != "maps" && folder_exists(path)) {
        visit(path, place, part || name == "parts", depth + 1);
      }
    }
  }

 private:
  void add(const std::string& path, std::size_t place, bool part) {
    Diagnostics reading;
    const auto text = read_file(path, kMostBytes, reading);
    // Folders, links to nowhere and what is too large are no templates.
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    const bool is_other = status.type() == std::filesystem::file_type::not_found ||
                          (std::filesystem::status_known(status) && !is_regular_file(status));
    if (reading.file_system_refused() && !is_other) refused_.append(reading);
    auto head = text ? scan_head(*text) : std::nullopt;
    if (!head) return;
    out_.push_back({std::move(head->name), head->version, std::move(head->was),
                    hex16(hash64(*text)), path, place, part});
  }

  std::vector<TemplateVersion>& out_;
  Diagnostics& refused_;
  std::set<std::filesystem::path> visited_;
  std::size_t files_ = 0;
};

auto order(const TemplateVersion& file) {
  return std::tuple(std::string_view(file.name), file.part, -file.version, file.place,
                    std::string_view(file.path));
}

/// NAME and, after an @, VERSION.
std::pair<std::string_view, std::optional<int>> name_and_version(std::string_view text) {
  const std::size_t at = text.rfind('@');
  if (at == std::string_view::npos) return {text, std::nullopt};
  const auto version = parse_integer(text.substr(at + 1));
  const bool fits = version && *version > 0 && *version <= 1'000'000'000;
  return {text.substr(0, at), fits ? static_cast<int>(*version) : 0};
}

}  // namespace

Versions::Versions(const std::vector<std::string>& folders) {
  Walk walk(all_, refused_);
  for (std::size_t i = 0; i < folders.size(); ++i) walk.visit(folders[i], i);
  std::sort(all_.begin(), all_.end(),
            [](const TemplateVersion& a, const TemplateVersion& b) { return order(a) < order(b); });
}

Versions::Run Versions::run_of(std::string_view name) const {
  const auto first = std::partition_point(
      all_.begin(), all_.end(), [&](const TemplateVersion& file) { return file.name < name; });
  const auto last = std::partition_point(
      first, all_.end(), [&](const TemplateVersion& file) { return file.name == name; });
  return {static_cast<std::size_t>(first - all_.begin()),
          static_cast<std::size_t>(last - all_.begin())};
}

const TemplateVersion* Versions::newest(std::string_view name) const {
  const Run run = run_of(name);
  return run.first == run.last ? nullptr : &all_[run.first];
}

const TemplateVersion* Versions::find(std::string_view name, int version) const {
  const Run run = run_of(name);
  for (std::size_t i = run.first; i < run.last; ++i)
    if (all_[i].version == version) return &all_[i];
  return nullptr;
}

std::vector<const TemplateVersion*> Versions::forks(std::string_view name) const {
  std::vector<const TemplateVersion*> found;
  for (const TemplateVersion& file : all_) {
    const bool keeps = std::find(file.was.begin(), file.was.end(), name) != file.was.end();
    if (keeps && file.name != name && newest(file.name) == &file) found.push_back(&file);
  }
  return found;
}

std::optional<std::string> Versions::resolve(const std::string& wanted,
                                             Diagnostics& diagnostics) const {
  if (is_path(wanted)) return wanted;
  const auto [name, version] = name_and_version(wanted);
  const TemplateVersion* found = version ? find(name, *version) : newest(name);
  if (found) return found->path;
  std::vector<std::string> known;
  const Run run = run_of(name);
  for (std::size_t i = run.first; i < run.last; ++i)
    known.push_back(fmt::format("{}@{}", name, all_[i].version));
  for (const TemplateVersion& file : all_)
    if (run.first == run.last && (known.empty() || known.back() != file.name))
      known.push_back(file.name);
  diagnostics.report(codes::kUnknownTemplate, Place(),
                     fmt::format("there is no template \"{}\"", printable(wanted, 100)),
                     suggest(wanted, known));
  return std::nullopt;
}

bool Versions::check_readable(Diagnostics& diagnostics) const {
  diagnostics.append(refused_);
  return refused_.ok();
}

void Versions::report_twins(Diagnostics& diagnostics) const {
  for (std::size_t i = 1; i < all_.size(); ++i) {
    const TemplateVersion &a = all_[i - 1], &b = all_[i];
    const bool same = a.name == b.name && a.version == b.version && a.part == b.part &&
                      a.place == b.place && !a.part;
    if (!same || a.digest == b.digest) continue;
    diagnostics.report(codes::kVersionTwice, Place(b.path),
                       fmt::format("{} says that it is {} version {} too, with other content",
                                   printable(a.path, 200), a.name, a.version),
                       "raise the version of one, or give it another name");
  }
}

}  // namespace rigc::templates
