// SPDX-License-Identifier: MIT
// Nanoseconds of each kind of instruction in one frame, for each instruction set, dispatch
// included: a program of sixteen of them, small enough for the first cache, over random input.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "bench/bench.h"
#include "eval/kernels/table.h"
#include "eval/program.h"
#include "math/generic/spline.h"
#include "math/math.h"

namespace {

using namespace rigc;
using eval::Op;
using Numbers = std::vector<double>;

constexpr int kInstructions = 16;
constexpr int kTargets = 2, kChainJoints = 8, kSplineControls = 5, kSplineOutputs = 6;

/// What random numbers an argument has.
enum class Kind { number, angle, angles, vector, scale, rotation, matrix };

struct Form {
  std::vector<Kind> arguments;
  std::uint32_t width = 1;  ///< of the result
  Numbers data;
};

const Numbers kIdentity = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

Numbers joined(std::initializer_list<Numbers> parts) {
  Numbers out;
  for (const Numbers& part : parts) out.insert(out.end(), part.begin(), part.end());
  return out;
}

Numbers limit_table() {
  return joined({{-10, -10, -10, 10, 10, 10}, {0, 0, 0, 1}, {0, 0, 0}, {0, 0, 0, 1}, {0, 1, 2}});
}

/// Outputs spread over the curve, which aim at each other; `moves`: lengths may be kept.
Numbers spline_table(double moves) {
  Numbers data{kSplineControls, kSplineOutputs, 1, moves, 0, 4};
  for (int i = 0; i < kSplineControls; ++i) data.insert(data.end(), {0, 1, 0, 1, 0, 1, 0, 0, 0, 1});
  for (int k = 0; k < kSplineOutputs; ++k) {
    const double x = static_cast<double>(k) * (kSplineControls - 1) / kSplineOutputs;
    const double segment = std::floor(x), t = x - segment;
    data.insert(data.end(), {segment, t});
    for (const auto& b : {math::generic::place_basis(t), math::generic::slope_basis(t)})
      data.insert(data.end(), {b.from, b.leaving, b.to, b.arriving});
    data.insert(data.end(), {x, 0.8});
    data.insert(data.end(), kIdentity.begin(), kIdentity.end());
  }
  return data;
}

/// The kinds of instructions that are no formulas, by their names in the table.
const std::map<std::string, Form>& forms() {
  using K = Kind;
  const K n = K::number, v = K::vector, q = K::rotation, s = K::scale, m = K::matrix, a = K::angle;
  Numbers rests;
  for (int joint = 0; joint < kChainJoints; ++joint)
    rests.insert(rests.end(), {0.04997916927067833, 0, 0, 0.9987502603949663});  // 0.1 about x
  std::vector<K> chain(4 + kChainJoints, v);
  chain[0] = chain[1] = chain[2] = m;
  chain[3] = a;
  std::vector<K> spline(4 + kSplineControls, m);
  spline[1] = spline[2] = spline[3] = n;
  static const std::map<std::string, Form> table = {
      {"compose", {{v, q, s}, 12, {}}},
      {"compose_rigid", {{v, q}, 12, {}}},
      {"compose_under", {{v, q}, 12, {0, 0.1, 0, 0, 0, 0, 1}}},
      {"multiply", {{m, m}, 12, {}}},
      {"hang", {{m, m}, 12, kIdentity}},
      {"hang_straight", {{m, m}, 12, {0, 0.1, 0}}},
      {"place", {{m, m, v}, 12, {}}},
      {"gather", {{v, q, n}, 8, {}}},
      {"from_euler", {{K::angles}, 4, {}}},
      {"to_euler", {{q}, 3, {}}},
      {"constraint", {{m, m, n, m, n}, 10, joined({{kTargets, 0}, kIdentity, kIdentity})}},
      {"aim", {{m, v, m, v, m, n, m, n}, 4, {kTargets, 1, 0, 0, 0, 1}}},
      {"blend", {{m, n, m, n}, 12, joined({{kTargets}, kIdentity, kIdentity})}},
      {"aim_world",
       {{m, v, m, v, m, n, m, n}, 12, joined({{kTargets, 1}, {1, 0, 0, 0, 1, 0, 0, 0, 1}})}},
      {"ik_two_bone",
       {{m, m, m, a, v, v, v, s, s},
        24,
        joined({{0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 1}})}},
      {"ik_chain",
       {chain, 4 * (kChainJoints - 1), joined({{kChainJoints, 1, 32}, {0, 0, 0}, rests})}},
      {"spline", {spline, 2 + 12 * kSplineOutputs, spline_table(0)}},
      {"limit_vector", {{v}, 3, limit_table()}},
      {"limit_rotation", {{q}, 4, limit_table()}},
      {"vector_add", {{v, v}, 3, {}}},
      {"vector_subtract", {{v, v}, 3, {}}},
      {"vector_scale", {{v, n}, 3, {}}},
      {"vector_multiply", {{v, v}, 3, {}}},
      {"vector_lerp", {{v, v, n}, 3, {}}},
      {"dot", {{v, v}, 1, {}}},
      {"cross", {{v, v}, 3, {}}},
      {"length", {{v}, 1, {}}},
      {"normalise", {{v}, 3, {}}},
      {"rotation_multiply", {{q, q}, 4, {}}},
      {"rotation_inverse", {{q}, 4, {}}},
      {"rotation_apply", {{q, v}, 3, {}}},
      {"rotation_slerp", {{q, q, n}, 4, {}}},
      {"axis_angle", {{v, a}, 4, {}}},
      {"twist_angle", {{q, v}, 1, {}}},
      {"between", {{v, v}, 4, {}}},
      {"aim_rotation", {{v, v}, 4, {}}},
      {"matrix_rotation", {{m}, 4, {}}},
      {"matrix_scale", {{m}, 3, {}}},
      {"matrix_inverse", {{m}, 12, {}}},
      {"transform_point", {{m, v}, 3, {}}},
      {"transform_vector", {{m, v}, 3, {}}},
      {"choose", {{n, m, m}, 12, {}}},
      {"remap", {{n, n, n, n, n}, 1, {1, 3, 0, 0, 2, 0, 0.5, 0.8, 1, 0, 1, 1, 1, 0}}},
  };
  return table;
}

class Maker {
 public:
  /// Adds an instruction with registers of its own.
  void add(Op op, const Form& form) {
    eval::Instruction instruction;
    instruction.op = op;
    instruction.first_argument = static_cast<std::uint32_t>(program_.arguments.size());
    instruction.argument_count = static_cast<std::uint32_t>(form.arguments.size());
    for (const Kind kind : form.arguments) {
      std::uint32_t width = 0;
      for (int lane = 0; lane < eval::kLanes; ++lane) {
        const Numbers one = values(kind);
        width = static_cast<std::uint32_t>(one.size());
        lanes_.insert(lanes_.end(), one.begin(), one.end());
      }
      program_.arguments.push_back({program_.rows, width});
      program_.inputs.push_back({program_.rows, width});
      program_.rows += width;
    }
    instruction.data = static_cast<std::uint32_t>(program_.data.size());
    program_.data.insert(program_.data.end(), form.data.begin(), form.data.end());
    instruction.out = {program_.rows, form.width};
    program_.rows += form.width;
    program_.outputs.push_back(instruction.out);
    program_.instructions.push_back(instruction);
  }

