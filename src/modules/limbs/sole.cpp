// SPDX-License-Identifier: MIT
// Measures of a sole. Test: tests/modules/foot_roll_test.cpp, tests/pipeline/soles_test.cpp
#include "modules/limbs/sole.h"

#include <fmt/format.h>

#include <algorithm>

#include "modules/codes.h"
#include "modules/made.h"

namespace rigc::modules {
namespace {

using math::Vec3;

// Proportions of a standing foot, in lengths of the foot and heights of the body. Source: Winter,
// Biomechanics and Motor Control of Human Movement, after Drillis and Contini 1966.
constexpr double kAnkleHeight = 0.039 / 0.152;
constexpr double kAnkleHeightOfBody = 0.039;
constexpr double kBreadth = 0.055 / 0.152;
/// Where ankle and ball stand between heel and tip.
constexpr double kAnkleAt = 0.25, kBallAt = 0.73;

/// Tilts beyond that at which the foot is looked at.
constexpr double kSteepest = 90, kSteepStep = 5;

/// Directions in which the outline is measured.
constexpr int kDirections = 72;

/// Angles, in degrees, at which a foot that rises over its toes is looked at; and how deep in the
/// ground nobody sees it, in lengths of the foot.
constexpr double kHingeStep = 1;
constexpr double kUnseen = 0.001;
/// Of a vertex whose weight is the toes' but for so little nothing sinks that one would see.
constexpr double kAllOfToes = 0.999;

bool moved_by_foot(const tags::BoundVertex& vertex) { return vertex.weight > 0.5; }

Vec3 flat(const Builder& b, Vec3 v) {
  const Vec3 up = b.character().up;
  return v - up * math::dot(v, up);
}

/// Where the foot points, level.
Vec3 heading(const Builder& b, const FootJoints& joints) {
  const NodeId front = joints.tip.valid() ? joints.tip : joints.ball;
  const Vec3 forward = math::normalised(flat(b, b.character().forward));
  if (!front.valid()) return forward;
  const Vec3 along = flat(b, position(b, front) - position(b, joints.ankle));
  return math::length(along) > 1e-3 * b.character().height ? math::normalised(along) : forward;
}

/// Height of the ground: the lowest vertex, else the lowest joint of the foot below the ankle, else
/// what is usual.
double ground(const Builder& b, const FootJoints& joints, const std::vector<Vec3>& vertices) {
  const Vec3 up = b.character().up;
  const double ankle = math::dot(up, position(b, joints.ankle));
  double lowest = ankle;
  for (const Vec3& vertex : vertices) lowest = std::min(lowest, math::dot(up, vertex));
  if (lowest < ankle) return lowest;
  for (const NodeId joint : {joints.ball, joints.tip, joints.heel}) {
    if (joint.valid()) lowest = std::min(lowest, math::dot(up, position(b, joint)));
  }
  if (lowest < ankle) return lowest;
  return ankle - kAnkleHeightOfBody * b.character().height;
}

/// Heel, tip and breadth from joints; what is missing as it is in most feet.
void measure_joints(const Builder& b, const FootJoints& joints, Sole& sole) {
  const math::Affine inward = math::inverse(sole.frame);
  const auto along = [&](NodeId joint) { return (inward * position(b, joint)).z; };
  const double ankle = along(joints.ankle);
  double length = (inward * position(b, joints.ankle)).y / kAnkleHeight;
  if (joints.tip.valid()) {
    length = (along(joints.tip) - ankle) / (1 - kAnkleAt);
  } else if (joints.ball.valid()) {
    length = (along(joints.ball) - ankle) / (kBallAt - kAnkleAt);
  }
  sole.heel = joints.heel.valid() ? along(joints.heel) : ankle - kAnkleAt * length;
  sole.tip = joints.tip.valid() ? along(joints.tip) : ankle + (1 - kAnkleAt) * length;
  sole.high = kBreadth / 2 * sole.length();
  sole.low = -sole.high;
}

/// How far the edge has to lie out in a direction (unit, level), so that no vertex gets into the
/// ground before the foot is tilted by so much. Vertices in the sole's frame.
double reach(const std::vector<Vec3>& vertices, Vec3 direction, double tilt = kEdgeTilt) {
  const double shrink = math::cos_degrees(tilt) / math::sin_degrees(tilt);
  double most = -1e300;
  for (const Vec3& v : vertices)
    most = std::max(most, v.x * direction.x + v.z * direction.z - v.y * shrink);
  return most;
}

/// Sole::lift that keeps every vertex above ground, whichever edge the foot stands on.
double steep_lift(const std::vector<Vec3>& vertices) {
  double lift = 0;
  for (const Vec3 direction : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}}) {
    const double edge = reach(vertices, direction);
    for (double tilt = kEdgeTilt + kSteepStep; tilt <= kSteepest; tilt += kSteepStep) {
      const double sinks = math::sin_degrees(tilt) * (reach(vertices, direction, tilt) - edge);
      lift = std::max(lift, sinks / math::sin_degrees(tilt - kEdgeTilt));
    }
  }
  return lift;
}

/// The roundest oval that holds the outline.
double fitting_power(const std::vector<Vec3>& vertices, const Sole& sole) {
  const double a = (sole.high - sole.low) / 2, c = sole.length() / 2;
  double power = 2;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 360.0 * i / kDirections;
    const Vec3 direction{math::sin_degrees(angle), 0, math::cos_degrees(angle)};
    const double out = reach(vertices, direction) - math::dot(sole.middle(), direction);
    const double x = a * std::abs(direction.x), z = c * std::abs(direction.z);
    const auto oval = [&](double q) { return math::pow(math::pow(x, q) + math::pow(z, q), 1 / q); };
    while (power > 1 && oval(power) < out) power = std::max(1.0, power - 0.05);
  }
  return power;
}

