// SPDX-License-Identifier: MIT
// Worlds of driven transforms without their parent's space: the same as with it, and only where
// they may be.
#include <doctest/doctest.h>

#include <algorithm>

#include "eval/kernels/table.h"
#include "tests/eval/scene_builder.h"
#include "tests/math/random.h"

namespace rigc {
namespace {

using eval::Op;
using eval::Setting;
using math::Quat;
using math::Vec3;
using scene::Kind;
using scene::NodeId;
using test::Random;
using test::SceneBuilder;
namespace transform = scene::transform;
namespace constraint = scene::constraint;

// Two rotations of the way about are equally near where targets are a half turn apart; nearer to
// that than this is not compared.
constexpr double kAlmostHalfTurn = 1e-3;
// Largest difference from the general path, of the largest distance from the origin.
constexpr double kBound = 1e-14;

struct Choice {
  Kind kind = Kind::parent_constraint;
  int targets = 1;
  bool translate = false, scale = false;
};

// A transform that a constraint drives, under moving parents and with moving targets.
struct Driven {
  SceneBuilder b;
  NodeId root, parent, driven, child, node;
  std::vector<NodeId> targets;
  std::vector<Setting> settings;

  NodeId moving(const std::string& name, NodeId under, Random& random) {
    const NodeId id = b.transform(name, under);
    const double size = random.between(0.3, 3);
    b.edit.set({id, transform::kScale}, Vec3{size, size, size});
    settings.push_back({{id, transform::kTranslate}, random.vector(2)});
    settings.push_back({{id, transform::kRotation}, random.rotation()});
    return id;
  }

  Driven(const Choice& choice, Random& random) {
    root = moving("root", {}, random);
    parent = moving("parent", root, random);
    driven = b.make(Kind::joint, "driven", parent);
    child = b.make(Kind::joint, "child", driven);
    b.edit.set({driven, transform::kTranslate}, random.vector());
    b.edit.set({driven, transform::kScale}, random.trs(random.chance(50)).scale);
    b.edit.set({child, transform::kTranslate}, random.vector());
    node = b.make(choice.kind, "constraint");
    b.edit.connect({driven, transform::kParent}, {node, constraint::kParent});
    for (std::int32_t i = 0; i < choice.targets; ++i) add_target(i, choice, random);
    b.edit.connect({node, constraint::kRotation}, {driven, transform::kRotation});
    if (choice.translate)
      b.edit.connect({node, constraint::kTranslate}, {driven, transform::kTranslate});
    if (choice.scale) b.edit.connect({node, constraint::kScale}, {driven, transform::kScale});
  }

  void add_target(std::int32_t i, const Choice& choice, Random& random) {
    const NodeId target = moving("target", random.chance(50) ? root : parent, random);
    targets.push_back(target);
    b.edit.connect({target, transform::kWorld}, {node, constraint::kTargets, i});
    math::Trs offset = random.trs(choice.targets > 1 || random.chance(50));
    if (choice.targets > 1) offset.scale = size_for(target);
    if (choice.targets == 1 && random.chance(30)) offset.scale.z *= -1;
    b.edit.set({node, constraint::kOffsets, i}, math::compose(offset));
    b.edit.set({node, constraint::kWeights, i}, 1.0);
    if (choice.targets > 1)
      settings.push_back({{node, constraint::kWeights, i}, random.between(-0.5, 2)});
  }

  // What makes the driven one as large as the world's unit.
  Vec3 size_for(NodeId target) const {
    const double size = math::length(b.scene.rest_world(target).linear.x);
    return {1 / size, 1 / size, 1 / size};
  }

  std::vector<scene::Plug> worlds() const {
    return {{driven, transform::kWorld}, {child, transform::kWorld}};
  }

  eval::Program program(const std::vector<Setting>& with) const {
    eval::Request request;
    for (const Setting& setting : with) request.inputs.push_back(setting.plug);
    request.outputs = worlds();
    Diagnostics diagnostics;
    const auto compiled = eval::compile(b.scene, request, diagnostics);
    REQUIRE(compiled);
    return *compiled;
  }

