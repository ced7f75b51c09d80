// SPDX-License-Identifier: MIT
// Guides: what is read, what goes along with a moved joint, what stays, and what is written.
#include "templates/guides.h"

#include <doctest/doctest.h>

#include "templates/templates_helpers.h"

using namespace rigc;
using namespace rigc::templates;
using namespace rigc::templates::testing;
using math::Vec3;

namespace {

// Two arms with an orient rule, a hand that is a limb of its own, a chain, and a joint between two.
const std::string kCreature = with_head(R"(
joints:
  - {name: hips, at: [0, 1, 0], local: torso, label: hips}
  - {name: spine, parent: hips, at: [0, 1.1, 0], chain: {count: 4, to: [0, 1.4, 0]}, local: spine,
     orient: {aim: +y, up: +z}}
  - {name: arm_l, parent: spine, at: [0.2, 1.4, 0], local: arm_l, label: shoulder,
     orient: {aim: +y, up: +z}}
  - {name: elbow_l, parent: arm_l, at: [0.5, 1.4, -0.02], local: arm_l, label: elbow,
     orient: {aim: +y, up: +z, toward: wrist_l}}
  - {name: roll_l, parent: elbow_l, at: [0.65, 1.4, -0.01], local: arm_l, label: roll,
     guide: {between: [elbow_l, wrist_l], at: 0.6}}
  - {name: wrist_l, parent: elbow_l, at: [0.75, 1.4, 0], local: arm_l, label: wrist}
  - {name: hand_l, parent: wrist_l, translate: [0.1, 0, 0], local: hand_l, label: palm}
  - {name: arm_r, parent: spine, at: [-0.2, 1.4, 0], local: arm_r, label: shoulder}
  - {name: elbow_r, parent: arm_r, at: [-0.5, 1.4, -0.02], local: arm_r, label: elbow}
  - {name: wrist_r, parent: elbow_r, at: [-0.75, 1.4, 0], local: arm_r, label: wrist}
  - {name: tip, parent: hips, at: [0, 0.9, -0.1]}
)");

struct Case {
  Diagnostics diagnostics;
  std::optional<Expanded> expanded;
  std::optional<tags::TaggedSkeleton> before, after;
  std::optional<Guides> guides;
  std::optional<Moves> moves;

  explicit Case(const std::string& text, const std::string& creature = kCreature) {
    expanded = expand_text(creature, diagnostics);
    REQUIRE(expanded);
    before = place(*expanded, diagnostics);
    REQUIRE(before);
    const auto file = diagnostics.sources().add("guides.yaml", "guides: case\n" + text);
    guides = read_guides(file, catalogue(), diagnostics);
    if (!guides) return;
    const auto guided = find_moves(*guides, &*expanded, *before, diagnostics);
    if (!guided) return;
    moves = guided->places;
    after = moves->empty() ? before : place(*expanded, *before, *moves, diagnostics);
    if (after) add_control_edits(*guides, catalogue(), *after, diagnostics);
  }
  Vec3 way(const std::string& name) const {
    return after->world(joint_named(*after, name)).origin -
           before->world(joint_named(*before, name)).origin;
  }
  math::Affine world(const std::string& name) const {
    return after->world(joint_named(*after, name));
  }
};

bool near(Vec3 a, Vec3 b) { return length(a - b) < 1e-12; }

}  // namespace

TEST_CASE("templates guides: a moved joint goes there, its limb and the others stay") {
  const Case c("joints:\n  arm_l.elbow: [0.5, 1.43, -0.02]\n");
  INFO(render(c.diagnostics, false));
  REQUIRE(c.after);
  CHECK(near(c.way("elbow_l"), {0, 0.03, 0}));
  CHECK(near(c.way("wrist_l"), {}));
  CHECK(near(c.way("hand_l"), {}));
  CHECK(near(c.way("arm_l"), {}));
  CHECK(near(c.way("elbow_r"), {}));
  // What has nothing to do with it has the same bits.
  for (const char* name : {"hips", "spine_1", "spine_4", "arm_r", "elbow_r", "tip"})
    CHECK(c.after->joints[joint_named(*c.after, name)].rest ==
          c.before->joints[joint_named(*c.before, name)].rest);
}

