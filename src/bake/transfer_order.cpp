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
      if (is_length(unknown)) continue;
      if (is_number(unknown))
        attributes_.insert(unknown.attribute);
      else
        solved_[unknown.node.index] = true;
      std::vector<Plug>& needs = needs_[solved_by(unknown)];  // several may be on one node
      const std::vector<Plug> own = needs_of_unknown(unknown);
      needs.insert(needs.end(), own.begin(), own.end());
    }
  }

  /// How many unknowns, one above the other, an unknown comes from.
  int of(const Unknown& unknown) {
    int level = 0;
    for (const Plug& need : needs_.at(solved_by(unknown))) level = std::max(level, of(need));
    return level;
  }

  bool has_feedback() const { return feedback_; }

 private:
  struct Frame {
    Plug plug;
    std::vector<Plug> needs;
    std::size_t next = 0;
  };

  /// An attribute, or what stands for the local transform of a node.
  static Plug solved_by(const Unknown& unknown) {
    return is_number(unknown) ? unknown.attribute : Plug{unknown.node, transform::kTranslate};
  }

  std::vector<Plug> needs_of_unknown(const Unknown& unknown) const {
    if (unknown.plays) return {};
    std::vector<Plug> needs{{unknown.node, transform::kParent}};
    if (unknown.relay.valid()) needs.push_back({unknown.relay, transform::kParent});
    if (unknown.turned.valid()) needs.push_back({unknown.turned, transform::kRotation});
    if (!unknown.solver.valid()) return needs;
    for (const std::uint16_t read : kLimbReads)
      if (!is_stretched({unknown.solver, read})) needs.push_back({unknown.solver, read});
    if (unknown.swivels) needs.push_back({unknown.solver, scene::ik2::kTwist});
    return needs;
  }

  /// A bone's length that is computed may come from the goal; while the limb is solved it is what
  /// the attribute of its length says, whatever that goal is.
  bool is_stretched(const Plug& read) const {
    if (read.attribute != scene::ik2::kMiddle && read.attribute != scene::ik2::kEnd) return false;
    const auto source = scene_.source(read);
    return source && scene_[source->node].kind == scene::Kind::compute;
  }

  int of(const Plug& wanted) {
    open(wanted);
    while (!stack_.empty()) {
      Frame& frame = stack_.back();
      if (frame.next < frame.needs.size()) {
        const Plug need = frame.needs[frame.next++];
        feedback_ = feedback_ || open_.contains(need);
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
    open_.insert(plug);
    std::vector<Plug> needs = needs_of(scene_, plug);
    if (is_solved(plug)) {
      const bool is_attribute = attributes_.contains(plug);
      const std::vector<Plug>& own =
          needs_.at(is_attribute ? plug : Plug{plug.node, transform::kTranslate});
      needs.insert(needs.end(), own.begin(), own.end());
    }
    stack_.push_back({plug, std::move(needs), 0});
  }

  void close() {
    const Frame frame = std::move(stack_.back());
    stack_.pop_back();
    open_.erase(frame.plug);
    int level = 0;
    for (const Plug& need : frame.needs) level = std::max(level, levels_.at(need));
    levels_.at(frame.plug) = level + (is_solved(frame.plug) ? 1 : 0);
  }

  const scene::Scene& scene_;
  std::vector<bool> solved_;                 // by scene node
  std::map<Plug, std::vector<Plug>> needs_;  // of unknowns, by solved_by
  std::set<Plug> attributes_;                // that are
  std::map<Plug, int> levels_;
  std::set<Plug> open_;  // on the stack
  bool feedback_ = false;
  std::vector<Frame> stack_;
};

}  // namespace

int order(const scene::Scene& scene, std::vector<Unknown>& unknowns, bool& feedback) {
  Levels levels(scene, unknowns);
  int count = 0;
  // Lengths come from the joints alone, and others may come from them: they are below all.
  const bool has_lengths = std::any_of(unknowns.begin(), unknowns.end(), is_length);
  for (Unknown& unknown : unknowns) {
    unknown.level = is_length(unknown) ? 0 : levels.of(unknown) + (has_lengths ? 1 : 0);
    count = std::max(count, unknown.level + 1);
  }
  feedback = levels.has_feedback();
  std::stable_sort(unknowns.begin(), unknowns.end(),
                   [](const Unknown& a, const Unknown& b) { return a.level < b.level; });
  return count;
}

}  // namespace rigc::bake