  // An animated scale, even one that stays what it is, leaves only the general way.
  std::vector<Setting> generally() const {
    std::vector<Setting> with = settings;
    with.push_back({{root, transform::kScale}, b.scene.value({root, transform::kScale})});
    return with;
  }

  math::Affine world(const std::vector<Setting>& with, std::size_t i = 0) const {
    Diagnostics diagnostics;
    const auto values = eval::evaluate(b.scene, worlds(), with, diagnostics);
    REQUIRE(values);
    return std::get<math::Affine>((*values)[i]);
  }
};

bool has(const eval::Program& program, Op op) {
  return std::ranges::any_of(program.instructions, [&](const auto& i) { return i.op == op; });
}

// Largest difference of both worlds on the two ways, of their size.
double difference(const Driven& rig) {
  double most = 0;
  for (const std::size_t i : {0u, 1u}) {
    const math::Affine direct = rig.world(rig.settings, i), other = rig.world(rig.generally(), i);
    const double size = 1 + math::length(other.origin) + math::length(other.linear.x) +
                        math::length(other.linear.y) + math::length(other.linear.z);
    most = std::max(most, test::distance(direct, other) / size);
  }
  return most;
}

// Whether two targets are so nearly a half turn apart that rounding decides.
bool half_turn(const Driven& rig) {
  std::vector<Quat> rotations;
  for (std::size_t i = 0; i < rig.targets.size(); ++i) {
    const auto world = eval::worlds(rig.b.scene, {rig.targets[i]}, rig.settings)[0];
    const auto offset = std::get<math::Affine>(
        rig.b.scene.value({rig.node, constraint::kOffsets, static_cast<std::int32_t>(i)}));
    rotations.push_back(math::decompose(world * offset).rotation);
  }
  for (const Quat& a : rotations) {
    for (const Quat& b : rotations) {
      if (std::fabs(math::dot(a, b)) < kAlmostHalfTurn) return true;
    }
  }
  return false;
}

TEST_CASE("eval direct: one target gives the worlds that the general way gives") {
  Random random(1);
  double most = 0;
  for (int i = 0; i < 400; ++i) {
    const Driven rig({random.chance(50) ? Kind::parent_constraint : Kind::orient_constraint, 1,
                      random.chance(50), random.chance(50)},
                     random);
    const eval::Program direct = rig.program(rig.settings);
    CHECK(!has(direct, Op::constraint));
    CHECK(has(rig.program(rig.generally()), Op::constraint));
    most = std::max(most, difference(rig));
  }
  MESSAGE("largest difference: ", most);
  CHECK(most < kBound);
}

TEST_CASE("eval direct: several weighted targets, weights below 0 and all of them") {
  Random random(2);
  double most = 0;
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    const int count = 2 + static_cast<int>(random.below(3));
    const Driven rig({Kind::parent_constraint, count, random.chance(50), random.chance(30)},
                     random);
    if (half_turn(rig)) continue;
    ++compared;
    CHECK(has(rig.program(rig.settings), Op::blend));
    CHECK(!has(rig.program(rig.settings), Op::constraint));
    most = std::max(most, difference(rig));
    Driven none = rig;
    for (Setting& setting : none.settings) {
      if (setting.plug.node == none.node) setting.value = random.chance(50) ? 0.0 : -1.0;
    }
    most = std::max(most, difference(none));
  }
  MESSAGE("largest difference: ", most, " in ", compared);
  CHECK(compared > 350);  // a mean of two may still be a half turn from the third
  CHECK(most < kBound);
}

TEST_CASE("eval direct: opposite targets give a rotation, whichever way round") {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    Driven rig({Kind::orient_constraint, 2, false, false}, random);
    const auto offset = [&](std::int32_t k) -> scene::Plug {
      return {rig.node, constraint::kOffsets, k};
    };
    // The second is the first, half a turn about any axis.
    rig.b.edit.connect({rig.targets[0], transform::kWorld}, {rig.node, constraint::kTargets, 1});
    const auto first = std::get<math::Affine>(rig.b.scene.value(offset(0)));
    const Vec3 axis = random.direction();
    rig.b.edit.set(offset(1), math::rotation({axis.x, axis.y, axis.z, 0}) * first);
    const math::Affine world = rig.world(rig.settings);
    const double size = math::length(rig.b.scene.rest_world(rig.parent).linear.x);
    const auto local = std::get<Vec3>(rig.b.scene.value({rig.driven, transform::kScale}));
    CHECK(math::length(world.linear.x) == doctest::Approx(size * local.x));
    CHECK(std::fabs(math::dot(world.linear.x, world.linear.y)) < 1e-12 * size * size * 10);
  }
}

