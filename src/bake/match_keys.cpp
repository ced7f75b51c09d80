// SPDX-License-Identifier: MIT
// The keys of a match. Test: tests/bake/match_keys_test.cpp
#include "bake/match_keys.h"

#include <algorithm>
#include <cmath>

#include "bake/bodies.h"
#include "bake/clip_frames.h"
#include "bake/frames.h"
#include "bake/gap_fill.h"
#include "base/trace.h"
#include "eval/clip_inputs.h"

namespace rigc::bake {
namespace {

/// Numbers (in units of 1 and of their size) that differ by less hold.
constexpr double kHeld = 1e-6;
/// Gaps between keys that are not halved, seconds: an elbow that is nearly straight moves by
/// millimetres where its hand moves by thousandths, and nobody wants a thousand keys a second.
constexpr double kShortest = 1.0 / 120;

bool is_step(const anim::Curve& curve) {
  return curve.interpolation == anim::Interpolation::step && curve.times->size() > 1;
}
bool never_moves(const anim::Curve& curve) { return curve.times->size() == 1; }

/// What must stay, and how far its rotation is felt.
class Followed {
 public:
  explicit Followed(const MatchTask& task) {
    const Options options;
    const std::vector<Body> bodies =
        find_bodies(task.scene, task.nodes, std::vector<bool>(task.scene.size(), false), options);
    const std::vector<Reach> felt = reaches(task.scene, task.nodes, bodies, options);
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (bodies[i].is_output) add(bodies[i].id, felt[i]);
    for (const scene::NodeId control : task.controls) add(control, of_joint(task, control));
  }

  const std::vector<scene::Plug>& worlds() const { return worlds_; }

  double compare(const Rows& wanted, const Rows& got, std::size_t frame, double seconds,
                 Deviation& largest) const {
    double off = 0;
    for (std::size_t i = 0; i < worlds_.size(); ++i) {
      const math::Affine a = affine(wanted[i], frame), b = affine(got[i], frame);
      if (i > 0 && a == b) continue;
      keep_larger(deviation(worlds_[i].node, a, b, seconds), largest);
      off = std::max(off, distance(b, a, reaches_[i]));
    }
    return off;
  }

  /// What differs by no bit is not moved by what is keyed.
  void note_moved(const Rows& wanted, const Rows& got, std::vector<char>& moved) const {
    moved.resize(worlds_.size());
    for (std::size_t i = 0; i < worlds_.size(); ++i) moved[i] = wanted[i] != got[i];
  }
  /// One at least stays.
  void keep(const std::vector<std::vector<char>>& moved) {
    std::vector<scene::Plug> worlds;
    std::vector<Reach> reaches;
    for (std::size_t i = 0; i < worlds_.size(); ++i) {
      const bool any = std::any_of(moved.begin(), moved.end(),
                                   [&](const std::vector<char>& one) { return one[i] != 0; });
      if (!any && (i + 1 < worlds_.size() || !worlds.empty())) continue;
      worlds.push_back(worlds_[i]);
      reaches.push_back(std::move(reaches_[i]));
    }
    worlds_ = std::move(worlds);
    reaches_ = std::move(reaches);
  }

 private:
  void add(scene::NodeId node, const Reach& reach) {
    worlds_.push_back({node, scene::transform::kWorld});
    reaches_.push_back(reach);
  }

  /// Of the joint that a control belongs to; its place alone where there is none.
  Reach of_joint(const MatchTask& task, scene::NodeId control) const {
    for (std::size_t i = 0; i < worlds_.size(); ++i)
      if (task.scene[worlds_[i].node].identity.owner == task.scene[control].identity.owner)
        return reaches_[i];
    return {};
  }

  std::vector<scene::Plug> worlds_;
  std::vector<Reach> reaches_;
};

class Keyer {
 public:
  Keyer(const MatchTask& task, MatchOptions options, Diagnostics& diagnostics)
      : task_(task), options_(std::move(options)), diagnostics_(diagnostics), followed_(task) {}

