// SPDX-License-Identifier: MIT
// Bake a file: clips on controls become clips on joints, as plain glTF. Test:
// tests/pipeline/bake_test.cpp
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/bake.h"
#include "base/diagnostics.h"
#include "base/threads.h"

namespace rigc::pipeline {

struct BakeRequest {
  std::string file;
  std::vector<std::string> clips;  ///< names or numbers; empty: all
  std::string fps = "30";          ///< a number, or "source"
  std::optional<double> start, end;
  double tolerance_mm =
      0;  ///< key reduction, world space, millimetres of a 1.75 m tall character's scale
  bool keep_rig = false;
  bool skip_without_rig = false;  ///< a file without a rig is no error; nothing is written
  Threads* threads = nullptr;     ///< for clips and frames; null: the caller's thread alone
};

struct BakedClip {
  std::string name;
  bool passed_through = true;  ///< it had no channels on controls
  std::size_t frames = 0, channels = 0, keys = 0;
  /// Largest distance in millimetres (of a 1.75 m tall character's scale) by which a joint, or a
  /// point at the length of its limb from it, plays off because of key reduction.
  double reduction_mm = 0;
  /// Where translation, rotation and scale cannot say what the rig does.
  struct {
    double relative = 0;  ///< largest entry that is lost of a matrix, in sizes of the joint
    double mm = 0;        ///< how far points at the length of the limb are off
    std::string joint;    ///< that is off farthest, and when
    double seconds = 0;
  } shear;
};

struct Baked {
  bool has_rig = false;
  std::vector<BakedClip> clips;
  std::uint64_t bytes = 0;
};

std::optional<Baked> bake_file(const BakeRequest& request, const std::string& out,
                               Diagnostics& diagnostics);

}  // namespace rigc::pipeline
