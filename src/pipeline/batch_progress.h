// SPDX-License-Identifier: MIT
// Shows how far a batch is: one line that is rewritten on a terminal, now and then a line in a log.
// Test: tests/pipeline/batch_progress_test.cpp
#pragma once

#include <functional>
#include <string>

#include "pipeline/batch.h"

namespace rigc::pipeline {

class ProgressPrinter final : public BatchListener {
 public:
  /// `seconds` is a clock that begins anywhere.
  ProgressPrinter(bool terminal, std::function<double()> seconds,
                  std::function<void(const std::string&)> print);
  void progress(const BatchProgress& progress) override;
  void said(const std::string& text) override;
  /// Takes the line away.
  void end();

 private:
  std::string line(double now) const;

  bool terminal_;
  std::function<double()> seconds_;
  std::function<void(const std::string&)> print_;
  double begun_, shown_;  ///< times, seconds
  bool has_line_ = false;
  BatchProgress progress_;
};

}  // namespace rigc::pipeline
