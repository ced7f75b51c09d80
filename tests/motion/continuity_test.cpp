// SPDX-License-Identifier: MIT
// Whole rigs whose controls all move smoothly at once: no joint jumps. A jump stays as large when
// frames become ten times finer; a smooth joint's step becomes ten times smaller, and where a limb
// straightens, the root of ten. Limbs are by FK or by IK alone: where the two poses of a joint are
// half a turn apart their blend has no one answer, and moving through that flips it
// (tests/eval/continuity_test.cpp shows how).
#include <doctest/doctest.h>

#include <algorithm>

#include "motion/moving_helpers.h"
#include "tests/math/random.h"

namespace rigc {
namespace {

using test::Keyable;
using test::Moving;

// One sine for each component, half a turn to one and a half in all, of a random phase.
class Waves {
 public:
  /// `degrees` that rotations move by; `numbers`: attributes move too.
  Waves(const Moving& rig, std::uint64_t seed, double degrees = 30, bool numbers = true)
      : rig_(rig), degrees_(degrees), numbers_(numbers) {
    test::Random random(seed);
    for (std::size_t i = 0; i < 3 * rig.keyables().size(); ++i) {
      const double phase = random.between(0, 1);
      waves_.push_back({phase, random.between(0.5, 1.5)});
    }
  }
  /// Translations by `reach` of the rig's size, rotations by some degrees, numbers over their
  /// range; those named `ik_fk` stay at `ik_fk`, those that count stay.
  void move(std::size_t index, double time, double ik_fk, std::vector<double>& numbers) const {
    const Keyable& keyable = rig_.keyables()[index];
    double x[3];
    for (std::size_t c = 0; c < 3; ++c) {
      const Wave& wave = waves_[3 * index + c];
      x[c] = math::sin(2 * math::kPi * (wave.phase + time * wave.turns));
    }
    if (keyable.what == Keyable::What::translate) {
      for (std::size_t c = 0; c < 3; ++c) numbers[c] += kReach * rig_.size() * x[c];
    } else if (keyable.what == Keyable::What::rotation) {
      const math::Quat q =
          math::from_euler_degrees({degrees_ * x[0], degrees_ * x[1], degrees_ * x[2]});
      numbers = {q.x, q.y, q.z, q.w};
    } else if (keyable.what == Keyable::What::number && !keyable.whole) {
      if (numbers_) numbers[0] = keyable.low + (keyable.high - keyable.low) * (0.5 + 0.5 * x[0]);
      if (keyable.name.ends_with("@ik_fk")) numbers[0] = ik_fk;
    }
  }

 private:
  struct Wave {
    double phase, turns;
  };
  static constexpr double kReach = 0.05;
  const Moving& rig_;
  double degrees_;
  bool numbers_;
  std::vector<Wave> waves_;
};

struct Steps {
  double largest = 0, median = 0;  ///< of the rig's size
  std::string joint;
  std::vector<double> all;  ///< by frame: the largest from it to the next
};

// A joint's step: of its origin, and of points a tenth of the rig's size along its axes.
double step_of(const double* a, const double* b, double size) {
  double squares = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    const double d = (b[i] - a[i]) * (i < 9 ? 0.1 : 1 / size);
    squares += d * d;
  }
  return std::sqrt(squares);
}

Steps steps_of(const Moving& rig, std::size_t frames, const Moving::Values& values) {
  const auto worlds = rig.worlds(frames, values);
  Steps steps;
  for (std::size_t f = 1; f < frames; ++f) {
    double most = 0;
    for (std::size_t j = 0; j < rig.joints().size(); ++j) {
      const double step = step_of(&worlds[f - 1][12 * j], &worlds[f][12 * j], rig.size());
      most = std::fmax(most, step);
      if (step <= steps.largest) continue;
      steps.largest = step;
      steps.joint = rig.scene()[rig.joints()[j]].name + ", frame " + std::to_string(f);
    }
    steps.all.push_back(most);
  }
  std::vector<double> all = steps.all;
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2),
                   all.end());
  steps.median = all[all.size() / 2];
  return steps;
}

double time_of(std::size_t frame, std::size_t frames) {
  return static_cast<double>(frame) / static_cast<double>(frames - 1);
}

TEST_CASE("motion continuity: every control of every template at once") {
  for (const char* file : {"biped.yaml", "quadruped.yaml", "winged.yaml", "hand.yaml", "prop.yaml",
                           "biped_tail.yaml"}) {
    const Moving rig(file);
    for (const double ik_fk : {0.0, 1.0}) {
      for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const Waves waves(rig, seed);
        const auto play = [&](double from, double to, std::size_t frames) {
          return steps_of(rig, frames, [&](std::size_t k, std::size_t f, auto& numbers) {
            waves.move(k, from + (to - from) * time_of(f, frames), ik_fk, numbers);
          });
        };
        const Steps at[] = {play(0, 1, 501), play(0, 1, 5001)};
        CAPTURE(rig.name());
        CAPTURE(at[1].joint);
        // By FK a joint's speed is bounded by that of what it hangs under: a chain of a dozen
        // controls that turn by 30 degrees, measured 5 to 15 sizes in the unit of time.
        if (ik_fk == 0) {
          CHECK(at[1].largest * 5000 < 20);
          CHECK(at[0].largest > 9.5 * at[1].largest);
        }
        // Limbs that straighten, or pass near their pole, move as fast as they like, but a hundred
        // times finer their steps are at least nearly ten times smaller.
        for (std::size_t f = 0; f < at[1].all.size(); ++f) {
          if (at[1].all[f] < 0.01) continue;
          const Steps finer = play(time_of(f, 5001), time_of(f + 1, 5001), 101);
          CAPTURE(finer.joint);
          CHECK(finer.largest < 0.25 * at[1].all[f]);
        }
      }
    }
  }
}

TEST_CASE("motion continuity: the blend from FK to IK") {
  for (const char* file : {"biped.yaml", "quadruped.yaml", "biped_tail.yaml"}) {
    const Moving rig(file);
    for (const std::uint64_t seed : {4u, 5u, 6u}) {
      const Waves waves(rig, seed, 10, false);
      Steps at[2];
      const std::size_t frames[] = {501, 5001};
      for (std::size_t i = 0; i < 2; ++i) {
        at[i] = steps_of(rig, frames[i], [&](std::size_t k, std::size_t f, auto& numbers) {
          waves.move(k, 0.3, time_of(f, frames[i]), numbers);
        });
      }
      CAPTURE(rig.name());
      CAPTURE(at[1].joint);
      CHECK(at[0].largest > 0);
      CHECK(at[1].largest * 5000 < 4);
      // The legs of a quadruped hang on what is blended, and may straighten.
      CHECK(at[0].largest > 3 * at[1].largest);
    }
  }
}

}  // namespace
}  // namespace rigc
