// SPDX-License-Identifier: MIT
// The parser's events become a flat list of raw nodes in which aliases are shared indices; the
// list, once it is whole and known to be finite and small, is unfolded into the tree that others
// see. Test: tests/base/yaml_test.cpp
#include "base/yaml.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <istream>
#include <streambuf>
#include <unordered_map>
#include <unordered_set>

#include "base/codes.h"
#include "base/text.h"

namespace rigc::yaml {
namespace {

constexpr std::size_t kMostBytes = 4u << 20;
constexpr std::size_t kMostNodes = 1'000'000;
constexpr std::size_t kMostAliased = 200'000;
constexpr std::size_t kMostAliasedText = 16u << 20;
constexpr std::size_t kMostDepth = 100;

/// Without leading blanks, line ends and comments.
std::string_view skip_blanks(std::string_view text) {
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    if (!text.starts_with('#')) return text;
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
}

/// Thrown through the parser to leave it, after the error was reported; caught in read().
struct Stop {};

/// A node before aliases are unfolded: children are indices, and several parents may share one.
struct Raw {
  NodeKind kind = NodeKind::null;
  bool quoted = false;
  bool open = false;     ///< still being read: an alias to it would be a cycle
  bool visited = false;  ///< unfolded once already
  bool broken = false;   ///< stands for a mistake that was reported
  Span span;
  std::string text;
  std::vector<std::uint32_t> children;  ///< items, or keys and values in turn
};

/// Counts what aliases make, in copies and in steps of merging.
struct AliasBudget {
  std::size_t nodes = 0;
  std::size_t bytes = 0;
  bool spend(std::size_t more_nodes, std::size_t more_bytes) {
    nodes += more_nodes;
    bytes += more_bytes;
    return nodes <= kMostAliased && bytes <= kMostAliasedText;
  }
};

class Builder : public YAML::EventHandler {
 public:
  Builder(std::uint32_t file, std::string_view text, Diagnostics& diagnostics)
      : file_(file), text_(text), diagnostics_(diagnostics) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ == 1) return;
    diagnostics_.report(codes::kYamlDocuments, span_at(mark), "a second document starts here",
                        "a file holds one document: remove this one");
    throw Stop();
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    add(NodeKind::null, mark, "", anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    const std::uint32_t index = add(NodeKind::scalar, mark, tag, anchor);
    raws_[index].text = value;
    raws_[index].quoted = tag == "!";
    if (tag == "!") last_quoted_ = mark;
    raws_[index].span.length = length_of(raws_[index], mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(add(NodeKind::sequence, mark, tag, anchor));
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(add(NodeKind::map, mark, tag, anchor));
  }
  void OnMapEnd() override {
    check_map(stack_.back());
    close();
  }

  /// Whether the last quoted text has its closing quote.
  bool check_end();
  /// The tree; empty if it would be too large or too deep.
  std::optional<Node> unfold();

 private:
  using Keys = std::unordered_set<std::string_view>;

  Span span_at(const YAML::Mark& mark) const {
    return {file_, static_cast<std::uint32_t>(mark.line + 1),
            static_cast<std::uint32_t>(mark.column + 1), 1};
  }
  std::uint32_t length_of(const Raw& raw, const YAML::Mark& mark) const;
  std::uint32_t add(NodeKind kind, const YAML::Mark& mark, const std::string& tag,
                    YAML::anchor_t anchor);
  void attach(std::uint32_t index) {
    if (!stack_.empty()) raws_[stack_.back()].children.push_back(index);
  }
  void open(std::uint32_t index);
  void close() {
    raws_[stack_.back()].open = false;
    stack_.pop_back();
  }
  void check_map(std::uint32_t index);
  void merge(std::uint32_t source, const Keys& written, Keys& merged,
             std::vector<std::uint32_t>& children);
  bool unfold(std::uint32_t index, std::size_t depth, Node& node);
  void report_explosion(const Span& span);

  std::uint32_t file_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  std::vector<Raw> raws_;
  std::vector<std::uint32_t> stack_;  ///< open containers
  std::unordered_map<YAML::anchor_t, std::uint32_t> anchors_;
  AliasBudget budget_;
  YAML::Mark last_quoted_ = YAML::Mark::null_mark();
  int documents_ = 0;
};

std::uint32_t Builder::length_of(const Raw& raw, const YAML::Mark& mark) const {
  const auto at = static_cast<std::size_t>(mark.pos);
  if (mark.pos < 0 || at >= text_.size() || raw.text.empty()) return 1;
  const bool has_quote = text_[at] == '"' || text_[at] == '\'';
  if (text_.substr(at + (has_quote ? 1 : 0), raw.text.size()) != raw.text) return 1;
  return static_cast<std::uint32_t>(raw.text.size() + (has_quote ? 2 : 0));
}

std::uint32_t Builder::add(NodeKind kind, const YAML::Mark& mark, const std::string& tag,
                           YAML::anchor_t anchor) {
  if (raws_.size() == kMostNodes) {
    diagnostics_.report(codes::kYamlTooLarge, span_at(mark),
                        fmt::format("the file has more than {} values", kMostNodes));
    throw Stop();
  }
  if (!tag.empty() && tag != "?" && tag != "!")
    diagnostics_.report(codes::kYamlTag, span_at(mark),
                        fmt::format("the tag \"{}\" is not used here", printable(tag)),
                        "remove the tag: a value's type follows from its key");
  const auto index = static_cast<std::uint32_t>(raws_.size());
  raws_.emplace_back();
  raws_.back().kind = kind;
  raws_.back().span = span_at(mark);
  if (anchor != 0) anchors_[anchor] = index;
  attach(index);
  return index;
}

void Builder::open(std::uint32_t index) {
  raws_[index].open = true;
  stack_.push_back(index);
  if (stack_.size() <= kMostDepth) return;
  diagnostics_.report(codes::kYamlTooDeep, raws_[index].span,
                      fmt::format("nested more than {} deep", kMostDepth));
  throw Stop();
}

void Builder::OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) {
  const auto found = anchors_.find(anchor);
  if (found == anchors_.end() || raws_[found->second].open) {
    diagnostics_.report(codes::kYamlAliasCycle, span_at(mark),
                        "this alias stands inside the value that it names");
    raws_[add(NodeKind::null, mark, "", 0)].broken = true;
    return;
  }
  attach(found->second);
}

void Builder::check_map(std::uint32_t index) {
  const std::vector<std::uint32_t> written = std::move(raws_[index].children);
  const auto is_merge = [&](const Raw& key) { return !key.quoted && key.text == "<<"; };
  Keys keys;
  for (std::size_t i = 0; i + 1 < written.size(); i += 2) {
    const Raw& key = raws_[written[i]];
    if (key.kind != NodeKind::scalar)
      diagnostics_.report(codes::kYamlBadKey, key.span, "a key must be text",
                          key.kind == NodeKind::null ? "put it in quotes if it is meant" : "");
    else if (!keys.insert(key.text).second)
      diagnostics_.report(
          codes::kYamlDuplicateKey, key.span,
          fmt::format("the key \"{}\" occurs twice in this map", printable(key.text)));
  }
  std::vector<std::uint32_t> children;
  Keys merged;
  for (std::size_t i = 0; i + 1 < written.size(); i += 2) {
    const Raw& value = raws_[written[i + 1]];
    if (!is_merge(raws_[written[i]])) {
      children.insert(children.end(), {written[i], written[i + 1]});
    } else if (value.kind == NodeKind::sequence) {
      for (std::uint32_t source : value.children) merge(source, keys, merged, children);
    } else {
      merge(written[i + 1], keys, merged, children);
    }
  }
  raws_[index].children = std::move(children);
}

void Builder::merge(std::uint32_t source, const Keys& written, Keys& merged,
                    std::vector<std::uint32_t>& children) {
  const Raw& map = raws_[source];
  if (map.broken) return;
  if (map.kind != NodeKind::map) {
    diagnostics_.report(codes::kYamlBadMerge, map.span, "<< takes a map or a list of maps");
    return;
  }
  if (!budget_.spend(map.children.size() + 1, 0)) {
    report_explosion(map.span);
    throw Stop();
  }
  for (std::size_t i = 0; i + 1 < map.children.size(); i += 2) {
    const std::string_view key = raws_[map.children[i]].text;
    if (written.contains(key) || !merged.insert(key).second) continue;
    children.insert(children.end(), {map.children[i], map.children[i + 1]});
  }
}

void Builder::report_explosion(const Span& span) {
  diagnostics_.report(codes::kYamlAliasExplosion, span,
                      fmt::format("aliases of this expand to more than {} values or {} MB of text",
                                  kMostAliased, kMostAliasedText >> 20));
}

bool Builder::check_end() {
  // yaml-cpp takes the end of the file for a closing quote where only blanks come before it.
  if (last_quoted_.is_null()) return true;
  std::string_view rest = text_.substr(static_cast<std::size_t>(last_quoted_.pos));
  while (!rest.empty() && (rest[0] == '&' || rest[0] == '!'))
    rest = skip_blanks(rest.substr(std::min(rest.find_first_of(" \t\r\n"), rest.size())));
  if (!rest.starts_with('"') && !rest.starts_with('\'')) return true;
  const char quote = rest[0];
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (quote == '"' && rest[i] == '\\')
      ++i;
    else if (rest[i] == quote && quote == '\'' && rest.substr(i + 1).starts_with('\''))
      ++i;
    else if (rest[i] == quote)
      return true;
  }
  diagnostics_.report(codes::kYamlSyntax, span_at(last_quoted_), "this text has no closing quote");
  return false;
}

