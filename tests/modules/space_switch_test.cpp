// SPDX-License-Identifier: MIT
// space_switch: a hand that follows the body, the head or the world, as an animator says.
#include <doctest/doctest.h>

#include "support/models.h"

using namespace rigc;
using math::Affine;
using math::Vec3;

namespace {

/// A root, a body and a head that turn by themselves, and a hand under the body with the command.
std::string figure(const std::string& with) {
  return test::template_of(R"(joints:
  - {name: root, at: [0, 0, 0], local: f, label: root, tags: [{command: root, with: {}}]}
  - name: body
    parent: root
    at: [0, 1, 0]
    local: f
    label: body
    tags: [{command: control, with: {}}]
  - name: head
    parent: body
    at: [0, 1.5, 0]
    local: f
    label: head
    tags: [{command: control, with: {translate: off}}]
  - name: hand
    parent: body
    at: [0.6, 1.2, 0.1]
    local: f
    label: hand
    tags:
      - {command: control, with: {}}
      - command: space_switch
        with: {spaces: [f.root/root.world, f.head], names: [world, head], own: body)" +
                           with + "}\n");
}

const std::string kHand = "f.hand/control", kBody = "f.body/control", kHead = "f.head/control";

/// Where a thing that is fixed to `space` goes.
Affine carried(const test::Rig& rig, const test::Pose& pose, const std::string& space) {
  return pose.world(space) * math::inverse(rig.rest(space)) * rig.rest(kHand);
}

/// Body and head turned, moved, the hand touched.
test::Pose danced(const test::Rig& rig) {
  test::Pose pose(rig);
  pose.translate(kBody, {0.2, -0.3, 0.4}).rotate(kBody, {20, 50, -10}).rotate(kHead, {0, -30, 25});
  return pose;
}

double error(const Affine& a, const Affine& b) { return test::difference(a, b, 1); }

}  // namespace

TEST_CASE("modules space_switch: each number is a space, as if the control hung there") {
  const test::Rig rig(figure(""));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-12);
  const std::string spaces[] = {"f.body", "f.root", "f.head"};
  for (int i = 0; i < 3; ++i) {
    CAPTURE(i);
    test::Pose pose = danced(rig);
    pose.set(kHand + "@space", static_cast<double>(i));
    CHECK(error(pose.world(kHand), carried(rig, pose, spaces[i])) < 1e-12);
    CHECK(error(pose.world("f.hand"), pose.world(kHand)) < 1e-12);
    // What the animator keys comes on top.
    const Affine zero = pose.world(kHand);
    pose.translate(kHand, {0.1, 0, 0.2}).rotate(kHand, {0, 0, 30});
    const Affine keyed =
        math::compose({{0.1, 0, 0.2}, math::from_euler_degrees({0, 0, 30}), {1, 1, 1}});
    CHECK(error(pose.world(kHand), zero * keyed) < 1e-12);
  }
}

TEST_CASE("modules space_switch: numbers beyond the spaces count as the nearest") {
  const test::Rig rig(figure(""));
  const auto at = [&](double number) {
    test::Pose pose = danced(rig);
    return pose.set(kHand + "@space", number).world(kHand);
  };
  CHECK(error(at(-1), at(0)) < 1e-12);
  CHECK(error(at(7), at(2)) < 1e-12);
}

TEST_CASE("modules space_switch: which space counts at rest") {
  const test::Rig rig(figure(", default: head"));
  REQUIRE(rig.clean());
  const test::Pose pose = danced(rig);
  CHECK(error(pose.world(kHand), carried(rig, pose, "f.head")) < 1e-12);
}

TEST_CASE("modules space_switch: weights blend, and take over from the number") {
  const test::Rig rig(figure(""));
  const auto at = [&](double number, double world, double head) {
    test::Pose pose = danced(rig);
    pose.set(kHand + "@space", number).set(kHand + "@space_world", world);
    return pose.set(kHand + "@space_head", head).world(kHand).origin;
  };
  const test::Pose pose = danced(rig);
  const Vec3 body = carried(rig, pose, "f.body").origin,
             world = carried(rig, pose, "f.root").origin,
             head = carried(rig, pose, "f.head").origin;
  CHECK(test::distance(at(0, 0.25, 0), body * 0.75 + world * 0.25) < 1e-12);
  CHECK(test::distance(at(2, 0.25, 0), head * 0.75 + world * 0.25) < 1e-12);
  CHECK(test::distance(at(0, 0.5, 0.5), (world + head) * 0.5) < 1e-12);
  CHECK(test::distance(at(0, 1, 1), (world + head) * 0.5) < 1e-12);
  // Small steps of a weight are small steps of the hand.
  double most = 0;
  for (int i = 0; i < 200; ++i)
    most = std::max(most, test::distance(at(0, i / 200.0, 0), at(0, (i + 1) / 200.0, 0)));
  CHECK(most < 1.001 * test::distance(body, world) / 200);
}

