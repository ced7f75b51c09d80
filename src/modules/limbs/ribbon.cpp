// SPDX-License-Identifier: MIT
// ribbon: joints pinned along a curve over a limb or spine, or on a surface of the model, with
// controls that bend it. Test: tests/modules/ribbon_test.cpp, tests/modules/ribbon_surface_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "modules/codes.h"
#include "modules/limbs/bone_riders.h"
#include "modules/limbs/curve.h"
#include "modules/limbs/share_weights.h"
#include "modules/limbs/surface_line.h"
#include "modules/registry.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

using math::Vec3;
namespace transform = scene::transform;
namespace constraint = scene::constraint;

/// Points of a surface's line that skins are told of.
constexpr int kTold = 64;

struct Ribbon {
  NodeId joint;                     ///< that what it makes belongs to
  std::vector<NodeId> along;        ///< what it lies over, first to last; or:
  std::optional<SurfaceLine> line;  ///< what it lies on
  NodeId space;                     ///< a control or transform that its controls hang under
  std::vector<NodeId> knots;        ///< what the curve passes through: the ends, and controls
  std::vector<NodeId> controls;
  std::vector<NodeId> pinned;  ///< joints of the model, or made ones
  std::vector<math::Affine> frames;
  std::vector<double> parts;  ///< of the length of `line`: where the pins are, rising
  bool made = false;

  bool goes_round() const { return line && line->closed(); }
  Plug twist_start, twist_end, stretch, volume, squash;
};

ControlSpec look(const Builder& b, NodeId joint, const math::Affine& frame, Vec3 direction) {
  ControlSpec spec;
  spec.joint = joint;
  spec.role = "tweak";
  spec.suffix = "bend";
  spec.shape = b.with().text("shape");
  spec.size = b.with().number("size");
  spec.color = side_color(b, joint, "color");
  spec.axes = AxesFrom::bone;
  spec.frame = frame;
  face(b, spec, "bone", direction);
  return spec;
}

ControlSpec look(const Builder& b, NodeId joint, Vec3 point, Vec3 direction) {
  return look(b, joint, {bone_frame(b, joint, direction), point}, direction);
}

/// An end of the curve: goes and turns with what lies there.
NodeId make_end(Builder& b, const Ribbon& ribbon, NodeId at) {
  return make_place(b, at, "end", ribbon.space, {character_axes(b), position(b, at)});
}

/// Controls on the way from one node to the next: they stay on the line between them, as far from
/// each as they rest, and turn with the first.
void make_bends(Builder& b, Ribbon& ribbon, std::size_t segment) {
  const NodeId first = ribbon.along[segment], second = ribbon.along[segment + 1];
  const auto count = static_cast<int>(b.with().number("bends"));
  for (int i = 1; i <= count; ++i) {
    const double part = static_cast<double>(i) / (count + 1);
    const Vec3 way = position(b, second) - position(b, first);
    ControlSpec spec =
        look(b, first, position(b, first) + way * part, math::normalised(way, b.character().up));
    spec.space = ribbon.space;
    const ControlNodes made = make_control(b, spec);
    if (b.failed()) return;
    const NodeId moves = make_constraint(b, scene::Kind::point_constraint, made.zero,
                                         {target(b, first), target(b, second)}, {1 - part, part},
                                         true, "space", first);
    b.connect({moves, constraint::kTranslate}, {made.zero, transform::kTranslate});
    const NodeId turns = make_constraint(b, scene::Kind::orient_constraint, made.zero,
                                         {target(b, first)}, {}, true, "space", first);
    b.connect({turns, constraint::kRotation}, {made.zero, transform::kRotation});
    ribbon.knots.push_back(made.control);
    ribbon.controls.push_back(made.control);
  }
}

void make_knots(Builder& b, Ribbon& ribbon) {
  for (std::size_t i = 0; i < ribbon.along.size(); ++i) {
    const NodeId at = ribbon.along[i];
    const bool last = i + 1 == ribbon.along.size();
    if (i == 0 || last) {
      const NodeId end = make_end(b, ribbon, at);
      ride(b, end, {target(b, at)}, {});
      ribbon.knots.push_back(end);
    } else {
      ControlSpec spec = look(b, at, position(b, at), chain_direction(b, ribbon.along, i));
      spec.space = ribbon.space;
      const ControlNodes made = make_control(b, spec);
      if (b.failed()) return;
      ride(b, made.zero, {target(b, at)}, {});
      ribbon.knots.push_back(made.control);
      ribbon.controls.push_back(made.control);
    }
    if (!last) make_bends(b, ribbon, i);
    if (b.failed()) return;
  }
}