std::optional<Node> Builder::unfold() {
  Node root;
  if (raws_.empty()) {
    root.span = {file_, 1, 1, 1};
    return root;
  }
  if (!unfold(0, 0, root)) return std::nullopt;
  return root;
}

bool Builder::unfold(std::uint32_t index, std::size_t depth, Node& node) {
  Raw& raw = raws_[index];
  if (raw.visited && !budget_.spend(1, raw.text.size())) {
    report_explosion(raw.span);
    return false;
  }
  raw.visited = true;
  const bool is_leaf = raw.kind == NodeKind::scalar || raw.kind == NodeKind::null;
  if (!is_leaf && depth == kMostDepth) {
    diagnostics_.report(codes::kYamlTooDeep, raw.span,
                        fmt::format("nested more than {} deep, aliases included", kMostDepth));
    return false;
  }
  node.kind = raw.kind;
  node.span = raw.span;
  node.quoted = raw.quoted;
  node.text = raw.text;
  if (raw.kind == NodeKind::sequence) {
    node.items.resize(raw.children.size());
    for (std::size_t i = 0; i < raw.children.size(); ++i)
      if (!unfold(raw.children[i], depth + 1, node.items[i])) return false;
  } else if (raw.kind == NodeKind::map) {
    node.entries.resize(raw.children.size() / 2);
    for (std::size_t i = 0; i < node.entries.size(); ++i) {
      Raw& key = raws_[raw.children[2 * i]];
      if (key.visited && !budget_.spend(1, key.text.size())) {
        report_explosion(key.span);
        return false;
      }
      key.visited = true;
      node.entries[i].key = key.text;
      node.entries[i].key_span = key.span;
      if (!unfold(raw.children[2 * i + 1], depth + 1, node.entries[i].value)) return false;
    }
  }
  return true;
}

