// SPDX-License-Identifier: MIT
// Finds the space of each skin's inverse bind matrices and places its joints.
// Test: tests/gltf/skeletons_test.cpp
#include "gltf/bind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "gltf/accessor.h"
#include "gltf/codes.h"

namespace rigc::gltf {
namespace {

using math::Affine;
using math::Trs;

/// Differences of less than this, summed over scale, place and rotation, are a tie.
constexpr double kTie = 1e-3;

struct Candidate {
  const char* name;
  Affine space;  ///< ancestor space from the space of the inverse bind matrices
};

Affine affine(const float* m) {
  Affine a;
  a.linear = {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}};
  a.origin = {m[12], m[13], m[14]};
  return a;
}

/// Whether the last row of a matrix is 0 0 0 1, but for rounding.
bool is_affine(const float* m) {
  constexpr float kRounding = 1e-4f;
  return std::abs(m[3]) <= kRounding && std::abs(m[7]) <= kRounding &&
         std::abs(m[11]) <= kRounding && std::abs(m[15] - 1) <= kRounding;
}

/// Logarithm of the mean scale; the determinant must not be 0.
double log_scale(const Affine& a) { return math::log(std::abs(math::determinant(a.linear))) / 3; }

/// Angle between two rotations as a part of a half turn, 0..1.
double turn(const Affine& a, const Affine& b) {
  const auto p = math::quaternion(math::orthonormal(a.linear));
  const auto q = math::quaternion(math::orthonormal(b.linear));
  return 2 * math::acos(std::min(1.0, std::abs(math::dot(p, q)))) / math::kPi;
}

bool uses_quantisation(const File& file) {
  for (const json::Value& name : file.root()["extensionsUsed"].items())
    if (name.string() == "KHR_mesh_quantization") return true;
  return false;
}

class BindReader {
 public:
  BindReader(const File& file, const Slim& slim, const BindContext& context, int ancestor,
             std::vector<std::string>& notes, Diagnostics& diagnostics)
      : file_(file),
        slim_(slim),
        context_(context),
        ancestor_(ancestor),
        quantised_(uses_quantisation(file)),
        notes_(notes),
        diagnostics_(diagnostics) {}

  void add(int skin) {
    const SlimSkin& source = slim_.skins[static_cast<std::size_t>(skin)];
    if (source.matrices < 0) {
      notes_.push_back(fmt::format(
          "skin {} has no inverse bind matrices: its joints rest as their nodes stand", skin));
      return;
    }
    const auto floats =
        read_floats(file_, slim_, source.matrices, source.joints.size(), diagnostics_);
    if (!floats) return;
    std::vector<Affine> matrices;
    for (std::size_t i = 0; i < source.joints.size(); ++i) {
      const float* numbers = floats->data() + 16 * i;
      const Affine inverse_bind = affine(numbers);
      const double determinant = math::determinant(inverse_bind.linear);
      if (!(std::abs(determinant) > 1e-30))
        report(codes::kBindSingular, skin, i, "has determinant 0");
      else if (!is_affine(numbers))
        report(codes::kNotAffine, skin, i, "has another last row than 0 0 0 1");
      matrices.push_back(math::inverse(inverse_bind));
    }
    place(skin, matrices);
  }

  std::map<int, Affine> take() { return std::move(bind_); }

 private:
  void report(const Code& code, int skin, std::size_t matrix, const char* what) {
    const int joint = slim_.skins[static_cast<std::size_t>(skin)].joints[matrix];
    diagnostics_.report(code, Place(file_.path, fmt::format("/skins/{}/inverseBindMatrices", skin)),
                        fmt::format("matrix {} of skin {} (node {}) {}", matrix, skin, joint, what),
                        "`--rest nodes` takes the pose in which the nodes stand");
  }

  void place(int skin, const std::vector<Affine>& matrices) {
    const std::vector<int>& joints = slim_.skins[static_cast<std::size_t>(skin)].joints;
    Affine space;
    const auto shared = std::find_if(joints.begin(), joints.end(),
                                     [&](int joint) { return bind_.count(joint) != 0; });
    if (shared != joints.end()) {
      const auto index = static_cast<std::size_t>(shared - joints.begin());
      space = bind_[*shared] * math::inverse(matrices[index]);
    } else {
      space = choose(skin, matrices);
    }
    for (std::size_t i = 0; i < joints.size(); ++i) bind_.emplace(joints[i], space * matrices[i]);
  }

  /// Rest of a node above the skin that is being placed: as it stands, seen from the nearest joint
  /// if that is placed, else from the ancestor.
  Affine rest(int node, int joint_above) const {
    if (node < 0) return {};
    const auto known = bind_.find(joint_above);
    const Affine from = known != bind_.end() ? known->second : Affine();
    const int base = known != bind_.end() ? joint_above : ancestor_;
    return base == node ? from : from * math::inverse(slim_.world(base)) * slim_.world(node);
  }

