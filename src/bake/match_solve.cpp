// SPDX-License-Identifier: MIT
// Solves a match frame by frame: what the limb does now, then the controls of the other side one
// after another, each seen from what the rig makes of those before. Test: tests/bake/match_test.cpp
#include <algorithm>
#include <cmath>
#include <set>

#include "bake/held.h"
#include "bake/match.h"
#include "bake/rounded.h"
#include "bake/transfer_limb.h"
#include "bake/transfer_order.h"

namespace rigc::bake {
namespace {

using math::Affine;
using math::Mat3;
using math::Quat;
using math::Vec3;
using scene::NodeId;
using scene::Plug;
namespace transform = scene::transform;
namespace ik2 = scene::ik2;

/// Lengths that differ by less are one: what 32-bit floats leave of them.
constexpr double kSame = 5e-7;

/// Values of plugs in all frames, [frames][width] each.
using Table = std::map<Plug, std::vector<double>>;

Vec3 vector(const std::vector<double>& row, std::size_t frame) {
  return {row[3 * frame], row[3 * frame + 1], row[3 * frame + 2]};
}

/// A limb in a frame: its joints' worlds.
using Pose = std::array<Affine, 3>;

double distance(Vec3 a, Vec3 b) { return math::length(a - b); }

/// The rotation of a control for which `joint`, which it turns, is turned as `wanted`; `control`
/// and `joint` are where they are now.
Quat turned(const Affine& parent, const Affine& control, const Affine& joint,
            const Affine& wanted) {
  const Mat3 offset = math::inverse(control.linear) * joint.linear;
  const Mat3 seen = math::orthonormal(math::inverse(parent.linear) * wanted.linear);
  return math::quaternion(seen * math::transposed(math::orthonormal(offset)));
}

class Matcher {
 public:
  Matcher(const scene::Scene& scene, const MatchLimb& limb, const MatchOptions& options,
          Diagnostics& diagnostics)
      : scene_(scene),
        limb_(limb),
        options_(options),
        frames_(scene, options.times, diagnostics),
        held_(scene, frames_, limb.held) {}

  std::optional<Matched> run(const std::vector<int>& nodes, const anim::Clip& clip) {
    frames_.sample(nodes, clip);
    const auto now = pose();
    if (!now || !held_.note()) return std::nullopt;
    wanted_ = *now;
    set(limb_.mode, options_.to_ik ? 1 : 0);
    if (!held_.hold()) return std::nullopt;
    if (!(options_.to_ik ? solve_ik() : solve_fk())) return std::nullopt;
    written_.insert(written_.end(), held_.written().begin(), held_.written().end());
    return matched();
  }

 private:
  std::size_t frames() const { return frames_.count(); }

  static std::vector<Plug> worlds_of(const std::array<NodeId, 3>& nodes) {
    std::vector<Plug> plugs;
    for (const NodeId node : nodes) plugs.push_back({node, transform::kWorld});
    return plugs;
  }
  static Pose pose_at(const Rows& rows, std::size_t frame) {
    return {affine(rows[0], frame), affine(rows[1], frame), affine(rows[2], frame)};
  }

  std::optional<std::vector<Pose>> pose() {
    const auto rows = frames_.evaluate(worlds_of(limb_.joints));
    if (!rows) return std::nullopt;
    std::vector<Pose> poses;
    for (std::size_t f = 0; f < frames(); ++f) poses.push_back(pose_at(*rows, f));
    return poses;
  }

  // --- values that are set ---

