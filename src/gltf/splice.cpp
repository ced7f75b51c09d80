// SPDX-License-Identifier: MIT
// Splits a JSON container into its members' texts and puts them together again.
// Test: tests/gltf/patch_test.cpp
#include "gltf/splice.h"

#include <cassert>

namespace rigc::gltf {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// First place at or after `from` that is not white space.
std::size_t after_space(std::string_view text, std::size_t from) {
  while (from < text.size() && is_space(text[from])) ++from;
  return from;
}

}  // namespace

Splice::Splice(const json::Value& container) {
  assert(container.is_object() || container.is_array());
  const bool object = container.is_object();
  const std::string_view all = container.text();
  open_ = all.front();
  close_ = all.back();
  std::size_t at = 1;
  const auto add = [&](const json::Value& value) {
    Part part;
    const std::size_t body = after_space(all, at);
    const std::size_t begin = value.begin() - container.begin();
    const std::size_t end = value.end() - container.begin();
    part.lead = all.substr(at, body - at);
    part.head = all.substr(body, begin - body);
    part.value = all.substr(begin, end - begin);
    at = after_space(all, end);
    if (all[at] == ',') {
      part.trail = all.substr(end, at - end);
      ++at;
    } else {
      at = end;
    }
    parts_.push_back(part);
  };
  if (object) {
    for (const auto& [key, value] : container.members()) {
      add(value);
      keys_.push_back(key);
    }
  } else {
    for (const json::Value& value : container.items()) add(value);
  }
  tail_ = all.substr(at, all.size() - 1 - at);
}

std::string_view Splice::keep(std::string text) { return kept_.emplace_back(std::move(text)); }

int Splice::find(std::string_view key) const {
  for (std::size_t i = 0; i < keys_.size(); ++i)
    if (keys_[i] == key) return static_cast<int>(i);
  return -1;
}

void Splice::replace(std::size_t index, std::string json) {
  if (parts_[index].value != json) parts_[index].value = keep(std::move(json));
}

void Splice::erase(std::size_t index) {
  if (index == 0 && parts_.size() > 1) parts_[1].lead = parts_[0].lead;
  parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(index));
  if (!keys_.empty()) keys_.erase(keys_.begin() + static_cast<std::ptrdiff_t>(index));
}

void Splice::truncate(std::size_t size) {
  if (size >= parts_.size()) return;
  parts_.resize(size);
  if (!keys_.empty()) keys_.resize(size);
}

void Splice::push(std::string_view head, std::string json) {
  Part part;
  if (!parts_.empty()) part.lead = parts_.back().lead;
  part.head = head;
  part.value = keep(std::move(json));
  parts_.push_back(part);
}

void Splice::append(std::string json) {
  assert(open_ == '[');
  push({}, std::move(json));
}

void Splice::set(std::string_view key, std::string json) {
  assert(open_ == '{');
  const int index = find(key);
  if (index >= 0 && json.empty()) {
    erase(static_cast<std::size_t>(index));
  } else if (index >= 0) {
    replace(static_cast<std::size_t>(index), std::move(json));
  } else if (!json.empty()) {
    const bool spaced = !parts_.empty() && parts_.back().head.back() == ' ';
    push(keep(json::quote(key) + (spaced ? ": " : ":")), std::move(json));
    keys_.emplace_back(key);
  }
}

std::string Splice::text() const {
  std::size_t length = 2 + tail_.size();
  for (const Part& part : parts_)
    length += part.lead.size() + part.head.size() + part.value.size() + part.trail.size() + 1;
  std::string out;
  out.reserve(length);
  out += open_;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    out += part.lead;
    out += part.head;
    out += part.value;
    if (i + 1 == parts_.size()) break;
    out += part.trail;
    out += ',';
  }
  out += tail_;
  out += close_;
  return out;
}

json::Document parsed(std::string text) {
  Diagnostics none;
  auto document = json::parse(text.empty() ? "{}" : std::move(text), "", 0, none);
  return document ? *std::move(document) : json::Document();
}

std::string with_member(const std::string& text, std::string_view key, std::string json) {
  const json::Document document = parsed(text);
  assert(document.root().is_object());
  Splice splice(document.root());
  splice.set(key, std::move(json));
  return splice.text();
}

bool is_empty_container(std::string_view text) {
  return text.size() >= 2 && after_space(text, 1) == text.size() - 1 &&
         (text.front() == '{' || text.front() == '[');
}

}  // namespace rigc::gltf