  const eval::Program& program() const { return program_; }

  /// Sets what each lane of each input holds.
  void fill(eval::Instance& instance) const {
    const double* at = lanes_.data();
    for (std::size_t i = 0; i < program_.inputs.size(); ++i) {
      const std::uint32_t width = program_.inputs[i].width;
      for (int lane = 0; lane < eval::kLanes; ++lane)
        for (std::uint32_t r = 0; r < width; ++r)
          instance.input(i)[r * eval::kLanes + lane] = *at++;
    }
  }

 private:
  double random(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / 4294967295.0;
  }
  math::Quat rotation() {
    const double x = random(-1, 1), y = random(-1, 1), z = random(-1, 1), w = random(-1, 1);
    return math::normalised(math::Quat{x, y, z, w});
  }
  Numbers values(Kind kind) {
    switch (kind) {
      case Kind::number:
        return {random(0, 1)};
      case Kind::angle:
        return {random(-90, 90)};
      case Kind::angles:
        return {random(-90, 90), random(-90, 90), random(-90, 90)};
      case Kind::scale:
        return {random(0.8, 1.2), random(0.8, 1.2), random(0.8, 1.2)};
      case Kind::vector:
        return {random(-1, 1), random(-1, 1), random(-1, 1)};
      case Kind::rotation: {
        const math::Quat q = rotation();
        return {q.x, q.y, q.z, q.w};
      }
      case Kind::matrix: {
        const math::Mat3 m = math::matrix(rotation());
        Numbers out;
        for (const math::Vec3& column : {m.x, m.y, m.z})
          out.insert(out.end(), {column.x, column.y, column.z});
        for (int i = 0; i < 3; ++i) out.push_back(random(-1, 1));
        return out;
      }
    }
    return {};
  }

  std::mt19937 engine_{1};
  eval::Program program_;
  Numbers lanes_;
};

void kernel(benchmark::State& state, Op op, eval::Isa isa) {
  const eval::KernelRow& row = eval::row(op, isa);
  const auto known = forms().find(std::string(row.name));
  Form form;
  if (known != forms().end()) {
    form = known->second;
  } else if (op >= Op::negate) {
    form.arguments.assign(static_cast<std::size_t>(row.arguments), Kind::number);
  } else {
    return state.SkipWithError("this benchmark has no input for the instruction");
  }
  Maker maker;
  for (int i = 0; i < kInstructions; ++i) maker.add(op, form);
  eval::Instance instance(maker.program(), isa);
  maker.fill(instance);
  const double least = bench::least_seconds(state, [&] {
    instance.run();
    benchmark::DoNotOptimize(instance.output(0)[0]);
  });
  state.counters["ns"] = least * 1e9 / (kInstructions * eval::kLanes);
}

}  // namespace

void rigc::bench::add_kernel_benchmarks() {
  for (int op = 0; op < static_cast<int>(Op::count); ++op) {
    for (const eval::Isa isa : eval::available_isas()) {
      const auto begin = "instruction/" + std::string(eval::row(static_cast<Op>(op)).name);
      const auto name = begin + "/" + std::string(eval::name(isa));
      benchmark::RegisterBenchmark(name.c_str(), kernel, static_cast<Op>(op), isa);
    }
  }
}
