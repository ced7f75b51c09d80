// SPDX-License-Identifier: MIT
// Evaluation alone, all outputs written: hierarchies of 100 to 100,000 transforms, solvers, the
// biped; one thread and two; and what compiling costs. `ns` is the time of one node (of the biped:
// of one transform that moves) in one frame, at best; `ratio` is to the hand-written lower bound.
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "bench/bound.h"
#include "eval/evaluate.h"
#include "pipeline/build.h"
#include "scene/edit.h"

namespace {

using namespace rigc;
using scene::Kind;
using scene::NodeId;
namespace transform = scene::transform;

struct Rig {
  scene::Scene scene;
  eval::Request request;
};

/// Builds a rig node by node.
struct Maker {
  eval::Request& request;
  scene::Journal journal;
  scene::Edit edit;

  explicit Maker(Rig& rig) : request(rig.request), edit(rig.scene, journal, nullptr) {}

  NodeId make(Kind kind, NodeId parent = {}) {
    scene::Node node;
    node.kind = kind;
    node.parent = parent;
    return edit.make(std::move(node));
  }
  /// A joint that turns and whose world is asked for.
  NodeId turning_joint(NodeId parent) {
    const NodeId joint = make(Kind::joint, parent);
    edit.set({joint, transform::kTranslate}, math::Vec3{0, 0.1, 0});
    request.inputs.push_back({joint, transform::kRotation});
    request.outputs.push_back({joint, transform::kWorld});
    return joint;
  }
};

/// Chains of ten joints under a root, one after the other.
void make_chains(Rig& rig, int joints) {
  Maker maker(rig);
  const NodeId root = maker.make(Kind::transform);
  NodeId at = root;
  for (int i = 0; i < joints; ++i) at = maker.turning_joint(i % 10 == 0 ? root : at);
}

/// A balanced tree, each joint with two below it, level by level.
void make_tree(Rig& rig, int joints) {
  Maker maker(rig);
  std::vector<NodeId> made;
  for (int i = 0; i < joints; ++i)
    made.push_back(
        maker.turning_joint(i == 0 ? NodeId{} : made[static_cast<std::size_t>(i - 1) / 2]));
}

/// No two limbs or chains are alike: what is computed twice a program computes once.
void make_two_bones(Rig& rig, int limbs) {
  namespace ik2 = scene::ik2;
  Maker maker(rig);
  const NodeId goal = maker.make(Kind::control);
  rig.request.inputs.push_back({goal, transform::kTranslate});
  for (int i = 0; i < limbs; ++i) {
    const NodeId ik = maker.make(Kind::ik_two_bone);
    maker.edit.connect({goal, transform::kWorld}, {ik, ik2::kGoal});
    maker.edit.set({ik, ik2::kPole}, math::translation({0.1 * i, 0, 5}));
    maker.edit.set({ik, ik2::kMiddle}, math::Vec3{0, -1, 0.1});
    maker.edit.set({ik, ik2::kEnd}, math::Vec3{0, -1, 0.1});
    for (std::int32_t k = 0; k < 2; ++k) maker.edit.set({ik, ik2::kOffsets, k}, math::Quat{});
    rig.request.outputs.push_back({ik, ik2::kMiddleWorld});
  }
}

void make_ik_chains(Rig& rig, int chains) {
  namespace chain_at = scene::ik_chain;
  Maker maker(rig);
  const NodeId goal = maker.make(Kind::control);
  maker.edit.set({goal, transform::kTranslate}, math::Vec3{1, 2, 1});
  rig.request.inputs.push_back({goal, transform::kTranslate});
  for (int i = 0; i < chains; ++i) {
    const NodeId chain = maker.make(Kind::ik_chain);
    maker.edit.connect({goal, transform::kWorld}, {chain, chain_at::kGoal});
    for (std::int32_t k = 0; k < 8; ++k) {
      maker.edit.set({chain, chain_at::kTranslates, k}, math::Vec3{0.01 * i, 0.5, 0});
      maker.edit.set({chain, chain_at::kRests, k}, math::axis_angle({1, 0, 0}, 0.1));
    }
    rig.request.outputs.push_back({chain, chain_at::kRotations, 0});
  }
}

enum class Biped {
  plain,      // with the features that are on by default
  full,       // with all features
  full_keyed  // the same with all numbers of controls animated too, but the size of the whole
};

/// Numbers that scale a transform as they are.
std::set<scene::Plug> sizes(const scene::Scene& scene) {
  std::set<scene::Plug> found;
  for (const NodeId id : scene.nodes())
    for (const scene::Connection& c : scene[id].inputs)
      if (scene::spec(scene[id].kind).is_transform && c.to.attribute == transform::kScale)
        found.insert(c.from);
  return found;
}

void add_numbers(Rig& rig, NodeId control, const std::set<scene::Plug>& without) {
  const auto& numbers = rig.scene[control].user;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const scene::Plug plug{control, static_cast<std::uint16_t>(scene::kUserAttributes + i)};
    if (numbers[i].keyable && !without.count(plug)) rig.request.inputs.push_back(plug);
  }
}

