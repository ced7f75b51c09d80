// SPDX-License-Identifier: MIT
// The head of a template's text: by lines where it is written as people write it, else by the YAML
// reader. Test: tests/templates/versions_test.cpp
#include <algorithm>
#include <cstring>

#include "base/text.h"
#include "base/yaml.h"
#include "templates/format.h"
#include "templates/versions.h"

namespace rigc::templates {
namespace {

constexpr std::size_t kMostNames = 64;  // as the reader allows

/// The four keys that count, line by line. Gives up, rather than guess, where a line is none of:
/// blank, comment, inside of the key above, `key: value` with a value that ends in the line.
class LineScan {
 public:
  explicit LineScan(std::string_view text) : text_(text) {}

  bool run() {
    for (std::size_t at = 0; at < text_.size();) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      std::string_view line = text_.substr(at, end - at);
      if (line.ends_with('\r')) line.remove_suffix(1);
      if (!take(line)) return false;
      at = end + 1;
    }
    return format_ && !head_.name.empty() && head_.version > 0;
  }
  Head take_head() { return std::move(head_); }

 private:
  bool take(std::string_view line) {
    const std::string_view content = trim(line);
    if (content.empty() || content.front() == '#') return true;
    if (content.front() == '-' || line.front() == ' ') {
      if (line.front() == '-' && line.size() > 1 && line[1] != ' ') return false;
      return !key_.empty() && line.front() != '\t' && (key_ != "was" || take_item(content));
    }
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || !is_name(line.substr(0, colon))) return false;
    const std::string_view rest = line.substr(colon + 1);
    if (!rest.empty() && rest.front() != ' ') return false;
    key_ = line.substr(0, colon);
    return take_value(without_comment(rest));
  }

  static std::string_view without_comment(std::string_view value) {
    const std::size_t hash = value.find(" #");
    return trim(hash == std::string_view::npos ? value : value.substr(0, hash));
  }

  /// Whether the value cannot go on in the next line.
  static bool ends(std::string_view value) {
    if (value.empty()) return true;
    switch (value.front()) {
      case '[':
        return value.ends_with(']');
      case '{':
        return value.ends_with('}');
      case '"':
      case '\'':
        return value.size() > 1 && value.back() == value.front();
      default:
        return true;
    }
  }

  bool take_value(std::string_view value) {
    if (key_ == "rigc") return !std::exchange(format_, true) && value == "1";
    if (key_ == "name") return head_.name.empty() && take_name(value, head_.name);
    if (key_ == "version") return head_.version == 0 && take_version(value);
    if (key_ == "was") return !std::exchange(has_was_, true) && take_names(value);
    return ends(value);
  }

  static bool take_name(std::string_view value, std::string& out) {
    if (value.size() > 1 && (value.front() == '"' || value.front() == '\'') && ends(value))
      value = value.substr(1, value.size() - 2);
    if (!is_name(value) || value == "null" || value == "Null" || value == "NULL") return false;
    out = value;
    return true;
  }

  bool take_version(std::string_view value) {
    const bool digits =
        std::all_of(value.begin(), value.end(), [](char c) { return c >= '0' && c <= '9'; });
    const auto version = digits ? parse_integer(value) : std::nullopt;
    if (!version || *version < 1 || *version > kMostVersion) return false;
    head_.version = static_cast<int>(*version);
    return true;
  }

  /// `a`, `[a, b]`, or nothing: the items follow.
  bool take_names(std::string_view value) {
    if (value.empty()) return true;
    if (value.front() != '[') return add_name(value);
    if (!value.ends_with(']')) return false;
    for (const std::string_view name : split(value.substr(1, value.size() - 2), ','))
      if (!add_name(trim(name))) return false;
    return true;
  }

  bool take_item(std::string_view content) {
    return content.starts_with("- ") && add_name(without_comment(content.substr(1)));
  }

  bool add_name(std::string_view value) {
    std::string name;
    const bool good = head_.was.size() < kMostNames && take_name(value, name) &&
                      std::find(head_.was.begin(), head_.was.end(), name) == head_.was.end();
    if (good) head_.was.push_back(std::move(name));
    return good;
  }