  void note(const Plug& plug) {
    if (std::find(written_.begin(), written_.end(), plug) == written_.end())
      written_.push_back(plug);
  }
  void set(const Plug& plug, double value) {
    note(plug);
    frames_.table[plug].assign(frames(), value);
  }
  void set(const Plug& plug, std::size_t frame, Vec3 value) {
    note(plug);
    std::vector<double>& values = frames_.table[plug];
    values.resize(3 * frames());
    for (std::size_t i = 0; i < 3; ++i) values[3 * frame + i] = value[i];
  }
  void set(const Plug& plug, std::size_t frame, Quat value) {
    note(plug);
    std::vector<double>& values = frames_.table[plug];
    values.resize(4 * frames());
    const double numbers[] = {value.x, value.y, value.z, value.w};
    std::copy_n(numbers, 4, values.begin() + static_cast<std::ptrdiff_t>(4 * frame));
  }
  const Plug* attribute(std::string_view meaning) const {
    const auto found = limb_.by.find(meaning);
    return found == limb_.by.end() ? nullptr : &found->second;
  }
  void set(std::string_view meaning, double value) {
    if (const Plug* plug = attribute(meaning)) set(*plug, value);
  }
  void set(std::string_view meaning, std::size_t frame, double value) {
    if (const Plug* plug = attribute(meaning)) frames_.table[*plug][frame] = value;
  }

  /// In the space of its joint, where the scale of what is above does not count.
  static double length_of(const Pose& pose, std::size_t bone) {
    return math::length(math::inverse(pose[bone]) * pose[bone + 1].origin);
  }

  /// Factor by which a bone is longer than at true length, as a file holds it; 1 where no attribute
  /// says it.
  double length_factor(std::string_view meaning, const Pose& wanted, const Pose& pose,
                       std::size_t bone) const {
    if (!attribute(meaning)) return 1;
    const double own = length_of(pose, bone);
    const double factor = own > 0 ? length_of(wanted, bone) / own : 1;
    return std::fabs(factor - 1) < kSame ? 1 : rounded(factor);
  }

  // --- FK ---

  bool solve_fk() {
    const char* const lengths[] = {"fk_upper_length", "fk_lower_length"};
    for (const char* length : lengths) set(length, 1);
    const auto own = pose();
    if (!own) return false;
    for (std::size_t f = 0; f < frames(); ++f)
      for (std::size_t bone = 0; bone < 2; ++bone)
        set(lengths[bone], f, length_factor(lengths[bone], wanted_[f], (*own)[f], bone));
    for (std::size_t i = 0; i < 3; ++i) {
      const auto rows = frames_.evaluate({{limb_.fk[i], transform::kParent},
                                          {limb_.fk[i], transform::kWorld},
                                          {limb_.joints[i], transform::kWorld}});
      if (!rows) return false;
      for (std::size_t f = 0; f < frames(); ++f)
        set({limb_.fk[i], transform::kRotation}, f,
            rounded(turned(affine((*rows)[0], f), affine((*rows)[1], f), affine((*rows)[2], f),
                           wanted_[f][i])));
      if (!held_.hold()) return false;
    }
    return true;
  }

  // --- IK ---

  bool solve_ik() {
    const Table before = frames_.table;
    for (const char* option : {"stretch", "squash", "soft", "slide", "pin", "wrist"})
      set(option, 0);
    for (const char* length : {"upper_length", "lower_length"}) set(length, 1);
    for (const char* twist : {"upper_twist", "lower_twist"}) set(twist, 0);
    if (!place_ik() || !place_pole() || !add_twists()) return false;
    return keep_options(before);
  }

