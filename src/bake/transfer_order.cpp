// SPDX-License-Identifier: MIT
// Levels of unknowns: depth first over the plugs that their parents' worlds come from, with a stack
// of its own, each plug once. Test: tests/bake/transfer_test.cpp
#include "bake/transfer_order.h"

#include <algorithm>
#include <map>
#include <set>

#include "bake/transfer_plugs.h"

namespace rigc::bake {
namespace {

using scene::NodeId;
using scene::Plug;
namespace transform = scene::transform;

class Levels {
 public:
  Levels(const scene::Scene& scene, const std::vector<Unknown>& unknowns) : scene_(scene) {
    solved_.assign(scene.size(), false);
    for (const Unknown& unknown : unknowns) {
      solved_[unknown.node.index] = true;
      if (is_twist(unknown)) attributes_.insert(unknown.attribute);
      std::vector<Plug>& needs = needs_[unknown.node];  // several unknowns may be on one
      const std::vector<Plug> own = needs_of_unknown(unknown);
      needs.insert(needs.end(), own.begin(), own.end());
    }
  }

  /// How many unknowns, one above the other, an unknown comes from.
  int of(NodeId unknown) {
    int level = 0;
    for (const Plug& need : needs_.at(unknown)) level = std::max(level, of(need));
    return level;
  }

 private:
  struct Frame {
    Plug plug;
    std::vector<Plug> needs;
    std::size_t next = 0;
  };

  static std::vector<Plug> needs_of_unknown(const Unknown& unknown) {
    if (unknown.plays) return {};
    std::vector<Plug> needs{{unknown.node, transform::kParent}};
    if (unknown.relay.valid()) needs.push_back({unknown.relay, transform::kParent});
    if (!unknown.solver.valid()) return needs;
    for (const std::uint16_t read : kLimbReads) needs.push_back({unknown.solver, read});
    return needs;
  }

  int of(const Plug& wanted) {
    open(wanted);
    while (!stack_.empty()) {
      Frame& frame = stack_.back();
      if (frame.next < frame.needs.size()) {
        const Plug need = frame.needs[frame.next++];
        if (!levels_.contains(need)) open(need);
        continue;
      }
      close();
    }
    return levels_.at(wanted);
  }

  /// The transform of an unknown counts one more than what it comes from.
  bool is_solved(const Plug& plug) const {
    const bool local = solved_[plug.node.index] && plug.attribute <= transform::kScale;
    return local || attributes_.contains(plug);
  }

  void open(const Plug& plug) {
    if (!levels_.emplace(plug, 0).second) return;
    std::vector<Plug> needs = needs_of(scene_, plug);
    if (is_solved(plug)) {
      const std::vector<Plug>& own = needs_.at(plug.node);
      needs.insert(needs.end(), own.begin(), own.end());
    }
    stack_.push_back({plug, std::move(needs), 0});
  }

  void close() {
    const Frame frame = std::move(stack_.back());
    stack_.pop_back();
    int level = 0;
    for (const Plug& need : frame.needs) level = std::max(level, levels_.at(need));
    levels_.at(frame.plug) = level + (is_solved(frame.plug) ? 1 : 0);
  }

  const scene::Scene& scene_;
  std::vector<bool> solved_;                   // by scene node
  std::map<NodeId, std::vector<Plug>> needs_;  // of unknowns
  std::set<Plug> attributes_;                  // that are
  std::map<Plug, int> levels_;
  std::vector<Frame> stack_;
};

}  // namespace

int order(const scene::Scene& scene, std::vector<Unknown>& unknowns) {
  Levels levels(scene, unknowns);
  int count = 0;
  for (Unknown& unknown : unknowns) {
    unknown.level = levels.of(unknown.node);
    count = std::max(count, unknown.level + 1);
  }
  std::stable_sort(unknowns.begin(), unknowns.end(),
                   [](const Unknown& a, const Unknown& b) { return a.level < b.level; });
  return count;
}

}  // namespace rigc::bake
