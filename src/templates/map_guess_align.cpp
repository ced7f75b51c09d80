// SPDX-License-Identifier: MIT
// The alignment: for each joint and bone the best way to lay the tree below the one into the tree
// below the other, from the leaves up. Test: tests/templates/map_guess_test.cpp
#include "templates/map_guess_align.h"

#include <algorithm>
#include <cmath>

namespace rigc::templates {
namespace {

using math::Mat3;
using math::Vec3;

constexpr double kEdge = 0.65;      // what a bone that lies exactly as its joint is worth
constexpr double kSkipBone = 0.12;  // what it costs to pass over a bone of the model
constexpr double kSkipJoint = 0.1;  // and a joint of the template
constexpr int kMostSkips = 3;       // bones or joints passed over in a row
constexpr double kNamed = 0.14;     // names that speak for a joint by more than its side
constexpr double kNever = -1e9;
constexpr double kAxesMargin = 0.02;  // other axes than glTF's own must be clearly better
constexpr std::size_t kManyBones = 500;

std::vector<std::vector<int>> children_of(const std::vector<AlignNode>& nodes) {
  std::vector<std::vector<int>> children(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].parent >= 0)
      children[static_cast<std::size_t>(nodes[i].parent)].push_back(static_cast<int>(i));
  return children;
}

/// Parents before children.
std::vector<int> ordered(const std::vector<AlignNode>& nodes,
                         const std::vector<std::vector<int>>& children) {
  std::vector<int> order;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].parent < 0) order.push_back(static_cast<int>(i));
  for (std::size_t i = 0; i < order.size(); ++i)
    for (const int child : children[static_cast<std::size_t>(order[i])]) order.push_back(child);
  return order;
}

double extent(const std::vector<Vec3>& points) {
  double low = 0, high = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    low = i == 0 ? points[i].y : std::min(low, points[i].y);
    high = i == 0 ? points[i].y : std::max(high, points[i].y);
  }
  return high - low;
}

/// What is below a bone: itself excluded, with how many bones lie between.
struct Below {
  int bone;
  int skipped;
};

class Aligner {
 public:
  explicit Aligner(const AlignInput& input);
  Alignment run(const Mat3& axes, double scale);
  /// The template's height and the model's along an axis: the first estimate of its scale.
  double scale_along(const Mat3& axes) const;
  double scale_of(const Alignment& alignment) const;
  /// After run(): trees that hang elsewhere in the model than in the template, best first.
  void place_rest(Alignment& out);

 private:
  /// A bone for a child of a joint, or for one below it where the child is passed over.
  struct Way {
    int joint, bone;
    double gain;
  };
  std::size_t at(int joint, int bone) const {
    return static_cast<std::size_t>(joint) * bones_.size() + static_cast<std::size_t>(bone);
  }
  double edge(int joint, int bone, int below_joint, int below_bone) const;
  void add_ways(int joint, int bone, int below, int skips, std::vector<Way>& ways) const;
  std::vector<Way> choose(int joint, int bone) const;
  std::vector<Way> disjoint(const std::vector<Way>& ways, int skip_child) const;
  bool is_joint_below(int joint, int above) const;
  void compute();
  void place(int joint, int bone, Alignment& out);
  double nearness(int joint, int bone, const Alignment& out) const;
  bool is_below(int bone, int above) const {
    return first_[static_cast<std::size_t>(above)] <= first_[static_cast<std::size_t>(bone)] &&
           first_[static_cast<std::size_t>(bone)] < last_[static_cast<std::size_t>(above)];
  }

  const std::vector<AlignNode>& joints_;
  const std::vector<AlignNode>& bones_;
  std::vector<std::vector<int>> joint_children_, bone_children_;
  std::vector<int> joint_order_, bone_order_;
  std::vector<std::vector<Below>> below_;  ///< by bone
  std::vector<int> first_, last_;          ///< by bone: its subtree in depth-first order
  std::vector<double> names_;              ///< by joint and bone
  std::vector<Vec3> points_;               ///< by bone, in the template's axes and metres
  std::vector<bool> used_;                 ///< by bone
  std::vector<double> best_;               ///< by joint and bone: gain over leaving all below out
  double height_ = 1;                      ///< of the template
};

