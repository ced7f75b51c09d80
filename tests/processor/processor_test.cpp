// SPDX-License-Identifier: MIT
// Running, stepping and taking back. Laws 1, 2 and 6 at the level of scenes, over random templates.
#include "processor/processor.h"

#include <doctest/doctest.h>

#include "eval/evaluate.h"
#include "support/random_template.h"
#include "support/rig.h"
#include "support/skeletons.h"

using namespace rigc;

namespace {

constexpr std::uint64_t kSeeds = 25;

/// The dump after each number of commands, 0 to all.
std::vector<std::string> recorded(test::Rig& rig) {
  processor::Processor& processor = rig.processor();
  std::vector<std::string> dumps{rig.scene().dump()};
  while (processor.position() < rig.commands.commands.size()) {
    INFO(test::text(rig.diagnostics));
    REQUIRE(processor.step(rig.diagnostics));
    dumps.push_back(rig.scene().dump());
  }
  return dumps;
}

constexpr const char* kLadder = R"(rigc: 1
name: ladder
version: 1
joints:
  - name: a
    at: [0, 0, 0]
    local: a
    label: a
    tags: [{command: root}, {command: control, id: one}]
  - name: b
    parent: a
    at: [0, 1, 0]
    local: b
    label: b
    tags: [{command: control, id: two}, {command: control, id: three, with: {drive: off}}]
)";

}  // namespace

TEST_CASE("processor: random templates build and compile") {
  int skipped = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    CAPTURE(seed);
    const test::Rig rig(test::random_template(seed));
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.listed());
    CHECK(rig.diagnostics.ok());
    skipped += static_cast<int>(rig.diagnostics.warnings());
    CHECK(eval::worlds(rig.scene(), {rig.scene().nodes().front()}).size() == 1);
    if (rig.diagnostics.warnings() > 0) CHECK(test::codes(rig.diagnostics).find("RIG0503") == 0);
  }
  CHECK(skipped > 0);
}

TEST_CASE("processor: law 1, two processors give the same scene") {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    CAPTURE(seed);
    const std::string text = test::random_template(seed);
    CHECK(text == test::random_template(seed));
    const test::Rig one(text), two(text);
    CHECK(one.scene().dump() == two.scene().dump());
  }
}

TEST_CASE("processor: law 2, every step back gives back the scene before it") {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    CAPTURE(seed);
    test::Rig rig(test::random_template(seed), {}, false);
    const std::vector<std::string> dumps = recorded(rig);
    processor::Processor& processor = rig.processor();
    test::Random random(seed);
    for (int walk = 0; walk < 20; ++walk) {
      for (std::size_t back = random.below(8); back > 0 && processor.position() > 0; --back) {
        REQUIRE(processor.step_back());
        CHECK(rig.scene().dump() == dumps[processor.position()]);
      }
      for (std::size_t on = random.below(8); on > 0; --on) {
        REQUIRE(processor.step(rig.diagnostics));
        CHECK(rig.scene().dump() == dumps[processor.position()]);
      }
    }
    REQUIRE(processor.go_to(0, rig.diagnostics));
    CHECK(rig.scene().dump() == dumps.front());
    CHECK_FALSE(processor.step_back());
  }
}

TEST_CASE("processor: law 6, a partial rebuild gives the scene of a full one") {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    CAPTURE(seed);
    test::Rig rig(test::random_template(seed));
    const std::string full = rig.scene().dump();
    test::Random random(seed + 1000);
    for (int i = 0; i < 5; ++i) {
      REQUIRE(
          rig.processor().go_to(random.below(rig.commands.commands.size() + 1), rig.diagnostics));
      REQUIRE(rig.processor().run(rig.diagnostics));
      CHECK(rig.scene().dump() == full);
    }
  }
}

TEST_CASE("processor: the index knows the scene again after going back") {
  test::Rig rig(kLadder);
  CHECK(rig.nodes("b.b/control").size() == 2);
  REQUIRE(rig.processor().step_back());
  CHECK(rig.nodes("b.b/control").size() == 1);
  REQUIRE(rig.processor().go_to(0, rig.diagnostics));
  CHECK(rig.nodes("a/root").empty());
  CHECK(rig.nodes("b").size() == 1);
}

