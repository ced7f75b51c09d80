// SPDX-License-Identifier: MIT
// What a bake did, for people and scripts, and bakes over many files. Test: tests/cli/bake_test.cpp
#pragma once

#include <string>

#include "base/json.h"
#include "pipeline/bake_file.h"
#include "pipeline/batch.h"

namespace rigc::pipeline {

/// One line for each clip.
std::string clips_text(const Baked& baked);

/// An array with an object for each clip.
void write_clips(json::Writer& w, const Baked& baked);

/// The work of a batch: `request` for one file. A file without a rig is skipped.
FileResult bake_work(BakeRequest request, const FileWork& work, Diagnostics& diagnostics);

}  // namespace rigc::pipeline