Aligner::Aligner(const AlignInput& input)
    : joints_(input.joints),
      bones_(input.bones),
      joint_children_(children_of(input.joints)),
      bone_children_(children_of(input.bones)),
      joint_order_(ordered(input.joints, joint_children_)),
      bone_order_(ordered(input.bones, bone_children_)),
      below_(input.bones.size()),
      first_(input.bones.size(), 0),
      last_(input.bones.size(), 0) {
  std::vector<int> size(bones_.size(), 1);
  for (auto bone = bone_order_.rbegin(); bone != bone_order_.rend(); ++bone) {
    const int parent = bones_[static_cast<std::size_t>(*bone)].parent;
    if (parent >= 0)
      size[static_cast<std::size_t>(parent)] += size[static_cast<std::size_t>(*bone)];
  }
  std::vector<int> next(bones_.size(), 0);
  int next_root = 0;
  for (const int bone : bone_order_) {
    const auto index = static_cast<std::size_t>(bone);
    const int parent = bones_[index].parent;
    int& start = parent < 0 ? next_root : next[static_cast<std::size_t>(parent)];
    first_[index] = start;
    start += size[index];
    last_[index] = start;
    next[index] = first_[index] + 1;
    int above = parent;
    for (int skipped = 0; above >= 0 && skipped <= kMostSkips; ++skipped) {
      below_[static_cast<std::size_t>(above)].push_back({bone, skipped});
      above = bones_[static_cast<std::size_t>(above)].parent;
    }
  }
  names_.resize(joints_.size() * bones_.size());
  for (std::size_t joint = 0; joint < joints_.size(); ++joint)
    for (std::size_t bone = 0; bone < bones_.size(); ++bone)
      names_[joint * bones_.size() + bone] = input.names(joint, bone);
}

/// How alike two segments lie: 0.65 for equal ones, below 0 for ones at right angles.
double Aligner::edge(int joint, int bone, int below_joint, int below_bone) const {
  const Vec3 own = joints_[static_cast<std::size_t>(below_joint)].at -
                   joints_[static_cast<std::size_t>(joint)].at;
  const Vec3 other =
      points_[static_cast<std::size_t>(below_bone)] - points_[static_cast<std::size_t>(bone)];
  const double both = length(own) + length(other);
  return both > 0 ? kEdge - length(own - other) / both : 0;
}

/// All ways to place `below` somewhere below a bone.
void Aligner::add_ways(int joint, int bone, int below, int skips, std::vector<Way>& ways) const {
  for (const Below& place : below_[static_cast<std::size_t>(bone)]) {
    if (used_[static_cast<std::size_t>(place.bone)]) continue;
    const double gain = best_[at(below, place.bone)] + edge(joint, bone, below, place.bone) -
                        kSkipBone * place.skipped - kSkipJoint * skips;
    if (gain > 0) ways.push_back({below, place.bone, gain});
  }
  if (skips == kMostSkips) return;
  // Where a joint is passed over, those below it take its place.
  for (const int next : joint_children_[static_cast<std::size_t>(below)])
    add_ways(joint, bone, next, skips + 1, ways);
}

bool Aligner::is_joint_below(int joint, int above) const {
  for (int at = joint; at >= 0; at = joints_[static_cast<std::size_t>(at)].parent)
    if (at == above) return true;
  return false;
}

/// The best ways first, none of which is in another's way; `passed_over` gets no bone itself.
std::vector<Aligner::Way> Aligner::disjoint(const std::vector<Way>& ways, int passed_over) const {
  std::vector<Way> chosen;
  for (const Way& way : ways) {
    const bool free = std::none_of(chosen.begin(), chosen.end(), [&](const Way& other) {
      return is_joint_below(way.joint, other.joint) || is_joint_below(other.joint, way.joint) ||
             is_below(way.bone, other.bone) || is_below(other.bone, way.bone);
    });
    if (free && way.joint != passed_over) chosen.push_back(way);
  }
  return chosen;
}

