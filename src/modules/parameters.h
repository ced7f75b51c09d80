// SPDX-License-Identifier: MIT
// A command's parameters, typed and with selectors resolved: what a constructor reads.
// Test: tests/modules/parameters_test.cpp
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "catalog/catalogue.h"
#include "tags/tags.h"
#include "traversal/resolve.h"

namespace rigc::modules {

using scene::NodeId;
using scene::Plug;

/// A formula and the plugs that `$0`, `$1`, ... stand for in it.
struct BoundExpression {
  std::string code;
  std::vector<Plug> plugs;
};

/// Values by parameter name. Asking for a name or type that the descriptor does not have is a bug
/// (asserted); what may be left out is asked for with `has` first.
class Parameters {
 public:
  using Value = std::variant<double, bool, std::string, math::Vec3, std::vector<double>,
                             std::vector<std::string>, std::vector<NodeId>, std::vector<Plug>,
                             std::vector<std::vector<double>>, BoundExpression, Literal>;

  bool has(std::string_view name) const;
  /// Whether a selector that may find nothing (`?`) was written and found nothing.
  bool found_nothing(std::string_view name) const;
  double number(std::string_view name) const;  ///< float, int, angle (degrees), length (rig units)
  bool flag(std::string_view name) const;
  const std::string& text(std::string_view name) const;  ///< string, enum
  math::Vec3 vec3(std::string_view name) const;  ///< vec3 (rig units where it has a unit), color
  const std::vector<double>& numbers(
      std::string_view name) const;  ///< floats; a curve: position, value, interpolation each
  const std::vector<std::string>& texts(std::string_view name) const;          ///< strings
  const std::vector<std::vector<double>>& table(std::string_view name) const;  ///< rows
  NodeId node(std::string_view name) const;                       ///< invalid where it was left out
  const std::vector<NodeId>& nodes(std::string_view name) const;  ///< empty where it was left out
  Plug plug(std::string_view name) const;
  const std::vector<Plug>& plugs(std::string_view name) const;
  const BoundExpression& expression(std::string_view name) const;
  const Literal& literal(std::string_view name) const;  ///< value
  Span span(std::string_view name) const;  ///< where it was written; the command's where it was not

 private:
  friend class Binder;
  template <class T>
  const T& get(std::string_view name) const;
  std::map<std::string, Value, std::less<>> values_;
  std::map<std::string, Span, std::less<>> spans_;
  std::set<std::string, std::less<>> empty_;
  Span command_;
};

/// A required selector that ends in `?` and is empty: the command is skipped.
struct Skipped {
  std::string parameter;
};

/// Binds a command's arguments (checked when the template was read) and the descriptor's defaults.
/// What a template pins was settled when it was read. `unit`: rig units of a
/// template's metre. `base`: where the descriptor lends another module's constructor, that
/// module's; its defaults stand in for parameters that the descriptor does not have.
std::optional<std::variant<Parameters, Skipped>> bind(const tags::CommandTag& command,
                                                      const catalog::Descriptor& descriptor,
                                                      double unit,
                                                      const traversal::Context& context,
                                                      Diagnostics& diagnostics,
                                                      const catalog::Descriptor* base = nullptr);

/// A colour's name or [r, g, b] as sRGB 0..1.
std::optional<math::Vec3> color_from(const Literal& literal);

}  // namespace rigc::modules