TEST_CASE("templates guides: orientations follow the template's rules after a move") {
  const Case c("joints:\n  arm_l.elbow: [0.5, 1.43, -0.02]\n");
  REQUIRE(c.after);
  const Vec3 upper = normalised(c.world("elbow_l").origin - c.world("arm_l").origin);
  const Vec3 lower = normalised(c.world("wrist_l").origin - c.world("elbow_l").origin);
  CHECK(near(c.world("arm_l").linear.y, upper));
  CHECK(near(c.world("elbow_l").linear.y, lower));
  // The template with the elbow written there is the same skeleton.
  std::string moved = kCreature;
  moved.replace(moved.find("[0.5, 1.4, -0.02], local: arm_l"), 17, "[0.5, 1.43, -0.02]");
  moved.replace(moved.find("at: [0.65, 1.4, -0.01]"), 22, "at: [0.65, 1.412, -0.01]");
  Diagnostics diagnostics;
  const auto written = place_text(moved, diagnostics);
  REQUIRE(written);
  for (std::size_t i = 0; i < written->joints.size(); ++i) {
    CAPTURE(written->joints[i].name);
    if (written->joints[i].name == "hand_l") continue;  // `translate` turns with the wrist
    CHECK(near(written->world(i).origin, c.after->world(i).origin));
    CHECK(near(written->world(i).linear.x, c.after->world(i).linear.x));
  }
}

TEST_CASE("templates guides: the first joint of a limb takes the limb and what hangs on it along") {
  const Case c("joints:\n  arm_l.shoulder: [0.25, 1.45, 0]\n  arm_l.wrist: [0.75, 1.4, 0.1]\n");
  REQUIRE(c.after);
  const Vec3 way{0.05, 0.05, 0};
  CHECK(near(c.way("arm_l"), way));
  CHECK(near(c.way("elbow_l"), way));
  CHECK(near(c.way("wrist_l"), {0, 0, 0.1}));  // it was moved itself
  CHECK(near(c.way("hand_l"), {0, 0, 0.1}));   // hangs on the wrist
  CHECK(near(c.way("roll_l"), lerp(way, Vec3{0, 0, 0.1}, 0.6)));
  CHECK(near(c.way("spine_4"), {}));
  const Case all("joints:\n  torso.hips: [0, 1.2, 0]\n");
  REQUIRE(all.after);
  for (const tags::TaggedJoint& joint : all.after->joints) {
    CAPTURE(joint.name);
    CHECK(near(all.way(joint.name), {0, 0.2, 0}));
  }
}

TEST_CASE("templates guides: joints of a chain stay between its ends until they are moved") {
  const Case end("joints:\n  spine[3]: [0, 1.43, 0.3]\n");
  REQUIRE(end.after);
  CHECK(near(end.way("spine_1"), {}));
  CHECK(near(end.way("spine_2"), {0, 0.01, 0.1}));
  CHECK(near(end.way("spine_3"), {0, 0.02, 0.2}));
  CHECK(near(end.way("arm_l"), {0, 0.03, 0.3}));  // its limb hangs on the last one
  const Case own("joints:\n  spine[3]: [0, 1.43, 0.3]\n  spine[1]: [0, 1.2, -0.05]\n");
  REQUIRE(own.after);
  CHECK(near(own.way("spine_2"), {0, 0, -0.05}));
  CHECK(near(own.way("spine_3"), {0, 0.02, 0.2}));
}

TEST_CASE("templates guides: an edit of one side is the other's, unless that has its own") {
  const std::string left = "joints:\n  arm_l.elbow: [0.53, 1.43, 0]\n";
  const Case mirrored("mirror: left_to_right\n" + left);
  REQUIRE(mirrored.after);
  CHECK(near(mirrored.way("elbow_r"), {-0.03, 0.03, 0.02}));
  const Case other("mirror: right_to_left\n" + left);
  REQUIRE(other.after);
  CHECK(near(other.way("elbow_r"), {}));
  const Case either("mirror: x\n" + left);
  REQUIRE(either.after);
  CHECK(near(either.way("elbow_r"), {-0.03, 0.03, 0.02}));
  const Case own("mirror: both\n" + left + "  arm_r.elbow: [-0.5, 1.5, -0.02]\n");
  REQUIRE(own.after);
  CHECK(near(own.way("elbow_r"), {0, 0.1, 0}));
}

TEST_CASE("templates guides: what stands where it was fitted changes nothing") {
  Diagnostics diagnostics;
  const auto expanded = expand_text(kCreature, diagnostics);
  const auto placed = place(*expanded, diagnostics);
  const std::string text = guides_text(*placed, *expanded, nullptr, false, {}, diagnostics);
  const std::string body = text.substr(text.find("\njoints:"));
  const Case c(body);
  INFO(render(c.diagnostics, false));
  REQUIRE(c.moves);
  CHECK(c.moves->empty());
  CHECK(c.guides->joints.size() == placed->joints.size());
  CHECK(body.find("  spine[1]:       {at: [0, 1.2, 0], fitted: [0, 1.2, 0]}\n") !=
        std::string::npos);
  CHECK(body.find("  tip: ") != std::string::npos);
}

