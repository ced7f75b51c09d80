// SPDX-License-Identifier: MIT
// What the builder adds to what a constructor asks for: identity, names, groups; and what it
// refuses.
#include "modules/builder.h"

#include <doctest/doctest.h>

#include <set>

#include "modules/bodies_helpers.h"
#include "support/random_template.h"
#include "support/rig.h"

using namespace rigc;

TEST_CASE("modules builder: a node's identity says for whom, by which command, in which role") {
  const test::Rig rig(
      test::tail(3, {{"base", "{command: fk_chain, id: whip, with: {joints: \"tail[*]\"}}"}}));
  REQUIRE(rig.clean());
  const scene::Node& fk = rig.scene()[rig.node("tail[1]/fk_chain#whip")];
  CHECK(fk.identity.owner == rig.skeleton.joints[2].key);
  CHECK(fk.identity.holder == rig.skeleton.joints[0].key);
  CHECK(fk.identity.command == "whip");
  CHECK(fk.identity.role == "fk");
  CHECK(fk.identity.counter == 0);
  CHECK(fk.ids == Identifiers{"test", "tail", ""});
  CHECK(fk.module == "fk_chain");
  CHECK(fk.name == "tail_2_fk");
  CHECK(fk.origin.joint == "base");
  CHECK(fk.origin.command == "whip");
  CHECK(fk.origin.span.known());
}

TEST_CASE("modules builder: no two nodes of a rig have one identity") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    const test::Rig rig(test::random_template(seed));
    std::set<std::string> identities;
    for (scene::NodeId id : rig.scene().nodes()) {
      const std::string identity = to_text(rig.scene()[id].identity);
      INFO(identity);
      CHECK(identities.insert(identity).second);
    }
  }
}

TEST_CASE("modules builder: a chain that grows keeps the identities of its joints") {
  const auto identities = [](int count) {
    const test::Rig rig(
        test::tail(count, {{"base", "{command: fk_chain, with: {joints: \"tail[*]\"}}"}}));
    std::vector<std::string> out;
    for (scene::NodeId id : rig.nodes("tail/fk_chain")) {
      out.push_back(to_text(rig.scene()[id].identity));
    }
    return out;
  };
  const auto three = identities(3), five = identities(5);
  REQUIRE(three.size() == 3);
  REQUIRE(five.size() == 5);
  CHECK(std::equal(three.begin(), three.end(), five.begin()));
}

TEST_CASE("modules builder: what is driven, whole or in part, is not driven again") {
  const auto codes = [](const std::string& first, const std::string& second) {
    const test::Rig rig(test::body(
        {{"root", "{command: control, with: {drive: off}}"},
         {"head", "{command: connect, id: one, with: {from: root/control@" + first + ", to: .@" +
                      first + "}}\n{command: connect, id: two, with: {from: root/control@" +
                      second + ", to: .@" + second + "}}"}}));
    return test::codes(rig.diagnostics);
  };
  CHECK(codes("translate", "translate") == "RIG0463");
  CHECK(codes("translate", "translate.x") == "RIG0463");
  CHECK(codes("translate.x", "translate") == "RIG0463");
  CHECK(codes("translate.x", "translate.y") == "");
  CHECK(codes("rotation", "rotate") == "RIG0463");
  CHECK(codes("rotation", "rotate.y") == "RIG0463");
  CHECK(codes("rotate.x", "rotation") == "RIG0463");
  CHECK(codes("rotate.x", "rotate.z") == "");
  CHECK(codes("translate", "rotate") == "");
}

TEST_CASE("modules builder: a driven attribute cannot be set") {
  const test::Rig rig(test::body({{"head",
                                   "{command: control, with: {}}\n"
                                   "{command: set, with: {plug: .@rotate.x, value: 10}}"}}));
  CHECK(test::codes(rig.diagnostics) == "RIG0463");
}
