// SPDX-License-Identifier: MIT
// Reports of batches. Test: tests/pipeline/batch_test.cpp
#include "pipeline/batch_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "base/json.h"
#include "base/text.h"
#include "pipeline/batch_codes.h"

namespace rigc::pipeline {
namespace {

using Outcome = FileResult::Outcome;

constexpr int kVersion = 1;
/// Of one file, of a severity: a damaged file can have thousands.
constexpr std::size_t kMostListed = 100;
constexpr std::pair<Outcome, const char*> kWords[] = {{Outcome::changed, "changed"},
                                                      {Outcome::unchanged, "unchanged"},
                                                      {Outcome::failed, "failed"},
                                                      {Outcome::skipped, "skipped"}};

void write_diagnostics(json::Writer& w, Severity severity, const Diagnostics& diagnostics) {
  std::size_t listed = 0;
  w.begin_array();
  for (const Diagnostic& one : diagnostics.all()) {
    if (one.code->severity != severity || ++listed > kMostListed) continue;
    w.begin_object()
        .member("code", fmt::format("RIG{:04}", one.code->number))
        .member("message", one.message)
        .member("place", describe(one.place, diagnostics.sources()))
        .end_object();
  }
  w.end_array();
}

std::string first_error(const Diagnostics& diagnostics) {
  for (const Diagnostic& one : diagnostics.all())
    if (one.code->severity == Severity::error)
      return fmt::format("RIG{:04} {}", one.code->number, one.message);
  return {};
}

/// The members of an object's text, without its braces.
std::string_view members_of(std::string_view object) {
  if (object.empty()) return {};
  assert(object.front() == '{' && object.back() == '}');
  return trim(object.substr(1, object.size() - 2));
}

std::optional<Outcome> outcome_of(const json::Value& entry) {
  const auto word = entry["outcome"].string();
  for (const auto& [outcome, name] : kWords)
    if (word == name) return outcome;
  return std::nullopt;
}

void refuse(const BatchRequest& request, std::string why, Diagnostics& diagnostics) {
  diagnostics.report(codes::kNotThatReport, request.resume, std::move(why),
                     "leave --resume out to begin anew: files that are done are found unchanged");
}

bool is_of_this_work(const BatchRequest& request, const json::Value& root,
                     Diagnostics& diagnostics) {
  if (root["rigc_report"].integer() != kVersion || !root["files"].is_array()) {
    refuse(request, "this is no report of rigc", diagnostics);
    return false;
  }
  const auto command = root["command"].string();
  const json::Value settings = root["settings"];
  const bool same_settings = settings && settings.text() == request.settings;
  if (command == request.command && same_settings) return true;
  refuse(request,
         command == request.command ? "the report is of a run with other options"
                                    : "the report is of another command",
         diagnostics);
  return false;
}

}  // namespace

const char* outcome_word(Outcome outcome) {
  for (const auto& [known, word] : kWords)
    if (known == outcome) return word;
  return "";
}

BatchEntry make_entry(const FileWork& work, const FileResult& result,
                      const Diagnostics& diagnostics) {
  BatchEntry entry;
  entry.file = work.input;
  entry.output = work.output;
  entry.outcome = diagnostics.ok() ? result.outcome : Outcome::failed;
  entry.summary = result.summary;
  entry.first_error = first_error(diagnostics);
  entry.refused = diagnostics.file_system_refused();
  json::Writer w;
  w.begin_object()
      .member("file", work.input)
      .member("output", work.output)
      .member("outcome", outcome_word(entry.outcome))
      .key("bytes")
      .integer(static_cast<std::int64_t>(result.bytes))
      .key("errors");
  write_diagnostics(w, Severity::error, diagnostics);
  w.key("warnings");
  write_diagnostics(w, Severity::warning, diagnostics);
  w.end_object();
  entry.json = w.take();
  if (const auto members = members_of(result.json); !members.empty()) {
    entry.json.pop_back();
    entry.json += fmt::format(",{}}}", members);
  }
  return entry;
}

std::string report_document(const BatchRequest& request, const Batch& batch) {
  json::Writer w(2);
  w.begin_object()
      .member("rigc_report", kVersion)
      .member("command", request.command)
      .key("settings")
      .raw(request.settings)
      .key("files")
      .begin_array();
  for (const BatchEntry& entry : batch.entries) w.raw(entry.json);
  w.end_array().key("totals").begin_object();
  w.member("files", batch.entries.size() + batch.remaining);
  for (const auto& [outcome, word] : kWords) w.member(word, batch.count(outcome));
  w.member("remaining", batch.remaining).end_object();
  w.member("interrupted", batch.remaining != 0).end_object();
  return w.take() + "\n";
}

std::optional<DoneBefore> read_report(const BatchRequest& request, Diagnostics& diagnostics) {
  DoneBefore done;
  if (request.resume.empty()) return done;
  auto text = read_file(request.resume, json::kMostBytes, diagnostics);
  if (!text) return std::nullopt;
  const auto document = json::parse(*std::move(text), request.resume, 0, diagnostics);
  if (!document || !is_of_this_work(request, document->root(), diagnostics)) return std::nullopt;
  for (const json::Value& value : document->root()["files"].items()) {
    const auto file = value["file"].string(), output = value["output"].string();
    const auto outcome = outcome_of(value);
    const bool is_done = outcome == Outcome::changed || outcome == Outcome::unchanged;
    if (!file || !output || !is_done) continue;
    BatchEntry& entry = done[*file];
    entry.file = *file;
    entry.output = *output;
    entry.outcome = *outcome;
    entry.json = std::string(value.text());
    entry.done_before = true;
  }
  return done;
}

}  // namespace rigc::pipeline
