// SPDX-License-Identifier: MIT
// Measuring: the rotation that takes the template's joints nearest to where the matched bones are
// in the world. There, not in rig space, a character is never mirrored, so that left x up is
// forward. Test: tests/templates/fit_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "base/text.h"
#include "templates/codes.h"
#include "templates/fit_match.h"

namespace rigc::templates {
namespace {

using math::Vec3;

constexpr double kSnapLeft = 0.9994;  // cosine of 2 degrees: left is measured well, from pairs
constexpr double kSnapUp = 0.9659;    // of 15 degrees: a spine leans
constexpr double kMostAsymmetry = 0.02;
constexpr double kMostMisfit = 0.65;        // Fox as a biped: 0.78; posed humanoids: up to 0.56
constexpr double kMirrorFitsBetter = 0.98;  // player with its sides exchanged: 0.97; others 0.995
constexpr std::size_t kLeastJoints = 6;     // to tell one build from another

struct Sample {
  Vec3 own;  ///< in the template, metres
  Vec3 rig;  ///< in the model's rig space
  Vec3 world;
  bool required = false;  ///< of a joint that every such character has
};

std::vector<Sample> samples_of(const Expanded& expanded, const tags::TaggedSkeleton& placed,
                               const std::vector<math::Affine>& placed_worlds,
                               const tags::ForeignSkeleton& model, const Matching& matching) {
  std::unordered_map<std::uint64_t, std::pair<std::size_t, std::size_t>> range;
  for (std::size_t i = 0; i < placed.joints.size(); ++i) {
    const auto [found, fresh] = range.emplace(placed.joints[i].key.uid, std::pair(i, i));
    if (!fresh) found->second.second = i;
  }
  std::vector<Sample> samples;
  const auto add = [&](std::size_t joint, int bone, bool required) {
    const Vec3 rig = model.joints[static_cast<std::size_t>(bone)].rest.origin;
    samples.push_back({placed_worlds[joint].origin, rig, model.ancestor_world * rig, required});
  };
  for (std::size_t i = 0; i < expanded.joints.size(); ++i) {
    if (!matching.has(i)) continue;
    const auto [first, last] = range.at(expanded.joints[i].tagged.key.uid);
    const bool required = !expanded.joints[i].tagged.optional;
    add(first, matching.bones[i].front(), required);
    if (matching.bones[i].size() > 1 && last != first)
      add(last, matching.bones[i].back(), required);
  }
  return samples;
}

/// Mean of the samples' places in the template and in the world.
std::pair<Vec3, Vec3> means(const std::vector<Sample>& samples) {
  std::pair<Vec3, Vec3> mean;
  const double share = 1 / static_cast<double>(samples.size());
  for (const Sample& sample : samples) {
    mean.first = mean.first + sample.own * share;
    mean.second = mean.second + sample.world * share;
  }
  return mean;
}

/// The rotation from the template to the world: the best for all samples; for samples on a line the
/// shortest that turns the line; else none.
math::Mat3 turn_of(const std::vector<Sample>& samples) {
  if (samples.empty()) return {};
  const auto [own_mean, world_mean] = means(samples);
  math::Mat3 correlation{{}, {}, {}};
  Vec3 own_line, world_line;  // to the sample that is farthest from the middle in the template
  for (const Sample& sample : samples) {
    const Vec3 own = sample.own - own_mean, world = sample.world - world_mean;
    correlation.x = correlation.x + world * own.x;
    correlation.y = correlation.y + world * own.y;
    correlation.z = correlation.z + world * own.z;
    if (length(own) > length(own_line)) {
      own_line = own;
      world_line = world;
    }
  }
  if (const auto rotation = math::fit_rotation(correlation)) return math::matrix(*rotation);
  if (!(length(own_line) > 1e-12) || !(length(world_line) > 1e-12)) return {};
  return math::matrix(math::between(normalised(own_line), normalised(world_line)));
}

/// How much of the joints' spread no turn and scale of the template explains, 0 to 1.
double misfit_of(const std::vector<Sample>& samples) {
  if (samples.size() < kLeastJoints) return 0;
  const math::Mat3 turn = turn_of(samples);
  const auto [own_mean, world_mean] = means(samples);
  double own = 0, world = 0, both = 0;
  for (const Sample& sample : samples) {
    const Vec3 a = turn * (sample.own - own_mean), b = sample.world - world_mean;
    own += dot(a, a);
    world += dot(b, b);
    both += dot(a, b);
  }
  return own > 0 && world > 0 ? math::sqrt(1 - both * both / (own * world)) : 1;
}

/// Warns of a model that is not the template's kind of creature, or its mirror image.
void check_build(const std::vector<Sample>& samples, const std::string& file, FitReport& report,
                 Diagnostics& diagnostics) {
  std::vector<Sample> required = samples, mirrored = samples;
  std::erase_if(required, [](const Sample& sample) { return !sample.required; });
  report.misfit = misfit_of(required);
  if (report.misfit > kMostMisfit)
    diagnostics.report(
        codes::kBuiltOtherwise, Place(file),
        fmt::format("even best turned and scaled, the template leaves {:.0f} % of how the joints "
                    "are spread",
                    report.misfit * 100),
        "is it the right template for this creature, and the right map?");
  for (Sample& sample : mirrored) sample.own.x = -sample.own.x;
  const double as_is = misfit_of(samples), as_image = misfit_of(mirrored);
  if (as_image < as_is * kMirrorFitsBetter)
    diagnostics.report(codes::kMirrorImage, Place(file),
                       "the model looks like the mirror image of the template: toes, knees and "
                       "elbows point the wrong way",
                       "left and right may be exchanged in the map or in the bones' names");
}

Vec3 snapped(Vec3 direction, double cosine) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 candidate;
    candidate[axis] = direction[axis] < 0 ? -1 : 1;
    if (dot(candidate, direction) >= cosine) return candidate;
  }
  return direction;
}

