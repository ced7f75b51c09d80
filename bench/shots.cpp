// SPDX-License-Identifier: MIT
// Shots that benchmarks work on: the biped with a clip on all its controls.
#include "bench/bench.h"
#include "gltf/clips.h"
#include "gltf/rig.h"
#include "pipeline/build.h"

namespace {

using namespace rigc;

constexpr std::size_t kNumbersOfAControl = 3 + 4;

/// Channels on translation and rotation of every control, `frames` keys each.
anim::Clip walk(const gltf::Rig& rig, std::size_t frames, double fps) {
  anim::Clip clip;
  clip.name = "walk";
  std::vector<float> times;
  for (std::size_t i = 0; i < frames; ++i)
    times.push_back(static_cast<float>(static_cast<double>(i) / fps));
  const auto shared = std::make_shared<const std::vector<float>>(std::move(times));
  for (const scene::NodeId id : rig.scene.nodes()) {
    if (rig.scene[id].kind != scene::Kind::control) continue;
    for (const anim::Path path : {anim::Path::translation, anim::Path::rotation}) {
      anim::Channel& channel = clip.channels.emplace_back();
      channel.node = rig.nodes[id.index];
      channel.path = path;
      channel.curve.times = shared;
      channel.curve.width = path == anim::Path::rotation ? 4 : 3;
      for (std::size_t i = 0; i < frames; ++i) {
        const double angle = 0.1 * math::sin(0.1 * static_cast<double>(i + id.index));
        const auto s = static_cast<float>(math::sin(angle));
        const auto c = static_cast<float>(math::cos(angle));
        if (path == anim::Path::rotation)
          channel.curve.values.insert(channel.curve.values.end(), {s, 0, 0, c});
        else
          channel.curve.values.insert(channel.curve.values.end(), {s, 0.1f * s, 0});
      }
    }
  }
  return clip;
}

}  // namespace

bool rigc::bench::write_shot(const std::string& path, std::size_t frames, double fps,
                             std::size_t bytes) {
  const std::string templates = std::string(RIGC_SOURCE_DIR) + "/templates";
  Diagnostics diagnostics;
  pipeline::BuildRequest request;
  request.template_file = templates + "/biped.yaml";
  request.paths.templates = {templates};
  const auto built = pipeline::build(request, path, diagnostics);
  const auto file = gltf::open(path, diagnostics);
  if (!built || !file) return false;
  const anim::Clip clip = walk(built->rig, frames, fps);
  gltf::Patch patch(*file);
  gltf::write_clips(patch, *file, {{clip, {}}});
  const std::uint64_t size =
      file->whole.size() + clip.channels.size() / 2 * frames * kNumbersOfAControl * sizeof(float);
  if (size < bytes) patch.append_view(std::string(bytes - size, '\0'), 0);  // the rest of a shot
  std::uint64_t written = 0;
  return pipeline::write_output(patch, *file, path, written, diagnostics) && diagnostics.ok();
}
