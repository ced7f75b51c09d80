// SPDX-License-Identifier: MIT
// What the readers of a template's pieces share. Only for the read_*.cpp of this folder.
// Test: tests/templates/read_test.cpp
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/yaml.h"
#include "catalog/catalogue.h"
#include "templates/template.h"

namespace rigc::templates {

struct Reader {
  const catalog::Catalogue& catalogue;
  Diagnostics& diagnostics;
  Template& out;

  void error(const Code& code, const Span& span, std::string message, std::string hint = {}) {
    diagnostics.report(code, span, std::move(message), std::move(hint));
  }
  /// The value of a key that cannot be left out; reports at the map where it is.
  const yaml::Node* required(const yaml::Node& map, std::string_view key, std::string_view what);
  /// Reports lists and maps that are longer than anybody writes: they only serve to exhaust us.
  bool at_most(const yaml::Node& node, std::size_t limit, std::string_view what);
  /// A name, or a list of at most 64 names without repetition.
  std::vector<std::string> names(const yaml::Node& node, std::string_view what);
  std::optional<math::Vec3> vector(const yaml::Node& node, std::string_view what);
  /// A vector in the file's units, as metres.
  std::optional<math::Vec3> metres(const yaml::Node& node, std::string_view what);
  std::optional<math::Quat> euler(const yaml::Node& node, std::string_view what);
  std::optional<Condition> condition(const yaml::Node& node);
  /// Reports a `$name` that the template does not declare.
  bool check_declared(std::string_view parameter, const Span& span);
};

void read_parameters(Reader& reader, const yaml::Node& node);
void read_features(Reader& reader, const yaml::Node& node);
void read_pins(Reader& reader, const yaml::Node& node);
void read_groups(Reader& reader, const yaml::Node& node);
void read_joints(Reader& reader, const yaml::Node& node);
void read_parts(Reader& reader, const yaml::Node& node);
/// `tags:` of a joint into its features and commands.
void read_tags(Reader& reader, const yaml::Node& node, Joint& joint);
/// The keys of a joint that say where it stands.
void read_placement(Reader& reader, const yaml::Node& node, Joint& joint);

}  // namespace rigc::templates