/// x along the line and y off the surface; both turned round on a mirrored joint, as in bone_frame.
math::Affine frame_on(const Builder& b, const Ribbon& ribbon, double part) {
  const SurfacePlace place = ribbon.line->at(part);
  const double sign = is_mirrored(b, ribbon.joint) ? -1.0 : 1.0;
  return {math::frame(place.along * sign, place.normal * sign), place.point};
}

/// Controls at even places on the surface, at both ends too. Where it goes round the curve passes
/// through the last once more before the first, and through the first two after the last: so it
/// has no ends where it meets itself.
void make_knots_on_surface(Builder& b, Ribbon& ribbon) {
  const auto count = static_cast<int>(b.with().number("controls"));
  const int pieces = ribbon.goes_round() ? count : count - 1;
  for (int i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / pieces;
    ControlSpec spec =
        look(b, ribbon.joint, frame_on(b, ribbon, part), ribbon.line->at(part).along);
    spec.space = ribbon.space;
    ribbon.controls.push_back(make_control(b, spec).control);
    if (b.failed()) return;
  }
  ribbon.knots = ribbon.controls;
  if (!ribbon.goes_round()) return;
  ribbon.knots.insert(ribbon.knots.begin(), ribbon.controls.back());
  ribbon.knots.insert(ribbon.knots.end(), ribbon.controls.begin(), ribbon.controls.begin() + 2);
}

/// Where made joints are pinned, in parts of the ribbon's length.
std::vector<double> pin_parts(Builder& b, bool goes_round) {
  std::vector<double> parts;
  if (b.with().has("places")) {
    parts = b.with().numbers("places");
    std::sort(parts.begin(), parts.end());
    return parts;
  }
  const auto count = static_cast<int>(b.with().number("count"));
  const int pieces = goes_round ? count : count - 1;
  for (int i = 0; i < count; ++i)
    parts.push_back(count == 1 ? 0.5 : static_cast<double>(i) / pieces);
  return parts;
}

/// The node of those that the ribbon lies over below which a part of it lies.
std::size_t segment_of(const Builder& b, const Ribbon& ribbon, double part) {
  const std::vector<Vec3> points = positions(b, ribbon.along);
  double whole = 0, passed = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    whole += math::length(points[i + 1] - points[i]);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    passed += math::length(points[i + 1] - points[i]);
    if (part * whole < passed) return i;
  }
  return points.size() - 2;
}

/// Warns where a bone under the ribbon has joints that share its weights already.
void check_untwisted(Builder& b, const Ribbon& ribbon) {
  for (std::size_t i = 0; i + 1 < ribbon.along.size(); ++i)
    for (const NodeId child : b.scene()[ribbon.along[i]].children)
      if (b.scene()[child].identity.role == "twist" && !b.scene()[child].is_skeleton())
        return b.warn(codes::kTwistedBefore, "along",
                      fmt::format("{} has joints that share out its twist, and the ribbon's get "
                                  "none of it",
                                  traversal::describe(b.scene(), ribbon.along[i])),
                      "put `twist_joints` after the ribbon");
}

/// Each bone under the ribbon shares its weights with the joints made along it, and so do the
/// model's twist joints on it. At the bone's start is the bone's joint, unless one was made there.
void share_bones(Builder& b, const Ribbon& ribbon) {
  const std::vector<Vec3> points = positions(b, ribbon.along);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 bone = points[i + 1] - points[i];
    std::vector<NodeId> joints;
    std::vector<double> fractions{0};
    for (std::size_t k = 0; k < ribbon.pinned.size(); ++k) {
      if (b.scene()[ribbon.pinned[k]].parent != ribbon.along[i]) continue;
      const double at =
          math::dot(ribbon.frames[k].origin - points[i], bone) / math::dot(bone, bone);
      if (at < 1e-6) fractions.front() = -1;
      if (at >= 1e-6 && at <= fractions.back()) continue;
      joints.push_back(ribbon.pinned[k]);
      fractions.push_back(std::max(at, 0.0));
    }
    if (joints.empty()) continue;
    share_weights(b, ribbon.along[i], ribbon.along[i + 1], joints, fractions);
    fractions.erase(fractions.begin());
    for (const Rider& rider : riders_on(b, ribbon.along[i], ribbon.along[i + 1]))
      share_weights_on(b, rider.joint, "", {points[i], points[i + 1]}, joints, fractions);
  }
}

