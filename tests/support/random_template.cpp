// SPDX-License-Identifier: MIT
// Random templates: a root, chains that hang on one another, commands of many modules.
#include "support/random_template.h"

#include <fmt/format.h>

#include <vector>

#include "support/skeletons.h"

namespace rigc::test {
namespace {

using math::Vec3;

struct Joint {
  std::string name;
  std::string parent;
  Vec3 at;
  std::string local, label;
  std::vector<std::string> commands;
};

/// What already drives a chain, so that no two commands fight for it.
enum class Drive { none, fk, controls, limb, ik_chain };

struct Chain {
  std::string local;
  std::vector<std::size_t> joints;
  Drive drive = Drive::none;
};

std::string list_of(Vec3 v) { return fmt::format("[{:.3f}, {:.3f}, {:.3f}]", v.x, v.y, v.z); }

class Generator {
 public:
  Generator(std::uint64_t seed, const RandomTemplateOptions& options)
      : random_(seed), options_(options) {}

  std::string text() {
    make_skeleton();
    for (Chain& chain : chains_) drive(chain);
    for (std::size_t i = 0; i < options_.commands; ++i) add_command(i);
    return write();
  }

 private:
  template <class T>
  const T& any(const std::vector<T>& items) {
    return items[random_.below(items.size())];
  }
  Joint& any_joint() { return joints_[random_.below(joints_.size())]; }
  std::string shape() {
    return any(std::vector<std::string>{"circle", "square", "cube", "sphere", "diamond", "pin"});
  }
  std::string orient() {
    return any(std::vector<std::string>{"character", "world", "joint", "bone"});
  }

  void make_skeleton() {
    joints_.push_back({"root", "", {0, 0, 0}, "base", "root", {}});
    joints_[0].commands.push_back(fmt::format(
        "{{command: root, with: {{drive: on, size: {:.2f}}}}}", random_.number(0.5, 2)));
    for (std::size_t c = 0; c < options_.chains; ++c) {
      Chain chain{fmt::format("g{}", c), {}, Drive::none};
      const std::size_t parent = random_.below(joints_.size());
      const std::size_t count = 3 + random_.below(options_.longest - 2);
      std::string above = joints_[parent].name;
      Vec3 at = joints_[parent].at + random_.vector(0.4);
      const Vec3 direction = math::normalised(random_.vector(1));  // one draw a statement
      const Vec3 step = direction * random_.number(0.1, 0.4);
      for (std::size_t i = 0; i < count; ++i) {
        chain.joints.push_back(joints_.size());
        const std::string label = fmt::format("j{}", i);
        joints_.push_back({chain.local + "_" + label, above, at, chain.local, label, {}});
        above = joints_.back().name;
        at = at + step + random_.vector(0.05);
      }
      chains_.push_back(std::move(chain));
    }
  }

  Joint& joint(const Chain& chain, std::size_t i) { return joints_[chain.joints[i]]; }

  void drive(Chain& chain) {
    Joint& first = joint(chain, 0);
    std::string look;
    switch (random_.below(5)) {
      case 0:
        chain.drive = Drive::fk;
        look = shape();
        first.commands.push_back(
            fmt::format("{{command: fk_chain, with: {{joints: \"{}[*]\", shape: {}, orient: {}}}}}",
                        chain.local, look, orient()));
        break;
      case 1:
        chain.drive = Drive::controls;
        for (std::size_t i = 0; i < chain.joints.size(); ++i) {
          look = shape();
          joint(chain, i).commands.push_back(
              fmt::format("{{command: control, with: {{shape: {}, translate: {}}}}}", look,
                          random_.chance(0.5) ? "on" : "off"));
        }
        break;
      case 2:
        chain.drive = Drive::limb;
        first.commands.push_back(fmt::format(
            "{{command: ik_fk_limb, with: {{start: {0}.j0, middle: {0}.j1, end: {0}.j2, "
            "ik_fk: {1:.2f}, bend: forward}}}}",
            chain.local, random_.number(0, 1)));
        break;
      case 3:
        chain.drive = Drive::ik_chain;
        first.commands.push_back(fmt::format(
            "{{command: control, id: goal, with: {{drive: off, parent: base/root.offset}}}}"));
        first.commands.push_back(
            fmt::format("{{command: ik_handle, with: {{start: \"{0}[START]\", end: \"{0}[END]\", "
                        "solver: chain, "
                        "goal: \"./control#goal\", iterations: 4}}}}",
                        chain.local));
        break;
      default:
        break;
    }
  }

  std::string target() {
    return any(std::vector<std::string>{"base/root.offset", "base/root.world", "base.root"});
  }

