// SPDX-License-Identifier: MIT
// Solves a change of space frame by frame. Test: tests/pipeline/match_space_test.cpp
#include "bake/match_space.h"

#include <algorithm>

#include "bake/held.h"
#include "bake/said.h"

namespace rigc::bake {
namespace {

using math::Affine;
using math::Quat;
using scene::Plug;
namespace transform = scene::transform;

/// Controls that go along with one of a limb's.
std::vector<scene::NodeId> held_with(const scene::Scene& scene, scene::NodeId control) {
  for (const MatchLimb& limb : find_match_limbs(scene))
    if (control == limb.ik || control == limb.pole ||
        std::find(limb.fk.begin(), limb.fk.end(), control) != limb.fk.end())
      return limb.held;
  return {};
}

class SpaceMatcher {
 public:
  SpaceMatcher(const scene::Scene& scene, const SpaceSwitch& spaces, const MatchOptions& options,
               Diagnostics& diagnostics)
      : scene_(scene),
        spaces_(spaces),
        frames_(scene, options.times, diagnostics),
        held_(scene, frames_, held_with(scene, spaces.control)) {}

  std::optional<Matched> run(const std::vector<int>& nodes, const anim::Clip& clip,
                             std::size_t space) {
    frames_.sample(nodes, clip);
    const Plug world{spaces_.control, transform::kWorld};
    const auto wanted = frames_.evaluate({world});
    if (!wanted || !held_.note()) return std::nullopt;
    choose(space);
    if (!held_.hold()) return std::nullopt;
    const auto parents = frames_.evaluate({{spaces_.control, transform::kParent}});
    if (!parents) return std::nullopt;
    stay(wanted->front(), parents->front());
    if (!held_.hold()) return std::nullopt;
    written_.insert(written_.end(), held_.written().begin(), held_.written().end());
    Matched out;
    for (const Plug& plug : written_) out.values.push_back({plug, frames_.table.at(plug)});
    return out;
  }

 private:
  void set(const Plug& plug, std::vector<double> values) {
    written_.push_back(plug);
    frames_.table[plug] = std::move(values);
  }

  /// One space counts alone. A share that is 0 anyway needs no key.
  void choose(std::size_t space) {
    for (const SpaceSwitch::Attributes& attributes : spaces_.switches) {
      set(attributes.number, std::vector<double>(frames_.count(), static_cast<double>(space)));
      for (const Plug& share : attributes.shares)
        if (frames_.keyed.contains(share) || scene_.number(share) != 0)
          set(share, std::vector<double>(frames_.count(), 0));
    }
  }

  /// The control's translation and rotation under its new parents, in the numbers of a file.
  void stay(const std::vector<double>& worlds, const std::vector<double>& parents) {
    Kept values = kept(worlds, parents, frames_.count(), scene_.local(spaces_.control).rotation);
    set({spaces_.control, transform::kTranslate}, std::move(values.places));
    set({spaces_.control, transform::kRotation}, std::move(values.turns));
  }

  const scene::Scene& scene_;
  const SpaceSwitch& spaces_;
  ClipFrames frames_;
  Held held_;
  std::vector<Plug> written_;
};

}  // namespace

std::optional<SpaceSwitch> find_spaces(const scene::Scene& scene, scene::NodeId control) {
  namespace at = scene::spaces;
  SpaceSwitch out;
  out.control = control;
  for (const scene::NodeId id : scene.nodes()) {
    if (scene[id].kind != scene::Kind::spaces) continue;
    SaidReader said(scene, id);
    if (said.transform({at::kControl}) != control) continue;
    std::vector<std::string> names = said.words(at::kNames);
    SpaceSwitch::Attributes found{said.attribute({at::kNumber}), {}};
    for (std::size_t i = 0; i < names.size(); ++i)
      found.shares.push_back(said.attribute({at::kShares, static_cast<std::int32_t>(i)}));
    if (!said.complete() || (!out.spaces.empty() && out.spaces != names)) continue;
    out.spaces = std::move(names);
    out.switches.push_back(std::move(found));
  }
  if (out.switches.empty()) return std::nullopt;
  return out;
}

std::optional<Matched> solve_space(const scene::Scene& scene, const std::vector<int>& nodes,
                                   const anim::Clip& clip, const SpaceSwitch& spaces,
                                   std::size_t space, const MatchOptions& options,
                                   Diagnostics& diagnostics) {
  return SpaceMatcher(scene, spaces, options, diagnostics).run(nodes, clip, space);
}

}  // namespace rigc::bake
