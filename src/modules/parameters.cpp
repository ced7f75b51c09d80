// SPDX-License-Identifier: MIT
// Binds arguments to parameters: literals to typed values, selectors to nodes and plugs.
// Test: tests/modules/parameters_test.cpp
#include "modules/parameters.h"

#include <fmt/format.h>

#include <cassert>

#include "base/text.h"
#include "traversal/codes.h"

namespace rigc::modules {

using catalog::Parameter;
using catalog::ParameterType;

template <class T>
const T& Parameters::get(std::string_view name) const {
  auto found = values_.find(name);
  assert(found != values_.end() && std::holds_alternative<T>(found->second));
  return std::get<T>(found->second);
}

bool Parameters::has(std::string_view name) const { return values_.find(name) != values_.end(); }
bool Parameters::found_nothing(std::string_view name) const {
  return empty_.find(name) != empty_.end();
}
double Parameters::number(std::string_view name) const { return get<double>(name); }
bool Parameters::flag(std::string_view name) const { return get<bool>(name); }
const std::string& Parameters::text(std::string_view name) const { return get<std::string>(name); }
math::Vec3 Parameters::vec3(std::string_view name) const { return get<math::Vec3>(name); }
const Literal& Parameters::literal(std::string_view name) const { return get<Literal>(name); }
Plug Parameters::plug(std::string_view name) const { return plugs(name).front(); }
const std::vector<Plug>& Parameters::plugs(std::string_view name) const {
  return get<std::vector<Plug>>(name);
}

const std::vector<double>& Parameters::numbers(std::string_view name) const {
  return get<std::vector<double>>(name);
}

const std::vector<std::string>& Parameters::texts(std::string_view name) const {
  return get<std::vector<std::string>>(name);
}

const std::vector<std::vector<double>>& Parameters::table(std::string_view name) const {
  return get<std::vector<std::vector<double>>>(name);
}

const BoundExpression& Parameters::expression(std::string_view name) const {
  return get<BoundExpression>(name);
}

const std::vector<NodeId>& Parameters::nodes(std::string_view name) const {
  static const std::vector<NodeId> kNone;
  return has(name) ? get<std::vector<NodeId>>(name) : kNone;
}

NodeId Parameters::node(std::string_view name) const {
  const auto& found = nodes(name);
  return found.empty() ? NodeId{} : found.front();
}

Span Parameters::span(std::string_view name) const {
  auto found = spans_.find(name);
  return found == spans_.end() ? command_ : found->second;
}

std::optional<math::Vec3> color_from(const Literal& literal) {
  if (literal.kind == Literal::Kind::text) {
    const auto named = catalog::named_color(literal.text);
    if (!named) return std::nullopt;
    return math::Vec3{(*named)[0], (*named)[1], (*named)[2]};
  }
  if (literal.items.size() != 3) return std::nullopt;
  return math::Vec3{literal.items[0].number, literal.items[1].number, literal.items[2].number};
}

namespace {

math::Vec3 vector_from(const Literal& literal) {
  return {literal.items[0].number, literal.items[1].number, literal.items[2].number};
}

double interpolation_code(const std::string& name) {
  constexpr std::string_view kNames[] = {"none", "linear", "smooth", "spline"};
  for (int i = 0; i < 4; ++i) {
    if (kNames[i] == name) return i;
  }
  return 1;
}

/// position, value, interpolation of each point, one after another.
std::vector<double> curve_from(const Literal& literal) {
  std::vector<double> points;
  for (const Literal& point : literal.items) {
    points.push_back(point.items[0].number);
    points.push_back(point.items[1].number);
    points.push_back(point.items.size() > 2 ? interpolation_code(point.items[2].text) : 1);
  }
  return points;
}

std::vector<double> numbers_from(const Literal& literal) {
  std::vector<double> numbers;
  for (const Literal& item : literal.items) numbers.push_back(item.number);
  return numbers;
}

std::vector<std::string> texts_from(const Literal& literal) {
  if (literal.kind == Literal::Kind::text) return {literal.text};
  std::vector<std::string> texts;
  for (const Literal& item : literal.items) texts.push_back(item.text);
  return texts;
}

bool takes_nodes(ParameterType type) {
  return type == ParameterType::node || type == ParameterType::nodes;
}
bool takes_one(ParameterType type) {
  return type == ParameterType::node || type == ParameterType::plug;
}

const Literal* default_of(const Parameter& parameter) {
  return parameter.default_value ? &*parameter.default_value : nullptr;
}

}  // namespace

class Binder {
 public:
  Binder(double unit, const traversal::Context& context, Diagnostics& diagnostics)
      : unit_(unit), context_(context), diagnostics_(diagnostics) {}

