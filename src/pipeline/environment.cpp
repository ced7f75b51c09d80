// SPDX-License-Identifier: MIT
// Where modules come from. Test: tests/pipeline/build_test.cpp
#include "pipeline/environment.h"

#include <cstdlib>

#include "base/text.h"

namespace rigc::pipeline {

bool add_modules(const Paths& paths, catalog::Catalogue& catalogue, Diagnostics& diagnostics) {
  std::vector<std::string> folders = paths.modules;
  if (const char* listed = std::getenv("RIGC_MODULES")) {
    for (std::string_view folder : split(listed, ':')) {
      if (!folder.empty()) folders.emplace_back(folder);
    }
  }
  bool good = true;
  for (const std::string& folder : folders)
    good = catalogue.add_folder(folder, diagnostics) && good;
  return good;
}

}  // namespace rigc::pipeline
