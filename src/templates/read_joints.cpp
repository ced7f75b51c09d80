// SPDX-License-Identifier: MIT
// Reads `joints:` and checks how they hang together. Parents that may come from parts are checked
// when the parts are known (expand). Test: tests/templates/read_test.cpp
#include <fmt/format.h>

#include <unordered_map>

#include "base/text.h"
#include "templates/arguments.h"
#include "templates/codes.h"
#include "templates/format.h"
#include "templates/reader.h"

namespace rigc::templates {
namespace {

using Handles = std::unordered_map<std::string, std::size_t>;

constexpr std::size_t kMostUids = 64;

void read_uid(Reader& reader, const yaml::Node& node, Joint& joint) {
  const auto uid = node.is_scalar() ? parse_hex16(node.text) : std::nullopt;
  if (!uid || *uid == 0)
    reader.error(codes::kBadUid, node.span, "uid: 16 hexadecimal digits are needed",
                 "without `uid:` it is made from the name");
  else if (!joint.uid)
    joint.uid = uid;
  else
    joint.earlier_uids.push_back(*uid);
}

/// One uid, or a list with the one that counts first.
void read_uids(Reader& reader, const yaml::Node& node, Joint& joint) {
  if (!node.is_sequence() || node.items.empty()) return read_uid(reader, node, joint);
  if (!reader.at_most(node, kMostUids, "uid")) return;
  for (const yaml::Node& item : node.items) read_uid(reader, item, joint);
}

/// `opposite: NAME`, or without a value: none, whatever the names say.
void read_sides(Reader& reader, const yaml::Node& node, Joint& joint) {
  if (const yaml::Node* flag = node.find("mirrored"))
    joint.mirrored = yaml::as_bool(*flag, "mirrored", reader.diagnostics).value_or(false);
  const yaml::Node* opposite = node.find("opposite");
  if (!opposite) return;
  joint.opposite_span = opposite->span;
  joint.opposite = opposite->is_null()
                       ? std::string()
                       : yaml::as_name(*opposite, "opposite", reader.diagnostics).value_or("");
}

void read_identifiers(Reader& reader, const yaml::Node& node, Joint& joint) {
  const auto read = [&](const char* key, std::string& out) {
    if (const yaml::Node* value = node.find(key))
      out = yaml::as_name(*value, key, reader.diagnostics).value_or("");
  };
  read("global", joint.ids.global);
  read("local", joint.ids.local);
  read("label", joint.ids.label);
}

void read_between(Reader& reader, const yaml::Node& node, Joint& joint) {
  if (!yaml::check_section(node, between_format(), reader.diagnostics)) return;
  Between between;
  between.span = node.span;
  if (const yaml::Node* joints = reader.required(node, "between", "a guide"))
    between.joints = reader.names(*joints, "between");
  if (const yaml::Node* at = node.find("at")) {
    between.share = yaml::as_number(*at, "at", reader.diagnostics).value_or(0.5);
    if (!(between.share >= 0 && between.share <= 1))
      reader.error(codes::kNotAllowed, at->span, "at: a share from 0 to 1 is needed");
  }
  if (between.joints.size() == 2)
    joint.between = std::move(between);
  else
    reader.error(codes::kBadBetween, node.span, "a guide lies between two joints",
                 "write `guide: {between: [elbow, wrist]}`");
}

void read_joint(Reader& reader, const yaml::Node& node) {
  if (!yaml::check_section(node, joint_format(), reader.diagnostics) && !node.is_map()) return;
  Joint joint;
  joint.span = node.span;
  if (const yaml::Node* name = reader.required(node, "name", "a joint")) {
    joint.name = yaml::as_name(*name, "name", reader.diagnostics).value_or("");
    joint.span = name->span;
  }
  if (const yaml::Node* parent = node.find("parent"); parent && !parent->is_null()) {
    joint.parent = yaml::as_name(*parent, "parent", reader.diagnostics).value_or("");
    joint.parent_span = parent->span;
  }
  read_placement(reader, node, joint);
  read_identifiers(reader, node, joint);
  if (const yaml::Node* guide = node.find("guide")) read_between(reader, *guide, joint);
  if (const yaml::Node* flag = node.find("optional"))
    joint.optional = yaml::as_bool(*flag, "optional", reader.diagnostics).value_or(false);
  if (const yaml::Node* flag = node.find("helper"))
    joint.helper = yaml::as_bool(*flag, "helper", reader.diagnostics).value_or(false);
  if (const yaml::Node* was = node.find("was")) joint.was = reader.names(*was, "was");
  if (const yaml::Node* uid = node.find("uid")) read_uids(reader, *uid, joint);
  read_sides(reader, node, joint);
  if (const yaml::Node* condition = node.find("if")) joint.condition = reader.condition(*condition);
  if (const yaml::Node* tags = node.find("tags")) read_tags(reader, *tags, joint);
  reader.out.joints.push_back(std::move(joint));
}

Handles index_names(Reader& reader) {
  Handles handles;
  for (std::size_t i = 0; i < reader.out.joints.size(); ++i) {
    const Joint& joint = reader.out.joints[i];
    if (joint.name.empty()) continue;
    const auto [other, fresh] = handles.emplace(joint.name, i);
    if (fresh) continue;
    const Span& first = reader.out.joints[other->second].span;
    reader.error(codes::kDuplicateJoint, joint.span,
                 fmt::format("there is a joint \"{}\" already, in line {}", joint.name, first.line),
                 "give it another name");
  }
  return handles;
}

/// Index of the joint that a word names, by name or by label; -1 if none does.
struct Finder {
  const Handles& names;
  Handles labels;
  int operator()(const std::string& word) const {
    if (const auto found = names.find(word); found != names.end())
      return static_cast<int>(found->second);
    if (const auto found = labels.find(word); found != labels.end())
      return static_cast<int>(found->second);
    return -1;
  }
};

void check_word(Reader& reader, const Finder& find, const std::string& word, const Span& span,
                const char* key) {
  if (word.empty() || find(word) >= 0) return;
  std::vector<std::string> names;
  if (reader.diagnostics.errors() < 100)  // later ones are not printed, and suggestions cost time
    for (const Joint& joint : reader.out.joints) names.push_back(joint.name);
  reader.error(codes::kUnknownJoint, span,
               fmt::format("{}: the template has no joint \"{}\"", key, word),
               suggest(word, names));
}

/// Reports each circle once, at its first joint in the file.
void check_cycles(Reader& reader, const Finder& find) {
  enum class Mark : std::uint8_t { fresh, open, done };
  const std::vector<Joint>& joints = reader.out.joints;
  std::vector<Mark> marks(joints.size(), Mark::fresh);
  for (std::size_t start = 0; start < joints.size(); ++start) {
    std::vector<std::size_t> path;
    int at = static_cast<int>(start);
    while (at >= 0 && marks[static_cast<std::size_t>(at)] == Mark::fresh) {
      const auto index = static_cast<std::size_t>(at);
      marks[index] = Mark::open;
      path.push_back(index);
      at = joints[index].parent.empty() ? -1 : find(joints[index].parent);
    }
    if (at >= 0 && marks[static_cast<std::size_t>(at)] == Mark::open) {
      const Joint& joint = joints[static_cast<std::size_t>(at)];
      reader.error(codes::kJointCycle, joint.parent_span,
                   fmt::format("the joint {} hangs below itself", joint.name),
                   "one of the joints on the way must hang elsewhere");
    }
    for (const std::size_t index : path) marks[index] = Mark::done;
  }
}

}  // namespace

void read_joints(Reader& reader, const yaml::Node& node) {
  if (!node.is_sequence()) {
    reader.error(codes::kMissingKey, node.span, "`joints` is a list", "write `- name: ...`");
    return;
  }
  reader.out.joints.reserve(node.items.size());
  for (const yaml::Node& item : node.items) read_joint(reader, item);
  const Handles names = index_names(reader);
  Finder find{names, {}};
  for (std::size_t i = 0; i < reader.out.joints.size(); ++i)
    if (!reader.out.joints[i].ids.label.empty())
      find.labels.emplace(reader.out.joints[i].ids.label, i);
  if (reader.out.parts.empty()) {
    for (const Joint& joint : reader.out.joints) {
      check_word(reader, find, joint.parent, joint.parent_span, "parent");
      if (joint.placement.orient)
        check_word(reader, find, joint.placement.orient->toward, joint.placement.orient->span,
                   "toward");
      if (joint.between)
        for (const std::string& word : joint.between->joints)
          check_word(reader, find, word, joint.between->span, "between");
    }
  }
  check_cycles(reader, find);
}

}  // namespace rigc::templates