TEST_CASE("eval direct: constant weights leave out who has none") {
  Random random(4);
  Driven rig({Kind::orient_constraint, 3, false, false}, random);
  std::erase_if(rig.settings, [&](const Setting& s) { return s.plug.node == rig.node; });
  for (const int alone : {0, 1, 2}) {
    for (std::int32_t i = 0; i < 3; ++i)
      rig.b.edit.set({rig.node, constraint::kWeights, i}, i == alone ? 0.25 : 0.0);
    CHECK(!has(rig.program(rig.settings), Op::blend));
    CHECK(difference(rig) < kBound);
    const auto target =
        eval::worlds(rig.b.scene, {rig.targets[static_cast<std::size_t>(alone)]}, rig.settings)[0];
    const auto offset =
        std::get<math::Affine>(rig.b.scene.value({rig.node, constraint::kOffsets, alone}));
    CHECK(test::distance(math::decompose(rig.world(rig.settings)).rotation,
                         math::decompose(target * offset).rotation) < 1e-14);
  }
  for (std::int32_t i = 0; i < 3; ++i) rig.b.edit.set({rig.node, constraint::kWeights, i}, 0.0);
  CHECK(has(rig.program(rig.settings), Op::blend));
}

TEST_CASE("eval direct: uneven, mirrored and lost scales above take the general way") {
  Random random(5);
  for (const Vec3 scale : {Vec3{1, 2, 1}, Vec3{1, 1, -1}, Vec3{-1, -1, -1}, Vec3{0, 0, 0},
                           Vec3{1, 1, 1 + 1e-9}, Vec3{1e-40, 1e-40, 1e-40}}) {
    for (const bool of_target : {false, true}) {
      Driven rig({Kind::parent_constraint, 1, true, false}, random);
      rig.b.edit.set({of_target ? rig.targets[0] : rig.parent, transform::kScale}, scale);
      CHECK(has(rig.program(rig.settings), Op::constraint));
      CHECK(!has(rig.program(rig.settings), Op::blend));
    }
  }
  Driven flat({Kind::parent_constraint, 1, true, false}, random);
  flat.b.edit.set({flat.node, constraint::kOffsets, 0},
                  math::Affine{{{1, 0, 0}, {0, 1, 0}, {1, 0, 0}}, {}});
  CHECK(has(flat.program(flat.settings), Op::constraint));
}

TEST_CASE("eval direct: what comes between takes the general way") {
  Random random(6);
  const Choice choice{Kind::parent_constraint, 1, true, false};
  {
    Driven locked(choice, random);
    const NodeId limits = locked.b.make(Kind::limits, "limits");
    locked.b.edit.connect({locked.driven, transform::kWorld}, {limits, scene::limits::kNode});
    locked.b.edit.set({limits, scene::limits::kBounds}, std::vector<double>{3, 0, -10});
    locked.b.edit.set({limits, scene::limits::kOrder}, std::string("xyz"));
    CHECK(has(locked.program(locked.settings), Op::constraint));
  }
  {
    Driven part(choice, random);
    const scene::Plug x{part.driven, transform::kRotate, -1, 0};
    part.b.edit.connect({part.targets[0], transform::kTranslate, -1, 0}, x);
    CHECK(has(part.program(part.settings), Op::constraint));
  }
  {
    Driven elsewhere(choice, random);
    elsewhere.b.edit.connect({elsewhere.root, transform::kWorld},
                             {elsewhere.node, constraint::kParent});
    CHECK(has(elsewhere.program(elsewhere.settings), Op::constraint));
    CHECK(difference(elsewhere) < kBound);
  }
}