void make_pin(Builder& b, Ribbon& ribbon, NodeId parent, const math::Affine& frame) {
  const auto beside = std::count_if(ribbon.pinned.begin(), ribbon.pinned.end(), [&](NodeId other) {
    return b.scene()[other].parent == parent;
  });
  const NodeId pin = b.make({.kind = scene::Kind::joint,
                             .role = "joint",
                             .joint = parent,
                             .parent = parent,
                             .suffix = fmt::format("ribbon_{}", beside + 1)});
  const math::Trs local = math::decompose(math::inverse(rest(b, parent)) * frame);
  b.set({pin, transform::kTranslate}, local.translation);
  b.set({pin, transform::kRotation}, local.rotation);
  b.set({pin, transform::kScale}, local.scale);
  ribbon.pinned.push_back(pin);
  ribbon.frames.push_back(frame);
}

void make_pins(Builder& b, Ribbon& ribbon) {
  ribbon.made = true;
  const std::vector<Vec3> points = positions(b, ribbon.along);
  for (const double part : pin_parts(b, false)) {
    const std::size_t i = segment_of(b, ribbon, part);
    const NodeId parent = ribbon.along[i];
    const Vec3 way = math::normalised(points[i + 1] - points[i], b.character().up);
    make_pin(b, ribbon, parent,
             {bone_frame(b, parent, way), point_along(points, std::clamp(part, 0.0, 1.0))});
  }
  check_untwisted(b, ribbon);
  share_bones(b, ribbon);
}

/// The surface's vertices go with the pins beside them; where it goes round, those between the last
/// and the first with both.
void share_surface(Builder& b, const Ribbon& ribbon) {
  std::vector<Vec3> told;
  for (int i = 0; i < kTold; ++i)
    told.push_back(ribbon.line->at(static_cast<double>(i) / (kTold - 1)).point);
  std::vector<NodeId> joints = ribbon.pinned;
  std::vector<double> parts = ribbon.parts;
  if (ribbon.goes_round()) {
    joints.insert(joints.begin(), joints.back());
    parts.insert(parts.begin(), parts.back() - 1);
    joints.push_back(ribbon.pinned.front());
    parts.push_back(parts[1] + 1);
  }
  share_weights_on(b, ribbon.joint, b.with().text("surface"), told, joints, parts);
}

void make_pins_on_surface(Builder& b, Ribbon& ribbon) {
  ribbon.made = true;
  for (const double part : pin_parts(b, ribbon.goes_round())) {
    ribbon.parts.push_back(std::clamp(part, 0.0, 1.0));
    make_pin(b, ribbon, ribbon.joint, frame_on(b, ribbon, ribbon.parts.back()));
  }
  if (!ribbon.pinned.empty()) share_surface(b, ribbon);
}

/// The settings stand on the control in the middle.
void add_settings(Builder& b, Ribbon& ribbon) {
  const NodeId control = ribbon.controls[ribbon.controls.size() / 2];
  const auto angle = scene::UserAttribute::Flavour::angle;
  ribbon.twist_start = add_number(b, control, {.name = "twist_start", .flavour = angle});
  ribbon.twist_end = add_number(b, control, {.name = "twist_end", .flavour = angle});
  ribbon.stretch = add_number(b, control, {.name = "stretch", .value = 1, .min = 0, .max = 1});
  ribbon.volume = add_number(
      b, control, {.name = "volume", .value = b.with().number("volume"), .min = 0, .max = 1});
  ribbon.squash = add_number(b, control, {.name = "squash", .value = 0, .min = -0.9, .max = 10});
}

/// How much of the twist at a knot is that of the end: all of it at the end, or on the far side of
/// what goes round.
double twist_part(const Ribbon& ribbon, std::size_t knot) {
  const auto last = static_cast<double>(ribbon.knots.size() - 1);
  if (!ribbon.goes_round()) return static_cast<double>(knot) / last;
  const auto count = ribbon.controls.size();
  const auto place = static_cast<double>((knot + count - 1) % count);
  return 1 - std::abs(1 - 2 * place / static_cast<double>(count));
}

Curve ribbon_curve(Builder& b, const Ribbon& ribbon) {
  CurveSpec spec;
  spec.joint = ribbon.joint;
  spec.controls = ribbon.knots;
  spec.follows.assign(ribbon.knots.size(), 0.0);
  spec.places = ribbon.frames;
  // What goes round has a segment for each control, after the one that comes before the first.
  if (ribbon.goes_round())
    for (const double part : ribbon.parts)
      spec.parameters.push_back(1 + part * static_cast<double>(ribbon.controls.size()));
  spec.base = ribbon.space;
  const Curve curve = make_curve(b, spec);
  b.connect(formula(b, spec.joint, "preserve", "1 - $0", {ribbon.stretch}),
            {curve.node, scene::spline::kPreserve});
  const bool mirrored = is_mirrored(b, spec.joint);
  for (std::size_t i = 0; i < ribbon.knots.size(); ++i) {
    const double part = twist_part(ribbon, i);
    const std::string code =
        fmt::format("({:.17g} * $0 + {:.17g} * $1) * {}", 1 - part, part, mirrored ? "-1" : "1");
    const Plug twist =
        formula(b, spec.joint, "twist", code, {ribbon.twist_start, ribbon.twist_end});
    b.connect(twist, {curve.node, scene::spline::kTwists, static_cast<std::int32_t>(i)});
  }
  return curve;
}

