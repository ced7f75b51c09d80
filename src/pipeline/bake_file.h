// SPDX-License-Identifier: MIT
// Bake a file: clips on controls become clips on joints, as plain glTF. Test:
// tests/pipeline/bake_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/bake.h"
#include "base/diagnostics.h"

namespace rigc::pipeline {

struct BakeRequest {
  std::string file;
  std::vector<std::string> clips;  ///< names or numbers; empty: all
  std::string fps = "30";          ///< a number, or "source"
  std::optional<double> start, end;
  double tolerance_mm =
      0;  ///< key reduction, world space, millimetres of a 1.75 m tall character's scale
  bool keep_rig = false;
};

struct BakedClip {
  std::string name;
  bool passed_through = false;  ///< it had no channels on controls
  bake::Report report;
};

struct Baked {
  std::vector<BakedClip> clips;
  std::uint64_t bytes = 0;
};

std::optional<Baked> bake_file(const BakeRequest& request, const std::string& out,
                               Diagnostics& diagnostics);

}  // namespace rigc::pipeline
