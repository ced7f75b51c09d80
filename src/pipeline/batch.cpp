// SPDX-License-Identifier: MIT
// Works over many files in parallel. Test: tests/pipeline/batch_test.cpp
#include "pipeline/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <new>
#include <system_error>

#include "base/codes.h"
#include "base/files.h"
#include "base/text.h"
#include "base/trace.h"
#include "pipeline/batch_codes.h"
#include "pipeline/batch_inputs.h"
#include "pipeline/batch_report.h"

namespace rigc::pipeline {
namespace {

using Outcome = FileResult::Outcome;

constexpr std::size_t kMostFailuresShown = 20;

void refuse(std::string message, std::string hint, Diagnostics& diagnostics) {
  diagnostics.report(codes::kBadOptions, Place(), std::move(message), std::move(hint));
}

bool check_options(const BatchRequest& request, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errors();
  if (!request.report.empty() && !ends_with(request.report, ".json"))
    refuse(fmt::format("\"{}\" does not end in .json", printable(request.report)),
           "--report names the file that the report goes into", diagnostics);
  if (!request.output.empty() && !request.out_dir.empty())
    refuse("-o and --out-dir both say where the output goes", "", diagnostics);
  if (!request.backup.empty() && !(request.output.empty() && request.out_dir.empty()))
    refuse("--backup is for files that are replaced in place",
           "with --out-dir or -o the originals stay where they are", diagnostics);
  return diagnostics.errors() == before;
}

std::string output_of(const BatchRequest& request, const BatchInput& input) {
  if (!request.output.empty()) return request.output;
  return request.out_dir.empty() ? input.path : join_path(request.out_dir, input.below);
}

/// No output or backup may be that of another file, and none but a file's own output an input.
class Places {
 public:
  Places(const std::vector<BatchInput>& inputs, Diagnostics& diagnostics)
      : diagnostics_(diagnostics) {
    for (const BatchInput& input : inputs) taken_.emplace(key(input.path), input.path);
  }

  void take(const std::string& path, const std::string& input) {
    const auto [at, is_new] = taken_.emplace(key(path), input);
    if (is_new) return;
    diagnostics_.report(codes::kSameOutput, path,
                        fmt::format("\"{}\" is to be written for \"{}\", but is taken by \"{}\"",
                                    printable(path), printable(input), printable(at->second)),
                        "without --out-dir files are replaced in place");
  }

 private:
  static std::string key(const std::string& path) { return resolved_path(path).value_or(path); }
  std::map<std::string, std::string> taken_;  ///< resolved path to the input that it belongs to
  Diagnostics& diagnostics_;
};

std::optional<std::vector<FileWork>> plan_works(const BatchRequest& request,
                                                Diagnostics& diagnostics) {
  const auto inputs = find_inputs(request.inputs, {request.out_dir, request.backup}, diagnostics);
  if (!inputs) return std::nullopt;
  if (!request.output.empty() && inputs->size() > 1) {
    refuse(fmt::format("-o names one output for {} files", inputs->size()),
           "--out-dir takes a folder", diagnostics);
    return std::nullopt;
  }
  const std::size_t before = diagnostics.errors();
  Places places(*inputs, diagnostics);
  std::vector<FileWork> works;
  for (const BatchInput& input : *inputs) {
    FileWork& work = works.emplace_back();
    work.input = input.path;
    work.output = output_of(request, input);
    if (!request.out_dir.empty()) places.take(work.output, input.path);
    if (request.backup.empty()) continue;
    work.backup = join_path(request.backup, input.below);
    places.take(work.backup, input.path);
  }
  if (diagnostics.errors() != before) return std::nullopt;
  return works;
}

bool make_folder_of(const std::string& path, Diagnostics& diagnostics) {
  std::error_code error;
  std::filesystem::create_directories(folder_of(path), error);
  if (!error) return true;
  diagnostics.report(rigc::codes::kCannotWrite, folder_of(path),
                     "cannot create the folder: " + error.message());
  return false;
}

/// Gives what is done to the listener and the batch, in the order of the inputs.
class Collector {
 public:
  Collector(std::size_t total, BatchListener* listener) : slots_(total), listener_(listener) {
    progress_.total = total;
    if (listener_) listener_->progress(progress_);
  }

