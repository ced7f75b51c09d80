// SPDX-License-Identifier: MIT
// Transfer: what the clip plays on joints, which controls say it, their values, their channels, and
// how far the rig then is from it. Test: tests/bake/transfer_test.cpp
#include "bake/transfer.h"

#include <algorithm>
#include <set>

#include "bake/frames.h"
#include "bake/joints.h"
#include "bake/match.h"
#include "bake/transfer_measure.h"
#include "bake/transfer_times.h"
#include "bake/transfer_write.h"

namespace rigc::bake {
namespace {

using scene::Plug;

/// What the clip moves besides what is solved or switched.
std::vector<eval::ClipInput> other_inputs(const scene::Scene& scene, const std::vector<Aim>& aims,
                                          const std::vector<eval::ClipInput>& all,
                                          const TransferPlan& plan,
                                          const std::vector<SwitchValue>& switches) {
  std::set<Plug> taken;
  for (const SwitchValue& value : switches) taken.insert(value.attribute);
  for (const Unknown& u : plan.unknowns) {
    if (is_number(u)) taken.insert(u.attribute);
    for (const anim::Path path : kPaths)
      if (solves(u, path)) taken.insert(plug_of(u.node, path));
  }
  for (const Aim& aim : aims)
    for (const anim::Path path : kPaths)
      if (is_solved(scene, aim)) taken.insert(plug_of(aim.id, path));
  std::vector<eval::ClipInput> others;
  for (const eval::ClipInput& input : all)
    if (!taken.contains(input.plug)) others.push_back(input);
  return others;
}

/// Joints that the clip animates and the rig drives.
std::size_t count_driven(const scene::Scene& scene, const std::vector<Aim>& aims) {
  return static_cast<std::size_t>(std::count_if(aims.begin(), aims.end(), [&](const Aim& aim) {
    return aim.animated() && is_driven(scene, aim.id);
  }));
}

/// Joints that keep their channels because nothing of the rig moves them.
std::vector<scene::NodeId> untouched(const scene::Scene& scene, const std::vector<Aim>& aims) {
  std::vector<scene::NodeId> out;
  for (const Aim& aim : aims)
    if (aim.animated() && !is_solved(scene, aim)) out.push_back(aim.id);
  return out;
}

/// One transfer: solved and measured, and again with more keys where it is too far off between.
class Run {
 public:
  Run(const scene::Scene& scene, const std::vector<int>& nodes, const anim::Clip& clip,
      const TransferOptions& options, const std::vector<Aim>& aims, const TransferPlan& plan)
      : scene_(scene), nodes_(nodes), clip_(clip), options_(options), aims_(aims), plan_(plan) {
    solving_ = options.switches;
    for (const MatchLimb& limb : find_match_limbs(scene)) add_neutral(limb);
    others_ = other_inputs(scene, aims, eval::clip_inputs(scene, nodes, clip), plan, solving_);
  }

  /// Numbers that are kept for each frame.
  std::size_t width() const { return 24 * aims_.size() + 10 * plan_.unknowns.size(); }

  std::optional<Transferred> at(std::vector<double> times, TransferReport& report,
                                Diagnostics& diagnostics) {
    const std::size_t begun_with = times.size();
    auto solution = solve_at(times, nullptr, diagnostics);
    if (!solution) return std::nullopt;
    Transferred out;
    TransferReport one;
    std::vector<GapOff> off;
    const auto measure = [&](const std::vector<std::size_t>& gaps, std::vector<GapOff>& all) {
      one = report;
      out = write_channels(
          {scene_, nodes_, aims_, clip_, options_.switches, plan_, *solution, times}, one);
      const MeasureInput input{scene_, nodes_, aims_, options_.standings, changed(clip_, out)};
      return bake::measure(input, times, gaps, threads(), all, diagnostics);
    };
    const auto add = [&](const std::vector<double>& more) {
      solution = extended(*solution, times, more, diagnostics);
      return solution.has_value();
    };
    Filling filling;
    if (inserts()) filling.tolerance = options_.tolerance;
    if (!fill_gaps(times, filling, off, measure, add)) return std::nullopt;
    finish(times.size(), begun_with, off, one);
    one.replaced = replaced_controls(scene_, nodes_, clip_, out);
    report = std::move(one);
    return out;
  }

 private:
  /// While a limb is solved its bones are as long as its joints say, by attributes for that alone.
  void add_neutral(const MatchLimb& limb) {
    for (const char* option : {"stretch", "squash", "soft", "slide", "pin", "wrist"})
      if (const auto found = limb.by.find(option); found != limb.by.end())
        solving_.push_back({found->second, 0});
  }

  bool inserts() const { return options_.fps == 0 && options_.tolerance > 0; }
  Threads& threads() { return options_.threads ? *options_.threads : alone_; }

  std::optional<Solution> solve_at(const std::vector<double>& times, const Solution* others,
                                   Diagnostics& diagnostics) {
    auto worlds = play(aims_, times);
    point_bones(plan_, worlds);
    return solve(scene_, {plan_, aims_, worlds, others_, solving_, times, others}, threads(),
                 diagnostics);
  }

  /// Solves at `more` and puts that among `times`. Frames do not depend on each other, but for what
  /// is taken for rounding.
  std::optional<Solution> extended(const Solution& solution, std::vector<double>& times,
                                   const std::vector<double>& more, Diagnostics& diagnostics) {
    const auto count = static_cast<double>(times.size() + more.size());
    if (!check_frame_count(count, width(), diagnostics)) return std::nullopt;
    const auto added = solve_at(more, &solution, diagnostics);
    if (!added) return std::nullopt;
    Solution all = merged(scene_, aims_, plan_, solution, times, *added, more);
    times.insert(times.end(), more.begin(), more.end());
    std::sort(times.begin(), times.end());
    return all;
  }

  static void finish(std::size_t frames, std::size_t begun_with, const std::vector<GapOff>& off,
                     TransferReport& report) {
    report.frames = frames;
    report.inserted = frames - begun_with;
    for (const GapOff& gap : off) {
      keep_larger(gap.at_ends, report.at_keys);
      keep_larger(gap.inside, report.between);
    }
  }

  const scene::Scene& scene_;
  const std::vector<int>& nodes_;
  const anim::Clip& clip_;
  const TransferOptions& options_;
  const std::vector<Aim>& aims_;
  const TransferPlan& plan_;
  std::vector<SwitchValue> solving_;  // those that are asked for, and what stays out of the way
  std::vector<eval::ClipInput> others_;
  Threads alone_{1};
};

}  // namespace

std::optional<Transferred> transfer(const scene::Scene& scene, const std::vector<int>& nodes,
                                    const anim::Clip& clip, const TransferOptions& options,
                                    TransferReport& report, Diagnostics& diagnostics) {
  const std::vector<Aim> aims = find_aims(scene, nodes, clip, options.standings);
  report.joints = count_driven(scene, aims);
  if (report.joints == 0) return Transferred{{clip.name, clip.source_animation, {}}, {}};
  report.untouched = untouched(scene, aims);
  const auto plan = make_plan(scene, nodes, aims, options.switches, diagnostics);
  if (!plan) return std::nullopt;
  Run run(scene, nodes, clip, options, aims, *plan);
  auto times = transfer_times(aims, options, run.width(), diagnostics);
  if (!times) return std::nullopt;
  return run.at(std::move(*times), report, diagnostics);
}

}  // namespace rigc::bake