  std::optional<std::variant<Parameters, Skipped>> bind(const tags::CommandTag& command,
                                                        const catalog::Descriptor& descriptor,
                                                        const catalog::Descriptor* base) {
    out_.command_ = command.span;
    bool good = true;
    for (const Parameter& parameter : descriptor.parameters) {
      const Literal* written = command.find(parameter.name);
      const Literal* value = written ? written : default_of(parameter);
      const Span span = written && written->span.known() ? written->span : command.span;
      out_.spans_[parameter.name] = span;
      fallback_ = written ? default_of(parameter) : nullptr;
      if (value && !bind(parameter, *value, span)) good = false;
    }
    if (base) good = bind_defaults(*base, descriptor) && good;
    if (!good) return std::nullopt;
    if (skipped_) return std::move(*skipped_);
    return std::move(out_);
  }

 private:
  /// Defaults of the module whose constructor runs, for parameters that `descriptor` does not have.
  bool bind_defaults(const catalog::Descriptor& base, const catalog::Descriptor& descriptor) {
    bool good = true;
    for (const Parameter& parameter : base.parameters) {
      if (descriptor.find(parameter.name) || !parameter.default_value) continue;
      good = bind(parameter, *parameter.default_value, out_.command_) && good;
    }
    return good;
  }

  bool bind(const Parameter& parameter, const Literal& value, const Span& span) {
    auto& slot = out_.values_;
    const bool metres = parameter.unit == "metre";
    switch (parameter.type) {
      case ParameterType::number:
      case ParameterType::integer:
      case ParameterType::angle:
        slot[parameter.name] = value.number;
        return true;
      case ParameterType::length:
        slot[parameter.name] = value.number * unit_;
        return true;
      case ParameterType::boolean:
        slot[parameter.name] = value.flag;
        return true;
      case ParameterType::enumeration:
      case ParameterType::text:
        slot[parameter.name] = value.text;
        return true;
      case ParameterType::vec3:
        slot[parameter.name] = vector_from(value) * (metres ? unit_ : 1.0);
        return true;
      case ParameterType::color:
        slot[parameter.name] = color_from(value).value_or(math::Vec3{});
        return true;
      case ParameterType::numbers:
        slot[parameter.name] = numbers_from(value);
        return true;
      case ParameterType::texts:
        slot[parameter.name] = texts_from(value);
        return true;
      case ParameterType::table: {
        std::vector<std::vector<double>> rows;
        for (const Literal& row : value.items) rows.push_back(numbers_from(row));
        slot[parameter.name] = std::move(rows);
        return true;
      }
      case ParameterType::curve:
        slot[parameter.name] = curve_from(value);
        return true;
      case ParameterType::value:
        slot[parameter.name] = value;
        return true;
      case ParameterType::expression:
        return bind_expression(parameter, value, span);
      default:
        return bind_selectors(parameter, value, span);
    }
  }

