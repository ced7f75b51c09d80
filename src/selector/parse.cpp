// SPDX-License-Identifier: MIT
// Parses selectors by recursive descent, one function for each line of the grammar
// (docs/selectors.md). Text in, Selector or diagnostics that point into the text out. Test:
// tests/selector/parse_test.cpp
#include <fmt/format.h>

#include "base/text.h"
#include "selector/codes.h"
#include "selector/locate.h"
#include "selector/selector.h"

namespace rigc::selector {
namespace {

constexpr long long kLargestIndex = 1'000'000;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
}

class Parser {
 public:
  Parser(std::string_view text, const Span& span, Diagnostics& diagnostics)
      : text_(text), locator_(text, span, diagnostics.sources()), diagnostics_(diagnostics) {}

  std::optional<Selector> selector();

 private:
  // Each returns false where it reported an error; position_ then stands at the error.
  bool choice(Choice& choice);
  bool scope(Choice& choice);
  bool group(Choice& choice);
  bool made(Choice& choice);
  bool attribute(Choice& choice);
  bool indices(std::vector<IndexItem>& items);
  bool item(IndexItem& item);
  bool index(Index& index);
  bool name(std::string& name, const char* what);
  bool number_word(std::string_view word, Index& index);

  bool at_end() const { return position_ >= text_.size(); }
  bool next_is(std::string_view token) const {
    return text_.substr(position_, token.size()) == token;
  }
  bool take(std::string_view token) {
    if (!next_is(token)) return false;
    position_ += token.size();
    return true;
  }
  void skip_spaces() {
    while (!at_end() && is_space(text_[position_])) ++position_;
  }
  std::string_view word() const;
  std::string found() const;
  bool error(const Code& code, std::size_t length, std::string message, std::string hint = {});
  bool expected(const char* what, std::string hint = {});
  void skip_to_next_choice();