TEST_CASE("modules space_switch: rotation alone, place alone, each by itself") {
  const test::Rig turns(figure(", translate: off"));
  REQUIRE(turns.clean());
  test::Pose pose = danced(turns);
  pose.set(kHand + "@space", 1.0);
  CHECK(test::distance(pose.world(kHand).origin, carried(turns, pose, "f.body").origin) < 1e-12);
  CHECK(error({pose.world(kHand).linear, {}}, {turns.rest(kHand).linear, {}}) < 1e-12);

  const test::Rig places(figure(", rotate: off"));
  test::Pose placed = danced(places);
  placed.set(kHand + "@space", 1.0);
  CHECK(test::distance(placed.world(kHand).origin, places.rest(kHand).origin) < 1e-12);
  CHECK(error({placed.world(kHand).linear, {}}, {placed.world("f.body").linear, {}}) < 1e-12);

  const test::Rig separate(figure(", separate: on"));
  REQUIRE(separate.clean());
  CHECK(test::rest_error(separate) < 1e-12);
  test::Pose both = danced(separate);
  both.set(kHand + "@space_translate", 1.0).set(kHand + "@space_rotate", 2.0);
  CHECK(test::distance(both.world(kHand).origin, separate.rest(kHand).origin) < 1e-12);
  CHECK(error({both.world(kHand).linear, {}}, {both.world("f.head").linear, {}}) < 1e-12);
}

// What a tool keys so that a switch keeps the pose.
TEST_CASE("modules space_switch: every pose has a key that keeps it in every space") {
  const test::Rig rig(figure(""));
  test::Pose before = danced(rig);
  before.translate(kHand, {0.1, 0.3, -0.2}).rotate(kHand, {40, 10, -70});
  for (double space = 0; space < 3; ++space) {
    test::Pose after = danced(rig);
    after.set(kHand + "@space", space);
    const math::Trs key =
        math::decompose(math::inverse(after.world("f.hand/control.zero")) * before.world(kHand));
    CHECK(test::distance(key.scale, {1, 1, 1}) < 1e-12);
    after.translate(kHand, key.translation).turn(kHand, key.rotation);
    CHECK(error(after.world("f.hand"), before.world("f.hand")) < 1e-12);
  }
}

TEST_CASE("modules space_switch: scaling the character scales the hand's way with it") {
  const test::Rig rig(figure(""));
  for (double space = 0; space < 3; ++space) {
    const auto at = [&](double size) {
      test::Pose pose = danced(rig);
      pose.set(kHand + "@space", space).set("f.root/root.world@master_scale", size);
      return pose.world(kHand);
    };
    const Affine once = at(1), twice = at(2);
    CHECK(test::distance(twice.origin, once.origin * 2.0) < 1e-12);
    CHECK(error({twice.linear, {}},
                {once.linear * math::Mat3{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, {}}) < 1e-12);
  }
}

TEST_CASE("modules space_switch: the same on every model") {
  const test::Rig plain(figure(""));
  const auto posed = [](const test::Rig& rig, const Affine& by, double space) {
    test::Pose pose(rig);
    pose.turn_in_world(kBody, test::mapped(by, math::from_euler_degrees({20, 50, -10})));
    pose.turn_in_world(kHead, test::mapped(by, math::from_euler_degrees({0, -30, 25})));
    pose.set(kHand + "@space", space);
    return test::motion(rig, pose);
  };
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(figure(""), model.change);
    for (double space = 0; space < 3; ++space) {
      CHECK(test::motion_difference(rig, posed(rig, model.by, space),
                                    test::mapped(model.by, posed(plain, {}, space))) < 1e-9);
    }
  }
}

TEST_CASE("modules space_switch: weights that only a tool reads") {
  const test::Rig rig(figure(", weights: off, attribute: follow"));
  REQUIRE(rig.clean());
  const auto& user = rig.scene()[rig.node(kHand)].user;
  REQUIRE(user.size() == 4);
  CHECK(user[0].name == "follow");
  CHECK(user[0].keyable);
  CHECK(user[1].name == "follow_body");
  CHECK_FALSE(user[1].keyable);
}

TEST_CASE("modules space_switch: the rig says which attributes switch what") {
  namespace at = scene::spaces;
  const test::Rig rig(figure(", separate: on, attribute: follow"));
  REQUIRE(rig.clean());
  const scene::Scene& scene = rig.scene();
  std::vector<std::string> numbers;
  for (const scene::NodeId id : scene.nodes()) {
    if (scene[id].kind != scene::Kind::spaces) continue;
    CHECK(scene.source({id, at::kControl})->node == rig.node(kHand));
    CHECK(std::get<std::string>(scene.value({id, at::kNames})) == "body world head");
    numbers.push_back(scene.plug_name(*scene.source({id, at::kNumber})));
    REQUIRE(scene[id].attributes[at::kShares].size() == 3);
    CHECK(scene.plug_name(*scene.source({id, at::kShares, 2})) == numbers.back() + "_head");
  }
  CHECK(numbers == std::vector<std::string>{"follow_translate", "follow_rotate"});
}

TEST_CASE("modules space_switch: names that do not fit, controls without a zero") {
  const auto codes = [](const std::string& with, const std::string& before = {}) {
    return test::codes(test::Rig(test::template_of(R"(joints:
  - {name: a, at: [0, 0, 0], local: f, label: a, tags: [{command: control, with: {}}]}
  - name: b
    at: [0, 1, 0]
    local: f
    label: b
    tags:
      - {command: control, with: {}}
)" + before + "      - {command: space_switch, with: {" +
                                                   with + "}}\n"))
                           .diagnostics);
  };
  CHECK(codes("spaces: f.a, names: [a, b]") == "RIG0870");
  CHECK(codes("spaces: [f.a, f.a/control], names: [a, a]") == "RIG0870");
  CHECK(codes("spaces: f.a, names: [9a]") == "RIG0870");
  CHECK(codes("spaces: f.a, names: [a], default: c") == "RIG0870");
  CHECK(codes("spaces: f.a, names: [a]",
              "      - {command: parent, with: {node: ./control, to: f.a/control}}\n") ==
        "RIG0871");
}