  std::optional<anim::Clip> run(MatchReport& report) {
    const auto holds = find_holds();
    if (!holds) return std::nullopt;
    options_.steps = *holds;
    if (!set_times(options_.steps)) return std::nullopt;
    const std::size_t begun_with = options_.times.size();
    if (!solve(report)) return std::nullopt;
    std::vector<GapOff> off;
    const auto measure = [&](const std::vector<std::size_t>& gaps, std::vector<GapOff>& all) {
      return this->measure(gaps, all);
    };
    const auto add = [&](const std::vector<double>& more) {
      std::vector<double>& times = options_.times;
      times.insert(times.end(), more.begin(), more.end());
      std::sort(times.begin(), times.end());
      return check_frame_count(static_cast<double>(times.size()), width(), diagnostics_) &&
             solve(report);
    };
    const bool inserts = task_.when.fps == 0 && task_.tolerance > 0;
    Filling filling{.shortest = kShortest};
    if (inserts) filling.tolerance = task_.tolerance;
    if (!fill_gaps(options_.times, filling, off, measure, add)) return std::nullopt;
    report.frames = options_.times.size();
    report.inserted = report.frames - begun_with;
    for (const GapOff& gap : off) {
      keep_larger(gap.at_ends, report.at_keys);
      keep_larger(gap.inside, report.between);
    }
    return std::move(out_);
  }

 private:
  Threads& threads() { return task_.threads ? *task_.threads : alone_; }
  std::size_t width() const { return 12 * followed_.worlds().size(); }

  bool set_times(bool steps) {
    MatchTiming when = task_.when;
    when.steps = steps;
    auto times = match_times(task_.scene, task_.nodes, task_.timing, when, diagnostics_);
    if (!times) return false;
    options_.times = std::move(*times);
    options_.opens = !when.start || options_.times.front() <= anim::first_time(task_.timing);
    options_.closes = !when.end || options_.times.back() >= anim::last_time(task_.timing);
    return true;
  }

  /// All times anew: a range in which an option matters is one for all.
  bool solve(MatchReport& report) {
    const auto matched = task_.solve(options_);
    if (!matched) return false;
    std::vector<scene::Plug> plugs;
    for (const Matched::Values& values : matched->values) plugs.push_back(values.plug);
    same_plugs_ = plugs == plugs_;
    plugs_ = std::move(plugs);
    report.channels = report.keys = 0;
    out_ = with_keys(task_.scene, task_.nodes, task_.clip, *matched, options_, report);
    return true;
  }

  // --- whether everything holds from key to key ---

  std::optional<bool> find_holds() {
    const auto inputs = eval::clip_inputs(task_.scene, task_.nodes, task_.clip);
    const auto all = [&](auto is) {
      return std::all_of(inputs.begin(), inputs.end(),
                         [&](const eval::ClipInput& input) { return is(*input.curve); });
    };
    if (all([](const anim::Curve& curve) { return !is_step(curve); })) return false;
    if (all([](const anim::Curve& curve) { return is_step(curve) || never_moves(curve); }))
      return true;
    return solved_holds();
  }

  /// By what is solved: lines may move what has no part in it.
  std::optional<bool> solved_holds() {
    MatchTiming when = task_.when;
    when.fps = 0;
    when.steps = true;
    const auto keys = match_times(task_.scene, task_.nodes, task_.timing, when, diagnostics_);
    if (!keys) return std::nullopt;
    MatchOptions options = options_;
    std::vector<std::size_t> begins;  // by frame: that of the key before it
    for (std::size_t k = 0; k < keys->size(); ++k) {
      const std::size_t begin = options.times.size();
      const Gap gap{(*keys)[k], k + 1 < keys->size() ? right_before((*keys)[k + 1]) : (*keys)[k]};
      options.times.push_back(gap.begin);
      for (std::size_t i = 0; i < Gap::kInside; ++i) options.times.push_back(gap.inside(i));
      options.times.push_back(gap.end);
      options.times.erase(std::unique(options.times.begin() + static_cast<std::ptrdiff_t>(begin),
                                      options.times.end()),
                          options.times.end());
      begins.resize(options.times.size(), begin);
    }
    const auto matched = task_.solve(options);
    if (!matched) return std::nullopt;
    return std::all_of(matched->values.begin(), matched->values.end(),
                       [&](const Matched::Values& values) { return hold(values, begins); });
  }

