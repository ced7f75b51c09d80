// SPDX-License-Identifier: MIT
// What the utility modules share. Test: tests/modules/utilities_test.cpp
#include "modules/utilities/utilities.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "modules/attributes/plugs.h"
#include "modules/codes.h"

namespace rigc::modules {

namespace transform = scene::transform;

Computed make_utility(Builder& b, const std::vector<Given>& given, const std::string& program) {
  return compute(b, {}, "utility", given, program, "utility");
}

NodeId make_result(Builder& b, const std::vector<Given>& given, const std::string& program,
                   const math::Affine& rest) {
  const NodeId node = b.make({.kind = scene::Kind::transform,
                              .role = "transform",
                              .joint = {},
                              .parent = {},
                              .suffix = ""});
  const math::Trs trs = math::decompose(rest);
  b.set({node, transform::kTranslate}, trs.translation);
  b.set({node, transform::kRotation}, trs.rotation);
  b.set({node, transform::kScale}, trs.scale);
  const Computed made = compute(b, {}, "matrix", given,
                                program +
                                    " out translate = world.origin; out turn = rotation(world);"
                                    " out size = scale(world);");
  b.connect(made["translate"], {node, transform::kTranslate});
  b.connect(made["turn"], {node, transform::kRotation});
  b.connect(made["size"], {node, transform::kScale});
  return node;
}

bool check_names(Builder& b, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto here = names.begin() + static_cast<std::ptrdiff_t>(i);
    const bool twice = std::find(names.begin(), here, names[i]) != here;
    const bool word =
        is_name(names[i]) && names[i][0] != '_' && names[i].find('-') == std::string::npos;
    if (word && !twice) continue;
    if (twice)
      b.fail(codes::kNames, "names", fmt::format("\"{}\" comes twice", names[i]));
    else
      b.fail(codes::kNames, "names", fmt::format("\"{}\" cannot name a value", printable(names[i])),
             "letters, digits and _, starting with a letter");
    return false;
  }
  return true;
}

const std::vector<std::string>& names_from(Builder& b, std::size_t count) {
  const std::vector<std::string>& names = b.with().texts("names");
  if (names.size() != count) {
    b.fail(codes::kNames, "names", fmt::format("{} names, {} are needed", names.size(), count));
  } else {
    check_names(b, names);
  }
  return names;
}

std::string literal(double number) {
  const std::string text = number_text(number);
  return text[0] == '-' ? "(" + text + ")" : text;
}

std::string sum_of(const std::string& name, std::size_t count) {
  std::string sum;
  for (std::size_t i = 0; i < count; ++i)
    sum += fmt::format("{}{}{}", sum.empty() ? "" : " + ", name, i);
  return sum;
}

NodeId space_or_parent(Builder& b, std::string_view parameter, NodeId node) {
  return space_from(b, parameter, b.scene()[node].parent);
}

Given world_given(std::string name, NodeId node) {
  if (node.valid()) return {std::move(name), node};
  return {std::move(name), scene::Value(math::Affine{})};
}

math::Affine rest_or_identity(const Builder& b, NodeId node) {
  return node.valid() ? rest(b, node) : math::Affine{};
}

void drive_plugs(Builder& b, const std::vector<Plug>& from, std::string_view to,
                 std::string_view amounts) {
  if (!b.with().has(to)) return;
  const std::vector<Plug>& plugs = b.with().plugs(to);
  const std::vector<double> times =
      b.with().has(amounts) ? b.with().numbers(amounts) : std::vector<double>(from.size(), 1.0);
  if (plugs.size() != from.size() || times.size() != from.size()) {
    b.fail(codes::kTable, plugs.size() != from.size() ? to : amounts,
           fmt::format("{} plugs and {} amounts for {} weights", plugs.size(), times.size(),
                       from.size()));
    return;
  }
  for (std::size_t i = 0; i < plugs.size(); ++i) {
    if (!check_input(b, plugs[i], to) || !check_number(b, plugs[i], to)) return;
    const double at_rest = b.scene().number(plugs[i]);
    const Plug sum =
        formula(b, {}, "amount", fmt::format("{} + $0 * {}", literal(at_rest), literal(times[i])),
                {from[i]});
    b.connect(sum, plugs[i]);
  }
}

}  // namespace rigc::modules
