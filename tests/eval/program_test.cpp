// SPDX-License-Identifier: MIT
// Programs: the listing, and that lanes and runs do not disturb each other.
#include "eval/program.h"

#include <doctest/doctest.h>

#include "tests/eval/scene_builder.h"
#include "tests/math/random.h"

namespace rigc {
namespace {

using math::Vec3;
using scene::NodeId;
using scene::Plug;
using test::SceneBuilder;
namespace transform = scene::transform;

TEST_CASE("eval program: the listing") {
  SceneBuilder b;
  const NodeId root = b.transform("root"), child = b.transform("child", root);
  b.edit.set({child, transform::kTranslate}, Vec3{0, 2, 0});
  const Plug half = b.formula("$0 / 2", {{root, transform::kTranslate, -1, 1}});
  Diagnostics diagnostics;
  const auto program = eval::compile(
      b.scene, {{{root, transform::kTranslate}}, {{child, transform::kWorld}, half}}, diagnostics);
  REQUIRE(program);
  CHECK(program->dump(b.scene) ==
        "rows 33\n"
        "input r0+3\n"
        "r0 = 0\nr1 = 0\nr2 = 0\n"
        "r3 = 0\nr4 = 0\nr5 = 0\nr6 = 1\n"
        "r7 = 2\n"
        "r21+12 = compose_rigid r0+3 r3+4  # transform root\n"
        "r8+12 = hang_straight r21+12 r21+12 [0 2 0]  # transform child\n"
        "r20 = divide r1 r7  # expression expression\n"
        "output r8+12\n"
        "output r20\n");
}

// A rig with one of each: hierarchy, constraint, aim, IK, chain, formula, remap.
struct Everything {
  SceneBuilder b;
  std::vector<Plug> inputs, outputs;