/// A text as a stream without a copy.
class TextBuffer : public std::streambuf {
 public:
  explicit TextBuffer(std::string_view text) {
    char* first = const_cast<char*>(text.data());
    setg(first, first, first + text.size());
  }
};

/// Where a byte of the text is.
Span span_of_byte(std::uint32_t file, std::string_view text, std::size_t byte) {
  Span span{file, 1, 1, 1};
  for (char c : text.substr(0, byte)) {
    ++span.column;
    if (c == '\n') {
      ++span.line;
      span.column = 1;
    }
  }
  return span;
}

/// What yaml-cpp would misread in silence (it guesses encodings, and takes byte 4 for the end).
bool check_bytes(std::uint32_t file, std::string_view text, Diagnostics& diagnostics) {
  if (text.size() > kMostBytes) {
    diagnostics.report(codes::kYamlTooLarge, Span{file, 0, 0, 0},
                       fmt::format("{} bytes, more than {}", text.size(), kMostBytes));
    return false;
  }
  // yaml-cpp reads a list in brackets to its end, at 200 bytes a token, before it tells of the
  // first.
  const auto separators = std::count_if(text.begin(), text.end(),
                                        [](char c) { return c == ',' || c == '[' || c == '{'; });
  if (static_cast<std::size_t>(separators) > kMostNodes) {
    diagnostics.report(codes::kYamlTooLarge, Span{file, 0, 0, 0},
                       fmt::format("the file has more than {} values", kMostNodes));
    return false;
  }
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c >= 0x80) {
      std::size_t length = 2;
      while (length <= 4 && !is_utf8(text.substr(i, length))) ++length;
      if (length > 4) {
        diagnostics.report(codes::kYamlBadUtf8, span_of_byte(file, text, i),
                           fmt::format("byte {:#04x} is not UTF-8", c), "save the file as UTF-8");
        return false;
      }
      i += length - 1;
    } else if ((c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7f) {
      diagnostics.report(codes::kYamlControlCharacter, span_of_byte(file, text, i),
                         fmt::format("control character {:#04x}", c),
                         "in double quotes it can be written as an escape");
      return false;
    }
  }
  return true;
}

