// SPDX-License-Identifier: MIT
// The progress of a batch as text. Test: tests/pipeline/batch_progress_test.cpp
#include "pipeline/batch_progress.h"

#include <fmt/format.h>

#include <utility>

namespace rigc::pipeline {
namespace {

/// Between two lines, seconds.
constexpr double kOnTerminal = 0.1;
constexpr double kInLog = 5;
/// Back to the beginning of the line, which is emptied.
constexpr const char* kEmptied = "\r\x1b[K";

std::string time_text(double seconds) {
  const auto whole = static_cast<long long>(seconds + 0.5);
  if (whole < 60) return fmt::format("{} s", whole);
  return whole < 3600 ? fmt::format("{} min {:02} s", whole / 60, whole % 60)
                      : fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string rate_text(double rate) {
  return rate < 10 ? fmt::format("{:.1f}", rate) : fmt::format("{:.0f}", rate);
}

}  // namespace

ProgressPrinter::ProgressPrinter(bool terminal, std::function<double()> seconds,
                                 std::function<void(const std::string&)> print)
    : terminal_(terminal),
      seconds_(std::move(seconds)),
      print_(std::move(print)),
      begun_(seconds_()),
      shown_(begun_) {}

std::string ProgressPrinter::line(double now) const {
  std::string text = fmt::format("{} of {} files", progress_.done, progress_.total);
  const double passed = now - begun_;
  if (progress_.done > 0 && passed > 0) {
    const double rate = static_cast<double>(progress_.done) / passed;
    const auto left = static_cast<double>(progress_.total - progress_.done);
    text += fmt::format(", {} a second, {} left", rate_text(rate), time_text(left / rate));
  }
  if (progress_.failed > 0) text += fmt::format(", {} failed", progress_.failed);
  return text;
}

void ProgressPrinter::progress(const BatchProgress& progress) {
  progress_ = progress;
  const double now = seconds_();
  if (now - shown_ < (terminal_ ? kOnTerminal : kInLog)) return;
  shown_ = now;
  print_(terminal_ ? kEmptied + line(now) : line(now) + "\n");
  has_line_ = terminal_;
}

void ProgressPrinter::said(const std::string& text) {
  print_(has_line_ ? kEmptied + text + line(seconds_()) : text);
}

void ProgressPrinter::end() {
  if (has_line_) print_(kEmptied);
  has_line_ = false;
}

}  // namespace rigc::pipeline