  bool bind_selectors(const Parameter& parameter, const Literal& value, const Span& span) {
    std::vector<NodeId> nodes;
    std::vector<Plug> plugs;
    bool absent = false;
    const bool list = value.kind == Literal::Kind::list;
    const std::size_t count = list ? value.items.size() : 1;
    for (std::size_t i = 0; i < count; ++i) {
      const Literal& item = list ? value.items[i] : value;
      const auto selector =
          selector::parse(item.text, item.span.known() ? item.span : span, diagnostics_);
      if (!selector) return false;
      auto found = traversal::resolve(*selector, context_, diagnostics_);
      if (!found) return false;
      if (takes_one(parameter.type) && !exactly_one(parameter, *selector, *found)) return false;
      if (!kinds_fit(parameter, *selector, *found)) return false;
      absent = absent || found->absent_rig;
      nodes.insert(nodes.end(), found->nodes.begin(), found->nodes.end());
      plugs.insert(plugs.end(), found->plugs.begin(), found->plugs.end());
    }
    if (nodes.empty() && absent && fallback_) {
      return bind_selectors(parameter, *std::exchange(fallback_, nullptr), span);
    }
    if (nodes.empty()) {
      if (!parameter.optional()) skipped_ = Skipped{parameter.name};
      out_.empty_.insert(parameter.name);
      return true;
    }
    if (takes_nodes(parameter.type)) {
      out_.values_[parameter.name] = std::move(nodes);
    } else {
      out_.values_[parameter.name] = std::move(plugs);
    }
    return true;
  }

  bool exactly_one(const Parameter& parameter, const selector::Selector& selector,
                   const traversal::Found& found) {
    if (found.nodes.size() <= 1) return true;
    std::vector<std::string> candidates;
    for (NodeId id : found.nodes) {
      if (candidates.size() == 8) {
        candidates.push_back("...");
        break;
      }
      candidates.push_back(traversal::describe(context_.scene, id));
    }
    diagnostics_.report(traversal::codes::kSeveralFound, selector.span,
                        fmt::format("\"{}\" takes one node, but \"{}\" finds {}", parameter.name,
                                    print(selector), found.nodes.size()),
                        "one of " + join(candidates, ", "));
    return false;
  }

  bool kinds_fit(const Parameter& parameter, const selector::Selector& selector,
                 const traversal::Found& found) {
    if (parameter.kind.empty()) return true;
    const auto kind = scene::parse_kind(parameter.kind);
    for (NodeId id : found.nodes) {
      if (kind && context_.scene[id].kind == *kind) continue;
      diagnostics_.report(
          traversal::codes::kWrongKind, selector.span,
          fmt::format("\"{}\" takes {}s, but \"{}\" finds {}", parameter.name, parameter.kind,
                      print(selector), traversal::describe(context_.scene, id)));
      return false;
    }
    return true;
  }

  bool bind_expression(const Parameter& parameter, const Literal& value, const Span& span) {
    const std::string text =
        value.kind == Literal::Kind::number ? number_text(value.number) : value.text;
    const auto expression = selector::parse_expression(text, span, diagnostics_);
    if (!expression) return false;
    BoundExpression bound;
    for (std::size_t i = 0; i < expression->pieces.size(); ++i) {
      if (i > 0) bound.code += fmt::format("${}", i - 1);
      bound.code += expression->pieces[i];
    }
    for (const selector::Selector& selector : expression->selectors) {
      auto found = traversal::resolve(selector, context_, diagnostics_);
      if (!found || !exactly_one(parameter, selector, *found)) return false;
      if (found->plugs.empty()) {
        skipped_ = Skipped{parameter.name};
        return true;
      }
      if (context_.scene.type(found->plugs.front()) != scene::Type::number) {
        diagnostics_.report(traversal::codes::kNotANumber, selector.span,
                            fmt::format("\"{}\" is no number", print(selector)),
                            "name a component, for example @translate.x");
        return false;
      }
      bound.plugs.push_back(found->plugs.front());
    }
    out_.values_[parameter.name] = std::move(bound);
    return true;
  }

  double unit_;
  const traversal::Context& context_;
  Diagnostics& diagnostics_;
  Parameters out_;
  std::optional<Skipped> skipped_;
  const Literal* fallback_ = nullptr;  ///< default that stands in for a selector of an absent rig
};

std::optional<std::variant<Parameters, Skipped>> bind(
    const tags::CommandTag& command, const catalog::Descriptor& descriptor, double unit,
    const traversal::Context& context, Diagnostics& diagnostics, const catalog::Descriptor* base) {
  return Binder(unit, context, diagnostics).bind(command, descriptor, base);
}

}  // namespace rigc::modules