/// Left and up in the world, unit and at right angles.
std::pair<Vec3, Vec3> axes_of(const std::vector<Sample>& samples) {
  const math::Mat3 turn = turn_of(samples);
  const Vec3 left = snapped(turn.x, kSnapLeft);
  const Vec3 up = turn.y - left * dot(turn.y, left);
  return {left, snapped(normalised(up), kSnapUp)};
}

template <class Position>
std::pair<double, double> extent(const std::vector<Sample>& samples, Position position) {
  std::pair<double, double> range{0, 0};
  bool first = true;
  for (const Sample& sample : samples) {
    const double at = position(sample);
    range.first = first ? at : std::min(range.first, at);
    range.second = first ? at : std::max(range.second, at);
    first = false;
  }
  return range;
}

/// Rig units of a template's metre: by the heights, or by the sizes where the template is flat, as
/// a hand is; without two joints in different places a metre of the template is a metre of the
/// world.
double unit_of(const std::vector<Sample>& samples, double own_height, double rig_height,
               double world_metre) {
  Vec3 own_mean, rig_mean;
  const double part = 1 / static_cast<double>(samples.size());
  for (const Sample& sample : samples) {
    own_mean = own_mean + sample.own * part;
    rig_mean = rig_mean + sample.rig * part;
  }
  double own = 0, rig = 0, widest = 0;
  for (const Sample& sample : samples) {
    own += dot(sample.own - own_mean, sample.own - own_mean);
    rig += dot(sample.rig - rig_mean, sample.rig - rig_mean);
    widest = std::max(widest, length(sample.own - own_mean));
  }
  if (own_height > widest / 2 && rig_height > 0) return rig_height / own_height;
  return own > 1e-12 && rig > 0 ? math::sqrt(rig / own) : world_metre;
}

