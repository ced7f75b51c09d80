// SPDX-License-Identifier: MIT
// Tests of src/pipeline/batch_progress.h with a clock of their own.
#include "pipeline/batch_progress.h"

#include <doctest/doctest.h>

using rigc::pipeline::BatchProgress;
using rigc::pipeline::ProgressPrinter;

namespace {

/// A printer whose clock stands until it is moved.
struct Shown {
  explicit Shown(bool terminal)
      : printer(
            terminal, [this] { return now; }, [this](const std::string& part) { text += part; }) {}
  /// What is printed `seconds` later.
  std::string after(double seconds, BatchProgress progress) {
    now += seconds;
    printer.progress(progress);
    return std::exchange(text, {});
  }
  double now = 1000;
  std::string text;
  ProgressPrinter printer;
};

}  // namespace

TEST_CASE("pipeline batch progress: a terminal has one line, rewritten ten times a second") {
  Shown shown(true);
  CHECK(shown.after(0, {0, 1000, 0}) == "");
  CHECK(shown.after(0.05, {5, 1000, 0}) == "");
  CHECK(shown.after(0.95, {100, 1000, 0}) == "\r\x1b[K100 of 1000 files, 100 a second, 9 s left");
  CHECK(shown.after(0.09, {105, 1000, 0}) == "");
  shown.printer.said("a.glb: error\n");
  CHECK(shown.text.starts_with("\r\x1b[Ka.glb: error\n105 of 1000 files, 96 a second"));
  shown.text.clear();
  CHECK(shown.after(98.91, {200, 1000, 2}) ==
        "\r\x1b[K200 of 1000 files, 2.0 a second, 6 min 40 s left, 2 failed");
  CHECK(shown.after(1900, {201, 100'000, 2}) ==
        "\r\x1b[K201 of 100000 files, 0.1 a second, 275 h 50 min left, 2 failed");
  shown.printer.end();
  CHECK(std::exchange(shown.text, {}) == "\r\x1b[K");
  shown.printer.end();
  CHECK(shown.text == "");
}

TEST_CASE(
    "pipeline batch progress: a log has a line every few seconds, without control characters") {
  Shown shown(false);
  CHECK(shown.after(1, {100, 1000, 0}) == "");
  shown.printer.said("a.glb: error\n");
  CHECK(std::exchange(shown.text, {}) == "a.glb: error\n");
  CHECK(shown.after(4, {500, 1000, 1}) == "500 of 1000 files, 100 a second, 5 s left, 1 failed\n");
  CHECK(shown.after(4, {900, 1000, 1}) == "");
  shown.printer.end();
  CHECK(shown.text == "");
}
