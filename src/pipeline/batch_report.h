// SPDX-License-Identifier: MIT
// The report of a batch as JSON (docs/schema/report.schema.json), and going on from one. Only for
// batch*.cpp. Test: tests/pipeline/batch_test.cpp
#pragma once

#include <map>
#include <optional>
#include <string>

#include "pipeline/batch.h"

namespace rigc::pipeline {

/// What an outcome is called in reports.
const char* outcome_word(FileResult::Outcome outcome);

/// An entry of a file that was worked on. Everything that the diagnostics say becomes part of it.
BatchEntry make_entry(const FileWork& work, const FileResult& result,
                      const Diagnostics& diagnostics);

/// The whole document.
std::string report_document(const BatchRequest& request, const Batch& batch);

/// What an earlier run has done, by file: entries that need not be done again.
using DoneBefore = std::map<std::string, BatchEntry>;

/// Reads the report that the request names, if it does. Reports of other commands or settings are
/// errors.
std::optional<DoneBefore> read_report(const BatchRequest& request, Diagnostics& diagnostics);

}  // namespace rigc::pipeline