  std::string_view text_;
  std::string_view key_;  ///< that the lines belong to
  bool format_ = false, has_was_ = false;
  Head head_;
};

/// A name, or a list of them; empty where it is anything else.
std::optional<std::vector<std::string>> names(const yaml::Node& node, Diagnostics& quiet) {
  std::vector<std::string> out;
  const std::vector<yaml::Node> one = {node};
  for (const yaml::Node& item : node.is_sequence() ? node.items : one) {
    auto name = yaml::as_name(item, "was", quiet);
    if (!name || out.size() == kMostNames || std::find(out.begin(), out.end(), *name) != out.end())
      return std::nullopt;
    out.push_back(std::move(*name));
  }
  return out;
}

std::optional<Head> read_whole(std::string_view text) {
  Diagnostics quiet;
  const std::uint32_t file = quiet.sources().add("template.yaml", std::string(text));
  const auto root = yaml::read(file, quiet);
  if (!root || !root->is_map()) return std::nullopt;
  const yaml::Node *format = root->find("rigc"), *name = root->find("name");
  const yaml::Node *version = root->find("version"), *was = root->find("was");
  if (!format || !format->is_scalar() || format->text != "1" || !name || !version)
    return std::nullopt;
  Head head;
  head.name = yaml::as_name(*name, "name", quiet).value_or("");
  const long long number = yaml::as_integer(*version, "version", quiet).value_or(0);
  auto earlier = was ? names(*was, quiet) : std::vector<std::string>();
  if (head.name.empty() || number < 1 || number > kMostVersion || !earlier) return std::nullopt;
  head.version = static_cast<int>(number);
  head.was = std::move(*earlier);
  return head;
}

constexpr std::string_view kPartKey = "template";

/// What follows each `template:` that is no comment; nothing where one is quoted, has a value that
/// is, or is an alias.
std::optional<std::vector<std::string>> parts_by_line(std::string_view text) {
  constexpr std::string_view kBehind = " \t\r\n,}#";
  std::vector<std::string> found;
  for (std::size_t at = text.find(kPartKey); at != std::string_view::npos;
       at = text.find(kPartKey, at + 1)) {
    const std::size_t line = text.rfind('\n', at) + 1;  // npos + 1: the first line
    const std::string_view before = text.substr(line, at - line);
    std::string_view rest = text.substr(at + kPartKey.size());
    if (trim(before).starts_with('#')) continue;
    if (rest.starts_with('"') || rest.starts_with('\'')) return std::nullopt;
    if (!rest.starts_with(':') || before.empty() || !std::strchr(" \t{,-", before.back())) continue;
    rest = trim(rest.substr(1, rest.find('\n') - 1));
    const std::string_view value = rest.substr(0, rest.find_first_of(kBehind));
    if (value.empty() || std::strchr("\"'*&!|>", value.front())) return std::nullopt;
    found.emplace_back(value);
  }
  return found;
}

std::vector<std::string> read_parts(std::string_view text) {
  Diagnostics quiet;
  const std::uint32_t file = quiet.sources().add("template.yaml", std::string(text));
  const auto root = yaml::read(file, quiet);
  const yaml::Node* parts = root && root->is_map() ? root->find("parts") : nullptr;
  std::vector<std::string> found;
  if (!parts) return found;
  for (const yaml::Node& part : parts->items) {
    const yaml::Node* reference = part.is_map() ? part.find(kPartKey) : nullptr;
    if (reference && reference->is_scalar()) found.push_back(reference->text);
  }
  return found;
}

/// Whether a line begins with the key, or the whole is one `{...}`: all else is no template, and
/// need not be read as YAML to say so.
bool may_be_template(std::string_view text) { return text.find("rigc") != std::string_view::npos; }

}  // namespace

std::optional<Head> scan_head(std::string_view text) {
  if (!may_be_template(text)) return std::nullopt;
  LineScan scan(text);
  return scan.run() ? scan.take_head() : read_whole(text);
}

std::vector<std::string> scan_parts(std::string_view text) {
  auto found = parts_by_line(text);
  return found ? std::move(*found) : read_parts(text);
}

}  // namespace rigc::templates