/// The biped with translation and rotation of all controls as inputs, all joints' worlds as
/// outputs; false where it cannot be built.
bool make_biped(Rig& rig, Biped which = Biped::plain) {
  Diagnostics diagnostics;
  pipeline::BuildRequest request;
  if (which != Biped::plain) request.features = bench::all_features();
  request.paths.templates = {std::string(RIGC_SOURCE_DIR) + "/templates"};
  request.template_file = request.paths.templates[0] + "/biped.yaml";
  const auto prepared = pipeline::prepare(request, diagnostics);
  std::size_t skipped = 0;
  auto built =
      prepared ? pipeline::run_commands(*prepared, prepared->catalogue, {}, skipped, diagnostics)
               : std::nullopt;
  if (!built) return false;
  rig.scene = std::move(built->scene);
  const std::set<scene::Plug> without = sizes(rig.scene);
  for (const NodeId id : rig.scene.nodes()) {
    const Kind kind = rig.scene[id].kind;
    if (kind == Kind::control)
      for (const std::uint16_t attribute : {transform::kTranslate, transform::kRotation})
        rig.request.inputs.push_back({id, attribute});
    if (kind == Kind::control && which == Biped::full_keyed) add_numbers(rig, id, without);
    if (kind == Kind::joint) rig.request.outputs.push_back({id, transform::kWorld});
  }
  return true;
}

/// Different small offsets and turns in every lane.
void pose(const Rig& rig, eval::Instance& instance) {
  for (std::size_t i = 0; i < rig.request.inputs.size(); ++i)
    for (int lane = 0; lane < eval::kLanes; ++lane) {
      const double s = 0.1 * math::sin(0.7 * static_cast<double>(i) + 0.3 * lane);
      const math::Quat q = math::normalised(math::Quat{s, 0.5 * s, -s, 1});
      const double turn[] = {q.x, q.y, q.z, q.w}, offset[] = {s, 0.1 * s, -s};
      const std::uint16_t attribute = rig.request.inputs[i].attribute;
      if (attribute >= scene::kUserAttributes) continue;
      const bool turns = attribute == transform::kRotation;
      eval::set_lane(instance.input(i), lane, turns ? turn : offset, turns ? 4 : 3);
    }
}

/// Transforms of the scene that the program evaluates in every frame.
std::size_t live_transforms(const scene::Scene& scene, const eval::Program& program) {
  std::set<std::uint32_t> nodes;
  for (const eval::Instruction& instruction : program.instructions) nodes.insert(instruction.node);
  std::size_t live = 0;
  for (const NodeId id : scene.nodes())
    live += scene::spec(scene[id].kind).is_transform && nodes.count(id.index) ? 1 : 0;
  return live;
}

using Make = void (*)(Rig&, int);

/// Evaluates blocks; gives the seconds of one frame at best.
double run_blocks(benchmark::State& state, const Rig& rig, const eval::Program& program,
                  eval::Isa isa) {
  eval::Instance instance(program, isa);
  pose(rig, instance);
  instance.run();
  const double first = instance.output(0)[0];
  const double seconds = bench::least_seconds(state, [&] {
    instance.run();
    benchmark::DoNotOptimize(instance.output(0)[0]);
  });
  if (instance.output(0)[0] != first) state.SkipWithError("another run, another result");
  return seconds / eval::kLanes;
}

void run(benchmark::State& state, Make make, int nodes, bool against_bound, eval::Isa isa) {
  Rig rig;
  make(rig, nodes);
  Diagnostics diagnostics;
  const auto program = eval::compile(rig.scene, rig.request, diagnostics);
  if (!program) return state.SkipWithError("the scene does not compile");
  const double seconds = run_blocks(state, rig, *program, isa) / nodes;
  state.counters["ns"] = seconds * 1e9;
  if (against_bound) state.counters["ratio"] = seconds / bench::bound_seconds(isa);
}

void run_biped(benchmark::State& state, Biped which, eval::Isa isa) {
  Rig rig;
  Diagnostics diagnostics;
  const auto program =
      make_biped(rig, which) ? eval::compile(rig.scene, rig.request, diagnostics) : std::nullopt;
  if (!program) return state.SkipWithError("the biped does not compile");
  const double seconds = run_blocks(state, rig, *program, isa);
  const auto live = static_cast<double>(live_transforms(rig.scene, *program));
  state.counters["us_per_frame"] = seconds * 1e6;
  state.counters["live"] = live;
  state.counters["instructions"] = static_cast<double>(program->instructions.size());
  state.counters["ns"] = seconds * 1e9 / live;
  state.counters["ratio"] = seconds / live / bench::bound_seconds(isa);
}

