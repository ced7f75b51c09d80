// SPDX-License-Identifier: MIT
// Which node takes whose keys: the rules, one by one and against each other.
#include "update/match.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "scene/edit.h"
#include "support/rig.h"

namespace rigc {
namespace {

using scene::Kind;
using scene::NodeId;
using scene::Scene;
using tags::TaggedSkeleton;
using update::Match;
using update::Rule;
using update::Source;

constexpr JointKey kA{1, 0}, kB{2, 0}, kC{3, 0}, kChild{1, 1};

Identity identity(JointKey owner, JointKey holder, const std::string& command,
                  const std::string& role = "control", std::uint32_t counter = 0) {
  return {0, owner, holder, command, role, counter};
}

/// A scene of nodes without a hierarchy.
class Made {
 public:
  NodeId add(const Identity& identity, const std::string& module = "control",
             const Identifiers& ids = {}, Kind kind = Kind::control) {
    scene::Node node;
    node.kind = kind;
    node.identity = identity;
    node.ids = ids;
    node.module = module;
    if (!module.empty()) node.command = 0;
    scene::Journal journal;
    return scene::Edit(scene, journal, nullptr).make(std::move(node));
  }
  NodeId add_joint(JointKey key) { return add({0, key, {}, "", "", 0}, "", {}, Kind::joint); }
  std::vector<Source> sources() const { return update::sources_of(scene); }
  Scene scene;
};

TaggedSkeleton joints(const std::vector<JointKey>& keys) {
  TaggedSkeleton out;
  for (const JointKey& key : keys) {
    out.joints.emplace_back().key = key;
    out.joints.back().name = to_text(key);
  }
  return out;
}

void give_command(TaggedSkeleton& skeleton, std::size_t joint, const std::string& id,
                  const std::vector<std::string>& was) {
  tags::CommandTag command;
  command.id = id;
  command.was = was;
  skeleton.joints[joint].commands.push_back(std::move(command));
}

std::string holder(JointKey key, const std::string& id) { return to_text(key) + "/" + id; }

std::string text(const std::vector<std::optional<Match>>& matches) {
  std::string out;
  for (const auto& match : matches)
    out += match ? fmt::format("{}:{} ", match->to.index, update::name_of(match->rule)) : "- ";
  return out;
}

std::string matched(const std::vector<Source>& sources, const Made& fresh,
                    const TaggedSkeleton& skeleton) {
  return text(update::match(sources, fresh.scene, skeleton, test::catalogue()));
}

/// A module `heir` whose role `fk` succeeds role `control` of the module `control`, and whose `ik`
/// succeeds `fk` of `fk_chain`.
catalog::Catalogue catalogue_with_heir() {
  const std::string folder = std::string(RIGC_TEST_OUT) + "/update_modules";
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/heir.yaml") << R"(module: heir
version: 1
title: Heir
category: controls
summary: Succeeds others.
implementation: builtin
parameters: []
creates:
  - {role: fk, kind: control, per: joint, help: One.}
  - {role: ik, kind: control, per: joint, help: Another.}
replaces: {control: {control: fk}, fk_chain: {fk: ik}}
example: |
  rigc: 1
  name: heir
  version: 1
  joints: [{name: a}]
)";
  catalog::Catalogue out;
  Diagnostics diagnostics;
  REQUIRE_MESSAGE(out.add_folder(folder, diagnostics), render(diagnostics, false));
  return out;
}

}  // namespace

TEST_CASE(
    "match: a node is the one of the same joint, command and role, whatever the rig's number") {
  Made old, fresh;
  Identity one = identity(kA, kA, "main"), other = identity(kB, kA, "main");
  one.rig = 3;
  old.add(one);
  old.add(other);
  old.add(identity(kB, kA, "main", "control", 1));
  fresh.add(other);
  one.rig = 5;
  fresh.add(one);
  CHECK(matched(old.sources(), fresh, joints({kA, kB})) == "1:identity 0:identity - ");
}

TEST_CASE("match: nodes without a place in a file are no sources") {
  Made old;
  old.add(identity(kA, kA, "main"));
  old.add(identity(kA, kA, "main", "driver"), "control", {}, Kind::parent_constraint);
  CHECK(old.sources().size() == 1);
}

TEST_CASE("match: a joint that was another takes the nodes for it and those that it holds") {
  Made old, fresh;
  old.add(identity(kA, kA, "main"));
  old.add(identity(kB, kA, "main"));
  old.add(identity(kA, kB, "far"));
  old.add_joint(kA);
  fresh.add(identity(kC, kC, "main"));
  fresh.add(identity(kB, kC, "main"));
  fresh.add(identity(kC, kB, "far"));
  fresh.add_joint(kC);
  TaggedSkeleton skeleton = joints({kC, kB});
  CHECK(matched(old.sources(), fresh, skeleton) == "- - - - ");
  skeleton.joints[0].was = {kA};
  CHECK(matched(old.sources(), fresh, skeleton) == "0:was 1:was 2:was 3:was ");
}

TEST_CASE("match: the latest of earlier keys that is there counts") {
  Made old, fresh;
  old.add(identity(kA, kA, "main"));
  old.add(identity(kB, kB, "main"));
  fresh.add(identity(kC, kC, "main"));
  TaggedSkeleton skeleton = joints({kC});
  skeleton.joints[0].was = {kA, kB};
  CHECK(matched(old.sources(), fresh, skeleton) == "- 0:was ");
  skeleton.joints[0].was = {kB, kA};
  CHECK(matched(old.sources(), fresh, skeleton) == "0:was - ");
}

TEST_CASE("match: a command that moved takes its nodes along") {
  Made old, fresh;
  old.add(identity(kA, kA, "main"));      // of the joint that held it
  old.add(identity(kChild, kA, "main"));  // for another joint
  fresh.add(identity(kB, kB, "chief"));   // its own is its holder's now
  fresh.add(identity(kChild, kB, "chief"));
  TaggedSkeleton skeleton = joints({kA, kB, kChild});
  give_command(skeleton, 1, "chief", {holder(kA, "main")});
  CHECK(matched(old.sources(), fresh, skeleton) == "0:was 1:was ");
}

TEST_CASE("match: a command for several joints moves to another of them") {
  Made old, fresh;
  old.add(identity(kA, kB, "chain"));
  old.add(identity(kB, kB, "chain"));
  for (const JointKey& joint : {kC, kA, kB}) fresh.add(identity(joint, kA, "chain"));
  TaggedSkeleton skeleton = joints({kA, kB, kC});
  give_command(skeleton, 0, "chain", {holder(kB, "chain")});
  CHECK(matched(old.sources(), fresh, skeleton) == "1:was 2:was ");
  // It makes nothing any more for the joint that held it: that is not its holder's now.
  Made less;
  less.add(identity(kA, kA, "chain"));
  CHECK(matched(old.sources(), less, skeleton) == "0:was - ");
}

TEST_CASE("match: a command that moved from a joint that was renamed") {
  Made old, fresh;
  old.add(identity(kA, kA, "main"));
  fresh.add(identity(kB, kB, "main"));
  TaggedSkeleton skeleton = joints({kC, kB});
  skeleton.joints[0].was = {kA};
  give_command(skeleton, 1, "main", {holder(kC, "main")});
  CHECK(matched(old.sources(), fresh, skeleton) == "0:was ");
}

TEST_CASE("match: what is still there is not given away to those that say they were it") {
  Made old, fresh;
  old.add(identity(kA, kA, "main"));
  fresh.add(identity(kB, kB, "main"));
  fresh.add(identity(kA, kA, "main"));
  TaggedSkeleton skeleton = joints({kA, kB});
  give_command(skeleton, 1, "main", {holder(kA, "main")});
  CHECK(matched(old.sources(), fresh, skeleton) == "1:identity ");
}

TEST_CASE("match: of two that say they were it only one is") {
  Made old, fresh;
  old.add(identity(kA, kA, "main"));
  fresh.add(identity(kB, kB, "main"));
  fresh.add(identity(kC, kC, "main"));
  TaggedSkeleton skeleton = joints({kB, kC});
  skeleton.joints[0].was = {kA};
  skeleton.joints[1].was = {kA};
  CHECK(matched(old.sources(), fresh, skeleton) == "0:was ");
}

TEST_CASE("match: commands that exchanged their places do so") {
  Made old, fresh;
  old.add(identity(kA, kA, "one"));
  old.add(identity(kB, kB, "two"));
  fresh.add(identity(kB, kB, "one"));
  fresh.add(identity(kA, kA, "two"));
  TaggedSkeleton skeleton = joints({kA, kB});
  give_command(skeleton, 0, "two", {holder(kB, "two")});
  give_command(skeleton, 1, "one", {holder(kA, "one")});
  CHECK(matched(old.sources(), fresh, skeleton) == "0:was 1:was ");
}

TEST_CASE("match: a module's role succeeds that of the module that it replaces") {
  const catalog::Catalogue catalogue = catalogue_with_heir();
  const auto run = [&](const Made& old, const Made& fresh, const TaggedSkeleton& skeleton) {
    return text(update::match(old.sources(), fresh.scene, skeleton, catalogue));
  };
  Made old, fresh;
  old.add(identity(kA, kA, "main"));
  old.add(identity(kB, kA, "chain", "fk"), "fk_chain");
  old.add(identity(kB, kA, "chain", "zero"), "fk_chain", {}, Kind::transform);
  fresh.add(identity(kA, kC, "new", "fk"), "heir");
  fresh.add(identity(kB, kC, "new", "ik"), "heir");
  CHECK(run(old, fresh, joints({kA, kB, kC})) == "0:replaces 1:replaces - ");
  // For a joint that was another, too.
  Made moved;
  moved.add(identity(kC, kC, "new", "fk"), "heir");
  TaggedSkeleton skeleton = joints({kC});
  skeleton.joints[0].was = {kA};
  CHECK(run(old, moved, skeleton) == "0:replaces - - ");
  // Two commands made one for the joint: neither is meant.
  old.add(identity(kA, kB, "also"));
  CHECK(run(old, fresh, joints({kA, kB, kC})) == "- 1:replaces - - ");
  // One of them is still there: the other is meant.
  fresh.add(identity(kA, kB, "also"));
  CHECK(run(old, fresh, joints({kA, kB, kC})) == "0:replaces 1:replaces - 2:identity ");
}

TEST_CASE("match: the only one with the label, in the group, of the kind and role") {
  const Identifiers wrist{"hero", "arm", "wrist"}, elbow{"hero", "arm", "elbow"};
  Made old, fresh;
  old.add(identity(kA, kA, "main"), "control", wrist);
  old.add(identity(kB, kB, "main"), "control", elbow);
  fresh.add(identity(kC, kC, "x"), "control", wrist);
  fresh.add(identity(kC, kC, "y", "ik"), "control", elbow);  // another role
  CHECK(matched(old.sources(), fresh, joints({kC})) == "0:label - ");
  SUBCASE("two of the new rig have it") {
    fresh.add(identity(kC, kC, "z"), "control", wrist);
    CHECK(matched(old.sources(), fresh, joints({kC})) == "- - ");
  }
  SUBCASE("one of them is another's by a better rule: still two have it") {
    fresh.add(identity(kB, kB, "main"), "control", wrist);
    CHECK(matched(old.sources(), fresh, joints({kB, kC})) == "- 2:identity ");
  }
  SUBCASE("two of the old rig have lost it") {
    old.add(identity(kB, kB, "also"), "control", wrist);
    CHECK(matched(old.sources(), fresh, joints({kC})) == "- - - ");
  }
  SUBCASE("it is taken") {
    old.add(identity(kC, kC, "x"));
    CHECK(matched(old.sources(), fresh, joints({kC})) == "- - 0:identity ");
  }
  SUBCASE("the group differs") {
    Made other;
    other.add(identity(kC, kC, "x"), "control", {"hero", "leg", "wrist"});
    CHECK(matched(old.sources(), other, joints({kC})) == "- - ");
  }
  SUBCASE("it is no control") {
    Made other;
    other.add(identity(kC, kC, "x"), "control", wrist, Kind::transform);
    CHECK(matched(old.sources(), other, joints({kC})) == "- - ");
  }
  SUBCASE("it has no label") {
    Made unlabelled, other;
    unlabelled.add(identity(kA, kA, "main"), "control", {"hero", "arm", ""});
    other.add(identity(kC, kC, "x"), "control", {"hero", "arm", ""});
    CHECK(matched(unlabelled.sources(), other, joints({kC})) == "- ");
  }
}

TEST_CASE("match: an orphan and a node of one identity go to the same node") {
  Made old, fresh;
  old.add(identity(kA, kA, "main"));
  std::vector<Source> sources = old.sources();
  Source orphan = sources.front();
  orphan.node = {};
  sources.push_back(orphan);
  fresh.add(identity(kA, kA, "main"));
  CHECK(matched(sources, fresh, joints({kA})) == "0:identity 0:identity ");
}

TEST_CASE("match: joints stay joints and meshes meshes") {
  Made old, fresh;
  old.add(identity(kA, kA, "main"), "joint", {}, Kind::joint);
  old.add(identity(kB, kB, "main"), "proxy_mesh", {}, Kind::mesh);
  fresh.add(identity(kA, kA, "main"), "control", {}, Kind::control);
  fresh.add(identity(kB, kB, "main"), "control", {}, Kind::control);
  CHECK(matched(old.sources(), fresh, joints({kA, kB})) == "- - ");
}

TEST_CASE("match: a rig built twice from one template matches node by node") {
  const std::string yaml = test::template_of(R"(joints:
  - name: base
    local: body
    label: base
    tags: [{command: root, with: {drive: on}}]
  - name: arm
    parent: base
    at: [0, 1, 0]
    chain: {count: 4, to: [1, 1, 0.1]}
    local: arm
    label: arm
    tags:
      - {command: fk_chain, with: {joints: "arm[*]"}}
      - {command: control, id: extra, with: {drive: off}}
)");
  const test::Rig a(yaml), b(yaml);
  REQUIRE(a.clean());
  const auto sources = update::sources_of(a.scene());
  const auto matches = update::match(sources, b.scene(), b.skeleton, test::catalogue());
  REQUIRE(sources.size() > 10);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    REQUIRE(matches[i]);
    CHECK(matches[i]->to == sources[i].node);
    CHECK(matches[i]->rule == Rule::identity);
    CHECK(sources[i].frame.space == update::frame_of(b.scene(), matches[i]->to).space);
  }
}