std::vector<Aligner::Way> Aligner::choose(int joint, int bone) const {
  const std::vector<int>& children = joint_children_[static_cast<std::size_t>(joint)];
  std::vector<Way> ways;
  for (const int child : children) add_ways(joint, bone, child, 0, ways);
  std::sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) {
    if (a.gain != b.gain) return a.gain > b.gain;
    return a.joint != b.joint ? a.joint < b.joint : a.bone < b.bone;
  });
  const auto sum = [](const std::vector<Way>& chosen) {
    double gain = 0;
    for (const Way& way : chosen) gain += way.gain;
    return gain;
  };
  std::vector<Way> best = disjoint(ways, -1);
  for (const int child : children) {
    if (joint_children_[static_cast<std::size_t>(child)].size() < 2) continue;
    std::vector<Way> without = disjoint(ways, child);
    if (sum(without) > sum(best)) best = std::move(without);
  }
  return best;
}

void Aligner::compute() {
  best_.assign(joints_.size() * bones_.size(), kNever);
  for (auto joint = joint_order_.rbegin(); joint != joint_order_.rend(); ++joint)
    for (auto bone = bone_order_.rbegin(); bone != bone_order_.rend(); ++bone) {
      if (used_[static_cast<std::size_t>(*bone)]) continue;
      double gain = joints_[static_cast<std::size_t>(*joint)].weight + names_[at(*joint, *bone)];
      for (const Way& way : choose(*joint, *bone)) gain += way.gain;
      best_[at(*joint, *bone)] = gain;
    }
}

void Aligner::place(int joint, int bone, Alignment& out) {
  out.bone_of[static_cast<std::size_t>(joint)] = bone;
  for (const Way& way : choose(joint, bone)) place(way.joint, way.bone, out);
}

/// How near a bone is to where the joint should be, seen from the nearest joint above that has one.
double Aligner::nearness(int joint, int bone, const Alignment& out) const {
  int above = joints_[static_cast<std::size_t>(joint)].parent;
  while (above >= 0 && out.bone_of[static_cast<std::size_t>(above)] < 0)
    above = joints_[static_cast<std::size_t>(above)].parent;
  if (above < 0) return 0;
  const auto anchor = static_cast<std::size_t>(above);
  const Vec3 expected = points_[static_cast<std::size_t>(out.bone_of[anchor])] +
                        joints_[static_cast<std::size_t>(joint)].at - joints_[anchor].at;
  const double distance = length(points_[static_cast<std::size_t>(bone)] - expected);
  return 0.4 - 3 * distance / height_;
}

void Aligner::place_rest(Alignment& out) {
  for (;;) {
    for (std::size_t i = 0; i < joints_.size(); ++i)
      if (out.bone_of[i] >= 0) used_[static_cast<std::size_t>(out.bone_of[i])] = true;
    std::vector<bool> whole(joints_.size(), true);  // nothing below has a bone
    for (auto joint = joint_order_.rbegin(); joint != joint_order_.rend(); ++joint) {
      const auto index = static_cast<std::size_t>(*joint);
      if (out.bone_of[index] >= 0) whole[index] = false;
      const int parent = joints_[index].parent;
      if (parent >= 0 && !whole[index]) whole[static_cast<std::size_t>(parent)] = false;
    }
    compute();
    double best = 0.1;
    int best_joint = -1, best_bone = -1;
    for (const int joint : joint_order_) {
      if (!whole[static_cast<std::size_t>(joint)]) continue;
      const int parent = joints_[static_cast<std::size_t>(joint)].parent;
      const double left_out = parent >= 0 && whole[static_cast<std::size_t>(parent)]
                                  ? joints_[static_cast<std::size_t>(parent)].weight
                                  : 0;  // rather the whole limb than its lower part
      for (std::size_t i = 0; i < bones_.size(); ++i) {
        const int bone = static_cast<int>(i);
        if (used_[i]) continue;
        const double gain = best_[at(joint, bone)] + nearness(joint, bone, out) - left_out;
        // One bone that only lies near is no limb.
        if (gain <= best || (names_[at(joint, bone)] < kNamed && choose(joint, bone).empty()))
          continue;
        best = gain;
        best_joint = joint;
        best_bone = bone;
      }
    }
    if (best_joint < 0) return;
    place(best_joint, best_bone, out);
    out.detached[static_cast<std::size_t>(best_joint)] = true;
    out.score += best;
  }
}