std::string hint_for(std::string_view message) {
  if (message.find("tab") != std::string_view::npos) return "indent with spaces, not tabs";
  if (message.starts_with("end of map flow")) return "a `}` or a comma is missing";
  if (message.starts_with("end of sequence flow")) return "a `]` or a comma is missing";
  if (message.starts_with("illegal map value"))
    return "quote text that contains `: `, or check the indentation";
  if (message.starts_with("end of map not found") || message.starts_with("end of sequence not"))
    return "check the indentation of this line and of the one above";
  if (message.starts_with("unknown token")) return "quote text that starts with ` @ or %";
  return {};
}

void report_exception(const YAML::Exception& error, std::uint32_t file, Diagnostics& diagnostics) {
  Span span{file, 1, 1, 1};
  if (!error.mark.is_null()) {
    span.line = static_cast<std::uint32_t>(error.mark.line + 1);
    span.column = static_cast<std::uint32_t>(error.mark.column + 1);
  }
  const std::string_view line = diagnostics.sources().line(file, span.line);
  const std::size_t tab = line.find('\t');
  const bool has_tab = tab != std::string_view::npos && tab < line.find_first_not_of(" \t");
  const bool anchor = error.msg.starts_with(YAML::ErrorMsg::UNKNOWN_ANCHOR);
  diagnostics.report(anchor ? codes::kYamlUnknownAnchor : codes::kYamlSyntax, span,
                     printable(error.msg),
                     has_tab ? "indent with spaces, not tabs" : hint_for(error.msg));
}

}  // namespace

const Node* Node::find(std::string_view key) const {
  const Entry* entry = find_entry(key);
  return entry ? &entry->value : nullptr;
}

const Node::Entry* Node::find_entry(std::string_view key) const {
  for (const Entry& entry : entries)
    if (entry.key == key) return &entry;
  return nullptr;
}

std::optional<Node> read(std::uint32_t file, Diagnostics& diagnostics) {
  std::string_view text = diagnostics.sources().text(file);
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  const std::size_t errors = diagnostics.errors();
  if (!check_bytes(file, text, diagnostics)) return std::nullopt;
  Builder builder(file, text, diagnostics);
  try {
    TextBuffer buffer(text);
    std::istream stream(&buffer);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const Stop&) {
    return std::nullopt;
  } catch (const YAML::Exception& error) {
    report_exception(error, file, diagnostics);
    return std::nullopt;
  } catch (const std::exception& error) {
    diagnostics.report(codes::kYamlSyntax, Span{file, 0, 0, 0}, printable(error.what()));
    return std::nullopt;
  }
  if (diagnostics.errors() != errors || !builder.check_end()) return std::nullopt;
  return builder.unfold();
}

}  // namespace rigc::yaml
