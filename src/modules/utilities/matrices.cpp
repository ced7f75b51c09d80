// SPDX-License-Identifier: MIT
// Modules that make a transform whose world is computed from others: aim_matrix, blend_matrix,
// multiply_matrix, pick_matrix, hold_matrix, compose. Other commands follow the transform or read
// its `@world`.
// Test: tests/modules/matrices_test.cpp
#include <fmt/format.h>

#include "modules/attributes/plugs.h"
#include "modules/codes.h"
#include "modules/constraints/weights.h"
#include "modules/registry.h"
#include "modules/utilities/utilities.h"

namespace rigc::modules {
namespace {

using math::Affine;
using math::Vec3;

/// A node parameter with a place in space; invalid where it was left out or fails.
NodeId place_from(Builder& b, std::string_view parameter) {
  return space_from(b, parameter, NodeId{});
}

Vec3 origin_of(const Builder& b, NodeId node) { return rest(b, node).origin; }

/// `out world` of a program with one or both of its parts from `_from` where `parts` say so, the
/// others from `_other`.
std::string parted(const Builder& b, const std::string& from, const std::string& other) {
  const auto one = [&](const char* flag, const std::string& part) {
    const std::string& taken = b.with().flag(flag) ? from : other;
    return fmt::format(fmt::runtime(part), taken);
  };
  return fmt::format("compose({}, {}, {})", one("translate", "{}.origin"),
                     one("rotate", "rotation({})"), one("scale", "scale({})"));
}

Affine parted(const Builder& b, const Affine& from, const Affine& other) {
  math::Trs trs = math::decompose(other);
  const math::Trs taken = math::decompose(from);
  if (b.with().flag("translate")) trs.translation = taken.translation;
  if (b.with().flag("rotate")) trs.rotation = taken.rotation;
  if (b.with().flag("scale")) trs.scale = taken.scale;
  return math::compose(trs);
}

}  // namespace

// The frame at a node with x toward another node and y leaning to a third one, or to a direction of
// the character that turns with a space. With `maintain` it stands as the node does at rest.
void aim_matrix(Builder& b) {
  const Parameters& with = b.with();
  const NodeId at = place_from(b, "at"), primary = place_from(b, "primary");
  const NodeId secondary = place_from(b, "secondary"), space = place_from(b, "up_space");
  if (b.failed()) return;
  const Vec3 origin = origin_of(b, at);
  const Vec3 up = character_direction(b, with.text("up"));
  const Vec3 toward = secondary.valid() ? origin_of(b, secondary) - origin : up;
  const Vec3 x = math::normalised(origin_of(b, primary) - origin);
  const Affine aimed{math::frame(x, toward), origin};
  const Affine at_rest{math::orthonormal(rest(b, at).linear), origin};
  const Affine own = with.flag("maintain") ? math::inverse(aimed) * at_rest : Affine{};

  std::vector<Given> given{{"_at", at}, {"_primary", primary}, {"_own", scene::Value(own)}};
  std::string up_code = "_secondary.origin - _at.origin";
  if (secondary.valid()) {
    given.emplace_back("_secondary", secondary);
  } else {
    given.push_back(world_given("_space", space));
    const Affine into = math::inverse(rest_or_identity(b, space));
    given.emplace_back("_up", scene::Value(into.linear * up));
    up_code = "direction(_space, _up)";
  }
  // Its size is the node's: what the character is scaled by.
  const math::Vec3 size = math::decompose(rest(b, at)).scale;
  given.emplace_back("_size", scene::Value(Vec3{1 / size.x, 1 / size.y, 1 / size.z}));
  make_result(b, given,
              "_turn = aim(_primary.origin - _at.origin, " + up_code +
                  ");"
                  " _frame = frame(_at.origin, _turn) * _own;"
                  " out world = compose(_frame.origin, rotation(_frame),"
                  " multiply(scale(_at), _size));",
              aimed * own);
}

// Each node takes over from the ones before by its weight.
void blend_matrix(Builder& b) {
  const std::vector<NodeId>& nodes = b.with().nodes("targets");
  const std::vector<Target> targets = constraint_targets(b);
  const std::vector<double> weights = constraint_weights(b, nodes.size());
  if (b.failed()) return;
  std::vector<Given> given{{"_m0", nodes[0]}};
  std::string program;
  Affine blended = targets[0].rest;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    given.emplace_back(fmt::format("_m{}", i), nodes[i]);
    given.emplace_back(fmt::format("_t{}", i), scene::Value(weights[i]));
    program += fmt::format(
        " _w{0} = clamp(_t{0}, 0, 1);"
        " _b{0} = compose(lerp({1}.origin, _m{0}.origin, _w{0}),"
        " slerp(rotation({1}), rotation(_m{0}), _w{0}), lerp(scale({1}), scale(_m{0}), _w{0}));",
        i, i == 1 ? std::string("_m0") : fmt::format("_b{}", i - 1));
    const math::Trs from = math::decompose(blended), to = math::decompose(targets[i].rest);
    const double t = weights[i];
    blended = math::compose({from.translation + (to.translation - from.translation) * t,
                             math::slerp(from.rotation, to.rotation, t),
                             from.scale + (to.scale - from.scale) * t});
  }
  const std::string last = nodes.size() == 1 ? "_m0" : fmt::format("_b{}", nodes.size() - 1);
  program += " out world = " + parted(b, last, std::string("_m0")) + ";";
  const std::vector<Plug> plugs = weight_attributes(b, weights);
  if (b.failed()) return;
  for (std::size_t i = 1; i < plugs.size(); ++i) {
    for (Given& each : given) {
      if (each.name == fmt::format("_t{}", i)) each.from = plugs[i];
    }
  }
  make_result(b, given, program, parted(b, blended, targets[0].rest));
}