  Everything() {
    const NodeId root = b.transform("root"), goal = b.transform("goal", root),
                 pole = b.transform("pole", root);
    const NodeId start = b.make(scene::Kind::joint, "start", root),
                 middle = b.make(scene::Kind::joint, "middle", start);
    const NodeId end = b.make(scene::Kind::joint, "end", middle);
    for (const NodeId joint : {middle, end})
      b.edit.set({joint, transform::kTranslate}, Vec3{0, -1, 0.1});
    b.edit.set({pole, transform::kTranslate}, Vec3{0, -1, 3});
    const NodeId ik = b.make(scene::Kind::ik_two_bone, "ik");
    b.edit.connect({start, transform::kParent}, {ik, scene::ik2::kBase});
    b.edit.connect({goal, transform::kWorld}, {ik, scene::ik2::kGoal});
    b.edit.connect({pole, transform::kWorld}, {ik, scene::ik2::kPole});
    b.edit.connect({middle, transform::kTranslate}, {ik, scene::ik2::kMiddle});
    b.edit.connect({end, transform::kTranslate}, {ik, scene::ik2::kEnd});
    for (std::int32_t i = 0; i < 2; ++i) b.edit.set({ik, scene::ik2::kOffsets, i}, math::Quat{});
    const NodeId drive = b.make(scene::Kind::orient_constraint, "drive");
    b.edit.connect({start, transform::kParent}, {drive, scene::constraint::kParent});
    b.edit.connect({ik, scene::ik2::kStartWorld}, {drive, scene::constraint::kTargets, 0});
    b.edit.set({drive, scene::constraint::kWeights, 0}, 1.0);
    b.edit.set({drive, scene::constraint::kOffsets, 0}, math::Affine{});
    b.edit.connect({drive, scene::constraint::kRotation}, {start, transform::kRotation});
    const NodeId remap = b.make(scene::Kind::remap, "remap");
    b.edit.connect({goal, transform::kTranslate, -1, 1}, {remap, scene::remap::kInput});
    b.edit.set({remap, scene::remap::kPoints}, std::vector<double>{0, 0, 3, 0.5, 0.8, 2, 1, 1, 1});
    b.edit.connect(b.formula("$0 * sin($1 * 90)", {{remap, scene::remap::kOutput},
                                                   {goal, transform::kTranslate, -1, 0}}),
                   {end, transform::kRotate, -1, 2});
    const NodeId aim = b.make(scene::Kind::aim_constraint, "aim"), eye = b.transform("eye", root);
    b.edit.connect({eye, transform::kParent}, {aim, scene::aim::kParent});
    b.edit.connect({goal, transform::kWorld}, {aim, scene::aim::kTargets, 0});
    b.edit.set({aim, scene::aim::kWeights, 0}, 1.0);
    b.edit.set({aim, scene::aim::kUpVector}, Vec3{0, 1, 0});
    b.edit.connect({aim, scene::aim::kRotation}, {eye, transform::kRotation});
    const NodeId chain = b.make(scene::Kind::ik_chain, "chain");
    b.edit.connect({goal, transform::kWorld}, {chain, scene::ik_chain::kGoal});
    for (std::int32_t i = 0; i < 4; ++i) {
      b.edit.set({chain, scene::ik_chain::kTranslates, i}, Vec3{0, i == 0 ? 0.0 : 0.5, 0});
      b.edit.set({chain, scene::ik_chain::kRests, i}, math::axis_angle({1, 0, 0}, 0.2));
    }
    inputs = {
        {root, transform::kRotation}, {goal, transform::kTranslate}, {pole, transform::kTranslate}};
    outputs = {{end, transform::kWorld},
               {eye, transform::kWorld},
               {chain, scene::ik_chain::kRotations, 1}};
  }
};

struct Frame {
  math::Quat root;
  Vec3 goal, pole;
};

TEST_CASE(
    "eval program: a frame gives the same bits in any lane, beside anything, again and again") {
  const Everything rig;
  test::Random random(1);
  std::vector<Frame> frames;
  for (int i = 0; i < 37; ++i)
    frames.push_back({random.rotation(), random.vector(2), random.vector(3)});
  Diagnostics diagnostics;
  const auto program = eval::compile(rig.b.scene, {rig.inputs, rig.outputs}, diagnostics);
  REQUIRE(program);
  using Result = std::vector<double>;
  const auto run = [&](const std::vector<std::size_t>& order) {
    std::vector<Result> results(frames.size());
    eval::for_frames(
        *program, order.size(),
        [&](eval::Instance& instance, std::size_t i, int lane) {
          const Frame& f = frames[order[i]];
          const double root[] = {f.root.x, f.root.y, f.root.z, f.root.w};
          eval::set_lane(instance.input(0), lane, root, 4);
          const double goal[] = {f.goal.x, f.goal.y, f.goal.z};
          eval::set_lane(instance.input(1), lane, goal, 3);
          const double pole[] = {f.pole.x, f.pole.y, f.pole.z};
          eval::set_lane(instance.input(2), lane, pole, 3);
        },
        [&](const eval::Instance& instance, std::size_t i, int lane) {
          Result& result = results[order[i]];
          result.clear();
          for (std::size_t o = 0; o < 3; ++o) {
            double numbers[12] = {};
            eval::get_lane(instance.output(o), lane, numbers,
                           static_cast<int>(program->outputs[o].width));
            result.insert(result.end(), numbers, numbers + 12);
          }
        });
    return results;
  };
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < frames.size(); ++i) order.push_back(i);
  const auto forward = run(order);
  std::reverse(order.begin(), order.end());
  CHECK(run(order) == forward);
  order.insert(order.begin() + 3, 11);
  CHECK(run(order) == forward);
  for (std::size_t i = 0; i < frames.size(); ++i) CHECK(forward[i] == run({i})[i]);
}

TEST_CASE("eval program: compiling again gives the same listing") {
  const Everything one, two;
  Diagnostics diagnostics;
  const auto a = eval::compile(one.b.scene, {one.inputs, one.outputs}, diagnostics);
  const auto b = eval::compile(two.b.scene, {two.inputs, two.outputs}, diagnostics);
  REQUIRE((a && b));
  CHECK(a->dump(one.b.scene) == b->dump(two.b.scene));
}

TEST_CASE("eval program: inputs that are never set hold the scene's values") {
  SceneBuilder b;
  const NodeId node = b.transform("node");
  b.edit.set({node, transform::kTranslate}, Vec3{1, 2, 3});
  Diagnostics diagnostics;
  const auto program = eval::compile(
      b.scene,
      {{{node, transform::kTranslate}, {node, transform::kScale}}, {{node, transform::kWorld}}},
      diagnostics);
  REQUIRE(program);
  eval::Instance instance(*program);
  instance.run();
  for (int lane = 0; lane < eval::kLanes; ++lane) {
    CHECK(instance.output(0)[9 * eval::kLanes + lane] == 1);
    CHECK(instance.output(0)[11 * eval::kLanes + lane] == 3);
  }
}

}  // namespace
}  // namespace rigc
