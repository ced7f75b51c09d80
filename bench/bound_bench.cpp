// SPDX-License-Identifier: MIT
// The hand-written lower bound of evaluating a hierarchy: what rigc's figures are held against.
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include "bench/bound.h"
#include "bench/lower_bound.h"
#include "math/math.h"

namespace {

using namespace rigc;
using bench::BoundHierarchy;
using bench::kBoundLanes;

/// Chains of ten under a root that stands still, as in the benchmark of rigc's own evaluation.
template <class Number>
struct Chains {
  std::vector<std::int32_t> parents;
  std::vector<Number> translations, rotations, worlds;

  explicit Chains(std::size_t count) : translations(3 * count), worlds(12 * kBoundLanes * count) {
    std::mt19937 engine(1);
    const auto number = [&] { return static_cast<double>(engine()) / 2147483648.0 - 1; };
    for (std::size_t i = 0; i < count; ++i) {
      parents.push_back(i % 10 == 0 ? -1 : static_cast<std::int32_t>(i) - 1);
      translations[3 * i + 1] = Number(0.1);
      rotations.resize(4 * kBoundLanes * (i + 1));
      for (std::size_t lane = 0; lane < kBoundLanes; ++lane) {
        const double x = number(), y = number(), z = number(), w = number();
        const math::Quat q = math::normalised(math::Quat{x, y, z, w});
        const double components[] = {q.x, q.y, q.z, q.w};
        for (std::size_t c = 0; c < 4; ++c)
          rotations[(4 * i + c) * kBoundLanes + lane] = static_cast<Number>(components[c]);
      }
    }
  }

  BoundHierarchy<Number> hierarchy() {
    return {parents.size(), parents.data(), translations.data(), rotations.data(), worlds.data()};
  }

  /// Whether the last chain's end is where plain mathematics has it, in every lane.
  bool is_right() const {
    for (std::size_t lane = 0; lane < kBoundLanes; ++lane) {
      math::Affine world;
      for (std::size_t i = parents.size() - 10; i < parents.size(); ++i) {
        const auto at = [&](std::size_t c) {
          return static_cast<double>(rotations[(4 * i + c) * kBoundLanes + lane]);
        };
        math::Trs local;
        local.translation = {0, 0.1, 0};
        local.rotation = math::normalised(math::Quat{at(0), at(1), at(2), at(3)});
        world = world * math::compose(local);
      }
      const Number* got = worlds.data() + (parents.size() - 1) * 12 * kBoundLanes + lane;
      for (std::size_t r = 0; r < 3; ++r)
        if (!(std::abs(static_cast<double>(got[(9 + r) * kBoundLanes]) - world.origin[r]) < 1e-5))
          return false;
    }
    return true;
  }
};

template <class Number>
using Run = void (*)(const BoundHierarchy<Number>&);

template <class Number>
void bound(benchmark::State& state, Run<Number> run, bool can_run, std::size_t count) {
  if (!can_run) return state.SkipWithError("this machine has not the instructions");
  Chains<Number> chains(count);
  const auto hierarchy = chains.hierarchy();
  const double seconds = bench::least_seconds(state, [&] {
    run(hierarchy);
    benchmark::DoNotOptimize(chains.worlds[0]);
  });
  if (!chains.is_right()) state.SkipWithError("wrong result");
  state.counters["ns"] = seconds * 1e9 / static_cast<double>(count * kBoundLanes);
}

}  // namespace

double rigc::bench::bound_seconds(eval::Isa isa) {
  Chains<double> chains(300);
  const auto hierarchy = chains.hierarchy();
  const double seconds = least_batch(
      [&] {
        isa == eval::Isa::avx2 ? lower_bound_avx2(hierarchy) : lower_bound_sse2(hierarchy);
        benchmark::DoNotOptimize(chains.worlds[0]);
      },
      0.02);
  return seconds / static_cast<double>(300 * kBoundLanes);
}

void rigc::bench::add_bound_benchmarks() {
  const bool avx2 = __builtin_cpu_supports("avx2"), fma = avx2 && __builtin_cpu_supports("fma");
  const struct {
    const char* name;
    Run<double> doubles;
    Run<float> floats;
    bool can_run;
  } sets[] = {{"sse2", lower_bound_sse2, lower_bound_sse2, true},
              {"avx2", lower_bound_avx2, lower_bound_avx2, avx2},
              {"avx2_fma", lower_bound_avx2_fma, lower_bound_avx2_fma, fma}};
  for (const auto& set : sets)
    for (const std::size_t count : {300, 10'000, 100'000}) {
      const std::string begin = std::string("bound/") + set.name;
      const std::string end = "/" + std::to_string(count);
      benchmark::RegisterBenchmark((begin + "/double" + end).c_str(), bound<double>, set.doubles,
                                   set.can_run, count);
      benchmark::RegisterBenchmark((begin + "/float" + end).c_str(), bound<float>, set.floats,
                                   set.can_run, count);
    }
}
