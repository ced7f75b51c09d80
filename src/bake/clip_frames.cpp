// SPDX-License-Identifier: MIT
// Frames of a clip. Test: tests/bake/match_test.cpp, tests/pipeline/morphs_test.cpp
#include "bake/clip_frames.h"

#include "eval/clip_inputs.h"
#include "eval/evaluate.h"

namespace rigc::bake {

math::Affine affine(const std::vector<double>& row, std::size_t frame) {
  const double* n = row.data() + 12 * frame;
  return {{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}}, {n[9], n[10], n[11]}};
}

void ClipFrames::sample(const std::vector<int>& nodes, const anim::Clip& clip) {
  for (const eval::ClipInput& input : eval::clip_inputs(scene_, nodes, clip)) {
    const auto width = static_cast<std::size_t>(input.curve->width);
    keyed.insert(input.plug);
    std::vector<double>& values = table[input.plug];
    values.resize(count() * width);
    anim::Sampler sampler(*input.curve, input.plug.attribute == scene::transform::kRotation &&
                                            scene::spec(scene_[input.plug.node].kind).is_transform);
    for (std::size_t f = 0; f < count(); ++f) sampler.at(times_[f], values.data() + f * width);
  }
}

std::optional<Rows> ClipFrames::evaluate(const std::vector<scene::Plug>& plugs) const {
  eval::Request request;
  for (const auto& [plug, values] : table) request.inputs.push_back(plug);
  request.outputs = plugs;
  const auto program = eval::compile(scene_, request, diagnostics_);
  if (!program) return std::nullopt;
  std::vector<int> widths;
  for (const scene::Plug& plug : plugs) widths.push_back(scene::width(*scene_.type(plug)));
  Rows rows(plugs.size());
  for (std::size_t i = 0; i < plugs.size(); ++i)
    rows[i].resize(count() * static_cast<std::size_t>(widths[i]));
  const auto give = [&](eval::Instance& instance, std::size_t frame, int lane) {
    std::size_t at = 0;
    for (const auto& [plug, values] : table) {
      const std::size_t width = values.size() / count();
      eval::set_lane(instance.input(at++), lane, values.data() + frame * width,
                     static_cast<int>(width));
    }
  };
  const auto take = [&](eval::Instance& instance, std::size_t frame, int lane) {
    for (std::size_t i = 0; i < plugs.size(); ++i)
      eval::get_lane(instance.output(i), lane,
                     rows[i].data() + frame * static_cast<std::size_t>(widths[i]), widths[i]);
  };
  eval::for_frames(*program, count(), give, take);
  return rows;
}

}  // namespace rigc::bake