// What a node does seen from another one, done again under a third.
void multiply_matrix(Builder& b) {
  const NodeId node = place_from(b, "node"), from = place_from(b, "from"),
               under = place_from(b, "under");
  if (b.failed()) return;
  make_result(
      b, {{"_node", node}, world_given("_from", from), world_given("_under", under)},
      "out world = _under * inverse(_from) * _node;",
      rest_or_identity(b, under) * math::inverse(rest_or_identity(b, from)) * rest(b, node));
}

// Some parts of a node's world, the others as they rest or from another node.
void pick_matrix(Builder& b) {
  const NodeId node = place_from(b, "node"), other = place_from(b, "otherwise");
  if (b.failed()) return;
  const Given otherwise =
      other.valid() ? Given{"_other", other} : Given{"_other", scene::Value(rest(b, node))};
  make_result(b, {{"_node", node}, otherwise},
              "out world = " + parted(b, std::string("_node"), std::string("_other")) + ";",
              parted(b, rest(b, node), rest(b, other.valid() ? other : node)));
}

// Where a node rests, held in a space whatever the node does.
void hold_matrix(Builder& b) {
  const NodeId node = place_from(b, "node");
  const NodeId space = space_from(b, "space", root_control(b));
  if (b.failed()) return;
  const NodeId held = b.make({.kind = scene::Kind::transform,
                              .role = "transform",
                              .joint = {},
                              .parent = {},
                              .suffix = ""});
  hang(b, held, space, rest(b, node));
}

// A matrix of parts that attributes give.
void compose(Builder& b) {
  const Parameters& with = b.with();
  const NodeId under = place_from(b, "under");
  if (b.failed()) return;
  std::vector<Given> given{world_given("_under", under)};
  math::Trs trs;
  const auto part = [&](const char* name, Vec3 otherwise) {
    if (!with.has(name)) {
      given.emplace_back(std::string("_") + name, scene::Value(otherwise));
      return otherwise;
    }
    const Plug plug = with.plug(name);
    if (b.scene().type(plug) != scene::Type::vec3) {
      b.fail(codes::kTypesDiffer, name,
             fmt::format("{} of {} is no vector", b.scene().plug_name(plug),
                         traversal::describe(b.scene(), plug.node)));
      return otherwise;
    }
    given.emplace_back(std::string("_") + name, plug);
    return std::get<Vec3>(b.scene().value(plug));
  };
  trs.translation = part("translate", {});
  trs.rotation = math::from_euler_degrees(part("rotate", {}));
  trs.scale = part("scale", {1, 1, 1});
  if (b.failed()) return;
  make_result(b, given, "out world = _under * compose(_translate, euler(_rotate), _scale);",
              rest_or_identity(b, under) * math::compose(trs));
}

}  // namespace rigc::modules
