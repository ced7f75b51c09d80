// SPDX-License-Identifier: MIT
// Replaced values of a JSON text. Test: tests/gltf/merge_test.cpp
#include "gltf/merge_edits.h"

#include <algorithm>

namespace rigc::gltf {

void Edits::replace(const json::Value& value, std::string json) {
  edits_.push_back({value.begin(), value.end(), std::move(json)});
}

void Edits::insert(const json::Value& object, std::string_view key, std::string_view json) {
  const std::size_t at = object.begin() + 1;
  edits_.push_back({at, at, json::quote(key) + ":" + std::string(json) + ","});
}

void Edits::sort() {
  std::stable_sort(edits_.begin(), edits_.end(),
                   [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
}

std::string Edits::text(const json::Value& value) const {
  const std::string_view all = value.text();
  const std::size_t first = value.begin(), last = value.end();
  auto edit = std::lower_bound(edits_.begin(), edits_.end(), first,
                               [](const Edit& e, std::size_t at) { return e.begin < at; });
  std::string out;
  std::size_t at = first;
  for (; edit != edits_.end() && edit->end <= last; ++edit) {
    if (edit->begin < at) continue;
    out += all.substr(at - first, edit->begin - at);
    out += edit->text;
    at = edit->end;
  }
  return out.append(all.substr(at - first));
}

}  // namespace rigc::gltf
