// SPDX-License-Identifier: MIT
// driven_key: attributes that follow another one through curves, all keyed in one table. Commands
// for several drivers add up.
// Test: tests/modules/driven_key_test.cpp
#include <fmt/format.h>

#include "modules/attributes/plugs.h"
#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/utilities/utilities.h"

namespace rigc::modules {
namespace {

using Table = std::vector<std::vector<double>>;

/// Rows of the driver's value and one for each driven plug; the driver's rise.
bool check_keys(Builder& b, const Table& keys, std::size_t driven) {
  std::string wrong;
  if (keys.size() < 2) wrong = "one row says nothing between two";
  if (keys.front().size() != driven + 1)
    wrong = fmt::format("rows of {} numbers for a driver and {} driven plugs", keys.front().size(),
                        driven);
  for (std::size_t row = 1; row < keys.size(); ++row) {
    if (keys[row][0] <= keys[row - 1][0]) wrong = "the driver's values do not rise";
  }
  if (wrong.empty()) return true;
  b.fail(codes::kTable, "keys", wrong, "each row is [driver, driven, driven, ...]");
  return false;
}

double interpolation(const std::string& name) {
  return name == "none" ? 0 : name == "linear" ? 1 : name == "smooth" ? 2 : 3;
}

/// A curve over the driver, through one column of the table.
Plug curve(Builder& b, const Plug& driver, const Table& keys, std::size_t column) {
  namespace remap = scene::remap;
  const NodeId node = b.make({.kind = scene::Kind::remap,
                              .role = "utility",
                              .joint = {},
                              .parent = {},
                              .suffix = "driven_key"});
  const double first = keys.front()[0], last = keys.back()[0];
  const double kind = interpolation(b.with().text("interpolation"));
  std::vector<double> points;
  for (const std::vector<double>& row : keys)
    points.insert(points.end(), {(row[0] - first) / (last - first), row[column], kind});
  b.set({node, remap::kInputMin}, first);
  b.set({node, remap::kInputMax}, last);
  b.set({node, remap::kPoints}, points);
  b.set({node, remap::kClamp}, b.with().flag("clamp") ? 1.0 : 0.0);
  b.connect(driver, {node, remap::kInput});
  return {node, remap::kOutput};
}

/// What the curve says on top of what drives the plug already, or of its value.
void add(Builder& b, const Plug& value, const Plug& to) {
  if (const auto source = b.scene().source(to)) {
    b.reconnect(formula(b, {}, "sum", "$0 + $1", {*source, value}, "utility"), to);
    return;
  }
  if (!b.check_free(to, "driven")) return;
  const std::string code = literal(b.scene().number(to)) + " + $0";
  b.connect(formula(b, {}, "sum", code, {value}, "utility"), to);
}

}  // namespace

void driven_key(Builder& b) {
  const Parameters& with = b.with();
  const Plug driver = with.plug("driver");
  const std::vector<Plug>& driven = with.plugs("driven");
  const Table& keys = with.table("keys");
  if (!check_number(b, driver, "driver") || !check_keys(b, keys, driven.size())) return;
  for (std::size_t i = 0; i < driven.size(); ++i) {
    if (!check_input(b, driven[i], "driven") || !check_number(b, driven[i], "driven")) return;
    const Plug value = curve(b, driver, keys, i + 1);
    if (with.flag("add")) {
      add(b, value, driven[i]);
    } else {
      b.connect(value, driven[i]);
    }
  }
}

}  // namespace rigc::modules