  std::vector<Candidate> candidates(int skin) const {
    const Affine from_scene = math::inverse(slim_.world(ancestor_));
    std::vector<Candidate> list = {{"the scene", from_scene}};
    list.push_back({"the skeleton's ancestor", Affine()});
    const int mesh = context_.mesh_nodes[static_cast<std::size_t>(skin)];
    if (mesh >= 0) list.push_back({"the mesh node", from_scene * slim_.world(mesh)});
    return list;
  }

  int joint_above(int joint) const { return context_.above[static_cast<std::size_t>(joint)]; }

  /// Indices of joints whose nearest joint above is not of the same skin.
  std::vector<std::size_t> topmost(const std::vector<int>& joints) const {
    const std::set<int> all(joints.begin(), joints.end());
    std::vector<std::size_t> tops;
    for (std::size_t i = 0; i < joints.size(); ++i)
      if (all.count(joint_above(joints[i])) == 0) tops.push_back(i);
    return tops;
  }

  /// How much a topmost joint differs from its node, seen from its parent.
  double difference(const Affine& bind, const Affine& node, double size) const {
    const double rotation = turn(bind, node);
    if (quantised_) return rotation;
    const double place = math::length(bind.origin - node.origin) / size;
    // A node may be hidden by scale 0 where its clip begins.
    const bool scaled = std::abs(math::determinant(node.linear)) > 1e-30;
    return (scaled ? std::abs(log_scale(bind) - log_scale(node)) : 0) + std::min(place, 1.0) +
           rotation;
  }

  Affine choose(int skin, const std::vector<Affine>& matrices) {
    const std::vector<int>& joints = slim_.skins[static_cast<std::size_t>(skin)].joints;
    const std::vector<std::size_t> tops = topmost(joints);
    const auto parent = [&](std::size_t top) {
      return rest(slim_.node(joints[top]).parent, joint_above(joints[top]));
    };
    const Candidate* best = nullptr;
    double least = 0;
    const std::vector<Candidate> list = candidates(skin);
    for (const Candidate& candidate : list) {
      double size = 0;
      for (const Affine& m : matrices)
        size = std::max(size, math::length(candidate.space * m.origin -
                                           candidate.space * matrices[tops[0]].origin));
      double sum = 0;
      for (std::size_t top : tops)
        sum += difference(math::inverse(parent(top)) * candidate.space * matrices[top],
                          slim_.node(joints[top]).matrix, size > 0 ? size : 1);
      sum /= static_cast<double>(tops.size());
      if (best && sum > least - kTie) continue;
      best = &candidate;
      least = sum;
    }
    if (best != &list[0])
      notes_.push_back(
          fmt::format("inverse bind matrices of skin {} are in the space of {}", skin, best->name));
    if (!quantised_) return best->space;
    const auto& node = slim_.node(joints[tops[0]]);
    return dequantised(best->space, matrices[tops[0]], parent(tops[0]) * node.matrix);
  }

  /// `space` with the scale and the place that take `matrix` to `target`.
  static Affine dequantised(const Affine& space, const Affine& matrix, const Affine& target) {
    const Affine now = space * matrix;
    if (!(std::abs(math::determinant(target.linear)) > 1e-30)) return space;
    const double scale = math::exp(log_scale(target) - log_scale(now));
    Affine result = space;
    result.linear = {space.linear.x * scale, space.linear.y * scale, space.linear.z * scale};
    result.origin = target.origin - result.linear * matrix.origin;
    return result;
  }

  const File& file_;
  const Slim& slim_;
  const BindContext& context_;
  int ancestor_;
  bool quantised_;
  std::vector<std::string>& notes_;
  Diagnostics& diagnostics_;
  std::map<int, Affine> bind_;
};

}  // namespace

BindContext bind_context(const Slim& slim) {
  BindContext context;
  context.mesh_nodes.resize(slim.skins.size(), -1);
  for (std::size_t i = slim.nodes.size(); i-- > 0;)
    if (slim.nodes[i].skin >= 0)
      context.mesh_nodes[static_cast<std::size_t>(slim.nodes[i].skin)] = static_cast<int>(i);
  std::vector<bool> is_joint(slim.nodes.size(), false);
  for (const SlimSkin& skin : slim.skins)
    for (int joint : skin.joints) is_joint[static_cast<std::size_t>(joint)] = true;
  context.above = joints_above(slim, is_joint);
  return context;
}

std::optional<std::map<int, Affine>> read_bind(const File& file, const Slim& slim,
                                               const BindContext& context, const Bones& bones,
                                               std::vector<std::string>& notes,
                                               Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errors();
  BindReader reader(file, slim, context, bones.ancestor, notes, diagnostics);
  for (int skin : bones.skins) reader.add(skin);
  if (diagnostics.errors() != errors) return std::nullopt;
  return reader.take();
}

}  // namespace rigc::gltf