  /// Where the end goes and how it is turned, and the lengths.
  bool place_ik() {
    std::vector<Plug> plugs = worlds_of(limb_.joints);
    plugs.insert(plugs.end(), {{limb_.ik, transform::kParent},
                               {limb_.ik, transform::kWorld},
                               {limb_.solver, ik2::kGoal}});
    for (const std::uint16_t read : kLimbReads) plugs.push_back({limb_.solver, read});
    const auto rows = frames_.evaluate(plugs);
    if (!rows) return false;
    const Vec3 goal_offset = std::get<Vec3>(scene_.value({limb_.solver, ik2::kGoalOffset}));
    for (std::size_t f = 0; f < frames(); ++f) {
      const Pose pose = pose_at(*rows, f);
      const Affine parent = affine((*rows)[3], f), control = affine((*rows)[4], f);
      Limb limb = limb_at(*rows, 6, f);
      const double upper = length_factor("upper_length", wanted_[f], pose, 0);
      const double lower = length_factor("lower_length", wanted_[f], pose, 1);
      limb.middle = limb.middle * upper;
      limb.end = limb.end * lower;
      own_.push_back({distance(pose[1].origin, pose[0].origin) * upper +
                          distance(pose[2].origin, pose[1].origin) * lower,
                      bones_of(limb, wanted_[f][0], wanted_[f][1])});
      const Quat rotation = rounded(turned(parent, control, pose[2], wanted_[f][2]));
      const Vec3 point = math::inverse(control) * (affine((*rows)[5], f) * goal_offset);
      const Vec3 turned_point = parent.linear * math::rotate(math::normalised(rotation), point);
      const Vec3 translate =
          rounded_goal(own_.back().bones, {parent.linear, turned_point + parent.origin});
      set("upper_length", f, upper);
      set("lower_length", f, lower);
      set({limb_.ik, transform::kRotation}, f, rotation);
      set({limb_.ik, transform::kTranslate}, f, translate);
    }
    return held_.hold();
  }

  static Limb limb_at(const Rows& rows, std::size_t first, std::size_t frame) {
    return {affine(rows[first], frame),     vector(rows[first + 1], frame),
            vector(rows[first + 2], frame), vector(rows[first + 3], frame),
            vector(rows[first + 4], frame), vector(rows[first + 5], frame)};
  }

  Quat offset_of(std::int32_t joint) const {
    return std::get<Quat>(scene_.value({limb_.solver, ik2::kOffsets, joint}));
  }

  /// As far out as it rests, in lengths of the limb.
  bool place_pole() {
    const auto rows =
        frames_.evaluate({{limb_.pole, transform::kParent}, {limb_.solver, ik2::kTwist}});
    if (!rows) return false;
    const auto at_rest = [&](NodeId node) { return scene_.rest_world(node).origin; };
    const double out = distance(at_rest(limb_.pole), at_rest(limb_.joints[1])) /
                       (distance(at_rest(limb_.joints[1]), at_rest(limb_.joints[0])) +
                        distance(at_rest(limb_.joints[2]), at_rest(limb_.joints[1])));
    for (std::size_t f = 0; f < frames(); ++f) {
      const Bones& bones = own_[f].bones;
      // The solver turns the limb from the side of the pole: see two_bone.cpp of the modules.
      const Quat back = math::axis_angle(math::normalised(bones.end - bones.start, bones.first),
                                         math::radians(-(*rows)[1][f]));
      const Vec3 side = bent_side(bones, wanted_[f][0], offset_of(0));
      const Vec3 from_start = bones.middle - bones.start + side * (out * own_[f].length);
      const Vec3 place = bones.start + math::rotate(back, from_start);
      set({limb_.pole, transform::kTranslate}, f,
          rounded(math::inverse(affine((*rows)[0], f)) * place));
    }
    return held_.hold();
  }

  /// What is left is turned about the bones. The attributes are linear in the solver's turns.
  bool add_twists() {
    const char* const words[] = {"upper_twist", "lower_twist"};
    const std::uint16_t turns[] = {ik2::kStartTwist, ik2::kMiddleTwist};
    std::vector<Plug> plugs = worlds_of(limb_.joints);
    for (const std::uint16_t turn : turns) plugs.push_back({limb_.solver, turn});
    const auto at_zero = frames_.evaluate(plugs);
    for (const char* word : words) set(word, 1);
    const auto at_one = at_zero ? frames_.evaluate(plugs) : std::nullopt;
    if (!at_one) return false;
    for (std::size_t bone = 0; bone < 2; ++bone) {
      double last = 0;
      for (std::size_t f = 0; f < frames(); ++f) {
        const double per_degree = (*at_one)[3 + bone][f] - (*at_zero)[3 + bone][f];
        const Vec3 axis = bone == 0 ? own_[f].bones.first : own_[f].bones.second;
        double turn = turn_about(axis, pose_at(*at_zero, f)[bone], wanted_[f][bone]);
        turn = per_degree == 0 ? 0 : turn / per_degree;
        if (f > 0) turn += 360 * std::nearbyint((last - turn) / 360);
        last = rounded(turn);
        set(words[bone], f, last);
      }
    }
    return true;
  }

