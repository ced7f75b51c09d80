// SPDX-License-Identifier: MIT
// The keys of a YAML format as tables: readers check keys and words with them, and the JSON Schemas
// for editors are made from them, so that both always know the same. Test:
// tests/base/format_test.cpp, tools/node/check_templates.mjs
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/yaml.h"

namespace rigc::yaml {

/// What the value of a key looks like.
enum class Form : std::uint8_t {
  any,
  text,
  name,
  names,       ///< a name, or a list of different names
  texts,       ///< a text, or a list of texts
  text_lists,  ///< a list of what `texts` is
  boolean,
  integer,
  number,
  numbers,  ///< a list of Rule::count numbers
  word,     ///< one of Rule::words
  condition,
  holders,  ///< JOINT/COMMAND, or a list of such
  uid,      ///< 16 hexadecimal digits
  count,    ///< an integer, or `$parameter`
  lines,    ///< lists of points [x, z] or [x, y, z]
  point,    ///< one point
  module,   ///< name of a module
  // From here on: forms of maps and of lists of maps.
  arguments,      ///< of a command: what its module takes
  values,         ///< a map from names to anything
  names_by_name,  ///< a map from names to names
  texts_by_name,  ///< a map from names to what `texts` is
  bones,          ///< of a map: GROUP.LABEL, or GROUP, to names of bones
  versions,       ///< a map from modules to versions
  tags,           ///< a list of commands and features
  parameters,     ///< of a descriptor: frames and parameters
  map,            ///< Rule::section
  list,           ///< a list of Rule::section
  named           ///< a map from names to Rule::section
};

struct Section;

/// What a key's form leaves open. Limits are of numbers, each of a list.
struct Rule {
  bool required = false;
  bool null = false;  ///< may be written without a value; of `named`: its entries may
  std::optional<double> min = {}, max = {}, above = {};
  std::size_t count = 0;
  std::vector<std::string> words = {};
  const Section* section = nullptr;
};

struct Key {
  std::string name;
  Form form = Form::any;
  std::string help;  ///< Markdown; what an editor shows
  Rule rule = {};
};

/// A map with fixed keys.
struct Section {
  std::string name;  ///< unique in its format
  std::string what;  ///< in messages: "a joint"
  std::vector<Key> keys;
  std::vector<std::vector<std::string>> exclusive = {};  ///< of each of these at most one
  std::vector<std::string> needs_one = {};               ///< of these at least one, not empty
  const Key* find(std::string_view key) const;
  /// The words that the value of a key may be.
  const std::vector<std::string>& words(std::string_view key) const;
};

/// Reports every key of a map that is not in the section; also that it is a map at all.
bool check_section(const Node& node, const Section& section, Diagnostics& diagnostics);
/// The same under another name.
bool check_section(const Node& node, const Section& section, std::string_view what,
                   Diagnostics& diagnostics);

}  // namespace rigc::yaml
