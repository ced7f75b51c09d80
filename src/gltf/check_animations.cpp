// SPDX-License-Identifier: MIT
// Checks of animations: samplers, their counts, what channels drive.
// Test: tests/gltf/file_test.cpp
#include <fmt/format.h>

#include "base/text.h"
#include "gltf/check.h"
#include "gltf/codes.h"

namespace rigc::gltf {
namespace {

struct Sampler {
  std::optional<std::size_t> input, output;
  bool cubic = false;
};

Sampler check_sampler(Check& check, const json::Value& value) {
  Sampler sampler;
  sampler.input = check.index(value, "input", "accessors", true);
  sampler.output = check.index(value, "output", "accessors", true);
  sampler.cubic =
      check.word(value, "interpolation", {"LINEAR", "STEP", "CUBICSPLINE"}) == "CUBICSPLINE";
  if (!sampler.input) return sampler;
  if (!check.accessors()[*sampler.input].is_real("SCALAR"))
    check.report(codes::kSampler, value["input"],
                 fmt::format("accessor {} is not of float SCALAR, as times are", *sampler.input));
  return sampler;
}

/// Whether the output's type can drive `path`: floats, or normalised integers where glTF allows
/// them.
bool drives(const AccessorFacts& output, std::string_view path) {
  if (path == "translation" || path == "scale") return output.is_real("VEC3");
  const bool numbers = output.component == 5126 || (output.component != 5125 && output.normalised);
  return numbers && output.type == (path == "rotation" ? "VEC4" : "SCALAR");
}

void check_output(Check& check, const json::Value& at, const Sampler& sampler,
                  std::string_view path) {
  if (!sampler.input || !sampler.output) return;
  const AccessorFacts& output = check.accessors()[*sampler.output];
  const std::int64_t keys = check.accessors()[*sampler.input].count;
  const std::int64_t values = output.count;
  if (keys < 1 || values < 1) return;  // said of the accessor
  if (path != "pointer" && !drives(output, path))
    check.report(codes::kSampler, at,
                 fmt::format("accessor {} cannot drive {}", *sampler.output, path));
  const bool triples = values % 3 == 0 && values / 3 % keys == 0;
  const bool fits = sampler.cubic ? triples : values % keys == 0;
  const bool exact = values == keys || (sampler.cubic && values / 3 == keys);
  if (!fits || (!exact && path != "weights" && path != "pointer"))
    check.report(codes::kSampler, at,
                 fmt::format("{} values for {} keys{}", values, keys,
                             sampler.cubic ? ", which CUBICSPLINE gives three each" : ""));
}

void check_channel(Check& check, const json::Value& channel, const std::vector<Sampler>& samplers) {
  const auto sampler = check.whole(channel, "sampler", 0, true);
  const json::Value target = channel["target"];
  if (!target.is_object())
    return check.report(codes::kMissing, channel, "the channel has no target");
  check.index(target, "node", "nodes");
  const auto path =
      check.word(target, "path", {"translation", "rotation", "scale", "weights", "pointer"}, true);
  if (sampler && static_cast<std::uint64_t>(*sampler) >= samplers.size())
    check.report(
        codes::kIndex, channel["sampler"],
        fmt::format("there is no sampler {}: the animation has {}", *sampler, samplers.size()));
  else if (sampler && path)
    check_output(check, channel, samplers[static_cast<std::size_t>(*sampler)], *path);
}

}  // namespace

void check_animations(Check& check) {
  for (const json::Value& animation : check.elements("animations")) {
    std::vector<Sampler> samplers;
    for (const json::Value& sampler : check.objects(animation, "samplers"))
      samplers.push_back(check_sampler(check, sampler));
    for (const json::Value& channel : check.objects(animation, "channels"))
      check_channel(check, channel, samplers);
  }
}

}  // namespace rigc::gltf
