// SPDX-License-Identifier: MIT
// The canonical text of selectors and expressions, and renaming of local groups.
// Test: tests/selector/print_test.cpp
#include "selector/selector.h"

namespace rigc::selector {
namespace {

void append(std::string& out, const Index& index) {
  switch (index.kind) {
    case Index::Kind::number:
      out += std::to_string(index.number);
      break;
    case Index::Kind::start:
      out += "START";
      break;
    case Index::Kind::middle:
      out += "MIDDLE";
      break;
    case Index::Kind::end:
      out += "END";
      break;
  }
}

void append(std::string& out, const std::vector<IndexItem>& items) {
  if (items.empty()) return;
  char separator = '[';
  for (const IndexItem& item : items) {
    out += separator;
    separator = ',';
    if (item.all) {
      out += '*';
      continue;
    }
    append(out, item.first);
    if (!item.last) continue;
    out += "..";
    append(out, *item.last);
  }
  out += ']';
}

void append_scope(std::string& out, const Choice& choice) {
  if (!choice.global.empty()) out.append(choice.global).append(":");
  switch (choice.scope) {
    case Scope::self:
      out += ".";
      return;
    case Scope::parent:
      out += "..";
      return;
    case Scope::group:
      break;
  }
  out += choice.local;
  if (!choice.label.empty()) out.append(".").append(choice.label);
  append(out, choice.indices);
}

void append(std::string& out, const Choice& choice) {
  append_scope(out, choice);
  if (choice.made) {
    out.append("/").append(choice.made->module);
    if (!choice.made->id.empty()) out.append("#").append(choice.made->id);
    if (!choice.made->role.empty()) out.append(".").append(choice.made->role);
    append(out, choice.made->indices);
  }
  if (!choice.kind.empty()) out.append("::").append(choice.kind);
  if (!choice.attribute.empty()) out.append("@").append(choice.attribute);
  if (!choice.component.empty()) out.append(".").append(choice.component);
}

}  // namespace

bool Choice::operator==(const Choice& other) const {
  return global == other.global && scope == other.scope && local == other.local &&
         label == other.label && indices == other.indices && made == other.made &&
         kind == other.kind && attribute == other.attribute && component == other.component;
}

std::string print(const Selector& selector) {
  std::string out;
  for (const Choice& choice : selector.choices) {
    if (!out.empty()) out += " | ";
    append(out, choice);
  }
  if (selector.optional) out += "?";
  return out;
}

std::string print(const Expression& expression) {
  std::string out = expression.pieces.front();
  for (std::size_t i = 0; i < expression.selectors.size(); ++i) {
    out.append("{").append(print(expression.selectors[i])).append("}");
    out += expression.pieces[i + 1];
  }
  return out;
}

void rename_groups(Selector& selector,
                   const std::vector<std::pair<std::string, std::string>>& groups) {
  for (Choice& choice : selector.choices) {
    // Another rig's groups are its own.
    if (choice.scope != Scope::group || !choice.global.empty()) continue;
    for (const auto& [before, after] : groups) {
      if (choice.local != before) continue;
      choice.local = after;
      break;
    }
  }
}

}  // namespace rigc::selector
