// SPDX-License-Identifier: MIT
// JSON Schema of the tables of keys (base/format.h), with the modules of a catalogue where a format
// names modules. Test: tests/pipeline/schema_test.cpp
#pragma once

#include <set>
#include <string>
#include <vector>

#include "base/format.h"
#include "base/json.h"
#include "catalog/catalogue.h"

namespace rigc::pipeline {

class FormatSchema {
 public:
  explicit FormatSchema(const catalog::Catalogue& catalogue) : catalogue_(catalogue), w_(2) {}
  /// The whole schema of files whose root is this section.
  std::string write(const yaml::Section& root, const std::string& title,
                    const std::string& description);

 private:
  void section(const yaml::Section& section);
  void key(const yaml::Key& key);
  void form(const yaml::Key& key);
  void simple_form(const yaml::Key& key);
  void deep_form(const yaml::Key& key);
  void module_names();
  void module_versions();
  void item(const yaml::Section& section);
  void named(const yaml::Key& key);
  void bones();
  void tags();
  void needs_one(const yaml::Section& section);
  void excludes(const std::string& a, const std::string& b);
  void restrictions(const yaml::Section& section);
  void command_arguments();
  void parameter_defaults();
  void definitions();
  /// An open object whose members somebody else writes, under a key.
  template <class Members>
  void object(const char* name, Members members);
  void reference(const std::string& definition);
  void reference(const yaml::Section& section);

  const catalog::Catalogue& catalogue_;
  json::Writer w_;
  std::vector<const yaml::Section*> open_;  ///< definitions still to be written
  std::set<std::string> seen_;
  bool uses_modules_ = false;
};

}  // namespace rigc::pipeline