TEST_CASE("match: an orphan waits at its node without keeping what plays from it") {
  // A limb had an attribute that the chain in its place has not; now the limb is back.
  Made old, fresh;
  fresh.add(identity(kA, kA, "limb", "fk"), "heir");
  old.add(identity(kA, kA, "ctrl"));
  Source orphan = old.sources().front();
  orphan.identity = identity(kA, kA, "limb", "fk");
  orphan.module = "heir";
  orphan.node = {};
  const auto skeleton = joints({kA});
  const catalog::Catalogue catalogue = catalogue_with_heir();
  const auto run = [&](std::vector<Source> sources) {
    return text(update::match(sources, fresh.scene, skeleton, catalogue));
  };
  std::vector<Source> sources = old.sources();
  sources.push_back(orphan);
  CHECK(run(sources) == "0:replaces 0:identity ");
  // Another orphan of the same kind has no right to it.
  Source other = orphan;
  other.identity = identity(kA, kA, "ctrl");
  other.module = "control";
  CHECK(run({orphan, other}) == "0:identity - ");
  CHECK(run({other}) == "0:replaces ");
  // And none comes to a node that something of the old rig has by a later rule.
  CHECK(run({old.sources().front(), other}) == "0:replaces 0:replaces ");
  other.identity = identity(kA, kB, "more");
  CHECK(run({old.sources().front(), other}) == "0:replaces - ");
}

}  // namespace rigc