TEST_CASE("eval direct: the short way into the parent's space is the general one") {
  Random random(10);
  double most = 0;
  for (int i = 0; i < 300; ++i) {
    const int targets = 1 + static_cast<int>(random.below(3));
    Driven rig({Kind::parent_constraint, targets, true, true}, random);
    rig.b.edit.connect({rig.root, transform::kWorld}, {rig.node, constraint::kParent});
    CHECK(has(rig.program(rig.settings), Op::constraint));
    if (!half_turn(rig)) most = std::max(most, difference(rig));
  }
  CHECK(most < kBound);
}

TEST_CASE("eval direct: a driven transform of animated scale, between sizes that vary") {
  Random random(12);
  double most = 0;
  for (int i = 0; i < 200; ++i) {
    Driven rig({Kind::parent_constraint, 1, random.chance(50), false}, random);
    const NodeId size = rig.b.make(Kind::expression, "size");
    rig.b.edit.set({size, scene::expression::kCode}, std::string("clamp($0, 0.2, 4)"));
    const scene::Plug in{size, scene::expression::kInputs, 0};
    rig.b.edit.set(in, 1.0);
    rig.settings.push_back({in, random.between(0.1, 5)});
    const NodeId grown = random.chance(50) ? rig.parent : rig.targets[0];
    for (std::int8_t c = 0; c < 3; ++c)
      rig.b.edit.connect({size, scene::expression::kOutput}, {grown, transform::kScale, -1, c});
    if (random.chance(50))
      rig.settings.push_back({{rig.driven, transform::kScale}, random.trs(false).scale});
    CHECK(!has(rig.program(rig.settings), Op::constraint));
    most = std::max(most, difference(rig));
  }
  CHECK(most < kBound);
}

TEST_CASE("eval direct: between targets that weigh the same all the time") {
  Random random(11);
  double most = 0;
  for (int i = 0; i < 100; ++i) {
    Driven rig({Kind::point_constraint, 3, true, false}, random);
    rig.b.edit.disconnect({rig.driven, transform::kRotation});
    const NodeId turning = rig.b.make(Kind::orient_constraint, "turning");
    rig.b.edit.connect({rig.driven, transform::kParent}, {turning, constraint::kParent});
    rig.b.edit.connect({rig.root, transform::kWorld}, {turning, constraint::kTargets, 0});
    rig.b.edit.set({turning, constraint::kWeights, 0}, 1.0);
    rig.b.edit.set({turning, constraint::kOffsets, 0}, math::compose(random.trs()));
    if (random.chance(50))
      rig.b.edit.connect({turning, constraint::kRotation}, {rig.driven, transform::kRotation});
    const Vec3 aside = random.vector();
    for (std::int32_t k = 0; k < 3; ++k) {
      std::erase_if(rig.settings, [&](const Setting& setting) {
        return setting.plug == scene::Plug{rig.node, constraint::kWeights, k};
      });
      const double weight[] = {2, 1, 1}, times[] = {1, -1, -1};
      rig.b.edit.set({rig.node, constraint::kWeights, k}, weight[k]);
      rig.b.edit.set({rig.node, constraint::kOffsets, k}, math::translation(aside * times[k]));
    }
    CHECK(!has(rig.program(rig.settings), Op::constraint));
    most = std::max(most, difference(rig));
  }
  CHECK(most < kBound);
}

