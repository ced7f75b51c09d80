// SPDX-License-Identifier: MIT
// Diagnostics: every message has a code and a place. Stages take Diagnostics& and return an empty
// optional exactly when they reported an error. Each folder declares its codes in codes.h.
// Test: tests/base/diagnostics_test.cpp
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/span.h"

namespace rigc {

enum class Severity { error, warning };

/// One kind of diagnostic. Declared `inline constexpr` in a folder's codes.h, never changed later.
struct Code {
  int number;  ///< printed as RIG0123
  Severity severity;
  const char* title;  ///< a few words
  const char* help;   ///< one or two sentences for the reference: why, and what to do
};

/// Where a diagnostic points: a span of a text, or a file with a JSON pointer or byte offset.
struct Place {
  Span span;
  std::string file;
  std::string pointer;                  ///< JSON pointer inside `file`
  std::optional<std::uint64_t> offset;  ///< byte offset inside `file`

  Place() = default;
  Place(const Span& where) : span(where) {}
  Place(std::string file_name) : file(std::move(file_name)) {}
  Place(std::string file_name, std::string json_pointer)
      : file(std::move(file_name)), pointer(std::move(json_pointer)) {}
  static Place at_byte(std::string file_name, std::uint64_t byte);
};

struct Diagnostic {
  const Code* code;
  Place place;
  std::string message;
  std::string hint;  ///< what to do next; may be empty, may have several lines
};

/// Collects what stages report. Never throws, never prints.
class Diagnostics {
 public:
  Diagnostics() : sources_(std::make_shared<Sources>()) {}
  /// Starts with a copy of `base`, so that spans into it can be reported here: each of several
  /// threads has Diagnostics of its own about templates that all share.
  explicit Diagnostics(const Sources& base) : sources_(std::make_shared<Sources>(base)) {}

  void report(const Code& code, Place place, std::string message, std::string hint = {});

  /// Reports again what another has: its spans then point into sources of this one.
  void append(const Diagnostics& other);

  Sources& sources() { return *sources_; }
  const Sources& sources() const { return *sources_; }
  /// In the order reported. Beyond 10,000 of a severity they are only counted: a hostile file can
  /// have millions.
  const std::vector<Diagnostic>& all() const { return all_; }
  std::size_t errors() const { return errors_; }
  std::size_t warnings() const { return warnings_; }
  bool ok() const { return errors_ == 0; }
  /// Exit status 3 is for these: the file system refused.
  bool file_system_refused() const;

 private:
  std::shared_ptr<Sources> sources_;
  std::vector<Diagnostic> all_;
  std::size_t errors_ = 0;
  std::size_t warnings_ = 0;
  bool refused_ = false;
};

/// `file:line:column: error[RIG0123]: message`, the source line, a caret, the hint. Control
/// characters are escaped and long lines cut. At most `limit` are printed, in the order reported,
/// with the total.
std::string render(const Diagnostics& diagnostics, bool colour, std::size_t limit = 100);

/// The place alone, as render prints it: `biped.yaml:88:5`, `rig.glb#/nodes/3`, `rig.glb@0x10`.
std::string describe(const Place& place, const Sources& sources);

}  // namespace rigc
