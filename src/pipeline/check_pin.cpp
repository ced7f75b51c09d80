// SPDX-License-Identifier: MIT
// Writes pins into a template as the smallest change of its text: comments, layout and everything
// else stay. The new text is read again before it is written. Test: tests/pipeline/check_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/files.h"
#include "base/text.h"
#include "base/yaml.h"
#include "pipeline/check_kinds.h"
#include "pipeline/codes.h"
#include "templates/read.h"

namespace rigc::pipeline {
namespace {

using yaml::Node;

constexpr std::size_t kWidth = 100;
using Pins = std::map<std::string, int>;

/// Modules that the template's commands name and that it does not pin.
Pins new_pins(const templates::Template& source, const catalog::Catalogue& catalogue) {
  Pins pins;
  for (const templates::Joint& joint : source.joints)
    for (const templates::Command& command : joint.commands)
      if (const auto* module = catalogue.find(command.tag.module))
        pins[module->module] = module->version;
  for (const auto& [module, version] : source.module_pins) pins.erase(module);
  return pins;
}

std::vector<std::string> entries(const Pins& pins) {
  std::vector<std::string> texts;
  for (const auto& [module, version] : pins)
    texts.push_back(fmt::format("{}: {}", module, version));
  return texts;
}

/// A text with places in it.
class Text {
 public:
  explicit Text(std::string text) : text_(std::move(text)) {
    const std::size_t line_end = text_.find('\n');
    if (line_end != std::string::npos && line_end > 0 && text_[line_end - 1] == '\r') eol_ = "\r\n";
  }
  const std::string& text() const { return text_; }
  std::size_t begin_of(const Span& span) const {
    std::size_t at = 0;
    for (std::uint32_t line = 1; line < span.line && at != std::string::npos; ++line)
      at = std::min(text_.find('\n', at), text_.size() - 1) + 1;
    return std::min(at + span.column - 1, text_.size());
  }
  std::size_t end_of(const Span& span) const {
    return std::min(begin_of(span) + span.length, text_.size());
  }
  char at(std::size_t offset) const { return offset < text_.size() ? text_[offset] : '\0'; }
  std::string with(std::size_t offset, const std::string& inserted) const {
    return std::string(text_).insert(offset, inserted);
  }
  /// Lines behind the one that holds an offset.
  std::string with_lines(std::size_t offset, std::size_t indent,
                         const std::vector<std::string>& lines) const {
    const std::size_t end = text_.find('\n', offset);
    const bool last = end == std::string::npos;
    std::string inserted;
    for (const std::string& line : lines) {
      const std::string whole = std::string(indent, ' ') + line;
      inserted += last ? eol_ + whole : whole + eol_;
    }
    return with(last ? text_.size() : end + 1, inserted);
  }

 private:
  std::string text_;
  std::string eol_ = "\n";
};

/// A template that was read has a map here.
std::string extended(const Text& text, const Node::Entry& modules, const Pins& pins) {
  const Node& value = modules.value;
  const std::string list = join(entries(pins), ", ");
  if (value.entries.empty()) return text.with(text.begin_of(value.span) + 1, list);
  const Node::Entry& last = value.entries.back();
  if (text.at(text.begin_of(value.span)) == '{')
    return text.with(text.end_of(last.value.span), ", " + list);
  return text.with_lines(text.begin_of(last.value.span), last.key_span.column - 1, entries(pins));
}

/// Behind the last of the head's keys that stand in one line.
std::string added(const Text& text, const Node& root, const Pins& pins) {
  const Node::Entry* last = nullptr;
  for (const char* key : {"rigc", "name", "version", "global", "units"}) {
    const Node::Entry* entry = root.find_entry(key);
    if (entry && (!last || entry->key_span.line > last->key_span.line ||
                  (entry->key_span.line == last->key_span.line &&
                   entry->key_span.column > last->key_span.column)))
      last = entry;
  }
  if (!last) return text.text();
  const std::string flow = fmt::format("modules: {{{}}}", join(entries(pins), ", "));
  if (text.at(text.begin_of(root.span)) == '{')
    return text.with(text.end_of(last->value.span), ", " + flow);
  const std::size_t indent = last->key_span.column - 1;
  std::vector<std::string> lines = {flow};
  if (indent + flow.size() > kWidth) {
    lines = {"modules:"};
    for (const std::string& entry : entries(pins)) lines.push_back("  " + entry);
  }
  return text.with_lines(text.begin_of(last->value.span), indent, lines);
}

bool same(const Node& a, const Node& b) {
  const auto same_entry = [](const Node::Entry& x, const Node::Entry& y) {
    return x.key == y.key && same(x.value, y.value);
  };
  return a.kind == b.kind && a.text == b.text && a.quoted == b.quoted &&
         std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(), same) &&
         std::equal(a.entries.begin(), a.entries.end(), b.entries.begin(), b.entries.end(),
                    same_entry);
}

void erase_modules(Node& root) {
  std::erase_if(root.entries, [](const Node::Entry& entry) { return entry.key == "modules"; });
}

/// Whether the new text is the old template with the pins.
bool is_pinned(const std::string& path, const std::string& text, Node before, const Pins& pins,
               const catalog::Catalogue& catalogue) {
  Diagnostics unused;
  const std::uint32_t file = unused.sources().add(path, text);
  auto after = yaml::read(file, unused);
  const auto read = templates::read(file, catalogue, unused);
  if (!after || !read || !new_pins(*read, catalogue).empty()) return false;
  for (const auto& pin : pins)
    if (!std::count(read->module_pins.begin(), read->module_pins.end(),
                    std::pair<std::string, int>(pin)))
      return false;
  erase_modules(before);
  erase_modules(*after);
  return same(before, *after);
}

}  // namespace

void pin_modules(const std::string& path, const catalog::Catalogue& catalogue, CheckedFile& out,
                 Diagnostics& diagnostics) {
  if (!file_exists(path)) {
    diagnostics.report(codes::kCannotPin, Place(path), "pins are written into a file, not a name",
                       "give the template's path");
    return;
  }
  const auto lock = FileLock::take(path, diagnostics);
  auto read = lock ? read_file(path, 4u << 20, diagnostics) : std::nullopt;
  if (!read) return;
  const Text text(std::move(*read));
  const std::uint32_t file = diagnostics.sources().add(path, text.text());
  const auto root = yaml::read(file, diagnostics);
  const auto source = templates::read(file, catalogue, diagnostics);
  if (!root || !source) return;
  const Pins pins = new_pins(*source, catalogue);
  if (pins.empty()) return;
  const Node::Entry* modules = root->find_entry("modules");
  const std::string pinned = modules ? extended(text, *modules, pins) : added(text, *root, pins);
  if (!is_pinned(path, pinned, *root, pins, catalogue)) {
    diagnostics.report(codes::kCannotPin, Place(path), "there is no place for pins in this text",
                       fmt::format("write it: modules: {{{}}}", join(entries(pins), ", ")));
    return;
  }
  if (write_file(path, {pinned}, diagnostics)) out.pins = entries(pins);
}

}  // namespace rigc::pipeline