TEST_CASE("eval direct: a translate alone, moved or from a point constraint") {
  Random random(7);
  double most = 0;
  for (int i = 0; i < 100; ++i) {
    Driven rig(
        {random.chance(50) ? Kind::parent_constraint : Kind::point_constraint, 1, true, false},
        random);
    rig.b.edit.disconnect({rig.driven, transform::kRotation});
    if (rig.b.scene[rig.node].kind == Kind::point_constraint)
      rig.b.edit.set({rig.node, constraint::kOffsets, 0}, math::Affine{});
    rig.settings.push_back({{rig.driven, transform::kRotation}, random.rotation()});
    CHECK(!has(rig.program(rig.settings), Op::constraint));
    most = std::max(most, difference(rig));
  }
  Driven beside({Kind::point_constraint, 1, true, false}, random);
  beside.b.edit.disconnect({beside.driven, transform::kRotation});
  CHECK(has(beside.program(beside.settings), Op::constraint));
  CHECK(difference(beside) < kBound);
  // A translate that is animated while the rotation is driven.
  for (int i = 0; i < 100; ++i) {
    Driven rig({Kind::orient_constraint, 1, false, random.chance(50)}, random);
    rig.settings.push_back({{rig.driven, transform::kTranslate}, random.vector()});
    CHECK(!has(rig.program(rig.settings), Op::constraint));
    most = std::max(most, difference(rig));
  }
  CHECK(most < kBound);
}

TEST_CASE("eval direct: who asks for the constraint's own values gets them") {
  Random random(8);
  const Driven rig({Kind::parent_constraint, 1, true, true}, random);
  Diagnostics diagnostics;
  const auto values = eval::evaluate(rig.b.scene,
                                     {{rig.driven, transform::kTranslate},
                                      {rig.driven, transform::kRotation},
                                      {rig.driven, transform::kScale},
                                      {rig.driven, transform::kParent},
                                      {rig.driven, transform::kWorld}},
                                     rig.settings, diagnostics);
  REQUIRE(values);
  const math::Affine local = math::compose(
      {std::get<Vec3>((*values)[0]), std::get<Quat>((*values)[1]), std::get<Vec3>((*values)[2])});
  const auto parent = std::get<math::Affine>((*values)[3]);
  const auto world = std::get<math::Affine>((*values)[4]);
  CHECK(test::distance(parent * local, world) < kBound * 20);
}

TEST_CASE("eval direct: aim") {
  Random random(9);
  namespace aim = scene::aim;
  double most = 0;
  for (int i = 0; i < 300; ++i) {
    Driven rig({Kind::orient_constraint, 1, false, false}, random);
    rig.b.edit.disconnect({rig.driven, transform::kRotation});
    const NodeId node = rig.b.make(Kind::aim_constraint, "aim");
    const NodeId up = rig.moving("up", rig.root, random);
    const bool moved = random.chance(50);
    rig.b.edit.connect({rig.driven, transform::kParent}, {node, aim::kParent});
    rig.b.edit.connect({rig.driven, transform::kTranslate}, {node, aim::kPosition});
    rig.b.edit.connect({rig.targets[0], transform::kWorld}, {node, aim::kTargets, 0});
    rig.b.edit.set({node, aim::kWeights, 0}, 1.0);
    rig.b.edit.connect({up, transform::kWorld}, {node, aim::kUpTarget});
    rig.b.edit.set({node, aim::kUpMode}, static_cast<double>(random.below(3)));
    rig.b.edit.set({node, aim::kUpVector}, random.direction());
    rig.b.edit.set({node, aim::kOffset}, random.rotation());
    rig.b.edit.connect({node, aim::kRotation}, {rig.driven, transform::kRotation});
    if (moved) rig.settings.push_back({{rig.driven, transform::kTranslate}, random.vector()});
    CHECK(has(rig.program(rig.settings), Op::aim_world));
    CHECK(!has(rig.program(rig.settings), Op::aim));
    CHECK(has(rig.program(rig.generally()), Op::aim));
    most = std::max(most, difference(rig));
  }
  MESSAGE("largest difference: ", most);
  CHECK(most < kBound);
}

}  // namespace
}  // namespace rigc