TEST_CASE("templates guides: writing again keeps what was moved and refreshes the rest") {
  Case c(
      "mirror: both\njoints:\n"
      "  arm_l.elbow: {at: [0.5, 1.43, -0.02], fitted: [0.5, 1.39, -0.02]}\n"
      "  arm_l.wrist: {at: [0.7, 1.4, 0], fitted: [0.7, 1.4, 0]}\n"
      "  gone.joint: [1, 2, 3]\n"
      "controls:\n  arm_l.wrist/control: {size: 1.5, color: [1, 0, 0]}\n");
  REQUIRE(c.guides);
  CHECK(numbers(c.diagnostics) == std::vector<int>{902});
  Diagnostics diagnostics(c.diagnostics.sources());
  const std::string text =
      guides_text(*c.before, *c.expanded, &*c.guides, true, {{"a.b/control", "box"}}, diagnostics);
  CHECK(numbers(diagnostics) == std::vector<int>{905});
  for (const char* line : {"units: centimetre\n", "mirror: both\n",
                           "  arm_l.elbow:    {at: [50, 143, -2], fitted: [50, 140, -2]}\n",
                           "  arm_l.wrist:    {at: [75, 140, 0], fitted: [75, 140, 0]}\n",
                           "  # gone: gone.joint: {at: [100, 200, 300]}\n",
                           "  arm_l.wrist/control: {size: 1.5, color: [1, 0, 0]}\n",
                           "  # a.b/control: {shape: box, size: 1}\n"}) {
    CAPTURE(line);
    CHECK_MESSAGE(text.find(line) != std::string::npos, text);
  }
  // What was written reads back and says the same.
  const auto again =
      read_guides(diagnostics.sources().add("again.yaml", text), catalogue(), diagnostics);
  REQUIRE(again);
  CHECK(guides_text(*c.before, *c.expanded, &*again, true, {{"a.b/control", "box"}},
                    diagnostics) != text);  // the comment of what is gone is written once
  CHECK(diagnostics.errors() == 0);
}

TEST_CASE("templates guides: edits of controls are commands, mirrored by the selector") {
  const Case c(
      "mirror: left_to_right\ncontrols:\n"
      "  arm_l.wrist/control: {shape: sphere}\n  arm_r.elbow/control: {size: 2}\n");
  INFO(render(c.diagnostics, false));
  REQUIRE(c.after);
  const auto commands = [&](const char* joint) {
    return c.after->joints[joint_named(*c.after, joint)].commands;
  };
  REQUIRE(commands("wrist_l").size() == 1);
  CHECK(commands("wrist_l")[0].module == "edit_shape");
  CHECK(commands("wrist_l")[0].find("control")->text == "arm_l.wrist/control?");
  REQUIRE(commands("wrist_r").size() == 1);
  CHECK(commands("wrist_r")[0].find("control")->text == "arm_r.wrist/control?");
  CHECK(commands("elbow_r").size() == 1);
  CHECK(commands("elbow_l").empty());
  // Another file's edits of the same controls, by whatever name, replace them; the others stay.
  tags::TaggedSkeleton skeleton = *c.after;
  const auto edit = [&](const std::string& text) {
    Diagnostics diagnostics;
    const auto file = diagnostics.sources().add("guides.yaml", "guides: case\n" + text);
    const auto guides = read_guides(file, catalogue(), diagnostics);
    REQUIRE(guides);
    const auto put_back = add_control_edits(*guides, catalogue(), skeleton, diagnostics);
    CHECK_MESSAGE(diagnostics.all().empty(), render(diagnostics, false));
    return put_back;
  };
  const auto edits = [&] {
    std::vector<std::string> out;
    for (const ControlEdit& one : control_edits(skeleton))
      for (const tags::Argument& argument : one.with)
        out.push_back(one.control + " " + argument.name);
    return out;
  };
  using Texts = std::vector<std::string>;
  CHECK(edit("controls:\n") == Texts{});
  CHECK(edits() == Texts{"arm_l.wrist/control shape", "arm_r.elbow/control size",
                         "arm_r.wrist/control shape"});
  CHECK(edit("controls:\n  arm_l[3]/control: {size: 3}\n") == Texts{});
  CHECK(edits() ==
        Texts{"arm_l.wrist/control size", "arm_r.elbow/control size", "arm_r.wrist/control shape"});
  CHECK(edit("controls:\n  arm_r.elbow/control: {}\n  leg_x.elbow/control: {}\n") ==
        Texts{"arm_r.elbow/control"});
  CHECK(edit("mirror: left_to_right\ncontrols:\n  arm_l.wrist/control: {}\n") ==
        Texts{"arm_l.wrist/control", "arm_r.wrist/control"});
  CHECK(edits() == Texts{});
}

