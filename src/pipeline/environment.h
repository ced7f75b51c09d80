// SPDX-License-Identifier: MIT
// Where modules and templates come from in this run. Test: tests/pipeline/build_test.cpp
#pragma once

#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "catalog/catalogue.h"

namespace rigc::pipeline {

struct Paths {
  std::vector<std::string> templates;  ///< --templates, before RIGC_TEMPLATES and the data folder
  std::vector<std::string> modules;    ///< --modules, before RIGC_MODULES
};

/// The built-in modules and those of the folders; false where a folder or descriptor has errors.
bool add_modules(const Paths& paths, catalog::Catalogue& catalogue, Diagnostics& diagnostics);

}  // namespace rigc::pipeline
