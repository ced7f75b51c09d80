// SPDX-License-Identifier: MIT
// The text of a template: its head and its joints. Test: tests/templates/write_test.cpp
#include "templates/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text.h"
#include "templates/expand.h"
#include "templates/library.h"
#include "templates/read.h"
#include "templates/write_skeleton.h"
#include "templates/write_tags.h"
#include "templates/yaml_text.h"

namespace rigc::templates {
namespace {

constexpr std::size_t kColumns = 100;

class Text {
 public:
  Text(const tags::TaggedSkeleton& skeleton, const catalog::Catalogue& catalogue,
       const WriteOptions& options, const std::set<std::uint64_t>& straight)
      : skeleton_(skeleton),
        catalogue_(catalogue),
        options_(options),
        straight_(straight),
        defaults_(feature_defaults(skeleton)),
        joints_(written_joints(skeleton, options.worlds)) {}
  std::string run();

 private:
  void line(std::size_t indent, const std::string& text) {
    out_.append(indent, ' ');
    out_ += text + '\n';
  }
  void head();
  void modules();
  void groups();
  void features();
  void shapes();
  void joint(const WrittenJoint& joint);
  void identity(const WrittenJoint& joint);
  void place(std::size_t indent, const math::Trs& rest);
  void chain(const WrittenJoint& joint);
  void sides(const WrittenJoint& joint);