TEST_CASE("templates guides: what cannot be meant is refused where it stands") {
  const std::pair<const char*, int> cases[] = {
      {"joints:\n  arm_l.elbw: [0, 1, 0]\n", 902},
      {"joints:\n  arm_l.elbow: [0, 1, 0]\n  arm_l[1]: [0, 1, 0]\n", 903},
      {"controls:\n  arm_l.wrist/control: {size: 2}\n  arm_l[3]/control: {size: 3}\n", 903},
      {"joints: [1]\n", 900},
      {"controls: 1\n", 900},
      {"controls:\n  arm_l.wrist: {size: 2}\n", 900},
      {"controls:\n  arm_l.wrist/control@roll: {size: 2}\n", 900},
      {"controls:\n  arm_x.wrist/control: {size: 2}\n", 902},
      {"controls:\n  arm_l.wrist/contrl: {size: 2}\n", 902},
  };
  for (const auto& [text, number] : cases) {
    const Case c(text);
    INFO(render(c.diagnostics, false));
    CHECK(numbers(c.diagnostics) == std::vector<int>{number});
    for (const Diagnostic& diagnostic : c.diagnostics.all()) CHECK(diagnostic.place.span.line > 1);
  }
  for (const char* text :
       {"joints:\n  arm_l.elbow: [0, nan, 0]\n", "joints:\n  arm_l.elbow: [0, 1]\n",
        "joints:\n  arm_l.elbow: {att: [0, 1, 0]}\n", "joints:\n  arm_l.elbow: high\n",
        "joints:\n  arm_l.elbow: {}\n", "mirror: up\n", "unit: metre\n",
        "joints:\n  arm_l.elbow: [0, 1, 0]\n  arm_l.elbow: [0, 1, 0]\n",
        "controls:\n  arm_l.wrist/control: {size: big}\n",
        "controls:\n  arm_l.wrist/control: {sise: 2}\n"}) {
    CAPTURE(text);
    const Case c(text);
    CHECK(c.diagnostics.errors() >= 1);
    CHECK_FALSE(c.after);
  }
}

TEST_CASE("templates guides: without the template joints turn with the bones that they lay along") {
  Case c("joints:\n  arm_l.elbow: [0.5, 1.43, -0.02]\n");
  REQUIRE(c.after);
  tags::TaggedSkeleton moved = *c.before;
  move_joints(moved, *c.moves);
  for (std::size_t i = 0; i < moved.joints.size(); ++i) {
    CAPTURE(moved.joints[i].name);
    CHECK(near(moved.world(i).origin, c.after->world(i).origin));
  }
  const auto along = [&](const char* joint, const char* child) {
    const math::Affine world = moved.world(joint_named(moved, joint));
    return dot(world.linear.y,
               normalised(moved.world(joint_named(moved, child)).origin - world.origin));
  };
  CHECK(along("arm_l", "elbow_l") == doctest::Approx(1).epsilon(1e-12));
  CHECK(along("elbow_l", "wrist_l") > 0.9999);  // it aims at its first child, which lies near
}

TEST_CASE("templates guides: a guide of the template lies between two placed joints") {
  const auto with = [](const std::string& guide) {
    return with_head(
        "joints:\n  - {name: a, at: [0, 0, 0]}\n  - {name: b, parent: a, at: [0, 1, 0], " + guide +
        "}\n  - {name: c, parent: a, at: [0, 2, 0]}\n");
  };
  const std::pair<const char*, int> cases[] = {{"guide: {between: [a, b]}", 906},
                                               {"guide: {between: [a]}", 906},
                                               {"guide: {between: [a, d]}", 225},
                                               {"guide: {between: [a, c], at: 2}", 222}};
  for (const auto& [guide, number] : cases) {
    Diagnostics diagnostics;
    CHECK_FALSE(expand_text(with(guide), diagnostics));
    INFO(render(diagnostics, false));
    CHECK(numbers(diagnostics) == std::vector<int>{number});
  }
}