/// The largest distance of a bone from the mirror image of its opposite.
void check_symmetry(const Expanded& expanded, const tags::ForeignSkeleton& model,
                    const Matching& matching, Vec3 left, FitReport& report,
                    Diagnostics& diagnostics) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  const auto position = [&](std::size_t joint) {
    const int bone = matching.bones[joint].front();
    return model.ancestor_world * model.joints[static_cast<std::size_t>(bone)].rest.origin;
  };
  double centre = 0;
  for (std::size_t i = 0; i < expanded.joints.size(); ++i) {
    const int other = expanded.joints[i].opposite;
    if (other <= static_cast<int>(i) || !matching.has(i) ||
        !matching.has(static_cast<std::size_t>(other)))
      continue;
    pairs.emplace_back(i, static_cast<std::size_t>(other));
    centre += dot(position(i) + position(pairs.back().second), left) / 2;
  }
  if (pairs.empty() || !(report.height_metres > 0)) return;
  centre = centre / static_cast<double>(pairs.size());
  for (const auto& [a, b] : pairs) {
    const Vec3 here = position(a);
    const Vec3 image = here - left * (2 * (dot(here, left) - centre));
    const double distance = length(image - position(b));
    if (report.asymmetry && distance <= report.asymmetry->metres) continue;
    const auto bone = [&](std::size_t joint) {
      return model.joints[static_cast<std::size_t>(matching.bones[joint].front())].name;
    };
    report.asymmetry = {bone(a), bone(b), distance, distance / report.height_metres};
  }
  if (report.asymmetry->share <= kMostAsymmetry) return;
  diagnostics.report(
      codes::kAsymmetric, Place(model.file),
      fmt::format("{} is {:.0f} mm ({:.1f} % of the height) from the mirror image of {}",
                  printable(report.asymmetry->opposite, 60), report.asymmetry->metres * 1000,
                  report.asymmetry->share * 100, printable(report.asymmetry->joint, 60)),
      "if the rest pose is a frame of a clip, choose another with --rest");
}

}  // namespace

Measured measure(const Expanded& expanded, const tags::TaggedSkeleton& placed,
                 const tags::ForeignSkeleton& model, const Matching& matching, FitReport& report,
                 Diagnostics& diagnostics) {
  std::vector<math::Affine> worlds;
  for (const tags::TaggedJoint& joint : placed.joints) {
    const math::Affine own = math::compose(joint.rest);
    worlds.push_back(joint.parent < 0 ? own : worlds[static_cast<std::size_t>(joint.parent)] * own);
  }
  const auto samples = samples_of(expanded, placed, worlds, model, matching);
  const auto [left, up] = axes_of(samples);
  const Vec3 forward = cross(left, up);
  const math::Mat3 to_rig = inverse(model.ancestor_world.linear);

  Measured out;
  out.world_left = left;
  out.character.left = normalised(to_rig * left);
  out.character.up = normalised(to_rig * up, {0, 1, 0});
  out.character.forward = normalised(to_rig * forward, {0, 0, 1});
  const Vec3 rig_up = out.character.up;
  const Vec3 world_up = up;
  const auto own = extent(samples, [](const Sample& s) { return s.own.y; });
  const auto rig = extent(samples, [&](const Sample& s) { return dot(s.rig, rig_up); });
  const auto world = extent(samples, [&](const Sample& s) { return dot(s.world, world_up); });
  out.lowest = rig.first;
  out.template_lowest = own.first;
  report.height_metres = world.second - world.first;
  const double own_height = own.second - own.first;
  const double rig_height = rig.second - rig.first;
  out.character.unit = unit_of(samples, own_height, rig_height, length(to_rig * up));
  out.character.height = rig_height > 0 ? rig_height : out.character.unit;
  check_build(samples, model.file, report, diagnostics);
  check_symmetry(expanded, model, matching, left, report, diagnostics);
  return out;
}

}  // namespace rigc::templates