  /// A command that fits wherever it stands; `n` makes its id unique.
  void add_command(std::size_t n) {
    Joint& at = any_joint();
    std::string first;  // of two draws in one text
    switch (random_.below(10)) {
      case 0:
        first = list_of(random_.vector(0.2));
        at.commands.push_back(
            fmt::format("{{command: transform, id: t{}, with: {{offset: {}, orient: {}}}}}", n,
                        first, orient()));
        break;
      case 1:
        at.commands.push_back(
            fmt::format("{{command: joint, id: j{0}, with: {{offset: {1}, label: made{0}}}}}", n,
                        list_of(random_.vector(0.2))));
        break;
      case 2:
        at.commands.push_back(fmt::format(
            "{{command: attribute, id: a{0}, with: {{\"on\": base/root.world, attribute: n{0}, "
            "min: -5, max: 5, default: {1:.2f}}}}}",
            n, random_.number(-5, 5)));
        break;
      case 3:
        first = "xyz"[random_.below(3)];
        at.commands.push_back(fmt::format(
            "{{command: set, id: s{}, with: {{plug: \"base/root.world@translate.{}\", value: "
            "{:.3f}}}}}",
            n, first, random_.number(-1, 1)));
        break;
      case 4:
        add_constrained(at, n);
        break;
      case 5:
        first = shape();
        at.commands.push_back(fmt::format(
            "{{command: control, id: c{}, with: {{drive: off, shape: {}, orient: {}}}}}", n, first,
            orient()));
        break;
      case 6:  // finds nothing: is skipped, or counts as left out
        at.commands.push_back(
            random_.chance(0.5)
                ? fmt::format("{{command: fk_chain, id: f{}, with: {{joints: \"{}.none?\"}}}}", n,
                              at.local)
                : fmt::format("{{command: control, id: o{}, stage: finish, with: {{drive: off, "
                              "parent: \"{}.none?\"}}}}",
                              n, at.local));
        break;
      case 7:
        add_computed(at, n);
        break;
      case 8:
        add_access(at, n);
        break;
      default:
        at.commands.push_back(fmt::format(
            "{{command: proxy_mesh, id: p{}, with: {{joints: [\".\", \"{}[*]\"]}}}}", n, at.local));
        break;
    }
  }

  /// A transform of its own that a constraint moves.
  void add_constrained(Joint& at, std::size_t n) {
    const std::string module =
        any(std::vector<std::string>{"point_constraint", "orient_constraint", "scale_constraint",
                                     "parent_constraint", "aim_constraint"});
    at.commands.push_back(fmt::format("{{command: transform, id: held{}, with: {{offset: {}}}}}", n,
                                      list_of(random_.vector(0.3))));
    const std::string first = target();
    const std::string second = target();
    const double weight = random_.number(0, 1);
    at.commands.push_back(fmt::format(
        "{{command: {0}, id: k{1}, with: {{driven: \"./transform#held{1}\", targets: [{2}, {3}], "
        "weights: [{4:.2f}, {5:.2f}]}}}}",
        module, n, first, second, weight, random_.number(0, 1)));
  }

  /// Limits, locks, layers and sets of the root's controls and of a control of its own.
  void add_access(Joint& at, std::size_t n) {
    at.commands.push_back(fmt::format("{{command: control, id: m{}, with: {{drive: off}}}}", n));
    const std::string own = fmt::format("./control#m{}", n);
    const double least = random_.number(-60, 0);
    const double most = random_.number(0, 2);
    at.commands.push_back(fmt::format(
        "{{command: limits, id: l{0}, with: {{nodes: [\"{1}\", base/root.offset, .], "
        "min_rotate_x: {2:.1f}, max_rotate_z: 30, max_translate_y: {3:.2f}, order: {4}}}}}",
        n, own, least, most, random_.chance(0.5) ? "xyz" : "zxy"));
    at.commands.push_back(fmt::format(
        "{{command: lock, id: k{0}, with: {{attributes: [\"{1}@translate.x\", \"{1}@rotate.y\"], "
        "mode: {2}}}}}",
        n, own, any(std::vector<std::string>{"lock", "hide", "lock_and_hide"})));
    const std::string layer = any(std::vector<std::string>{"body", "face"});
    at.commands.push_back(
        fmt::format("{{command: display_layer, id: y{0}, with: {{layer: {1}, nodes: [\"{2}\", "
                    "base/root.world, .], color: {3}, switch_on: base/root.world}}}}",
                    n, layer, own, layer == "body" ? "red" : "green"));
    const std::string set = any(std::vector<std::string>{"a", "b", "c"});
    at.commands.push_back(
        fmt::format("{{command: control_set, id: g{0}, with: {{set: {1}, parent: all}}}}", n, set));
  }

  /// A transform of its own that a formula or a curve moves.
  void add_computed(Joint& at, std::size_t n) {
    at.commands.push_back(fmt::format("{{command: transform, id: free{}}}", n));
    if (random_.chance(0.5)) {
      at.commands.push_back(
          fmt::format("{{command: expression, id: e{0}, with: {{to: "
                      "\"./transform#free{0}@translate.y\", value: "
                      "\"{{base/root.world@master_scale}} * {1:.2f} + "
                      "sin({{base/root.offset@translate.x}})\"}}}}",
                      n, random_.number(-2, 2)));
    } else {
      at.commands.push_back(fmt::format(
          "{{command: remap, id: r{0}, with: {{from: base/root.offset@translate.z, to: "
          "\"./transform#free{0}@rotate.x\", output_max: {1:.1f}, curve: [[0, 0, smooth], [0.4, 1, "
          "spline], [1, 0.2]]}}}}",
          n, random_.number(-90, 90)));
    }
  }

  std::string write() const {
    std::string out = "rigc: 1\nname: random\nversion: 1\njoints:\n";
    for (const Joint& joint : joints_) {
      out += fmt::format("  - name: {}\n    at: {}\n    local: {}\n    label: {}\n", joint.name,
                         list_of(joint.at), joint.local, joint.label);
      if (!joint.parent.empty()) out += fmt::format("    parent: {}\n", joint.parent);
      if (joint.commands.empty()) continue;
      out += "    tags:\n";
      for (const std::string& command : joint.commands) out += "      - " + command + "\n";
    }
    return out;
  }

  Random random_;
  RandomTemplateOptions options_;
  std::vector<Joint> joints_;
  std::vector<Chain> chains_;
};

}  // namespace

std::string random_template(std::uint64_t seed, const RandomTemplateOptions& options) {
  return Generator(seed, options).text();
}

}  // namespace rigc::test