  void add(std::size_t index, BatchEntry entry, std::string said) {
    const std::lock_guard lock(mutex_);
    ++progress_.done;
    progress_.failed += entry.outcome == Outcome::failed ? 1 : 0;
    slots_[index] = Slot{std::move(entry), std::move(said)};
    for (; next_ < slots_.size() && slots_[next_]; ++next_) say(*slots_[next_]);
    if (listener_) listener_->progress(progress_);
  }

  /// Once all threads are done: the entries, empty where a work was not begun.
  std::vector<std::optional<BatchEntry>> take() {
    for (; next_ < slots_.size(); ++next_)
      if (slots_[next_]) say(*slots_[next_]);
    std::vector<std::optional<BatchEntry>> entries(slots_.size());
    for (std::size_t i = 0; i < slots_.size(); ++i)
      if (slots_[i]) entries[i] = std::move(slots_[i]->entry);
    return entries;
  }

 private:
  struct Slot {
    BatchEntry entry;
    std::string said;
  };

  void say(Slot& slot) {
    if (listener_ && !slot.said.empty()) listener_->said(slot.said);
    slot.said = {};
  }

  std::mutex mutex_;
  std::vector<std::optional<Slot>> slots_;
  std::size_t next_ = 0;  ///< the first that has not been said
  BatchProgress progress_;
  BatchListener* listener_;
};

/// Does the work for each file, over threads.
class Runner {
 public:
  Runner(const BatchRequest& request, const Work& work, const std::vector<FileWork>& works,
         const Sources& sources, Collector& collector)
      : request_(request), work_(work), works_(works), sources_(sources), collector_(collector) {}

  void run() {
    Threads own(request_.threads ? 1 : request_.jobs);
    Threads& threads = request_.threads ? *request_.threads : own;
    threads.for_each(works_.size(), [this](std::size_t index) {
      if (!stopped()) run_one(index);
    });
  }

 private:
  bool stopped() const { return request_.stop && request_.stop->load(); }

  void run_one(std::size_t index) {
    Diagnostics diagnostics(sources_);
    const FileResult result = result_of(works_[index], diagnostics);
    collector_.add(index, make_entry(works_[index], result, diagnostics),
                   render(diagnostics, request_.colour));
  }

  FileResult result_of(const FileWork& work, Diagnostics& diagnostics) {
    const trace::Span span("file", trace::kFile, "file", work.input);
    const bool mirrors = request_.writes && !request_.out_dir.empty();
    if (mirrors && !make_folder_of(work.output, diagnostics)) return {};
    try {
      return work_(work, diagnostics);
    } catch (const std::bad_alloc&) {
      // One file that is too much must not end the others.
      diagnostics.report(codes::kOutOfMemory, work.input, "there is not enough memory");
      return {};
    }
  }

