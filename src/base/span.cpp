// SPDX-License-Identifier: MIT
// The texts that spans point into.
// Test: tests/base/diagnostics_test.cpp
#include "base/span.h"

#include <utility>

namespace rigc {

std::uint32_t Sources::add(std::string name, std::string text) {
  sources_.push_back(std::make_shared<const Source>(Source{std::move(name), std::move(text)}));
  return static_cast<std::uint32_t>(sources_.size());
}

std::string_view Sources::name(std::uint32_t file) const {
  return file == 0 || file > sources_.size() ? std::string_view() : sources_[file - 1]->name;
}

std::string_view Sources::text(std::uint32_t file) const {
  return file == 0 || file > sources_.size() ? std::string_view() : sources_[file - 1]->text;
}

std::string_view Sources::line(std::uint32_t file, std::uint32_t line) const {
  std::string_view rest = text(file);
  if (line == 0) return {};
  for (std::uint32_t i = 1; i < line; ++i) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) return {};
    rest.remove_prefix(end + 1);
  }
  rest = rest.substr(0, rest.find('\n'));
  if (rest.ends_with('\r')) rest.remove_suffix(1);
  return rest;
}

}  // namespace rigc
