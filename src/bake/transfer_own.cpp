// SPDX-License-Identifier: MIT
// What of the joints' own transforms is negligible: the smallest first, as long as what all of them
// do to a joint, one above the other, is allowed. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_own.h"

#include <algorithm>
#include <cmath>

#include "bake/joints.h"
#include "bake/transfer_plan.h"
#include "scene/hierarchy.h"

namespace rigc::bake {
namespace {

struct Candidate {
  int aim;
  anim::Path path;
  double moved;  ///< how far the joint or one below it goes at most, rig units
};

class Chooser {
 public:
  Chooser(const scene::Scene& scene, const std::vector<Aim>& aims) : scene_(scene), aims_(aims) {
    below_.resize(aims.size());
    reach_.assign(aims.size(), 0);
    moved_.assign(aims.size(), 0);
    for (std::size_t i = 0; i < aims.size(); ++i) {
      const math::Vec3 at = scene.rest_world(aims[i].id).origin;
      for (int above = static_cast<int>(i); above >= 0; above = aim(above).base) {
        const auto place = static_cast<std::size_t>(above);
        below_[place].push_back(i);
        const double far = math::length(at - scene.rest_world(aim(above).id).origin);
        reach_[place] = std::max(reach_[place], far);
        // Skin goes on beyond the last joint, about as far as to the one before.
        if (above == aims[i].base) reach_[i] = std::max(reach_[i], far);
      }
    }
  }

  std::set<std::pair<int, anim::Path>> choose(double allowed) {
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < aims_.size(); ++i)
      for (const anim::Path path : kPaths)
        if (is_candidate(aims_[i], path))
          candidates.push_back({static_cast<int>(i), path, moved_by(static_cast<int>(i), path)});
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.moved < b.moved; });
    std::set<std::pair<int, anim::Path>> chosen;
    for (const Candidate& candidate : candidates) {
      const auto& below = below_[static_cast<std::size_t>(candidate.aim)];
      const bool fits = std::all_of(below.begin(), below.end(), [&](std::size_t joint) {
        return moved_[joint] + candidate.moved <= allowed;
      });
      if (!fits) continue;
      for (const std::size_t joint : below) moved_[joint] += candidate.moved;
      chosen.emplace(candidate.aim, candidate.path);
    }
    return chosen;
  }

 private:
  const Aim& aim(int index) const { return aims_[static_cast<std::size_t>(index)]; }

  /// Of joints that the rig moves in other ways. Where a joint is not the scene's own way in the
  /// file, numbers of both mean different things.
  bool is_candidate(const Aim& joint, anim::Path path) const {
    return joint.direct && is_driven(scene_, joint.id) &&
           !is_driven(scene_, plug_of(joint.id, path));
  }

  double moved_by(int index, anim::Path path) const {
    const math::Trs rest = scene_.local(aim(index).id);
    const double off = largest_difference(aim(index), path, rest);
    const double reach = reach_[static_cast<std::size_t>(index)];
    if (path == anim::Path::rotation) return 2 * off * reach;
    if (path == anim::Path::scale) {
      const double smallest =
          std::min({std::abs(rest.scale.x), std::abs(rest.scale.y), std::abs(rest.scale.z)});
      return off / std::max(smallest, 1e-30) * reach;
    }
    const scene::NodeId above = scene::transform_above(scene_, aim(index).id);
    return off * (above.valid() ? math::length(scene_.rest_world(above).linear.x) : 1);
  }

  const scene::Scene& scene_;
  const std::vector<Aim>& aims_;
  std::vector<std::vector<std::size_t>> below_;  // and itself, by aim
  std::vector<double> reach_, moved_;            // by aim
};

}  // namespace

std::set<std::pair<int, anim::Path>> negligible(const scene::Scene& scene,
                                                const std::vector<Aim>& aims, double allowed) {
  return Chooser(scene, aims).choose(allowed);
}

double extent(const scene::Scene& scene, const std::vector<Aim>& aims) {
  math::Vec3 least{1e300, 1e300, 1e300}, most{-1e300, -1e300, -1e300};
  for (const Aim& aim : aims) {
    const math::Vec3 at = scene.rest_world(aim.id).origin;
    for (std::size_t i = 0; i < 3; ++i) {
      least[i] = std::min(least[i], at[i]);
      most[i] = std::max(most[i], at[i]);
    }
  }
  return aims.empty() ? 0 : math::length(most - least);
}

}  // namespace rigc::bake
