// SPDX-License-Identifier: MIT
// pole_vector: gives the chain of an ik_handle a pole after the fact; the rest pose stays.
// Test: tests/modules/pole_vector_test.cpp
#include <fmt/format.h>

#include <optional>

#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

using math::Vec3;
namespace ik2 = scene::ik2;
namespace ik_chain = scene::ik_chain;

/// Sine of the angle between pole and line below which the pole says no side.
constexpr double kOnLine = 1e-3;

/// The inputs that both solvers have.
struct Solver {
  NodeId node;
  bool chain = false;  ///< ik_chain, which works in the space of the chain's base
  Plug pole, twist;
};

bool is_solver(const scene::Node& node) {
  return node.kind == scene::Kind::ik_two_bone || node.kind == scene::Kind::ik_chain;
}

/// The solver that a node is, or that its command made.
std::optional<Solver> solver_of(Builder& b, NodeId node) {
  const scene::Node& named = b.scene()[node];
  NodeId found = is_solver(named) ? node : NodeId{};
  if (!named.is_skeleton() && !found.valid()) {
    for (NodeId id : b.index().made_by(b.global(), named.module)) {
      const scene::Node& made = b.scene()[id];
      if (is_solver(made) && made.command == named.command) found = id;
    }
  }
  if (!found.valid()) {
    b.fail(codes::kNoSolver, "ik",
           fmt::format("{} has no IK solver", traversal::describe(b.scene(), node)),
           "name what ik_handle made, such as `./ik_handle.handle`");
    return std::nullopt;
  }
  const bool chain = b.scene()[found].kind == scene::Kind::ik_chain;
  return Solver{found,
                chain,
                {found, chain ? ik_chain::kPole : ik2::kPole},
                {found, chain ? ik_chain::kTwist : ik2::kTwist}};
}

/// Whether nobody but the solver's own command, as a stand-in, says where the chain bends to.
bool check_no_pole(Builder& b, const Solver& solver) {
  const auto source = b.scene().source(solver.pole);
  if (!source) return true;
  const scene::Node& pole = b.scene()[source->node];
  if (pole.identity.role == "space" && pole.command == b.scene()[solver.node].command) return true;
  b.fail(codes::kAlreadyDriven, "ik",
         fmt::format("{} bends toward {} already", traversal::describe(b.scene(), solver.node),
                     traversal::describe(b.scene(), source->node)),
         "move or constrain that, or make the chain with an ik_handle that has no `pole`");
  return false;
}

/// The turn is free, or that of a limb that swivels as it bends.
bool turns_alone(const Builder& b, const Solver& solver) {
  const auto source = b.scene().source(solver.twist);
  return source && b.scene()[source->node].command == b.scene()[solver.node].command;
}

/// A chain at rest as its solver sees it.
struct Bend {
  math::Affine to_solver;  ///< from rig space into the space in which the solver works
  Vec3 start, end;         ///< there
  Vec3 toward;             ///< from start, where it bends to; zero: a straight chain, to any side
};

Bend bend_of(const Builder& b, const Solver& solver) {
  const scene::Scene& scene = b.scene();
  const NodeId first = b.index().joint(scene[solver.node].identity.owner);
  Bend bend;
  if (!solver.chain) {
    const auto goal = std::get<math::Affine>(scene.value({solver.node, ik2::kGoal}));
    bend.start = position(b, first);
    bend.end = goal * std::get<Vec3>(scene.value({solver.node, ik2::kGoalOffset}));
    bend.toward = std::get<math::Affine>(scene.value(solver.pole)).origin - bend.start;
    return bend;
  }
  const NodeId base = scene[first].parent;
  if (base.valid()) bend.to_solver = math::inverse(rest(b, base));
  const auto count =
      static_cast<std::int32_t>(scene[solver.node].attributes[ik_chain::kTranslates].size());
  std::vector<Vec3> points;
  math::Quat turned;
  for (std::int32_t i = 0; i < count; ++i) {
    const auto step = std::get<Vec3>(scene.value({solver.node, ik_chain::kTranslates, i}));
    points.push_back((points.empty() ? Vec3{} : points.back()) + math::rotate(turned, step));
    turned = turned * std::get<math::Quat>(scene.value({solver.node, ik_chain::kRests, i}));
  }
  bend.start = points.front();
  bend.end = points.back();
  if (scene.source(solver.pole)) return bend;  // a stand-in: the chain is straight
  for (const Vec3& point : points) bend.toward = bend.toward + (point - bend.start);
  return bend;
}

/// Degrees about `axis` from the side on which `from` lies to that of `to`.
double angle_between(Vec3 axis, Vec3 from, Vec3 to) {
  const Vec3 a = math::cross(axis, from), c = math::cross(axis, to);
  return math::degrees(math::atan2(math::dot(math::cross(a, c), axis), math::dot(a, c)));
}

}  // namespace

void pole_vector(Builder& b) {
  const NodeId pole = b.with().node("pole");
  const auto solver = solver_of(b, b.with().node("ik"));
  if (!solver || !check_place(b, pole, "pole") || !check_no_pole(b, *solver)) return;
  const Bend bend = bend_of(b, *solver);
  const Vec3 line = math::normalised(bend.end - bend.start);
  const Vec3 to_pole = bend.to_solver * position(b, pole) - bend.start;
  if (math::length(math::cross(line, to_pole)) <= kOnLine * math::length(to_pole)) {
    b.fail(codes::kPoleOnLine, "pole",
           fmt::format("{} lies on the line from the chain's start to its end",
                       traversal::describe(b.scene(), pole)),
           "place it beside the chain, on the side to which it bends");
    return;
  }
  if (b.with().flag("maintain") && bend.toward != Vec3{}) {
    const double turn = angle_between(line, to_pole, bend.toward);
    if (turns_alone(b, *solver)) {
      const Computed turned = compute(b, b.joint(), "turn",
                                      {now(b, "own", solver->twist), {"more", scene::Value(turn)}},
                                      "out turn = own + more;");
      b.reconnect(turned["turn"], solver->twist);
    } else if (b.check_free(solver->twist, "ik")) {
      b.set(solver->twist, b.scene().number(solver->twist) + turn);
    } else {
      return;
    }
  }
  if (solver->chain) b.set({solver->node, ik_chain::kHasPole}, 1.0);
  b.set(solver->pole, rest(b, pole));
  b.reconnect(world_of(pole), solver->pole);
}

}  // namespace rigc::modules
