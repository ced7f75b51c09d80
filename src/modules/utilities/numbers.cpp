// SPDX-License-Identifier: MIT
// Modules that compute a number or a vector for other commands to read by `@output`: condition,
// clamp, blend (over formulas), vector, distance.
// Test: tests/modules/utilities_test.cpp
#include <fmt/format.h>

#include <array>

#include "modules/attributes/plugs.h"
#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/utilities/utilities.h"

namespace rigc::modules {
namespace {

/// One formula of several parameters that are formulas themselves.
class Terms {
 public:
  explicit Terms(Builder& b) : b_(b) {}

  /// The parameter's formula in parentheses, its inputs renumbered.
  std::string operator()(std::string_view parameter) {
    const BoundExpression& bound = b_.with().expression(parameter);
    b_.check_formula(parameter, bound);
    std::string code = "(";
    for (std::size_t i = 0; i < bound.code.size(); ++i) {
      code += bound.code[i];
      if (bound.code[i] != '$') continue;
      std::size_t input = 0;
      while (i + 1 < bound.code.size() && bound.code[i + 1] >= '0' && bound.code[i + 1] <= '9')
        input = input * 10 + static_cast<std::size_t>(bound.code[++i] - '0');
      code += std::to_string(input + plugs_.size());
    }
    plugs_.insert(plugs_.end(), bound.plugs.begin(), bound.plugs.end());
    return code + ")";
  }

  /// Makes the node, and connects it where the parameter `to` says so.
  void make(const std::string& code) {
    if (b_.failed()) return;
    const Plug output = formula(b_, {}, "utility", code, plugs_, "utility");
    if (!b_.with().has("to")) return;
    const Plug to = b_.with().plug("to");
    if (check_input(b_, to, "to") && check_number(b_, to, "to")) b_.connect(output, to);
  }

 private:
  Builder& b_;
  std::vector<Plug> plugs_;
};

struct Operation {
  std::string_view name;
  std::array<scene::Type, 2> takes;
  bool two;
  std::string_view code;
};
constexpr auto kVector = scene::Type::vec3;
constexpr Operation kOperations[] = {
    {"add", {kVector, kVector}, true, "a + b"},
    {"subtract", {kVector, kVector}, true, "a - b"},
    {"multiply", {kVector, kVector}, true, "multiply(a, b)"},
    {"dot", {kVector, kVector}, true, "dot(a, b)"},
    {"cross", {kVector, kVector}, true, "cross(a, b)"},
    {"angle",
     {kVector, kVector},
     true,
     "2 * atan2(length(normalise(a) - normalise(b)), length(normalise(a) + normalise(b)))"},
    {"project", {kVector, kVector}, true, "normalise(b) * dot(a, normalise(b))"},
    {"reject", {kVector, kVector}, true, "a - normalise(b) * dot(a, normalise(b))"},
    {"length", {kVector, kVector}, false, "length(a)"},
    {"normalise", {kVector, kVector}, false, "normalise(a)"},
    {"point", {kVector, scene::Type::matrix}, true, "b * a"},
    {"direction", {kVector, scene::Type::matrix}, true, "direction(b, a)"},
};

/// A plug under a name: of the type that is needed, or a matrix for a vector, whose origin counts.
/// Empty where it fits neither.
std::string operand(Builder& b, const char* name, scene::Type wanted, std::vector<Given>& given) {
  if (!b.with().has(name)) {
    b.fail(codes::kValueDoesNotFit, name, "the operation needs a second value");
    return {};
  }
  const Plug plug = b.with().plug(name);
  const auto type = b.scene().type(plug);
  given.emplace_back(std::string("_") + name, plug);
  if (type == wanted) return fmt::format("{0} = _{0};", name);
  if (type == scene::Type::matrix && wanted == kVector)
    return fmt::format("{0} = _{0}.origin;", name);
  b.fail(codes::kTypesDiffer, name,
         fmt::format("{} of {} is no {}", b.scene().plug_name(plug),
                     traversal::describe(b.scene(), plug.node), scene::name_of(wanted)));
  return {};
}

}  // namespace

void condition(Builder& b) {
  Terms term(b);
  const std::string condition = term("if");
  const std::string yes = term("then");
  const std::string no = term("else");
  term.make(condition + " ? " + yes + " : " + no);
}

void clamp(Builder& b) {
  Terms term(b);
  const std::string value = term("value");
  const std::string low = term("min");
  const std::string high = term("max");
  const double soft = b.with().number("soft");
  if (soft <= 0) return term.make("clamp(" + value + ", " + low + ", " + high + ")");
  // The smooth least of two: within `soft` of a bound the way to it slows down (a quarter of a
  // square each side of the corner), and never passes it.
  const auto least = [&](const std::string& a, const std::string& c) {
    return fmt::format("(min({0}, {1}) - max(0, {2} - abs({0} - {1})) ^ 2 / {3})", a, c,
                       literal(soft), literal(4 * soft));
  };
  const auto largest = [&](const std::string& a, const std::string& c) {
    return fmt::format("(max({0}, {1}) + max(0, {2} - abs({0} - {1})) ^ 2 / {3})", a, c,
                       literal(soft), literal(4 * soft));
  };
  term.make(largest(least(value, high), low));
}

void blend(Builder& b) {
  Terms term(b);
  const std::string from = term("from");
  const std::string into = term("into");
  const std::string weight = term("weight");
  const std::string share =
      b.with().flag("smooth") ? "smoothstep(0, 1, " + weight + ")" : "clamp(" + weight + ", 0, 1)";
  term.make("lerp(" + from + ", " + into + ", " + share + ")");
}

void vector_operation(Builder& b) {
  const std::string& name = b.with().text("operation");
  for (const Operation& operation : kOperations) {
    if (operation.name != name) continue;
    std::vector<Given> given;
    std::string program = operand(b, "a", operation.takes[0], given);
    if (operation.two && !b.failed()) program += " " + operand(b, "b", operation.takes[1], given);
    if (b.failed()) return;
    make_utility(b, given, program + " out output = " + std::string(operation.code) + ";");
  }
}

// Measured in a space, so that scaling the character changes nothing.
void distance(Builder& b) {
  const Parameters& with = b.with();
  const NodeId from = with.node("from"), to = with.node("to");
  if (!check_place(b, from, "from") || !check_place(b, to, "to")) return;
  const NodeId space = space_from(b, "space", root_control(b));
  if (b.failed()) return;
  const math::Affine into = math::inverse(rest_or_identity(b, space));
  const double at_rest = math::length(into * rest(b, to).origin - into * rest(b, from).origin);
  make_utility(b,
               {{"_from", from},
                {"_to", to},
                world_given("_space", space),
                {"_rest", scene::Value(at_rest)}},
               "_into = inverse(_space);"
               " out output = distance(_into * _from.origin, _into * _to.origin);"
               " out ratio = output / _rest; out change = output - _rest;");
}

}  // namespace rigc::modules
