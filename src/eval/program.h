// SPDX-License-Identifier: MIT
// A rig compiled to a flat list of instructions over registers, in dependency order of plugs.
// Evaluates blocks of frames: each register is `width` rows of `lanes` doubles.
// Test: tests/eval/program_test.cpp
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "eval/isa.h"
#include "eval/kernels/call.h"
#include "scene/scene.h"

namespace rigc::eval {

/// What a program must give and what varies from frame to frame.
struct Request {
  std::vector<scene::Plug>
      inputs;  ///< animated: whole plugs (translate, rotation, scale, number), never components
  std::vector<scene::Plug> outputs;  ///< whole plugs or components
};

enum class Op : std::uint8_t;  // kernels/table.h
struct KernelRow;

struct Instruction {
  Op op;
  Register out;
  std::uint32_t first_argument = 0;  ///< into Program::arguments
  std::uint32_t argument_count = 0;
  std::uint32_t data = 0;  ///< into Program::data; its meaning is the kernel's
  std::uint32_t data_count = 0;
  std::uint32_t node = 0;  ///< index of the scene node it came from
};

class Program {
 public:
  std::uint32_t rows = 0;
  std::vector<Instruction> instructions;
  std::vector<Register> arguments;
  std::vector<double> data;  ///< tables of kernels (curves, counts)
  struct Constant {
    std::uint32_t row;
    double value;
  };
  std::vector<Constant> constants;  ///< rows that hold one value in every lane and frame, and what
                                    ///< inputs hold until set
  std::vector<Register> inputs;     ///< one for each Request::inputs, same order
  std::vector<Register> outputs;    ///< one for each Request::outputs, same order

  /// A readable listing, the same for the same scene: each instruction with its node. With the
  /// request also the plugs of inputs and outputs, with the sources the template line of each node.
  std::string dump(const scene::Scene& scene, const Request* request = nullptr,
                   const Sources* sources = nullptr) const;
};

/// Cycles are reported with every plug, command and template line in them.
std::optional<Program> compile(const scene::Scene& scene, const Request& request,
                               Diagnostics& diagnostics);

/// Registers of one thread: set inputs, run, read outputs. Inputs that are never set hold the
/// scene's values.
class Instance {
 public:
  explicit Instance(const Program& program, Isa isa = default_isa());
  /// Rows of an input or output register: row r, lane l at [r * kLanes + l].
  double* input(std::size_t index);
  const double* output(std::size_t index) const;
  void run();

 private:
  /// A line of the cache each, so that no pack lies across two.
  struct alignas(sizeof(double) * kLanes) Row {
    double lanes[kLanes] = {};
  };

  const Program& program_;
  const KernelRow* kernels_;
  std::vector<Row> rows_;
};

}  // namespace rigc::eval