  const BatchRequest& request_;
  const Work& work_;
  const std::vector<FileWork>& works_;
  const Sources& sources_;
  Collector& collector_;
};

/// The batch as it is when the entries of `works` are known as far as given.
Batch gather(const std::vector<FileWork>& all, const DoneBefore& before,
             std::vector<std::optional<BatchEntry>> entries) {
  Batch batch;
  std::size_t next = 0;
  for (const FileWork& work : all) {
    const auto done = before.find(work.input);
    if (done != before.end()) {
      batch.entries.push_back(done->second);
      continue;
    }
    const std::size_t index = next++;
    if (index < entries.size() && entries[index])
      batch.entries.push_back(*std::move(entries[index]));
    else
      ++batch.remaining;
  }
  return batch;
}

/// Leaves in `before` what this run would do again, and returns the works that are left to do.
std::vector<FileWork> works_to_do(const std::vector<FileWork>& all, DoneBefore& before) {
  std::vector<FileWork> works;
  for (const FileWork& work : all) {
    const auto done = before.find(work.input);
    if (done != before.end() && done->second.output == work.output) continue;
    if (done != before.end()) before.erase(done);
    works.push_back(work);
  }
  return works;
}

bool write_report(const BatchRequest& request, Batch& batch, Diagnostics& diagnostics) {
  batch.report = report_document(request, batch);
  return request.report.empty() || write_file(request.report, {batch.report}, diagnostics);
}

}  // namespace

std::size_t Batch::count(Outcome outcome) const {
  return static_cast<std::size_t>(
      std::count_if(entries.begin(), entries.end(),
                    [&](const BatchEntry& entry) { return entry.outcome == outcome; }));
}

int Batch::exit_status() const {
  const std::size_t failed = count(Outcome::failed);
  if (remaining != 0) return 1;
  if (failed == 0) return 0;
  const bool all_refused = std::all_of(entries.begin(), entries.end(), [](const BatchEntry& entry) {
    return entry.outcome != Outcome::failed || entry.refused;
  });
  return all_refused ? 3 : 1;
}

std::optional<Batch> run_batch(const BatchRequest& request, const Work& work,
                               Diagnostics& diagnostics, BatchListener* listener) {
  if (!check_options(request, diagnostics)) return std::nullopt;
  const auto all = plan_works(request, diagnostics);
  if (!all) return std::nullopt;
  auto before = read_report(request, diagnostics);
  if (!before) return std::nullopt;
  const std::vector<FileWork> works = works_to_do(*all, *before);
  // A report that cannot be written is said before the work, and one is there if rigc is killed.
  Batch batch = gather(*all, *before, {});
  if (!write_report(request, batch, diagnostics)) return std::nullopt;
  const Sources& sources = request.sources ? *request.sources : diagnostics.sources();
  Collector collector(works.size(), listener);
  Runner(request, work, works, sources, collector).run();
  batch = gather(*all, *before, collector.take());
  if (batch.remaining != 0)
    diagnostics.report(
        codes::kInterrupted, Place(),
        fmt::format("interrupted: {} of {} files were not begun", batch.remaining, all->size()),
        request.report.empty() ? "" : "--resume with the report goes on");
  write_report(request, batch, diagnostics);
  return batch;
}

std::string batch_table(const Batch& batch) {
  std::string text;
  std::size_t shown = 0;
  const std::size_t failed = batch.count(Outcome::failed);
  for (const BatchEntry& entry : batch.entries) {
    if (entry.outcome != Outcome::failed || ++shown > kMostFailuresShown) continue;
    text += fmt::format("  failed: {}: {}\n", printable(entry.file), printable(entry.first_error));
  }
  if (failed > kMostFailuresShown)
    text += fmt::format("  and {} more\n", failed - kMostFailuresShown);
  for (Outcome outcome : {Outcome::changed, Outcome::unchanged, Outcome::failed, Outcome::skipped})
    text += fmt::format("{:>10} {}\n", batch.count(outcome), outcome_word(outcome));
  if (batch.remaining != 0) text += fmt::format("{:>10} not begun\n", batch.remaining);
  return text;
}

bool keep_original(const FileWork& work, const Bytes& original, Diagnostics& diagnostics) {
  if (work.backup.empty()) return true;
  if (!make_folder_of(work.backup, diagnostics)) return false;
  if (file_exists(work.backup)) {
    const auto there = Bytes::open(work.backup, UINT64_MAX, diagnostics);
    if (!there) return false;
    const std::size_t before = diagnostics.errors();
    if (same_bytes(*there, original, diagnostics)) return true;
    if (diagnostics.errors() == before)
      diagnostics.report(
          rigc::codes::kBackupDiffers, work.backup,
          fmt::format("the backup of \"{}\" would overwrite another file", printable(work.input)));
    return false;
  }
  WriteSettings settings;
  if (original.version()) settings.mode = original.version()->mode;
  return write_file(work.backup, {original}, diagnostics, settings);
}

}  // namespace rigc::pipeline
