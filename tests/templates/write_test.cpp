// SPDX-License-Identifier: MIT
// Writing templates: what the format needs to say of a flat skeleton, and that it reads back.
#include "templates/write.h"

#include <doctest/doctest.h>

#include "tags/dump.h"
#include "templates/templates_helpers.h"
#include "templates/write_skeleton.h"
#include "templates/yaml_text.h"

namespace rigc::templates {
namespace {

using testing::catalogue;
using testing::numbers;
using testing::place_text;
using testing::with_head;

tags::TaggedSkeleton placed(const std::string& text) {
  Diagnostics diagnostics;
  auto skeleton = place_text(text, diagnostics);
  REQUIRE_MESSAGE(skeleton, render(diagnostics, false));
  return *skeleton;
}

std::string written(const tags::TaggedSkeleton& skeleton) {
  WriteOptions options;
  options.name = skeleton.name;
  return write(skeleton, catalogue(), options);
}

std::vector<int> errors_of(const std::string& joints) {
  Diagnostics diagnostics;
  place_text(with_head("joints:\n" + joints), diagnostics);
  return numbers(diagnostics);
}

/// A dump without what the text of a template alone decides.
std::string dump_of(tags::TaggedSkeleton skeleton) {
  skeleton.templates.clear();
  skeleton.character = {};
  return dump(skeleton);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("templates write: texts that YAML takes for something else are quoted") {
  CHECK(yaml_text("arm_l.wrist/control#main") == "arm_l.wrist/control#main");
  CHECK(yaml_text("moves the whole body") == "moves the whole body");
  CHECK(yaml_text("+y") == "+y");
  for (const char* text :
       {"",   "on", "Yes", "null", "0.5", "1e3", "a: b", "a #b", "[a]",  "a,b", "-a",
        " a", "a ", "a?",  "{x}",  "*",   "&a",  "%",    "\"",   "a\nb", "~",   "nan"}) {
    CAPTURE(text);
    CHECK(yaml_text(text).front() == '"');
    Diagnostics diagnostics;
    const auto file = diagnostics.sources().add("t", "k: {a: " + yaml_text(text) + "}\n");
    const auto root = yaml::read(file, diagnostics);
    REQUIRE_MESSAGE(root, render(diagnostics, false));
    const auto value = literal_from(*root->find("k")->find("a"), diagnostics);
    REQUIRE(value);
    CHECK(value->kind == Literal::Kind::text);
    CHECK(value->text == text);
  }
  Literal list;
  list.kind = Literal::Kind::list;
  list.items = {Literal::of(0.1), Literal::of(true), Literal::of("no"), Literal()};
  CHECK(yaml_text(list) == "[0.1, true, \"no\", ~]");
}

TEST_CASE("templates write: chains, straight to the last bit or by steps") {
  const tags::TaggedSkeleton straight = placed(with_head(
      "joints:\n  - {name: tail, at: [0, 1, 0], chain: {count: 3, to: [0, 2, 0]}, local: t}\n"
      "  - {name: tip, parent: tail, at: [0, 3, 0]}\n"));
  CHECK(contains(written(straight), "chain: {count: 3, to: [0, 2, 0]}"));
  CHECK(dump_of(placed(written(straight))) == dump_of(straight));

  tags::TaggedSkeleton bent = straight;
  bent.joints[1].rest.translation = {0.1, 0.2, 0.3};
  bent.joints[1].rest.rotation = math::from_euler_degrees({0, 90, 0});
  bent.joints[2].rest = {};
  const std::string text = written(bent);
  CHECK(contains(text,
                 "    chain:\n      count: 3\n      steps:\n        - translate: [0.1, 0.2, 0.3]\n"
                 "          rotate: [0, 90, 0]\n        - {}\n"));
  CHECK(dump_of(placed(text)) == dump_of(bent));
  CHECK(written(placed(text)) == text);
}

TEST_CASE("templates write: a quaternion of length 1 stays as it is written") {
  tags::TaggedSkeleton skeleton = placed(with_head("joints:\n  - {name: a}\n"));
  const math::Quat turn = math::normalised(math::Quat{0.1, -0.7, 0.3, 0.2});
  for (int i = 0; i < 200; ++i) {
    skeleton.joints[0].rest.rotation =
        math::normalised(math::axis_angle({0, 0.6, 0.8}, 0.01 * i) * turn);
    CHECK(placed(written(skeleton)).joints[0].rest.rotation == skeleton.joints[0].rest.rotation);
  }
}

TEST_CASE("templates write: sides that names do not say") {
  const tags::TaggedSkeleton skeleton =
      placed(with_head("joints:\n  - {name: hand_l, opposite: other}\n"
                       "  - {name: hand_r, opposite: ~}\n"
                       "  - {name: other, mirrored: true, opposite: hand_l}\n"
                       "  - {name: foot_l}\n  - {name: foot_r}\n"));
  const auto opposite = [&](std::size_t joint) { return skeleton.joints[joint].mirror.opposite; };
  CHECK(opposite(0) == skeleton.joints[2].key);
  CHECK(opposite(1) == JointKey{});
  CHECK(opposite(2) == skeleton.joints[0].key);
  CHECK(opposite(3) == skeleton.joints[4].key);
  CHECK(skeleton.joints[2].mirror.mirrored);
  const std::string text = written(skeleton);
  CHECK(contains(text, "opposite: other"));
  CHECK(contains(text, "name: hand_r\n    opposite: ~"));
  CHECK_FALSE(contains(text, "foot_l\n    opposite"));
  CHECK(dump_of(placed(text)) == dump_of(skeleton));
  CHECK(errors_of("  - {name: a, opposite: nobody}\n") == std::vector{225});
}

TEST_CASE("templates write: uids with earlier ones, commands with earlier holders") {
  const std::string text = with_head(
      "joints:\n  - name: a\n    uid: [00000000000000aa, 00000000000000bb]\n    tags:\n"
      "      - command: control\n        was: [00000000000000cc/main]\n");
  const tags::TaggedSkeleton skeleton = placed(text);
  CHECK(skeleton.joints[0].key == JointKey{0xaa, 0});
  CHECK(skeleton.joints[0].was == std::vector<JointKey>{{0xbb, 0}});
  CHECK(skeleton.joints[0].commands[0].was == std::vector<std::string>{"00000000000000cc/main"});
  CHECK(dump_of(placed(written(skeleton))) == dump_of(skeleton));
  CHECK(errors_of("  - {name: a, uid: []}\n") == std::vector{230});
  CHECK(errors_of("  - {name: a, uid: [00000000000000aa, 7]}\n") == std::vector{230});
}

TEST_CASE("templates write: steps that make no chain are errors") {
  CHECK(errors_of("  - {name: a, chain: {count: 2, to: [0, 1, 0], steps: [{}]}}\n").size() == 1);
  CHECK(errors_of("  - {name: a, chain: {count: 3, steps: [{}]}}\n").size() == 1);
  CHECK(errors_of("  - {name: a, chain: {count: 2, steps: {}}}\n").size() == 1);
  CHECK(errors_of("  - {name: a, chain: {count: 2, steps: [{at: [0, 1, 0]}]}}\n").size() == 1);
  CHECK(errors_of("  - {name: a, chain: {count: 2}}\n").size() == 1);
  CHECK(errors_of("  - {name: a, chain: {count: 2, steps: [{rotate: [0, 0, 0], quat: [0, 0, 0, "
                  "1]}]}}\n")
            .size() == 1);
}

TEST_CASE("templates write: arguments by the descriptor, modules by their versions") {
  tags::TaggedSkeleton skeleton = placed(
      with_head("joints:\n  - name: a\n    tags:\n"
                "      - {command: control, with: {shape: circle, size: 0.35}}\n"
                "      - {commands: [{command: control, id: b}]}\n"
                "      - {on: off, commands: [{command: control, id: c, comment: 'off: now'}]}\n"));
  const std::string text = written(skeleton);
  CHECK(contains(text,
                 "- command: control\n        with: {size: 0.35}\n      - command: control\n"
                 "        id: b\n      - on: false\n        commands:\n"
                 "          - command: control\n            id: c\n"
                 "            comment: \"off: now\"\n"));
  WriteOptions options;
  options.name = "case";
  options.modules = {{"control", catalogue().find("control")->version}};
  CHECK_FALSE(contains(write(skeleton, catalogue(), options), "modules:"));
  options.modules[0].second -= 1;
  CHECK(contains(write(skeleton, catalogue(), options), "modules: {control: "));
  options.name = "fork";
  options.version = 4;
  options.comments = {"one", "two"};
  CHECK(
      write(skeleton, catalogue(), options)
          .starts_with("# one\n# two\nrigc: 1\nname: fork\nwas: case\nversion: 4\nglobal: case\n"));
}

TEST_CASE("templates write: hostile parents end") {
  tags::TaggedSkeleton skeleton =
      placed(with_head("joints:\n  - {name: a}\n  - {name: b, parent: a}\n"));
  skeleton.joints[0].template_parent = skeleton.joints[1].key;
  skeleton.joints[1].name = "no name: at\nall";
  const auto joints = written_joints(skeleton, {});
  REQUIRE(joints.size() == 2);
  CHECK(joints[0].parent == -1);
  CHECK(placed(written(skeleton)).joints.size() == 2);
}

}  // namespace rigc::templates
