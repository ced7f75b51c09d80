// SPDX-License-Identifier: MIT
// pose_reader: how near a joint is to each of several poses, as weights that drive correctives.
// Cones: by the angle to each pose alone. Radial: an interpolation that gives 1 at its pose and 0
// at all others and at rest, over the chord between directions or rotations. Both are measured from
// rest in the space of another node, and equal poses of both sides mirror each other.
// Test: tests/modules/pose_reader_test.cpp
#include <fmt/format.h>

#include <cmath>

#include "modules/codes.h"
#include "modules/made.h"
#include "modules/registry.h"
#include "modules/utilities/utilities.h"

namespace rigc::modules {
namespace {

using math::Mat3;
using math::Vec3;

/// Poses whose chord (0 none, 1 half a turn) is shorter count as one.
constexpr double kDistinct = 0.01;

struct Reader {
  NodeId node, space;
  bool rotation = false;  ///< reads the whole rotation, else where the bone points
  /// Rotation from rest of each pose, in the axes of the space at rest.
  std::vector<Mat3> turns;
  Vec3 bone;  ///< direction at rest, in the axes of the space
  std::vector<std::string> names;
};

/// The joint that says where a node's bone points and on which side it is.
NodeId joint_of(const Builder& b, NodeId node) {
  const NodeId joint = owner(b, node);
  return joint.valid() ? joint : b.joint();
}

/// Left, up and forward of the character in the axes of the space at rest; on its right side x is
/// turned round: away from the middle on both sides.
Mat3 outward_axes(const Builder& b, NodeId joint, const Mat3& into) {
  const tags::Character& c = b.character();
  const Vec3 out = is_mirrored(b, joint) || side_of(b, joint) < 0 ? -c.left : c.left;
  return {math::normalised(into * out), math::normalised(into * c.up),
          math::normalised(into * c.forward)};
}

/// Angles about the axes as a rotation; about mirrored axes it is the mirror image.
Mat3 turned(const Mat3& axes, Vec3 degrees) {
  return axes * math::matrix(math::from_euler_degrees(degrees)) * math::transposed(axes);
}

/// Where the pose's rows point the bone, as the shortest rotation there.
Mat3 pointed(const Mat3& axes, Vec3 bone, Vec3 direction) {
  const Vec3 to = math::normalised(axes * direction, bone);
  return math::matrix(math::between(bone, to));
}

Reader reader_from(Builder& b) {
  const Parameters& with = b.with();
  Reader reader;
  reader.node = with.node("node");
  if (!check_place(b, reader.node, "node")) return reader;
  reader.space = space_or_parent(b, "space", reader.node);
  reader.rotation = with.text("reads") == "rotation";
  const auto& poses = with.table("poses");
  if (poses.front().size() != 3) {
    b.fail(codes::kTable, "poses", fmt::format("rows of {} numbers", poses.front().size()),
           "each pose is [out, up, forward] or three angles");
    return reader;
  }
  reader.names = names_from(b, poses.size());
  const Mat3 into = math::inverse(rest_or_identity(b, reader.space).linear);
  const NodeId joint = joint_of(b, reader.node);
  const Mat3 axes = outward_axes(b, joint, into);
  reader.bone = math::normalised(into * bone_direction(b, joint));
  for (const std::vector<double>& row : poses) {
    const Vec3 pose{row[0], row[1], row[2]};
    reader.turns.push_back(reader.rotation ? turned(axes, pose) : pointed(axes, reader.bone, pose));
  }
  return reader;
}

/// Chord between two poses: the sine of half the angle between them.
double chord(const Reader& reader, const Mat3& a, const Mat3& b) {
  if (!reader.rotation) return math::length(a * reader.bone - b * reader.bone) / 2;
  const Vec3 off{math::length(a.x - b.x), math::length(a.y - b.y), math::length(a.z - b.z)};
  return math::length(off) / math::sqrt(8);
}

/// Gauss and Jordan with pivots; the matrix is regular where its poses are distinct.
using Square = std::vector<std::vector<double>>;
Square inverse(Square a) {
  const std::size_t n = a.size();
  for (std::size_t row = 0; row < n; ++row) {
    a[row].resize(2 * n, 0);
    a[row][n + row] = 1;
  }
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < n; ++r)
      if (std::abs(a[r][c]) > std::abs(a[pivot][c])) pivot = r;
    std::swap(a[c], a[pivot]);
    for (std::size_t k = 2 * n; k-- > c;) a[c][k] /= a[c][c];
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      for (std::size_t k = 2 * n; k-- > c;) a[r][k] -= a[r][c] * a[c][k];
    }
  }
  for (std::vector<double>& row : a) row.erase(row.begin(), row.begin() + static_cast<int>(n));
  return a;
}

