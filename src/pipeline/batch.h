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
#include "base/files.h"
#include "base/threads.h"

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

struct BatchRequest {
  std::string command = "update";  ///< in the report
  /// A JSON object: the options that decide what becomes of a file. --resume wants them unchanged.
  std::string settings = "{}";
  std::vector<std::string> inputs;          ///< FILE, DIR, 'PATTERN', @LIST: see find_inputs()
  std::string output;                       ///< where the only file goes
  std::string out_dir;                      ///< where the files go, mirrored; empty: in place
  std::string backup;                       ///< folder for the originals of files replaced in place
  std::string report;                       ///< a .json file to write at the end
  std::string resume;                       ///< the report of a run to go on with
  bool writes = true;                       ///< false: the work only looks; no folders are made
  bool colour = false;                      ///< of diagnostics
  unsigned jobs = 0;                        ///< files at a time; 0: as many as there are processors
  Threads* threads = nullptr;               ///< instead of `jobs`: those that the work loops with
  const Sources* sources = nullptr;         ///< what spans of all files' diagnostics point into
  const std::atomic<bool>* stop = nullptr;  ///< true: no further file is begun
};

/// How far a batch is.
struct BatchProgress {
  std::size_t done = 0, total = 0;  ///< files, without those that were done before
  std::size_t failed = 0;
};

/// Hears of a batch while it works. Called from any thread, but never twice at a time.
class BatchListener {
 public:
  virtual ~BatchListener() = default;
  virtual void progress(const BatchProgress& progress) = 0;
  /// Diagnostics of one file, rendered. In the order of the inputs.
  virtual void said(const std::string& text) = 0;
};

struct BatchEntry {
  std::string file, output;  ///< as the user gave them
  FileResult::Outcome outcome = FileResult::Outcome::unchanged;
  std::string summary;
  std::string first_error;   ///< empty: none
  std::string json;          ///< the report's entry
  bool done_before = false;  ///< in the run that this one goes on with
  bool refused = false;      ///< by the file system, if it failed
};

struct Batch {
  std::vector<BatchEntry> entries;  ///< in the order of the inputs, without those not begun
  std::size_t remaining = 0;        ///< not begun
  std::string report;               ///< the JSON document (docs/schema/report.schema.json)
  std::size_t count(FileResult::Outcome outcome) const;
  /// 0: all done; 1: a file failed, or the batch was interrupted; 3: files failed, and all of them
  /// because the file system refused.
  int exit_status() const;
};

/// Does `work` for every file of the request. What is wrong with a file is said in its entry and
/// ends nothing. Empty exactly where nothing could be begun; an interruption and a report that
/// cannot be written at the end are errors too.
std::optional<Batch> run_batch(const BatchRequest& request, const Work& work,
                               Diagnostics& diagnostics, BatchListener* listener = nullptr);

/// Counts and failures for people.
std::string batch_table(const Batch& batch);

/// Copies `original`, the bytes of the work's input as they were read, to its backup, flushed. A
/// work calls this before it replaces the input. A backup that is there already is an error unless
/// it has the same bytes. Does nothing where no backup is wanted.
bool keep_original(const FileWork& work, const Bytes& original, Diagnostics& diagnostics);

}  // namespace rigc::pipeline
