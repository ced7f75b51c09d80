// SPDX-License-Identifier: MIT
// Which templates there are: every template file of the template folders by its identity (`name:`)
// and version, from the heads of the files alone. Test: tests/templates/versions_test.cpp
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"

namespace rigc::templates {

/// What the head of a template says.
struct Head {
  std::string name;
  int version = 0;
  std::vector<std::string> was;  ///< templates whose uids it keeps, oldest first
};

/// The head of a template's text, as the reader would read it; nothing where the text is no
/// template. What usual templates have is found line by line, everything else by the YAML reader.
std::optional<Head> scan_head(std::string_view text);

/// The references of a template's text to parts, in order, without reading the rest of it where it
/// is written as people write it; perhaps also words that are none.
std::vector<std::string> scan_parts(std::string_view text);

/// One template file.
struct TemplateVersion {
  std::string name;
  int version = 0;
  std::vector<std::string> was;
  std::string digest;     ///< of the text, as Template::digest
  std::string path;       ///< folder as it was given, and the file in it
  std::size_t place = 0;  ///< of its template folder in the list
  bool part = false;      ///< lies in a folder `parts`: nobody updates to it
};

/// The template files of folders and the folders in them (but `maps`), found once when made. Files
/// that are no templates, or too large for one, are left out. Threads may share it.
class Versions {
 public:
  /// `folders` in the order in which they are searched: of two files with one name and version the
  /// earlier folder's counts.
  explicit Versions(const std::vector<std::string>& folders);

  /// The highest version of a name; parts only where there is nothing else. Null: none.
  const TemplateVersion* newest(std::string_view name) const;
  /// Null: none.
  const TemplateVersion* find(std::string_view name, int version) const;
  /// The newest version of each other template that says `was:` of this name, sorted by name.
  std::vector<const TemplateVersion*> forks(std::string_view name) const;

  /// The file that somebody asked for by its path, as NAME (the newest) or as NAME@VERSION; nothing
  /// was reported. Whether a path leads to a template shows when it is read.
  std::optional<std::string> resolve(const std::string& wanted, Diagnostics& diagnostics) const;

  /// Warns of files in one folder that claim to be the same version of a name and differ: which of
  /// them counts is chance.
  void report_twins(Diagnostics& diagnostics) const;

  /// False, and reported, where the system refused to list a folder or to read a file that is
  /// there: the newest version may be among them.
  bool check_readable(Diagnostics& diagnostics) const;

  /// Sorted by name, then parts last, newest first, then in the order of the folders and paths.
  const std::vector<TemplateVersion>& all() const& { return all_; }
  void all() && = delete;

 private:
  struct Run {
    std::size_t first, last;
  };
  Run run_of(std::string_view name) const;

  std::vector<TemplateVersion> all_;
  Diagnostics refused_;
};

}  // namespace rigc::templates
