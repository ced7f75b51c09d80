// SPDX-License-Identifier: MIT
// What check found, for people and as JSON. Test: tests/cli/check_test.cpp
#include <fmt/format.h>

#include "base/json.h"
#include "base/text.h"
#include "pipeline/check.h"

namespace rigc::pipeline {
namespace {

std::string counted(std::size_t count, const char* word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

std::string result(std::size_t errors, std::size_t warnings) {
  if (errors == 0 && warnings == 0) return "no errors";
  if (warnings == 0) return counted(errors, "error");
  if (errors == 0) return counted(warnings, "warning");
  return counted(errors, "error") + ", " + counted(warnings, "warning");
}

void write_place(json::Writer& w, const Place& place, const Sources& sources) {
  if (place.span.known()) {
    w.member("file", sources.name(place.span.file)).member("line", place.span.line);
    w.member("column", place.span.column);
    return;
  }
  w.member("file", place.file);
  if (!place.pointer.empty()) w.member("pointer", place.pointer);
  if (place.offset) w.key("offset").integer(static_cast<std::int64_t>(*place.offset));
}

void write_diagnostic(json::Writer& w, const Diagnostic& one, const Sources& sources) {
  w.begin_object().member("code", fmt::format("RIG{:04}", one.code->number));
  w.member("severity", one.code->severity == Severity::error ? "error" : "warning");
  write_place(w, one.place, sources);
  w.member("message", one.message);
  if (!one.hint.empty()) w.member("hint", one.hint);
  w.end_object();
}

void write_texts(json::Writer& w, const char* key, const std::vector<std::string>& texts) {
  w.key(key).begin_array();
  for (const std::string& text : texts) w.value(text);
  w.end_array();
}

}  // namespace

std::string check_text(const std::vector<CheckedFile>& files) {
  std::string out;
  std::size_t errors = 0, warnings = 0;
  for (const CheckedFile& file : files) {
    errors += file.errors;
    warnings += file.warnings;
    out += fmt::format("{}: {}, {}\n", printable(file.file), file.kind,
                       result(file.errors, file.warnings));
    for (const std::string& fact : file.facts) out += fmt::format("  {}\n", fact);
    if (!file.pins.empty()) out += fmt::format("  pinned {}\n", join(file.pins, ", "));
  }
  return out +
         fmt::format("{} checked: {}\n", counted(files.size(), "file"), result(errors, warnings));
}

std::string check_json(const std::vector<CheckedFile>& files, const Diagnostics& diagnostics) {
  json::Writer w(2);
  w.begin_object().key("files").begin_array();
  for (const CheckedFile& file : files) {
    w.begin_object().member("file", file.file).member("kind", file.kind);
    w.member("errors", file.errors).member("warnings", file.warnings);
    write_texts(w, "facts", file.facts);
    write_texts(w, "pins", file.pins);
    w.key("diagnostics").begin_array();
    for (std::size_t i = file.first; i < file.last; ++i)
      write_diagnostic(w, diagnostics.all()[i], diagnostics.sources());
    w.end_array().end_object();
  }
  w.end_array().member("errors", diagnostics.errors()).member("warnings", diagnostics.warnings());
  w.end_object();
  return w.take() + "\n";
}

}  // namespace rigc::pipeline