/// From a built biped to its first eight frames.
void first_block(benchmark::State& state) {
  Rig rig;
  if (!make_biped(rig)) return state.SkipWithError("the biped cannot be built");
  for ([[maybe_unused]] auto iteration : state) {
    Diagnostics diagnostics;
    const auto program = eval::compile(rig.scene, rig.request, diagnostics);
    if (!program) return state.SkipWithError("the biped does not compile");
    eval::Instance instance(*program);
    instance.run();
    benchmark::DoNotOptimize(instance.output(0)[0]);
  }
}

/// Chains whose program all threads of a benchmark share.
struct Shared {
  Rig rig;
  std::optional<eval::Program> program;
  explicit Shared(int nodes) {
    Diagnostics diagnostics;
    make_chains(rig, nodes);
    program = eval::compile(rig.scene, rig.request, diagnostics);
  }
};

/// Each thread evaluates blocks of its own; items are nodes times frames of all threads.
void run_threads(benchmark::State& state, int nodes) {
  static std::mutex mutex;
  static std::shared_ptr<const Shared> shared;
  static int shared_nodes = 0;
  std::shared_ptr<const Shared> own;
  {
    const std::lock_guard lock(mutex);
    if (!shared || shared_nodes != nodes) shared = std::make_shared<Shared>(nodes);
    shared_nodes = nodes;
    own = shared;
  }
  if (!own->program) return state.SkipWithError("the scene does not compile");
  eval::Instance instance(*own->program);
  pose(own->rig, instance);
  for ([[maybe_unused]] auto iteration : state) {
    instance.run();
    benchmark::DoNotOptimize(instance.output(0)[0]);
  }
  state.SetItemsProcessed(state.iterations() * nodes * eval::kLanes);
}

void compile(benchmark::State& state, Make make, int nodes) {
  Rig rig;
  make(rig, nodes);
  const double seconds = bench::least_seconds(state, [&] {
    Diagnostics diagnostics;
    benchmark::DoNotOptimize(eval::compile(rig.scene, rig.request, diagnostics));
  });
  state.counters["ns"] = seconds * 1e9 / nodes;
}

void compile_biped(benchmark::State& state, Biped which) {
  Rig rig;
  if (!make_biped(rig, which)) return state.SkipWithError("the biped cannot be built");
  const double seconds = bench::least_seconds(state, [&] {
    Diagnostics diagnostics;
    benchmark::DoNotOptimize(eval::compile(rig.scene, rig.request, diagnostics));
  });
  state.counters["ns"] = seconds * 1e9 / static_cast<double>(rig.scene.nodes().size());
}

std::string evaluate_name(const std::string& rig, eval::Isa isa) {
  return "evaluate/" + rig + "/" + std::string(eval::name(isa));
}

}  // namespace

void rigc::bench::add_eval_benchmarks() {
  const struct {
    const char* name;
    Make make;
    int nodes;
    bool is_hierarchy;
  } rigs[] = {
      {"chains/100", make_chains, 100, true},        {"chains/300", make_chains, 300, true},
      {"chains/1000", make_chains, 1000, true},      {"chains/10000", make_chains, 10'000, true},
      {"chains/100000", make_chains, 100'000, true}, {"tree/100", make_tree, 100, true},
      {"tree/1000", make_tree, 1000, true},          {"tree/10000", make_tree, 10'000, true},
      {"tree/100000", make_tree, 100'000, true},     {"ik_two_bone/20", make_two_bones, 20, false},
      {"ik_chain/10", make_ik_chains, 10, false},
  };
  const struct {
    const char* name;
    Biped which;
  } bipeds[] = {
      {"biped", Biped::plain}, {"biped_all", Biped::full}, {"biped_all_keyed", Biped::full_keyed}};
  for (const auto& biped : bipeds) {
    for (const eval::Isa isa : eval::available_isas())
      benchmark::RegisterBenchmark(evaluate_name(biped.name, isa).c_str(), run_biped, biped.which,
                                   isa);
    benchmark::RegisterBenchmark(("compile/" + std::string(biped.name)).c_str(), compile_biped,
                                 biped.which)
        ->Unit(benchmark::kMicrosecond);
  }
  benchmark::RegisterBenchmark("first_block/biped", first_block)->Unit(benchmark::kMicrosecond);
  for (const auto& rig : rigs) {
    const std::string name = rig.name;
    for (const eval::Isa isa : eval::available_isas())
      benchmark::RegisterBenchmark(evaluate_name(name, isa).c_str(), run, rig.make, rig.nodes,
                                   rig.is_hierarchy, isa);
    benchmark::RegisterBenchmark(("compile/" + name).c_str(), compile, rig.make, rig.nodes);
  }
  for (const int nodes : {100, 1000, 2000, 10'000})
    benchmark::RegisterBenchmark(("threads/chains/" + std::to_string(nodes)).c_str(), run_threads,
                                 nodes)
        ->ThreadRange(1, 2)
        ->UseRealTime();
}
