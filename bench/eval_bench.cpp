// SPDX-License-Identifier: MIT
// Evaluation alone: nanoseconds a node and frame of a hierarchy, of two-bone IK and of chain IK,
// and the time that compiling a scene takes. Scenes are built here, so that the figures do not move
// with the templates.
#include <benchmark/benchmark.h>

#include "bench/bench.h"
#include "eval/evaluate.h"
#include "scene/edit.h"

namespace {

using namespace rigc;
using scene::Kind;
using scene::NodeId;
using scene::Plug;
namespace transform = scene::transform;

struct Rig {
  scene::Scene scene;
  scene::Journal journal;
  scene::Edit edit{scene, journal, nullptr};
  eval::Request request;

  NodeId make(Kind kind, NodeId parent = {}) {
    scene::Node node;
    node.kind = kind;
    node.parent = parent;
    return edit.make(std::move(node));
  }
};

/// Chains of ten joints under a root, each joint's rotation animated.
void make_hierarchy(Rig& rig, int joints) {
  const NodeId root = rig.make(Kind::transform);
  NodeId at = root;
  for (int i = 0; i < joints; ++i) {
    at = rig.make(Kind::joint, i % 10 == 0 ? root : at);
    rig.edit.set({at, transform::kTranslate}, math::Vec3{0, 0.1, 0});
    rig.request.inputs.push_back({at, transform::kRotation});
    rig.request.outputs.push_back({at, transform::kWorld});
  }
}

void make_two_bones(Rig& rig, int limbs) {
  namespace ik2 = scene::ik2;
  const NodeId goal = rig.make(Kind::control);
  rig.request.inputs.push_back({goal, transform::kTranslate});
  for (int i = 0; i < limbs; ++i) {
    const NodeId ik = rig.make(Kind::ik_two_bone);
    rig.edit.connect({goal, transform::kWorld}, {ik, ik2::kGoal});
    rig.edit.set({ik, ik2::kPole}, math::translation({0, 0, 5}));
    rig.edit.set({ik, ik2::kMiddle}, math::Vec3{0, -1, 0.1});
    rig.edit.set({ik, ik2::kEnd}, math::Vec3{0, -1, 0.1});
    for (std::int32_t k = 0; k < 2; ++k) rig.edit.set({ik, ik2::kOffsets, k}, math::Quat{});
    rig.request.outputs.push_back({ik, ik2::kMiddleWorld});
  }
}

void make_chains(Rig& rig, int chains) {
  namespace chain_at = scene::ik_chain;
  const NodeId goal = rig.make(Kind::control);
  rig.edit.set({goal, transform::kTranslate}, math::Vec3{1, 2, 1});
  rig.request.inputs.push_back({goal, transform::kTranslate});
  for (int i = 0; i < chains; ++i) {
    const NodeId chain = rig.make(Kind::ik_chain);
    rig.edit.connect({goal, transform::kWorld}, {chain, chain_at::kGoal});
    for (std::int32_t k = 0; k < 8; ++k) {
      rig.edit.set({chain, chain_at::kTranslates, k}, math::Vec3{0, 0.5, 0});
      rig.edit.set({chain, chain_at::kRests, k}, math::axis_angle({1, 0, 0}, 0.1));
    }
    rig.request.outputs.push_back({chain, chain_at::kRotations, 0});
  }
}

using Make = void (*)(Rig&, int);

/// Blocks of kLanes frames; the counter is the time of one node in one frame.
void run(benchmark::State& state, Make make, int nodes) {
  Rig rig;
  make(rig, nodes);
  Diagnostics diagnostics;
  const auto program = eval::compile(rig.scene, rig.request, diagnostics);
  if (!program) return state.SkipWithError("the scene does not compile");
  eval::Instance instance(*program);
  for ([[maybe_unused]] auto iteration : state) {
    instance.run();
    benchmark::DoNotOptimize(instance.output(0)[0]);
  }
  const double per_block = static_cast<double>(nodes) * eval::kLanes;
  state.counters["per_node_and_frame"] = benchmark::Counter(
      per_block, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void compile(benchmark::State& state, Make make, int nodes) {
  Rig rig;
  make(rig, nodes);
  for ([[maybe_unused]] auto iteration : state) {
    Diagnostics diagnostics;
    benchmark::DoNotOptimize(eval::compile(rig.scene, rig.request, diagnostics));
  }
}

}  // namespace

void rigc::bench::add_eval_benchmarks() {
  const struct {
    const char* name;
    Make make;
    int nodes;
  } rigs[] = {{"hierarchy", make_hierarchy, 300},
              {"two_bones", make_two_bones, 20},
              {"chains", make_chains, 10}};
  for (const auto& rig : rigs) {
    const std::string name = rig.name;
    benchmark::RegisterBenchmark(("evaluate/" + name).c_str(), run, rig.make, rig.nodes);
    benchmark::RegisterBenchmark(("compile/" + name).c_str(), compile, rig.make, rig.nodes);
  }
}