  std::string_view text_;
  Locator locator_;
  Diagnostics& diagnostics_;
  std::size_t position_ = 0;
};

std::string_view Parser::word() const {
  std::size_t end = position_;
  while (end < text_.size() && is_word(text_[end])) ++end;
  return text_.substr(position_, end - position_);
}

/// What stands at the position, for "expected ..., not ...".
std::string Parser::found() const {
  if (at_end()) return "the end";
  if (is_space(text_[position_])) return "a space";
  if (!word().empty()) return fmt::format("`{}`", printable(word(), 40));
  std::size_t length = 1;
  while (length < 4 && !is_utf8(text_.substr(position_, length))) ++length;
  if (!is_utf8(text_.substr(position_, length))) length = 1;
  return fmt::format("`{}`", printable(text_.substr(position_, length)));
}

bool Parser::error(const Code& code, std::size_t length, std::string message, std::string hint) {
  diagnostics_.report(code, locator_.at(position_, length), std::move(message), std::move(hint));
  return false;
}

bool Parser::expected(const char* what, std::string hint) {
  const std::size_t length = std::max<std::size_t>(1, word().size());
  return error(codes::kSyntax, at_end() ? 0 : length,
               fmt::format("expected {}, not {}", what, found()), std::move(hint));
}

void Parser::skip_to_next_choice() {
  while (!at_end() && text_[position_] != '|') ++position_;
}

std::optional<Selector> Parser::selector() {
  Selector result;
  bool ok = true;
  skip_spaces();
  if (at_end()) {
    diagnostics_.report(codes::kEmpty, locator_.whole(), "the selector is empty");
    return std::nullopt;
  }
  do {
    Choice one;
    skip_spaces();
    const std::size_t begin = position_;
    if (choice(one)) {
      const bool alone = position_ - begin == text_.size();
      one.span = alone ? locator_.whole() : locator_.at(begin, position_ - begin);
      result.choices.push_back(std::move(one));
      skip_spaces();
    } else {
      ok = false;
      skip_to_next_choice();
    }
  } while (take("|"));
  if (ok && take("?")) {
    result.optional = true;
    skip_spaces();
    if (!at_end()) {
      ok = expected("nothing after `?`", "`?` stands once, at the very end of the selector");
    }
  }
  if (ok && !at_end()) ok = expected("`|`, `?` or the end");
  if (!ok) return std::nullopt;
  for (const Choice& one : result.choices) {
    if (one.attribute.empty() == result.choices[0].attribute.empty()) continue;
    diagnostics_.report(codes::kMixedChoices, one.span,
                        "one choice names an attribute and another does not",
                        "write `@attribute` after every choice or after none");
    return std::nullopt;
  }
  result.span = locator_.whole();
  return result;
}

bool Parser::choice(Choice& choice) {
  if (at_end() || next_is("|") || next_is("?")) {
    return error(codes::kEmpty, at_end() ? 0 : 1, "a choice is empty",
                 "write a selector on each side of `|`");
  }
  if (!scope(choice)) return false;
  if (take("/") && !made(choice)) return false;
  if (take("::") && !name(choice.kind, "a kind of node")) return false;
  if (take("@") && !attribute(choice)) return false;
  if (at_end() || is_space(text_[position_]) || next_is("|") || next_is("?")) return true;
  if (!choice.attribute.empty()) return expected("`|`, `?` or the end");
  if (next_is("/") && choice.made) {
    return expected("`::kind`, `@attribute` or the end", "there is one `/` in a choice");
  }
  if (next_is("[") && !choice.label.empty() && !choice.made) {
    return expected("`/module`, `::kind` or `@attribute`",
                    "indices stand after a group or a module, not after a label");
  }
  if (next_is("#") && !choice.made) {
    return expected("`/module` before `#id`", "write `/module#id`, for example `/control#main`");
  }
  return expected("`/module`, `::kind`, `@attribute`, `|`, `?` or the end");
}

bool Parser::scope(Choice& choice) {
  const std::string_view first = word();
  const std::size_t after = position_ + first.size();
  const bool has_global = !first.empty() && after < text_.size() && text_[after] == ':' &&
                          text_.substr(after, 2) != "::";
  if (has_global) {
    if (!name(choice.global, "the name of a rig")) return false;
    ++position_;
  }
  if (!next_is(".")) return group(choice);
  const std::size_t length = next_is("..") ? 2 : 1;
  if (has_global) {
    return error(codes::kSelfOfOtherRig, length,
                 fmt::format("`{}` cannot follow the rig `{}:`", text_.substr(position_, length),
                             choice.global),
                 "name a local group of that rig, for example `prop:handle`");
  }
  choice.scope = length == 2 ? Scope::parent : Scope::self;
  position_ += length;
  if (next_is(".") || !word().empty()) {
    return expected("`/module`, `::kind`, `@attribute` or the end after `.` and `..`",
                    "a label stands after its group: `arm_l.elbow`");
  }
  return true;
}

bool Parser::group(Choice& choice) {
  choice.scope = Scope::group;
  if (!name(choice.local, "a local group, `.` or `..`")) return false;
  if (take(".")) return name(choice.label, "a label");
  return !take("[") || indices(choice.indices);
}

bool Parser::made(Choice& choice) {
  Made& made = choice.made.emplace();
  if (take("*")) {
    made.module = "*";
  } else if (!name(made.module, "a module or `*`")) {
    return false;
  }
  if (take("#") && !name(made.id, "the id of a command")) return false;
  if (take(".") && !name(made.role, "a role")) return false;
  return !take("[") || indices(made.indices);
}

bool Parser::attribute(Choice& choice) {
  if (!name(choice.attribute, "an attribute")) return false;
  if (!take(".")) return true;
  const std::string_view component = word();
  if (component != "x" && component != "y" && component != "z" && component != "w") {
    if (component.empty()) return expected("x, y, z or w");
    return error(codes::kBadComponent, component.size(),
                 fmt::format("there is no component `{}`", printable(component, 40)),
                 suggest(component, {"x", "y", "z", "w"}));
  }
  choice.component = component;
  position_ += component.size();
  return true;
}

bool Parser::indices(std::vector<IndexItem>& items) {
  do {
    skip_spaces();
    if (!item(items.emplace_back())) return false;
    skip_spaces();
  } while (take(","));
  return take("]") || expected("`,` or `]`");
}

bool Parser::item(IndexItem& item) {
  if (take("*")) {
    item.all = true;
    return true;
  }
  if (!index(item.first)) return false;
  return !take("..") || index(item.last.emplace());
}

bool Parser::index(Index& index) {
  const std::string_view found_word = word();
  if (found_word.empty()) return expected("an index: a number, START, MIDDLE, END or `*`");
  if (found_word == "START") {
    index.kind = Index::Kind::start;
  } else if (found_word == "MIDDLE") {
    index.kind = Index::Kind::middle;
  } else if (found_word == "END") {
    index.kind = Index::Kind::end;
  } else if (!number_word(found_word, index)) {
    return false;
  }
  position_ += found_word.size();
  return true;
}

bool Parser::number_word(std::string_view found_word, Index& index) {
  const auto number = parse_integer(found_word);
  if (!number) {
    return error(codes::kBadIndex, found_word.size(),
                 fmt::format("`{}` is no index", printable(found_word, 40)),
                 suggest(found_word, {"START", "MIDDLE", "END"}));
  }
  if (*number > kLargestIndex || *number < -kLargestIndex) {
    return error(codes::kBadIndex, found_word.size(),
                 fmt::format("the index {} is too large", *number), "no group is that long");
  }
  index.number = static_cast<int>(*number);
  return true;
}

bool Parser::name(std::string& name, const char* what) {
  const std::string_view found_word = word();
  if (found_word.empty()) return expected(what);
  if (!is_name(found_word)) {
    return error(codes::kBadName, found_word.size(),
                 fmt::format("expected {}, but `{}` is no name", what, printable(found_word, 40)),
                 found_word.size() > 255 ? "names have at most 255 characters"
                                         : "names do not start with a digit or `-`");
  }
  name = found_word;
  position_ += found_word.size();
  return true;
}

}  // namespace

std::optional<Selector> parse(std::string_view text, const Span& span, Diagnostics& diagnostics) {
  return Parser(text, span, diagnostics).selector();
}

}  // namespace rigc::selector
