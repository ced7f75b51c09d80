// SPDX-License-Identifier: MIT
// Names while expanding: what handles mean in each template, how local groups are called from
// outside, whose child a joint is. Test: tests/templates/expand_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "templates/codes.h"
#include "templates/expander.h"

namespace rigc::templates {

int Handles::find(const std::string& word) const {
  if (const auto found = names.find(word); found != names.end()) return found->second;
  if (const auto found = labels.find(word); found != labels.end()) return found->second;
  return kUnknown;
}

void Handles::add_label(const std::string& word, int joint) {
  const auto [found, fresh] = labels.emplace(word, joint);
  if (!fresh && found->second != joint) found->second = kAmbiguous;
}

/// How the user of a part calls one of its local groups.
std::string Expander::group_in_outer(const Use& use, const std::string& local) const {
  if (local.empty()) return local;
  for (const auto& [need, bound] : use.part->groups)
    if (need == local) return bound;
  if (use.source->is_main_group(local)) return use.part->as;
  return use.part->as + "_" + local;
}

std::string Expander::final_group(int use, std::string local) const {
  for (int at = use; at >= 0;) {
    const Use& around = uses_[static_cast<std::size_t>(at)];
    if (around.part) local = group_in_outer(around, local);
    at = around.outer;
  }
  return local;
}

/// Neither bound from outside nor what the part itself is called.
bool Expander::is_own_group(const Use& use, const std::string& local) const {
  const auto& bound = use.part->groups;
  return !use.source->is_main_group(local) &&
         std::none_of(bound.begin(), bound.end(),
                      [&](const auto& group) { return group.first == local; });
}

/// Notes beneath which group a part's own group was made, and beneath which that one.
void Expander::add_group(int use, std::string local) {
  while (!local.empty() && uses_[static_cast<std::size_t>(use)].part) {
    const Use& own = uses_[static_cast<std::size_t>(use)];
    if (is_own_group(own, local)) {
      std::string name = final_group(use, local);
      if (!groups_.insert(name).second) return;
      skeleton_.groups.emplace_back(std::move(name), final_group(own.outer, own.part->as));
      local = own.part->as;
    } else {
      local = group_in_outer(own, local);
    }
    use = own.outer;
  }
}

void Expander::register_handles(int index) {
  const RawJoint& joint = joints_[static_cast<std::size_t>(index)];
  std::string name = joint.source->name;
  std::string local = joint.source->ids.local;
  const std::string& label = joint.source->ids.label;
  Span place = joint.source->span;
  for (int at = joint.use; at >= 0;) {
    Use& use = uses_[static_cast<std::size_t>(at)];
    const auto [other, fresh] = use.handles.names.emplace(name, index);
    if (!fresh) {
      diagnostics_.report(
          codes::kJointNameTaken, place,
          fmt::format("there is a joint \"{}\" already in the template {}", name, use.source->name),
          "call the joint or the part (`as`) something else");
      return;
    }
    if (!label.empty()) {
      use.handles.add_label(label, index);
      if (!local.empty()) use.handles.add_label(local + "." + label, index);
    }
    if (use.part) {
      place = use.part->as_span;
      name = use.part->as + "_" + name;
      local = group_in_outer(use, local);
    }
    at = use.outer;
  }
}

/// The joint that a word means in a template; reports what it cannot mean. kAbsent without a
/// report, as kUnknown where a part that may have the joint is missing.
int Expander::resolve(int use, const std::string& word, const Span& span, const char* key) {
  const Use& scope = uses_[static_cast<std::size_t>(use)];
  const int found = scope.handles.find(word);
  if (found == kAmbiguous) {
    diagnostics_.report(
        codes::kAmbiguousLabel, span,
        fmt::format("{}: several joints have the label \"{}\"", key, printable(word, 60)),
        "name the joint, or write GROUP.LABEL");
  } else if (found == kUnknown && !scope.lacks_joints) {
    std::vector<std::string> names;
    if (diagnostics_.errors() < 100)
      for (const auto& entry : scope.handles.names) names.push_back(entry.first);
    std::sort(names.begin(), names.end());
    diagnostics_.report(codes::kUnknownJoint, span,
                        fmt::format("{}: the template {} has no joint \"{}\"", key,
                                    scope.source->name, printable(word, 60)),
                        suggest(word, names));
  }
  return found;
}

void Expander::resolve_parents() {
  for (Use& use : uses_) {
    if (!use.part) continue;
    use.attach = use.part->attach.empty()
                     ? uses_[static_cast<std::size_t>(use.outer)].attach
                     : resolve(use.outer, use.part->attach, use.part->attach_span, "attach");
  }
  for (RawJoint& joint : joints_) {
    const Joint& source = *joint.source;
    joint.parent = source.parent.empty()
                       ? uses_[static_cast<std::size_t>(joint.use)].attach
                       : resolve(joint.use, source.parent, source.parent_span, "parent");
    if (joint.parent == kUnknown || joint.parent == kAmbiguous) joint.parent = kRoot;
    const auto& orient = source.placement.orient;
    if (orient && !orient->toward.empty())
      joint.result.toward =
          std::max(-1, resolve(joint.use, orient->toward, orient->span, "toward"));
  }
  resolve_between();
}

/// Ends that a condition took away leave the joint a guide of its own.
void Expander::resolve_between() {
  for (RawJoint& joint : joints_) {
    const auto& between = joint.source->between;
    if (!between) continue;
    const int a = resolve(joint.use, between->joints[0], between->span, "between");
    const int b = resolve(joint.use, between->joints[1], between->span, "between");
    if (a < 0 || b < 0) continue;
    const auto itself = [&](int end) {
      const RawJoint& other = joints_[static_cast<std::size_t>(end)];
      return &other == &joint || other.source->between;
    };
    if (a == b || itself(a) || itself(b))
      diagnostics_.report(codes::kBadBetween, between->span,
                          fmt::format("the guide of {} does not lie between two placed joints",
                                      joint.result.tagged.name),
                          "name two joints that have no `guide:` themselves");
    joint.between[0] = a;
    joint.between[1] = b;
    joint.result.tagged.guide.share = between->share;
  }
}

/// A joint below an absent one is absent too. Circles (through parts) are errors.
void Expander::find_absent(bool report_none_left) {
  enum class Mark : std::uint8_t { fresh, open, done };
  std::vector<Mark> marks(joints_.size(), Mark::fresh);
  bool left = false;
  for (std::size_t start = 0; start < joints_.size(); ++start) {
    std::vector<std::size_t> way;
    int at = static_cast<int>(start);
    while (at >= 0 && marks[static_cast<std::size_t>(at)] == Mark::fresh) {
      marks[static_cast<std::size_t>(at)] = Mark::open;
      way.push_back(static_cast<std::size_t>(at));
      at = joints_[static_cast<std::size_t>(at)].parent;
    }
    bool absent = at == kAbsent;
    if (at >= 0) {
      RawJoint& top = joints_[static_cast<std::size_t>(at)];
      absent = top.parent == kAbsent;
      if (marks[static_cast<std::size_t>(at)] == Mark::open) {
        diagnostics_.report(codes::kJointCycle, top.source->span,
                            fmt::format("the joint {} hangs below itself", top.result.tagged.name),
                            "one of the joints or parts on the way must hang elsewhere");
        top.parent = kRoot;
      }
    }
    for (const std::size_t index : way) {
      marks[index] = Mark::done;
      if (absent) joints_[index].parent = kAbsent;
      left |= !absent;
    }
  }
  if (!left && report_none_left)
    diagnostics_.report(codes::kNoJointsLeft, main_.span,
                        "conditions take away every joint of the template");
}

}  // namespace rigc::templates
