// SPDX-License-Identifier: MIT
// Names of templates, maps and modules. Test: tests/cli/completions_test.cpp
#include "pipeline/names.h"

#include <algorithm>

#include "base/files.h"
#include "base/text.h"
#include "templates/library.h"

namespace rigc::pipeline {

std::vector<std::string> names(const std::string& kind, const Paths& paths,
                               Diagnostics& diagnostics) {
  if (kind == "modules") {
    catalog::Catalogue catalogue;
    add_modules(paths, catalogue, diagnostics);
    return catalogue.modules();
  }
  std::vector<std::string> found;
  for (const std::string& folder : templates::template_folders(paths.templates))
    for (const std::string& file : list_folder(kind == "maps" ? join_path(folder, "maps") : folder))
      if (ends_with(file, ".yaml")) found.push_back(stem_of(file));
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace rigc::pipeline
