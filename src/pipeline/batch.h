// SPDX-License-Identifier: MIT
// One work over many files: found below folders, by patterns and in lists, done in parallel,
// reported in the order of the inputs whatever finishes first. Knows nothing of rigs.
// Test: tests/pipeline/batch_test.cpp
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/diagnostics.h"

namespace rigc::pipeline {

/// What a work is to do with one file.
struct FileWork {
  std::string input;
  std::string output;  ///< the input itself where the file is replaced in place
  std::string backup;  ///< where keep_original() puts the input; empty: nowhere
};

struct FileResult {
  enum class Outcome : std::uint8_t { changed, unchanged, failed, skipped };
  Outcome outcome = Outcome::unchanged;
  std::string summary;      ///< one line for people
  std::string json;         ///< an object; its members become part of the report's entry
  std::uint64_t bytes = 0;  ///< size of the output
};

/// Does one file. Called from several threads at once, each call with Diagnostics of its own; a
/// file whose work reports an error has failed, whatever the outcome says.
using Work = std::function<FileResult(const FileWork&, Diagnostics&)>;

/// Copies `original`, the bytes of the work's input as they were read, to its backup, flushed. A
/// work calls this before it replaces the input. A backup that is there already is an error unless
/// it has the same bytes. Does nothing where no backup is wanted.
bool keep_original(const FileWork& work, const Bytes& original, Diagnostics& diagnostics);

}  // namespace rigc::pipeline
