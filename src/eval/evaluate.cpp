// SPDX-License-Identifier: MIT
// One frame of a scene. Test: tests/eval/evaluate_test.cpp
#include "eval/evaluate.h"

#include "eval/values.h"

namespace rigc::eval {

std::optional<std::vector<scene::Value>> evaluate(const scene::Scene& scene,
                                                  const std::vector<scene::Plug>& plugs,
                                                  const std::vector<Setting>& settings,
                                                  Diagnostics& diagnostics) {
  Request request;
  request.outputs = plugs;
  for (const Setting& setting : settings) request.inputs.push_back(setting.plug);
  const auto program = compile(scene, request, diagnostics);
  if (!program) return std::nullopt;
  Instance instance(*program);
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const std::vector<double> numbers = numbers_of(settings[i].value);
    set_lane(instance.input(i), 0, numbers.data(), static_cast<int>(numbers.size()));
  }
  instance.run();
  std::vector<scene::Value> values;
  for (std::size_t i = 0; i < plugs.size(); ++i) {
    double numbers[12];
    get_lane(instance.output(i), 0, numbers, static_cast<int>(program->outputs[i].width));
    values.push_back(value_from(*scene.type(plugs[i]), numbers));
  }
  return values;
}

std::vector<math::Affine> worlds(const scene::Scene& scene, const std::vector<scene::NodeId>& nodes,
                                 const std::vector<Setting>& settings) {
  std::vector<scene::Plug> plugs;
  for (const scene::NodeId node : nodes) plugs.push_back({node, scene::transform::kWorld});
  Diagnostics diagnostics;
  const auto values = evaluate(scene, plugs, settings, diagnostics);
  std::vector<math::Affine> result;
  if (!values) return result;
  for (const scene::Value& value : *values) result.push_back(std::get<math::Affine>(value));
  return result;
}

std::vector<bool> varying_outputs(const Program& program) {
  std::vector<bool> written(program.rows, false);
  const auto mark = [&](const Register& r) {
    for (std::uint32_t row = r.row; row < r.row + r.width; ++row) written[row] = true;
  };
  for (const Register& input : program.inputs) mark(input);
  for (const Instruction& instruction : program.instructions) mark(instruction.out);
  std::vector<bool> varying;
  for (const Register& output : program.outputs) {
    bool varies = false;
    for (std::uint32_t row = output.row; row < output.row + output.width; ++row)
      varies = varies || written[row];
    varying.push_back(varies);
  }
  return varying;
}

}  // namespace rigc::eval