TEST_CASE("processor: steps by command and by joint") {
  test::Rig rig(kLadder, {}, false);
  processor::Processor& processor = rig.processor();
  CHECK(processor.position() == 0);
  REQUIRE(processor.step(rig.diagnostics));
  CHECK(processor.position() == 1);
  REQUIRE(processor.step_joint(rig.diagnostics));  // the rest of a
  CHECK(processor.position() == 2);
  REQUIRE(processor.step_joint(rig.diagnostics));
  CHECK(processor.position() == 4);
  CHECK(processor.step(rig.diagnostics));  // at the end there is nothing to do
  CHECK(processor.step_joint(rig.diagnostics));
  CHECK(processor.position() == 4);
  CHECK(processor.step_joint_back());
  CHECK(processor.position() == 2);
  CHECK(processor.step_joint_back());
  CHECK(processor.position() == 0);
  CHECK_FALSE(processor.step_joint_back());
}

TEST_CASE("processor: a failing command leaves the scene as it was, and says where it stands") {
  // Each fails after it has made nodes.
  for (const char* command :
       {"{command: control, with: {shape: no_such_shape}}",
        "{command: fk_chain, with: {joints: [a.a, b.b], shape: no_such_shape}}",
        "{command: point_constraint, with: {driven: a.a, targets: b.b, weights_on: a/control, "
        "weights_name: taken}}",
        "{command: control, id: again, with: {}}"}) {
    CAPTURE(std::string(command));
    std::string text = R"(rigc: 1
name: failing
version: 1
joints:
  - name: a
    at: [0, 0, 0]
    local: a
    label: a
    tags:
      - {command: control}
      - {command: attribute, with: {attribute: taken_0}}
  - name: b
    parent: a
    at: [0, 1, 0]
    local: b
    label: b
    tags:
      - {command: orient_constraint, stage: build, with: {targets: a/control}}
)";
    text += std::string("      - ") + command + "\n";
    test::Rig rig(text, {}, false);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.listed());
    REQUIRE(rig.processor().go_to(3, rig.diagnostics));
    const std::string before = rig.scene().dump();
    CHECK_FALSE(rig.processor().step(rig.diagnostics));
    CHECK(rig.scene().dump() == before);
    CHECK(rig.processor().position() == 3);
    REQUIRE(rig.diagnostics.errors() > 0);
    CHECK(rig.diagnostics.all().front().place.span.line == 19);
    CHECK_FALSE(rig.processor().run(rig.diagnostics));
    CHECK(rig.scene().dump() == before);
  }
}

TEST_CASE("processor: a skipped command is reported, changes nothing, and can be taken back") {
  const std::string text = test::template_of(R"(joints:
  - name: a
    at: [0, 0, 0]
    local: a
    label: a
    tags:
      - {command: fk_chain, with: {joints: "toes[*]?"}}
      - {command: control}
)");
  test::Rig rig(text, {}, false);
  const std::string before = rig.scene().dump();
  REQUIRE(rig.processor().step(rig.diagnostics));
  CHECK(rig.scene().dump() == before);
  CHECK(rig.processor().skipped(0));
  CHECK(test::places(rig.diagnostics) == "RIG0503 10:19\n");
  CHECK(rig.diagnostics.ok());
  REQUIRE(rig.processor().step(rig.diagnostics));
  CHECK_FALSE(rig.processor().skipped(1));
  REQUIRE(rig.processor().go_to(0, rig.diagnostics));
  CHECK(rig.scene().dump() == before);
}

TEST_CASE("processor: what a plan shows is what the selectors find") {
  test::Rig rig(test::template_of(R"(joints:
  - name: a
    at: [0, 0, 0]
    local: a
    label: a
    tags:
      - {command: control}
      - {command: point_constraint, with: {driven: b.b, targets: [./control, "c[*]?"]}}
  - {name: b, at: [0, 1, 0], local: b, label: b}
)"));
  INFO(test::text(rig.diagnostics));
  const auto arguments = rig.processor().resolved(1);
  REQUIRE(arguments.size() == 3);
  CHECK(arguments[0].name == "driven");
  CHECK(arguments[0].found == std::vector<std::string>{"b.b (joint \"b\")"});
  CHECK(arguments[1].selector == "./control");
  CHECK(arguments[1].found ==
        std::vector<std::string>{"a.a/control.control (control \"a_control\")"});
  CHECK(arguments[2].found.empty());
}
