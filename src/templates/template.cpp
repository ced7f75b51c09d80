// SPDX-License-Identifier: MIT
// Look-ups in a template. Test: tests/templates/read_test.cpp
#include "templates/template.h"

#include <algorithm>

namespace rigc::templates {

const catalog::Parameter* Template::find_parameter(std::string_view parameter) const {
  for (const catalog::Parameter& candidate : parameters)
    if (candidate.name == parameter) return &candidate;
  return nullptr;
}

const tags::FeatureDeclaration* Template::find_feature(std::string_view feature) const {
  for (const tags::FeatureDeclaration& candidate : features)
    if (candidate.name == feature) return &candidate;
  return nullptr;
}

bool Template::is_main_group(std::string_view local) const {
  return local == name || std::find(was.begin(), was.end(), local) != was.end();
}

}  // namespace rigc::templates