double Aligner::scale_along(const Mat3& axes) const {
  std::vector<Vec3> own, other;
  for (const AlignNode& joint : joints_) own.push_back(joint.at);
  const Mat3 back = transposed(axes);
  for (const AlignNode& bone : bones_) other.push_back(back * bone.at);
  const double height = extent(own);
  return height > 0 && extent(other) > 0 ? extent(other) / height : 1;
}

/// From the lengths of the segments that were matched.
double Aligner::scale_of(const Alignment& alignment) const {
  double own = 0, other = 0;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    int above = joints_[i].parent;
    while (above >= 0 && alignment.bone_of[static_cast<std::size_t>(above)] < 0)
      above = joints_[static_cast<std::size_t>(above)].parent;
    if (above < 0 || alignment.bone_of[i] < 0) continue;
    const auto anchor = static_cast<std::size_t>(above);
    own += length(joints_[i].at - joints_[anchor].at);
    other += length(bones_[static_cast<std::size_t>(alignment.bone_of[i])].at -
                    bones_[static_cast<std::size_t>(alignment.bone_of[anchor])].at);
  }
  return own > 0 && other > 0 ? other / own : alignment.scale;
}

Alignment Aligner::run(const Mat3& axes, double scale) {
  Alignment out;
  out.axes = axes;
  out.scale = scale;
  out.bone_of.assign(joints_.size(), -1);
  out.detached.assign(joints_.size(), false);
  used_.assign(bones_.size(), false);
  points_.clear();
  const Mat3 back = transposed(axes);
  for (const AlignNode& bone : bones_) points_.push_back(back * bone.at * (1 / scale));
  std::vector<Vec3> own;
  for (const AlignNode& joint : joints_) own.push_back(joint.at);
  height_ = std::max(extent(own), 1e-9);
  compute();
  double best = 0;
  int best_joint = -1, best_bone = -1;
  for (const int joint : joint_order_)
    for (std::size_t bone = 0; bone < bones_.size(); ++bone)
      if (best_[at(joint, static_cast<int>(bone))] > best) {
        best = best_[at(joint, static_cast<int>(bone))];
        best_joint = joint;
        best_bone = static_cast<int>(bone);
      }
  if (best_joint < 0) return out;
  out.score = best;
  place(best_joint, best_bone, out);
  return out;
}

/// Left, up and forward along the world's axes: glTF's own first, then turned about Y, then lying.
std::vector<Mat3> all_axes() {
  std::vector<Mat3> out;
  const Vec3 units[6] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {0, -1, 0}};
  for (const Vec3& up : units)
    for (const Vec3& forward : units)
      if (dot(up, forward) == 0) out.push_back({cross(up, forward), up, forward});
  return out;
}

}  // namespace

Alignment align(const AlignInput& input) {
  Aligner aligner(input);
  Alignment best;
  best.bone_of.assign(input.joints.size(), -1);
  best.detached.assign(input.joints.size(), false);
  std::vector<Mat3> ways = all_axes();
  if (input.bones.size() > kManyBones) ways.resize(4);
  for (const Mat3& axes : ways) {
    if (dot(axes.x, input.left) < 0.7 * length(input.left)) continue;
    Alignment found = aligner.run(axes, aligner.scale_along(axes));
    if (found.score > best.score * (1 + kAxesMargin)) best = std::move(found);
  }
  if (best.score <= 0) return best;
  Alignment again = aligner.run(best.axes, aligner.scale_of(best));
  if (again.score < best.score) again = aligner.run(best.axes, best.scale);
  if (input.bones.size() <= kManyBones) aligner.place_rest(again);
  return again;
}

}  // namespace rigc::templates
