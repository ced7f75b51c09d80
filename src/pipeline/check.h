// SPDX-License-Identifier: MIT
// Check: every diagnostic of templates, maps, module descriptors, rig files and models, nothing
// written but pins where they are asked for. Test: tests/pipeline/check_test.cpp
#pragma once

#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "pipeline/environment.h"

namespace rigc::pipeline {

struct CheckRequest {
  std::vector<std::string> paths_to_check;  ///< files, folders, names of templates
  bool pin = false;  ///< writes `modules:` pins into templates without errors
  Paths paths;
};

/// One file with what was found in it.
struct CheckedFile {
  std::string file;
  std::string kind;                ///< template, map, module, rig, model
  std::vector<std::string> facts;  ///< for people: what it is
  std::vector<std::string> pins;   ///< `module: version` that were written
  std::size_t errors = 0, warnings = 0;
  std::size_t first = 0, last = 0;  ///< its diagnostics in Diagnostics::all()
};

/// In the order given; a folder stands for the files in and below it that are rigc's or glTF,
/// sorted by path.
std::vector<CheckedFile> check(const CheckRequest& request, Diagnostics& diagnostics);

/// One file; whether it has no errors.
bool check(const std::string& file, const Paths& paths, Diagnostics& diagnostics);

/// The result as text for people and as one JSON document.
std::string check_text(const std::vector<CheckedFile>& files);
std::string check_json(const std::vector<CheckedFile>& files, const Diagnostics& diagnostics);

}  // namespace rigc::pipeline