  const tags::TaggedSkeleton& skeleton_;
  const catalog::Catalogue& catalogue_;
  const WriteOptions& options_;
  const std::set<std::uint64_t>& straight_;  ///< uids of chains that stand in a line
  std::map<std::string, bool> defaults_;     ///< of features
  std::vector<WrittenJoint> joints_;
  std::string out_;
};

void Text::head() {
  for (const std::string& comment : options_.comments) line(0, "# " + printable(comment, 500));
  line(0, "rigc: 1");
  line(0, "name: " + yaml_text(options_.name));
  if (options_.name != skeleton_.name) line(0, "was: " + yaml_text(skeleton_.name));
  line(0, fmt::format("version: {}", options_.version));
  if (skeleton_.global != options_.name) line(0, "global: " + yaml_text(skeleton_.global));
  modules();
  groups();
}

void Text::groups() {
  if (skeleton_.groups.empty()) return;
  line(0, "groups:");
  for (const auto& [group, above] : skeleton_.groups)
    line(2, yaml_text(group) + ": " + yaml_text(above));
}

/// Pins: those of the skeleton, and modules that have moved on since the rig was built.
void Text::modules() {
  std::map<std::string, int> pins;
  for (const auto& [module, version] : options_.modules) {
    const catalog::Descriptor* descriptor = catalogue_.find(module);
    if (descriptor && version < descriptor->version) pins[module] = version;
  }
  for (const auto& [module, version] : skeleton_.module_pins) pins[module] = version;
  std::vector<std::string> items;
  for (const auto& [module, version] : pins)
    items.push_back(fmt::format("{}: {}", yaml_text(module), version));
  if (!items.empty()) line(0, "modules: {" + join(items, ", ") + "}");
}

void Text::features() {
  if (skeleton_.features.empty()) return;
  line(0, "");
  line(0, "features:");
  for (const tags::FeatureDeclaration& feature : skeleton_.features) {
    std::vector<std::string> items;
    const auto add = [&](const char* key, const std::string& value) {
      if (!value.empty()) items.push_back(std::string(key) + ": " + yaml_text(value));
    };
    add("kind", feature.kind);
    add("title", feature.title);
    if (!defaults_.at(feature.name)) items.push_back("default: off");
    if (!feature.switches.empty()) {
      std::vector<std::string> names;
      for (const std::string& name : feature.switches) names.push_back(yaml_text(name));
      items.push_back("switches: [" + join(names, ", ") + "]");
    }
    const std::string begin = yaml_text(feature.name) + ": {";
    std::string text = begin + join(items, ", ");
    if (!feature.help.empty()) {
      const std::string help = "help: " + yaml_text(feature.help);
      const bool fits = text.size() + help.size() + 5 <= kColumns;
      if (!items.empty()) text += fits ? ", " : ",\n  " + std::string(begin.size(), ' ');
      text += help;
    }
    line(2, text + "}");
  }
}

void Text::shapes() {
  if (skeleton_.shapes.empty()) return;
  line(0, "");
  line(0, "shapes:");
  for (const tags::NamedShape& shape : skeleton_.shapes) {
    line(2, yaml_text(shape.name) + ":");
    line(4, "lines:");
    for (const auto& points : shape.lines) {
      std::vector<std::string> items;
      for (const math::Vec3& point : points) items.push_back(yaml_vector(point));
      line(6, "- [" + join(items, ", ") + "]");
    }
  }
}

/// The uid, unless the names give it.
void Text::identity(const WrittenJoint& joint) {
  const tags::TaggedJoint& source = *joint.source;
  const bool by_name = source.key.uid == uid_of(skeleton_.name, "", joint.name);
  std::vector<std::string> uids = {hex16(source.key.uid)};
  for (const JointKey& earlier : source.was) {
    const bool implied =
        options_.name != skeleton_.name && earlier.uid == uid_of(options_.name, "", joint.name);
    if (!implied) uids.push_back(hex16(earlier.uid));
  }
  if (by_name && uids.size() == 1) return;
  line(4, uids.size() == 1 ? "uid: " + uids.front() : "uid: [" + join(uids, ", ") + "]");
}

/// Degrees where they say the rotation exactly, else the quaternion.
void Text::place(std::size_t indent, const math::Trs& rest) {
  if (rest.translation != math::Vec3{}) line(indent, "translate: " + yaml_vector(rest.translation));
  if (rest.rotation != math::Quat{}) {
    math::Vec3 degrees = math::to_euler_degrees(rest.rotation);
    for (std::size_t i = 0; i < 3; ++i)
      degrees[i] = parse_number(fmt::format("{:.6f}", degrees[i])).value_or(0);
    if (math::from_euler_degrees(degrees) == rest.rotation)
      line(indent, "rotate: " + yaml_vector(degrees));
    else
      line(indent, "quat: " + yaml_numbers(&rest.rotation.x, 4));
  }
  if (rest.scale != math::Vec3{1, 1, 1}) line(indent, "scale: " + yaml_vector(rest.scale));
}

void Text::chain(const WrittenJoint& joint) {
  if (!joint.chain) return;
  const std::size_t count = joint.steps.size() + 1;
  if (count == 1 || straight_.contains(joint.source->key.uid)) {
    line(4, fmt::format("chain: {{count: {}, to: {}}}", count, yaml_vector(joint.end)));
    return;
  }
  line(4, "chain:");
  line(6, fmt::format("count: {}", count));
  line(6, "steps:");
  for (const math::Trs& step : joint.steps) {
    const std::size_t begin = out_.size();
    place(10, step);
    if (out_.size() == begin)
      line(8, "- {}");
    else
      out_[begin + 8] = '-';
  }
}

void Text::sides(const WrittenJoint& joint) {
  if (joint.source->mirror.mirrored) line(4, "mirrored: true");
  if (joint.opposite_by_name) return;
  line(4, "opposite: " + (joint.opposite < 0
                              ? std::string("~")
                              : yaml_text(joints_[static_cast<std::size_t>(joint.opposite)].name)));
}

void Text::joint(const WrittenJoint& joint) {
  const tags::TaggedJoint& source = *joint.source;
  line(2, "- name: " + yaml_text(joint.name));
  if (joint.parent >= 0)
    line(4, "parent: " + yaml_text(joints_[static_cast<std::size_t>(joint.parent)].name));
  identity(joint);
  place(4, joint.rest);
  chain(joint);
  const auto tag = [&](const char* key, const std::string& value) {
    if (!value.empty()) line(4, std::string(key) + ": " + yaml_text(value));
  };
  if (source.ids.global != skeleton_.global) tag("global", source.ids.global);
  tag("local", source.ids.local);
  tag("label", source.ids.label);
  if (source.optional) line(4, "optional: true");
  if (joint.helper) line(4, "helper: true");
  sides(joint);
  out_ += tags_text(source, catalogue_, defaults_, kColumns);
}

std::string Text::run() {
  head();
  features();
  shapes();
  line(0, "");
  line(0, "joints:");
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (i > 0) line(0, "");
    joint(joints_[i]);
  }
  return std::move(out_);
}

/// Chains whose joints stand where a line from the first to the last puts them, to the last bit:
/// tried, because that depends on every rounding on the way.
std::set<std::uint64_t> straight_chains(const tags::TaggedSkeleton& skeleton,
                                        const catalog::Catalogue& catalogue,
                                        const WriteOptions& options) {
  std::set<std::uint64_t> chains;
  for (const WrittenJoint& joint : written_joints(skeleton, options.worlds))
    if (!joint.steps.empty()) chains.insert(joint.source->key.uid);
  if (chains.empty() || was_fitted(skeleton)) return {};
  Diagnostics trial;
  const std::string text = Text(skeleton, catalogue, options, chains).run();
  const auto read_back = read(trial.sources().add("", text), catalogue, trial);
  Library library({}, catalogue);
  const auto expanded = read_back ? expand(*read_back, library, catalogue, trial) : std::nullopt;
  const auto placed = expanded ? place(*expanded, trial) : std::nullopt;
  if (!placed) return {};
  std::map<JointKey, math::Trs> rests;
  for (const tags::TaggedJoint& joint : placed->joints) rests.emplace(joint.key, joint.rest);
  for (const tags::TaggedJoint& joint : skeleton.joints) {
    const auto found = rests.find(joint.key);
    if (found == rests.end() || !(found->second == joint.rest)) chains.erase(joint.key.uid);
  }
  return chains;
}

}  // namespace

std::string write(const tags::TaggedSkeleton& skeleton, const catalog::Catalogue& catalogue,
                  const WriteOptions& options) {
  const std::set<std::uint64_t> straight = straight_chains(skeleton, catalogue, options);
  return Text(skeleton, catalogue, options, straight).run();
}

}  // namespace rigc::templates
