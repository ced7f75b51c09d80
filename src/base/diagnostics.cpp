// SPDX-License-Identifier: MIT
// Collects diagnostics and prints them with their source lines.
// Test: tests/base/diagnostics_test.cpp
#include "base/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/codes.h"
#include "base/text.h"

namespace rigc {
namespace {

constexpr std::size_t kMostKept = 10'000;
constexpr std::size_t kMostMessage = 4'000;
constexpr std::size_t kMostLine = 160;

/// The escape sequences of a terminal, or nothing.
struct Colours {
  const char *bold = "", *error = "", *warning = "", *caret = "", *off = "";
};

Colours colours(bool wanted) {
  if (!wanted) return {};
  return {"\x1b[1m", "\x1b[1;31m", "\x1b[1;35m", "\x1b[1;32m", "\x1b[0m"};
}

/// One character of a source line as it is shown: a tab is two blanks, control characters are
/// escaped.
std::string shown(std::string_view character) {
  return character == "\t" ? "  " : printable(character);
}

std::size_t character_length(std::string_view text) {
  for (std::size_t length = 1; length <= 4 && length <= text.size(); ++length)
    if (is_utf8(text.substr(0, length))) return length;
  return 1;
}

/// Columns that a shown piece takes: its characters, not its bytes.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

bool is_inner_byte(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

/// The source line of a span and the line with the caret below it.
std::string excerpt(const Span& span, const Sources& sources, const Colours& colour) {
  const std::string_view line = sources.line(span.file, span.line);
  if (span.line == 0 || span.column == 0 || trim(line).empty()) return {};
  const std::size_t at = std::min<std::size_t>(span.column - 1, line.size());
  std::size_t from = 0, to = line.size();
  if (line.size() > kMostLine) {
    from = at > kMostLine / 2 ? std::min(at - kMostLine / 2, line.size() - kMostLine) : 0;
    to = std::min(line.size(), from + kMostLine);
    while (from > 0 && is_inner_byte(line[from])) --from;
    while (to < line.size() && is_inner_byte(line[to])) ++to;
  }
  std::string text = from > 0 ? "..." : "";
  std::size_t before = text.size(), marked = 0;
  const std::size_t marked_end = at + std::max<std::size_t>(span.length, 1);
  for (std::size_t i = from; i < to;) {
    const std::size_t length = character_length(line.substr(i, std::min<std::size_t>(4, to - i)));
    const std::string piece = shown(line.substr(i, length));
    if (i < at) before += width(piece);
    if (i >= at && i < marked_end) marked += width(piece);
    text += piece;
    i += length;
  }
  if (to < line.size()) text += "...";
  const std::string caret = '^' + std::string(marked > 1 ? marked - 1 : 0, '~');
  return fmt::format("  {}\n  {}{}{}{}\n", text, std::string(before, ' '), colour.caret, caret,
                     colour.off);
}

std::string render_hint(const std::string& hint, const Colours& colour) {
  if (hint.empty()) return {};
  std::string text;
  for (std::string_view line : split(hint, '\n'))
    text += fmt::format(
        "{}{}\n",
        text.empty() ? fmt::format("  {}hint:{} ", colour.bold, colour.off) : std::string(8, ' '),
        printable(line, kMostMessage));
  return text;
}

std::string render_one(const Diagnostic& one, const Sources& sources, const Colours& colour) {
  const std::string place = describe(one.place, sources);
  const bool error = one.code->severity == Severity::error;
  return fmt::format("{}{}: {}{}[RIG{:04}]:{} {}{}{}\n", colour.bold,
                     place.empty() ? "rigc" : place, error ? colour.error : colour.warning,
                     error ? "error" : "warning", one.code->number, colour.off, colour.bold,
                     printable(one.message, kMostMessage), colour.off) +
         excerpt(one.place.span, sources, colour) + render_hint(one.hint, colour);
}

std::string counted(std::size_t count, const char* word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

}  // namespace

Place Place::at_byte(std::string file_name, std::uint64_t byte) {
  Place place(std::move(file_name));
  place.offset = byte;
  return place;
}

void Diagnostics::append(const Diagnostics& other) {
  std::map<std::uint32_t, std::uint32_t> files;
  for (const Diagnostic& one : other.all_) {
    Place place = one.place;
    if (place.span.known()) {
      auto [file, is_new] = files.emplace(place.span.file, 0);
      if (is_new)
        file->second = sources_->add(std::string(other.sources().name(place.span.file)),
                                     std::string(other.sources().text(place.span.file)));
      place.span.file = file->second;
    }
    report(*one.code, std::move(place), one.message, one.hint);
  }
}

void Diagnostics::report(const Code& code, Place place, std::string message, std::string hint) {
  std::size_t& count = code.severity == Severity::error ? errors_ : warnings_;
  if (codes::is_file_system(code)) refused_ = true;
  if (++count <= kMostKept)
    all_.push_back({&code, std::move(place), std::move(message), std::move(hint)});
}

bool Diagnostics::file_system_refused() const { return refused_; }

std::string describe(const Place& place, const Sources& sources) {
  if (place.span.known()) {
    std::string text = printable(sources.name(place.span.file), kMostMessage);
    if (place.span.line != 0) text += fmt::format(":{}:{}", place.span.line, place.span.column);
    return text;
  }
  std::string text = printable(place.file, kMostMessage);
  if (!place.pointer.empty()) text += '#' + printable(place.pointer);
  if (place.offset) text += fmt::format("@{:#x}", *place.offset);
  return text;
}

std::string render(const Diagnostics& diagnostics, bool colour, std::size_t limit) {
  const Colours palette = colours(colour);
  std::string text;
  std::size_t shown_count = 0;
  for (const Diagnostic& one : diagnostics.all()) {
    if (shown_count == limit) break;
    text += render_one(one, diagnostics.sources(), palette);
    ++shown_count;
  }
  if (shown_count < diagnostics.errors() + diagnostics.warnings())
    text += fmt::format("{}, {} in total; the first {} are shown\n",
                        counted(diagnostics.errors(), "error"),
                        counted(diagnostics.warnings(), "warning"), shown_count);
  return text;
}

}  // namespace rigc