  /// Degrees from one frame to another about an axis that they share.
  static double turn_about(Vec3 axis, const Affine& from, const Affine& to) {
    const Quat turn = math::quaternion(math::orthonormal(to.linear) *
                                       math::transposed(math::orthonormal(from.linear)));
    return math::degrees(2 * math::atan2(math::dot(Vec3{turn.x, turn.y, turn.z}, axis), turn.w));
  }

  /// An option that does nothing to the pose stays what it was.
  bool keep_options(const Table& before) {
    const auto restore = [&](const char* option) {
      const Plug* plug = attribute(option);
      if (!plug) return;
      const auto was = before.find(*plug);
      if (was != before.end())
        frames_.table[*plug] = was->second;
      else
        frames_.table.erase(*plug);
      written_.erase(std::remove(written_.begin(), written_.end(), *plug), written_.end());
    };
    const auto is_unused = [&](const char* option, auto unused) {
      const Plug* plug = attribute(option);
      if (!plug) return false;
      const auto was = before.find(*plug);
      for (std::size_t f = 0; f < frames(); ++f) {
        const double value = was != before.end() ? was->second[f] : scene_.number(*plug);
        if (value != 0 && !unused(value, own_[f])) return false;
      }
      return true;
    };
    const double rest_reach = reach_at_rest();
    restore("stretch");  // no pose is longer than its bones
    if (is_unused("soft", [](double soft, const Own& own) {
          return own.reach() < own.length * (1 - soft);
        }))
      restore("soft");
    if (is_unused("squash",
                  [&](double, const Own& own) { return own.reach() > own.length * rest_reach; }))
      restore("squash");
    for (const char* option : {"slide", "pin", "wrist"})
      if (is_unused(option, [](double, const Own&) { return false; })) restore(option);
    return true;
  }

  double reach_at_rest() const {
    const auto at = [&](std::size_t i) { return scene_.rest_world(limb_.joints[i]).origin; };
    return distance(at(2), at(0)) / (distance(at(1), at(0)) + distance(at(2), at(1)));
  }

  // --- results ---

  Matched matched() const {
    Matched out;
    for (const Plug& plug : written_)
      if (!is_needless(plug)) out.values.push_back({plug, frames_.table.at(plug)});
    return out;
  }

  /// An attribute that nobody keyed, and that is as it stands in the rig; the switch always is
  /// keyed.
  bool is_needless(const Plug& plug) const {
    if (plug == limb_.mode || frames_.keyed.contains(plug) ||
        plug.attribute < scene::kUserAttributes)
      return false;
    const std::vector<double>& values = frames_.table.at(plug);
    return std::all_of(values.begin(), values.end(),
                       [&](double value) { return value == scene_.number(plug); });
  }

  /// The limb as it shall be in a frame.
  struct Own {
    double length = 0;  ///< of its bones, rig units
    Bones bones;
    double reach() const { return distance(bones.end, bones.start); }
  };

  const scene::Scene& scene_;
  const MatchLimb& limb_;
  const MatchOptions& options_;
  ClipFrames frames_;
  Held held_;
  std::vector<Plug> written_;  // in the order in which they were set
  std::vector<Pose> wanted_;
  std::vector<Own> own_;
};

}  // namespace

std::optional<Matched> solve_match(const scene::Scene& scene, const std::vector<int>& nodes,
                                   const anim::Clip& clip, const MatchLimb& limb,
                                   const MatchOptions& options, Diagnostics& diagnostics) {
  return Matcher(scene, limb, options, diagnostics).run(nodes, clip);
}

}  // namespace rigc::bake