void measure_vertices(const std::vector<Vec3>& vertices, Sole& sole) {
  const math::Affine inward = math::inverse(sole.frame);
  std::vector<Vec3> seen;
  for (const Vec3& vertex : vertices) seen.push_back(inward * vertex);
  sole.heel = -reach(seen, {0, 0, -1});
  sole.tip = reach(seen, {0, 0, 1});
  sole.low = -reach(seen, {-1, 0, 0});
  sole.high = reach(seen, {1, 0, 0});
  sole.power = fitting_power(seen, sole);
  sole.lift = steep_lift(seen);
}

/// A place of the foot, and how much of it moves with the toes, 0..1.
struct Place {
  Vec3 at;
  double of_toes = 0;
};

/// Places of the foot with what of them stays behind with the toes: of vertices, else the tip where
/// there are no toes. Vertices of the toes are a subsequence of all: each is where it comes next.
std::vector<Place> shared_with_toes(const Builder& b, const FootJoints& joints, const Sole& sole,
                                    const std::vector<tags::BoundVertex>& all) {
  if (!joints.ball.valid() && all.empty()) return {{sole.frame * Vec3{0, 0, sole.tip}}};
  std::vector<tags::BoundVertex> toes;
  if (joints.ball.valid()) toes = b.vertices({joints.ball, joints.tip});
  const double same = 1e-5 * b.character().height;
  std::vector<Place> out;
  auto next = toes.begin();
  for (const tags::BoundVertex& vertex : all) {
    const bool shared = next != toes.end() && math::length(next->at - vertex.at) < same;
    if (moved_by_foot(vertex)) out.push_back({vertex.at, shared ? next->weight : 0});
    if (shared) ++next;
  }
  // Joints that are bound otherwise than they rest say nothing of one another's vertices.
  return next == toes.end() ? out : std::vector<Place>{};
}

/// How far the hinge has to slide so that what the toes do not move is never in the ground before
/// the ball: nowhere where nothing of the foot lies there, to the tip where the toes move nothing.
/// What they move in part sinks less by that part.
void measure_hinge(const std::vector<Place>& places, Sole& sole) {
  const math::Affine inward = math::inverse(sole.frame);
  for (double angle = kHingeStep; angle <= kEdgeTilt; angle += kHingeStep) {
    const double sine = math::sin_degrees(angle), rises = 1 - math::cos_degrees(angle);
    for (const Place& place : places) {
      if (place.of_toes > kAllOfToes) continue;
      const Vec3 v = inward * place.at;
      const double spare =
          (v.y + kUnseen * sole.length()) / (1 - place.of_toes) + (sole.ball - v.y) * rises;
      const double ahead = v.z - spare / sine;
      sole.hinge = std::max(sole.hinge, ahead);
      sole.hinge_slide = std::max(sole.hinge_slide, ahead / angle);
    }
  }
}

}  // namespace

FootJoints foot_joints(const Builder& b, NodeId ankle) {
  const Parameters& with = b.with();
  FootJoints joints{ankle, {}, {}, {}};
  if (with.has("toes")) joints.ball = owner(b, with.node("toes"));
  if (with.has("tip")) joints.tip = with.node("tip");
  if (with.has("heel")) joints.heel = with.node("heel");
  return joints;
}

Sole measure_sole(const Builder& b, const FootJoints& joints) {
  const Vec3 up = b.character().up, ahead = heading(b, joints);
  const auto moved = b.vertices({joints.ankle, joints.ball, joints.tip});
  std::vector<Vec3> vertices;
  for (const tags::BoundVertex& vertex : moved)
    if (moved_by_foot(vertex)) vertices.push_back(vertex.at);
  const double floor = ground(b, joints, vertices);
  const auto on_ground = [&](Vec3 p) { return p + up * (floor - math::dot(up, p)); };
  const Vec3 side = math::cross(up, ahead), ankle = position(b, joints.ankle);
  Sole sole;
  sole.frame = {{side, up, ahead}, on_ground(ankle)};
  sole.from = joints.ball.valid() || joints.tip.valid() ? Sole::From::guides : Sole::From::ankle;
  measure_joints(b, joints, sole);
  const Vec3 ball = joints.ball.valid() ? position(b, joints.ball)
                                        : ankle + ahead * (sole.heel + kBallAt * sole.length());
  sole.frame.origin = on_ground(ball);
  measure_joints(b, joints, sole);
  if (!vertices.empty()) {
    sole.from = Sole::From::vertices;
    measure_vertices(vertices, sole);
  }
  if (joints.ball.valid()) sole.ball = math::dot(up, ball) - floor;
  measure_hinge(shared_with_toes(b, joints, sole, moved), sole);
  sole.outward = (math::dot(side, b.character().left) > 0) == is_mirrored(b, joints.ankle) ? -1 : 1;
  return sole;
}

void report_sole(Builder& b, NodeId control, const Sole& sole) {
  scene::UserAttribute from;
  from.name = "sole_from";
  from.flavour = scene::UserAttribute::Flavour::integer;
  from.value = from.initial = static_cast<double>(sole.from);
  from.min = 0;
  from.max = 2;
  from.keyable = false;
  b.add_attribute(control, std::move(from));
  if (sole.from != Sole::From::ankle) return;
  b.warn(codes::kSoleGuessed, {},
         fmt::format("nothing says where the foot of {} touches the ground: it is as long as feet "
                     "are whose ankle is as high",
                     traversal::describe(b.scene(), control)),
         "name the joint at the end of the toes as `tip`");
}

}  // namespace rigc::modules