/// Statements that give the chord to each pose: c0, c1, ...; `way` is what turns a rest direction.
std::string chords(const Reader& reader, std::size_t count, std::vector<Given>& given) {
  std::string program;
  // Constants: where each pose takes the bone, or the axes.
  const Vec3 axes[] = {reader.rotation ? Vec3{1, 0, 0} : reader.bone, {0, 1, 0}, {0, 0, 1}};
  const std::size_t used = reader.rotation ? 3 : 1;
  for (std::size_t k = 0; k < used; ++k) {
    given.emplace_back(fmt::format("_a{}", k), scene::Value(axes[k]));
    program += fmt::format(" _n{0} = normalise(direction(_turned, _a{0}));", k);
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::string off;
    for (std::size_t k = 0; k < used; ++k) {
      given.emplace_back(fmt::format("_p{}_{}", i, k), scene::Value(reader.turns[i] * axes[k]));
      const std::string one = fmt::format("length(_n{1} - _p{0}_{1})", i, k);
      off = off.empty() ? one : fmt::format("hypot({}, {})", off, one);
    }
    program += fmt::format(" _c{} = {} / {};", i, off,
                           reader.rotation ? literal(math::sqrt(8)) : std::string("2"));
  }
  return program;
}

/// 1 within `inner` degrees of a pose and 0 from `angle` on, smoothly between.
std::string cones(Builder& b, std::size_t count) {
  std::string program;
  const double inner = b.with().number("inner"), angle = b.with().number("angle");
  for (std::size_t i = 0; i < count; ++i) {
    program += fmt::format(" _w{0} = 1 - smoothstep({1}, {2}, 2 * asin(_c{0}));", i, literal(inner),
                           literal(angle));
  }
  return program;
}

/// Multiquadrics of the chords: regular for any distinct poses (Micchelli 1986), smooth at them.
std::string radial(Builder& b, const Reader& reader, std::size_t count) {
  const double softness = b.with().number("softness");
  Square matrix(count, std::vector<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < count; ++k)
      matrix[i][k] = math::length({chord(reader, reader.turns[i], reader.turns[k]), softness, 0});
  }
  const Square solved = inverse(matrix);
  std::string program;
  for (std::size_t i = 0; i < count; ++i)
    program += fmt::format(" _f{0} = hypot(_c{0}, {1});", i, literal(softness));
  for (std::size_t i = 0; i < count; ++i) {
    std::string sum;
    for (std::size_t k = 0; k < count; ++k)
      sum += fmt::format("{}_f{} * {}", k ? " + " : "", k, literal(solved[i][k]));
    program += fmt::format(" _w{} = max(0, {});", i, sum);
  }
  return program;
}

bool check_distinct(Builder& b, const Reader& reader, std::size_t poses) {
  for (std::size_t i = 0; i < reader.turns.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (chord(reader, reader.turns[i], reader.turns[k]) > kDistinct) continue;
      const std::string other =
          i >= poses ? "the rest pose" : fmt::format("\"{}\"", reader.names[i]);
      b.fail(codes::kTable, "poses",
             fmt::format("\"{}\" and {} are one pose", reader.names[k], other));
      return false;
    }
  }
  return true;
}

}  // namespace

void pose_reader(Builder& b) {
  const Parameters& with = b.with();
  Reader reader = reader_from(b);
  if (b.failed()) return;
  if (with.number("inner") >= with.number("angle")) {
    b.fail(codes::kEmptyRange, "inner", "`inner` is not below `angle`");
    return;
  }
  const bool is_radial = with.text("method") == "radial";
  const std::size_t poses = reader.turns.size();
  if (is_radial && with.flag("rest")) reader.turns.emplace_back();
  if (is_radial && !check_distinct(b, reader, poses)) return;
  const std::size_t count = reader.turns.size();

  // What the node's axes at rest, in the space's, are turned to.
  const math::Affine seen = math::inverse(rest_or_identity(b, reader.space)) * rest(b, reader.node);
  std::vector<Given> given{{"_node", reader.node},
                           world_given("_space", reader.space),
                           {"_rest", scene::Value(math::Affine{math::inverse(seen.linear), {}})}};
  std::string program = "_turned = inverse(_space) * _node * _rest;" + chords(reader, count, given);
  program += is_radial ? radial(b, reader, count) : cones(b, count);
  const std::string sum = sum_of("_w", count);
  // Cones that do not overlap are left alone; radial weights add up to 1.
  const std::string all = !with.flag("normalise") ? "1"
                          : is_radial             ? "max(1e-9, " + sum + ")"
                                                  : "max(1, " + sum + ")";
  program += " _all = " + all + ";";
  for (std::size_t i = 0; i < poses; ++i)
    program += fmt::format(" out {} = _w{} / _all;", reader.names[i], i);
  const Computed made = make_utility(b, given, program);
  std::vector<Plug> weights;
  for (const std::string& name : reader.names) weights.push_back(made[name]);
  drive_plugs(b, weights, "to", "amounts");
}

}  // namespace rigc::modules