  static double right_before(double seconds) {
    return static_cast<double>(std::nextafter(static_cast<float>(seconds), -HUGE_VALF));
  }

  static bool hold(const Matched::Values& values, const std::vector<std::size_t>& begins) {
    const std::size_t width = values.numbers.size() / begins.size();
    for (std::size_t f = 0; f < begins.size(); ++f)
      for (std::size_t i = 0; i < width; ++i) {
        const double a = values.numbers[f * width + i];
        const double b = values.numbers[begins[f] * width + i];
        if (std::fabs(a - b) > kHeld * std::max(1.0, std::fabs(b))) return false;
      }
    return true;
  }

  // --- how far off it is ---

  /// Those gaps; all where other attributes were keyed than before.
  bool measure(const std::vector<std::size_t>& gaps, std::vector<GapOff>& off) {
    const trace::Span span("measure");
    const std::vector<std::size_t> looked_at = same_plugs_ ? gaps : all_gaps(options_.times);
    const bool first_time = moved_.empty();
    if (first_time) moved_.resize(looked_at.size());
    const bool good = for_gaps(looked_at.size(), threads(), diagnostics_,
                               [&](std::size_t first, std::size_t last, Diagnostics& own) {
                                 measure_block(looked_at, first, last, off, own,
                                               first_time ? &moved_[first] : nullptr);
                               });
    if (!good || !first_time) return good;
    std::erase_if(moved_, [](const std::vector<char>& one) { return one.empty(); });
    followed_.keep(moved_);
    return true;
  }

  void measure_block(const std::vector<std::size_t>& gaps, std::size_t first, std::size_t last,
                     std::vector<GapOff>& off, Diagnostics& diagnostics, std::vector<char>* moved) {
    const std::vector<double> times = times_in(gaps, first, last, options_.times);
    const auto wanted = play(task_.clip, times, diagnostics);
    const auto got = wanted ? play(out_, times, diagnostics) : std::nullopt;
    if (!got) return;
    if (moved) followed_.note_moved(*wanted, *got, *moved);
    const auto compare = [&](std::size_t frame, Deviation& largest) {
      return followed_.compare(*wanted, *got, frame, times[frame], largest);
    };
    for (std::size_t i = first; i < last; ++i)
      off[gaps[i]] = measure_gap(compare, (i - first) * kGapTimes);
  }

  std::optional<Rows> play(const anim::Clip& clip, const std::vector<double>& times,
                           Diagnostics& diagnostics) const {
    ClipFrames frames(task_.scene, times, diagnostics);
    frames.sample(task_.nodes, clip);
    return frames.evaluate(followed_.worlds());
  }

  const MatchTask& task_;
  MatchOptions options_;
  Diagnostics& diagnostics_;
  Followed followed_;
  anim::Clip out_;
  std::vector<scene::Plug> plugs_;        // that were solved
  bool same_plugs_ = false;               // as before
  std::vector<std::vector<char>> moved_;  // by block of the first measurement, by what is followed
  Threads alone_{1};
};

}  // namespace

std::optional<anim::Clip> match_keys(const MatchTask& task, MatchOptions options,
                                     MatchReport& report, Diagnostics& diagnostics) {
  return Keyer(task, std::move(options), diagnostics).run(report);
}

}  // namespace rigc::bake
