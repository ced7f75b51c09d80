// SPDX-License-Identifier: MIT
// The driver of expanding, and how templates are joined: every use of a template adds its joints,
// then its parts. Test: tests/templates/expand_test.cpp
#include "templates/expand.h"

#include <fmt/format.h>

#include "base/text.h"
#include "base/trace.h"
#include "templates/codes.h"
#include "templates/expander.h"

namespace rigc::templates {
namespace {

constexpr std::size_t kMostDepth = 16;
constexpr std::size_t kMostJoints = 20'000;

}  // namespace

std::optional<Expanded> expand(const Template& main, Library& library,
                               const catalog::Catalogue& catalogue, Diagnostics& diagnostics) {
  const trace::Span span("expand");
  return Expander(main, library, catalogue, diagnostics).run();
}

std::optional<Expanded> Expander::run() {
  const std::size_t errors_before = diagnostics_.errors();
  add_use(main_, nullptr, -1);
  collect_features();
  resolve_parents();
  find_absent(diagnostics_.errors() == errors_before);
  if (diagnostics_.errors() != errors_before) return std::nullopt;
  assign_keys();
  pair_sides();
  if (diagnostics_.errors() != errors_before) return std::nullopt;
  return finish();
}

int Expander::template_index(const Template& source) {
  for (std::size_t i = 0; i < templates_.size(); ++i)
    if (templates_[i] == &source) return static_cast<int>(i);
  templates_.push_back(&source);
  skeleton_.templates.push_back({source.name, source.version, source.reference, source.digest});
  for (const auto& pin : source.module_pins) {
    bool known = false;
    for (const auto& other : skeleton_.module_pins) known |= other.first == pin.first;
    if (!known) skeleton_.module_pins.push_back(pin);
  }
  for (const catalog::Shape& shape : source.shapes) {
    bool known = false;
    for (const tags::NamedShape& other : skeleton_.shapes) known |= other.name == shape.name;
    if (known) continue;  // the outer template's shape of that name counts
    tags::NamedShape named{shape.name, {}};
    for (const auto& line : shape.lines) {
      named.lines.emplace_back();
      for (const catalog::Point& point : line)
        named.lines.back().push_back({point[0], point[1], point[2]});
    }
    skeleton_.shapes.push_back(std::move(named));
  }
  return static_cast<int>(templates_.size()) - 1;
}

void Expander::add_use(const Template& source, const Part* part, int outer) {
  const int index = static_cast<int>(uses_.size());
  Use use;
  use.source = &source;
  use.part = part;
  use.outer = outer;
  use.template_index = template_index(source);
  if (part) {
    const Use& around = uses_[static_cast<std::size_t>(outer)];
    use.depth = around.depth + 1;
    use.prefix = around.prefix + part->as + "_";
    use.mirrored = around.mirrored != part->mirror.has_value();
  }
  uses_.push_back(std::move(use));
  if (!bind_parameters(index)) {
    if (part) leave_out(*part, outer);
    return;
  }
  for (const auto& [group, above] : source.groups)
    if (const std::string name = final_group(index, group); groups_.insert(name).second)
      skeleton_.groups.emplace_back(name, final_group(index, above));
  add_joints(index);
  add_parts(index);
}

void Expander::add_joints(int use) {
  const std::size_t count = uses_[static_cast<std::size_t>(use)].source->joints.size();
  uses_[static_cast<std::size_t>(use)].joints.assign(count, kAbsent);
  for (std::size_t i = 0; i < count; ++i) add_joint(use, i);
}

/// Whether the rig may still grow; reports where it may not.
bool Expander::fits(const Span& span) {
  if (joint_count_ <= kMostJoints && uses_.size() < kMostJoints) return true;
  if (!full_)
    diagnostics_.report(codes::kTooMuch, span,
                        fmt::format("the skeleton has more than {} joints", kMostJoints));
  full_ = true;
  return false;
}

void Expander::add_joint(int use, std::size_t index) {
  Use& owner = uses_[static_cast<std::size_t>(use)];
  const Joint& source = owner.source->joints[index];
  std::optional<Chain> chain = source.chain;
  bool present = !source.condition || holds(*source.condition, owner.environment);
  if (chain && !chain->count.parameter.empty()) {
    const double count = owner.environment.find(chain->count.parameter)->second.number;
    if (count > 1000)
      diagnostics_.report(codes::kNotAllowed, chain->count.span, "count: at most 1000 is allowed");
    chain->count.value = count < 1 ? 0 : count < 1000 ? static_cast<int>(count) : 1000;
    present &= count >= 1;
  }
  if (!present) {
    owner.handles.names.emplace(source.name, kAbsent);
    for (const Use* at = &owner; at->outer >= 0; at = &uses_[static_cast<std::size_t>(at->outer)]) {
      Use& around = uses_[static_cast<std::size_t>(at->outer)];
      const std::string name = owner.prefix.substr(around.prefix.size()) + source.name;
      around.handles.names.emplace(name, kAbsent);
    }
    return;
  }
  joint_count_ += chain ? static_cast<std::size_t>(chain->count.value) : 1;
  if (!fits(source.span)) return;
  RawJoint joint;
  joint.source = &source;
  joint.use = use;
  joint.result.placement = source.placement;
  joint.result.chain = chain;
  joint.result.helper = source.helper;
  joint.result.instance = use;
  joint.result.ordinal_in_template = index;
  tags::TaggedJoint& tagged = joint.result.tagged;
  tagged.name = owner.prefix + source.name;
  tagged.ids = source.ids;
  tagged.ids.local = final_group(use, source.ids.local);
  add_group(use, source.ids.local);
  if (tagged.ids.global.empty()) tagged.ids.global = main_.global;
  tagged.optional = source.optional;
  tagged.mirror.mirrored = owner.mirrored != source.mirrored;
  tagged.template_index = owner.template_index;
  tagged.span = source.span;
  add_tags(joint);
  owner.joints[index] = static_cast<int>(joints_.size());
  joints_.push_back(std::move(joint));
  register_handles(static_cast<int>(joints_.size()) - 1);
}

/// What names its joints must not be reported, too.
void Expander::leave_out(const Part& part, int use) {
  left_out_.insert(&part);
  for (int at = use; at >= 0; at = uses_[static_cast<std::size_t>(at)].outer)
    uses_[static_cast<std::size_t>(at)].lacks_joints = true;
}

void Expander::add_parts(int use) {
  const Template& source = *uses_[static_cast<std::size_t>(use)].source;
  uses_[static_cast<std::size_t>(use)].parts.assign(source.parts.size(), kAbsent);
  for (std::size_t i = 0; i < source.parts.size(); ++i) {
    const Part& part = source.parts[i];
    const Use& owner = uses_[static_cast<std::size_t>(use)];
    if (part.condition && !holds(*part.condition, owner.environment)) continue;
    if (owner.depth + 1 >= kMostDepth) {
      diagnostics_.report(codes::kTooMuch, part.span,
                          fmt::format("parts are nested more than {} deep", kMostDepth));
      leave_out(part, use);
      continue;
    }
    if (!fits(part.span)) return;
    // A template that is used twice lacks its part twice, and that is reported once.
    const Template* inner =
        left_out_.contains(&part) ? nullptr : library_.open_part(part, source, diagnostics_);
    if (!inner) {
      leave_out(part, use);
      continue;
    }
    bool cycle = false;
    for (int at = use; at >= 0; at = uses_[static_cast<std::size_t>(at)].outer) {
      const Template* around = uses_[static_cast<std::size_t>(at)].source;
      cycle |= around == inner || (around->name == inner->name && around->digest == inner->digest);
    }
    if (cycle) {
      diagnostics_.report(codes::kPartCycle, part.span,
                          fmt::format("the template {} would be a part of itself", inner->name));
      leave_out(part, use);
      continue;
    }
    uses_[static_cast<std::size_t>(use)].parts[i] = static_cast<int>(uses_.size());
    add_use(*inner, &part, use);
  }
}

std::vector<int> Expander::order() const {
  std::vector<int> sorted;
  std::vector<bool> taken(joints_.size(), false);
  std::vector<int> waiting;
  for (std::size_t start = 0; start < joints_.size(); ++start) {
    if (joints_[start].parent == kAbsent) continue;
    for (int at = static_cast<int>(start); at >= 0 && !taken[static_cast<std::size_t>(at)];
         at = joints_[static_cast<std::size_t>(at)].parent) {
      taken[static_cast<std::size_t>(at)] = true;
      waiting.push_back(at);
    }
    while (!waiting.empty()) {
      sorted.push_back(waiting.back());
      waiting.pop_back();
    }
  }
  return sorted;
}

Expanded Expander::finish() {
  Expanded out;
  const std::vector<int> sorted = order();
  std::vector<int> index_of(joints_.size(), -1);
  for (std::size_t i = 0; i < sorted.size(); ++i)
    index_of[static_cast<std::size_t>(sorted[i])] = static_cast<int>(i);
  const auto renumbered = [&](int old) {
    return old >= 0 ? index_of[static_cast<std::size_t>(old)] : -1;
  };
  for (const int old : sorted) {
    RawJoint& raw = joints_[static_cast<std::size_t>(old)];
    raw.result.tagged.parent = renumbered(raw.parent);
    raw.result.toward = renumbered(raw.result.toward);
    raw.result.opposite = renumbered(raw.result.opposite);
    out.joints.push_back(std::move(raw.result));
  }
  const auto key_of = [&](int joint) {
    return out.joints[static_cast<std::size_t>(joint)].tagged.key;
  };
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    ExpandedJoint& joint = out.joints[i];
    if (joint.opposite >= 0) joint.tagged.mirror.opposite = key_of(joint.opposite);
    const RawJoint& raw = joints_[static_cast<std::size_t>(sorted[i])];
    const int first = renumbered(raw.between[0]), second = renumbered(raw.between[1]);
    if (first >= 0 && second >= 0) joint.tagged.guide.between = {key_of(first), key_of(second)};
  }
  for (const Use& use : uses_) {
    Instance instance;
    instance.outer = use.outer;
    instance.path = path(use);
    if (use.part) {
      instance.at = use.part->at;
      instance.rotation = use.part->rotation;
      instance.size = use.part->size;
      instance.mirror = use.part->mirror;
    }
    out.instances.push_back(std::move(instance));
  }
  out.skeleton = std::move(skeleton_);
  out.skeleton.name = main_.name;
  out.skeleton.global = main_.global;
  return out;
}

}  // namespace rigc::templates
