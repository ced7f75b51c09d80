// SPDX-License-Identifier: MIT
// The registry and the descriptors agree, and what every descriptor shows as its example works: it
// builds without a diagnostic, stays at rest on every kind of skeleton, and can be taken back.
#include "modules/registry.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "modules/builder.h"
#include "support/models.h"
#include "support/pose.h"
#include "support/rig.h"

using namespace rigc;

namespace {

constexpr double kRest = 1e-9;

/// `set` is there to give a control another value than it rests at.
bool rests(const std::string& module) { return module != "set"; }

/// These write numbers into a joint's own attributes, which mean something else on other axes.
bool means_axes(const std::string& module) {
  return module == "connect" || module == "expression" || module == "remap";
}

void check_at_rest(const std::string& module, const test::Rig& rig) {
  INFO(test::text(rig.diagnostics));
  CHECK(rig.clean());
  if (rig.clean() && rests(module)) CHECK(test::rest_error(rig) < kRest);
}

}  // namespace

TEST_CASE("modules registry: sorted by name, and every descriptor has its constructor") {
  const auto modules = modules::registry();
  CHECK(std::is_sorted(modules.begin(), modules.end(),
                       [](const auto& a, const auto& b) { return a.name < b.name; }));
  std::vector<std::string> names;
  for (const modules::Module& module : modules) {
    names.emplace_back(module.name);
    REQUIRE(modules::find(module.name));
    const bool same = modules::find(module.name)->construct == module.construct;
    CHECK(same);
  }
  CHECK(names == test::catalogue().modules());
  CHECK_FALSE(modules::find(""));
  CHECK_FALSE(modules::find("controls"));
  CHECK_FALSE(modules::find("zzz"));
}

TEST_CASE("modules registry: every example builds and rests where its joints rest") {
  for (const std::string& name : test::catalogue().modules()) {
    CAPTURE(name);
    const test::Rig rig(test::catalogue().find(name)->example);
    check_at_rest(name, rig);
  }
}

TEST_CASE("modules registry: every example rests on skeletons of every kind") {
  for (const std::string& name : test::catalogue().modules()) {
    if (means_axes(name)) continue;
    CAPTURE(name);
    const std::string& example = test::catalogue().find(name)->example;
    for (const test::Model& model : test::models()) {
      CAPTURE(model.name);
      check_at_rest(name, test::Rig(example, model.change));
    }
  }
}

TEST_CASE("modules registry: examples make what their descriptors say, and use their own module") {
  for (const std::string& name : test::catalogue().modules()) {
    CAPTURE(name);
    const catalog::Descriptor& descriptor = *test::catalogue().find(name);
    const test::Rig rig(descriptor.example);
    REQUIRE(rig.clean());
    bool used = false;
    for (const processor::Command& command : rig.commands.commands) {
      used = used || tag_of(rig.skeleton, command).module == name;
    }
    CHECK(used);
    for (scene::NodeId id : rig.scene().nodes()) {
      const scene::Node& node = rig.scene()[id];
      if (node.module != name) continue;
      const std::string kind(scene::spec(node.kind).name);
      INFO(node.identity.role << " of kind " << kind);
      CHECK(std::any_of(descriptor.creates.begin(), descriptor.creates.end(),
                        [&](const catalog::Creates& row) {
                          return row.role == node.identity.role && row.kind == kind;
                        }));
    }
  }
}

TEST_CASE("modules registry: every example taken back leaves the skeleton alone") {
  for (const std::string& name : test::catalogue().modules()) {
    CAPTURE(name);
    test::Rig rig(test::catalogue().find(name)->example, {}, false);
    const std::string before = rig.scene().dump();
    REQUIRE(rig.processor().run(rig.diagnostics));
    CHECK(rig.scene().dump() != before);
    REQUIRE(rig.processor().go_to(0, rig.diagnostics));
    CHECK(rig.scene().dump() == before);
  }
}