/// Made joints are thinner across where the ribbon is longer; those of the model, whose axes are
/// theirs, as a whole.
void keep_volume(Builder& b, const Ribbon& ribbon, const Curve& curve) {
  const Computed sizes = compute(b, ribbon.joint, "volume",
                                 {{"long", curve.stretch},
                                  {"stretch", ribbon.stretch},
                                  {"volume", ribbon.volume},
                                  {"squash", ribbon.squash}},
                                 "ratio = max(1 + (long - 1) * stretch, 0.01);"
                                 "across = pow(ratio, -0.5 * volume) * (1 + squash);"
                                 "out across_bone = vector(1, across, across);"
                                 "out all = vector(across, across, across);");
  for (const NodeId joint : ribbon.pinned)
    scale_joint(b, joint, sizes[ribbon.made ? "across_bone" : "all"]);
}

bool lay_over_joints(Builder& b, Ribbon& ribbon) {
  ribbon.along = b.with().nodes("along");
  if (ribbon.along.size() < 2 || (ribbon.along.size() == 2 && b.with().number("bends") < 1)) {
    b.fail(codes::kTooFewJoints, "along",
           "a ribbon lies over at least two joints and has a control between its ends");
    return false;
  }
  ribbon.joint = ribbon.along.front();
  const NodeId named = space_from(b, "parent", root_control(b));
  if (b.failed() || !check_order(b, ribbon.along, "along")) return false;
  ribbon.space = stand_on(b, named, ribbon.joint);
  make_knots(b, ribbon);
  return !b.failed();
}

/// False too where the model does not have the surface.
bool lay_on_surface(Builder& b, Ribbon& ribbon) {
  const std::string& name = b.with().text("surface");
  const auto surface = b.surface(name);
  if (!surface) {
    b.warn(codes::kNoSurface, "surface",
           fmt::format("there is no mesh \"{}\" that a ribbon could lie on", printable(name)));
    return false;
  }
  std::string trouble = surface->trouble;
  if (trouble.empty()) {
    ribbon.line = line_on(*surface, b.with().text("direction"), b.with().number("row"));
    if (!ribbon.line) trouble = "its texture coordinates rise nowhere along it";
  }
  if (!ribbon.line) {
    b.fail(codes::kNoLine, "surface",
           fmt::format("mesh \"{}\" has no line that a ribbon could lie on", printable(name)),
           trouble);
    return false;
  }
  ribbon.joint = b.joint();
  const NodeId named = space_from(b, "parent", ribbon.joint);
  if (b.failed()) return false;
  ribbon.space = stand_on(b, named, ribbon.joint);
  make_knots_on_surface(b, ribbon);
  return !b.failed();
}

}  // namespace

void ribbon(Builder& b) {
  const Parameters& with = b.with();
  if (with.has("along") == with.has("surface")) {
    b.fail(codes::kAlongOrSurface, with.has("surface") ? "surface" : "",
           "a ribbon takes either `along` or `surface`");
    return;
  }
  Ribbon ribbon;
  if (!(with.has("surface") ? lay_on_surface(b, ribbon) : lay_over_joints(b, ribbon))) return;
  add_settings(b, ribbon);
  ribbon.pinned = with.nodes("joints");
  for (const NodeId joint : ribbon.pinned) {
    const math::Affine at = rest(b, joint);
    ribbon.frames.push_back({math::orthonormal(at.linear), at.origin});
    if (ribbon.line) ribbon.parts.push_back(ribbon.line->nearest(at.origin));
  }
  if (ribbon.pinned.empty() && ribbon.line)
    make_pins_on_surface(b, ribbon);
  else if (ribbon.pinned.empty())
    make_pins(b, ribbon);
  const Curve curve = ribbon_curve(b, ribbon);
  for (std::size_t k = 0; k < ribbon.pinned.size(); ++k) {
    if (!b.check_free({ribbon.pinned[k], transform::kRotation}, "joints")) return;
    ride(b, ribbon.pinned[k], {curve.outputs[k]}, {}, "driver");
  }
  keep_volume(b, ribbon, curve);
}

}  // namespace rigc::modules
