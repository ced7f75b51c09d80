// SPDX-License-Identifier: MIT
// Templates that several tests of modules rig.
#include "modules/bodies_helpers.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <set>

#include "base/text.h"

namespace rigc::test {
namespace {

/// Writes joints with the commands that belong to them.
class Writer {
 public:
  explicit Writer(const Commands& commands) : commands_(commands) {}

  void joint(const std::string& name, const std::string& parent, const std::string& at,
             const std::string& local, const std::string& label, const std::string& more = {}) {
    out_ += fmt::format("  - name: {}\n    at: {}\n    local: {}\n", name, at, local);
    if (!parent.empty()) out_ += fmt::format("    parent: {}\n", parent);
    if (!label.empty()) out_ += fmt::format("    label: {}\n", label);
    if (!more.empty()) out_ += "    " + more + "\n";
    const auto found = commands_.find(name);
    if (found == commands_.end()) return;
    used_.insert(name);
    out_ += "    tags:\n";
    for (const std::string_view line : split(found->second, '\n')) {
      if (!line.empty()) out_ += fmt::format("      - {}\n", line);
    }
  }

  std::string finish() const {
    REQUIRE(used_.size() == commands_.size());
    return out_;
  }

 private:
  const Commands& commands_;
  std::set<std::string> used_;
  std::string out_ = "rigc: 1\nname: test\nversion: 1\njoints:\n";
};

std::string point(double side, double x, double y, double z) {
  return fmt::format("[{}, {}, {}]", side * x, y, z);
}

}  // namespace

std::string body(const Commands& commands) {
  Writer w(commands);
  w.joint("root", "", "[0, 0, 0]", "root", "root");
  w.joint("hips", "root", "[0, 0.95, 0]", "torso", "hips");
  w.joint("spine", "hips", "[0, 1.05, 0]", "spine", "", "chain: {count: 2, to: [0, 1.17, 0.01]}");
  w.joint("chest", "spine", "[0, 1.3, 0.01]", "torso", "chest");
  w.joint("head", "chest", "[0, 1.6, 0.02]", "head", "head");
  for (const auto& [s, side] : {std::pair{std::string("l"), 1.0}, {std::string("r"), -1.0}}) {
    w.joint("clavicle_" + s, "chest", point(side, 0.03, 1.45, 0), "arm_" + s, "clavicle");
    w.joint("upperarm_" + s, "clavicle_" + s, point(side, 0.18, 1.44, 0), "arm_" + s, "upper");
    w.joint("forearm_" + s, "upperarm_" + s, point(side, 0.46, 1.43, -0.03), "arm_" + s, "lower");
    w.joint("hand_" + s, "forearm_" + s, point(side, 0.73, 1.42, 0), "arm_" + s, "end");
    w.joint("thigh_" + s, "hips", point(side, 0.1, 0.9, 0), "leg_" + s, "upper");
    w.joint("shin_" + s, "thigh_" + s, point(side, 0.1, 0.5, 0.014), "leg_" + s, "lower");
    w.joint("foot_" + s, "shin_" + s, point(side, 0.1, 0.08, 0), "leg_" + s, "end");
  }
  return w.finish();
}

std::string tail(int count, const Commands& commands) {
  Writer w(commands);
  w.joint("base", "", "[0, 1, 0.2]", "base", "base");
  w.joint("tail", "base", "[0, 1, 0]", "tail", "",
          fmt::format("chain: {{count: {}, to: [0, 1, -1]}}", count));
  return w.finish();
}

std::string limb(const std::string& upper, const std::string& lower, const std::string& end,
                 const Commands& commands) {
  Writer w(commands);
  w.joint("base", "", "[0, 0, 0]", "base", "base");
  w.joint("upper", "base", upper, "limb", "upper");
  w.joint("lower", "upper", lower, "limb", "lower");
  w.joint("end", "lower", end, "limb", "end");
  return w.finish();
}

}  // namespace rigc::test
