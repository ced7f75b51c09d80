// SPDX-License-Identifier: MIT
// Finds templates by path, name or a part's reference and reads each file once.
// Test: tests/templates/library_test.cpp
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "catalog/catalogue.h"
#include "templates/template.h"

namespace rigc::templates {

/// Folders of templates, in the order in which they are searched: those given, RIGC_TEMPLATES (a
/// list with colons), the data folder's `templates`.
std::vector<std::string> template_folders(const std::vector<std::string>& given);

/// The file of a part, by the same rule as Library::open_part: beside the template that names it,
/// then in the template folders, never outside of them.
std::optional<std::string> part_file(const std::string& reference, const std::string& folder,
                                     const std::vector<std::string>& folders);

/// One library serves one Diagnostics: the spans of what it read point into its sources.
class Library {
 public:
  Library(std::vector<std::string> folders, const catalog::Catalogue& catalogue)
      : folders_(std::move(folders)), catalogue_(catalogue) {}

  /// A path to a file, or a name that is looked for in the folders. The result lives as long as the
  /// library.
  const Template* open(const std::string& path_or_name, Diagnostics& diagnostics);

  /// A part: relative to the folder of `outer`, then in the folders; never outside of them.
  const Template* open_part(const Part& part, const Template& outer, Diagnostics& diagnostics);

  /// The file of a template with this name in the folders, if there is one.
  std::optional<std::string> find(const std::string& name) const;

  const std::vector<std::string>& folders() const { return folders_; }

 private:
  const Template* read_once(const std::string& path, const std::string& shown_path,
                            const std::string& reference, Diagnostics& diagnostics);

  std::vector<std::string> folders_;
  const catalog::Catalogue& catalogue_;
  std::map<std::string, std::unique_ptr<Template>>
      read_;  ///< by path; null: it had errors, which were reported then
};

}  // namespace rigc::templates
