// SPDX-License-Identifier: MIT
// Evaluating without ceremony, and values as numbers.
#include "eval/evaluate.h"

#include <doctest/doctest.h>

#include "eval/values.h"
#include "tests/eval/scene_builder.h"
#include "tests/math/random.h"

namespace rigc {
namespace {

using scene::Plug;
using test::SceneBuilder;
namespace transform = scene::transform;

TEST_CASE("eval values: numbers read back") {
  test::Random random(1);
  for (int i = 0; i < 50; ++i) {
    for (const scene::Value& value :
         {scene::Value(random.between(-1, 1)), scene::Value(random.vector()),
          scene::Value(random.rotation()), scene::Value(math::compose(random.trs(false)))}) {
      const std::vector<double> numbers = eval::numbers_of(value);
      CHECK(static_cast<int>(numbers.size()) == scene::width(scene::type_of(value)));
      CHECK(eval::value_from(scene::type_of(value), numbers.data()) == value);
    }
  }
  CHECK(eval::numbers_of(std::string("text")).empty());
  CHECK(eval::numbers_of(std::vector<double>{1, 2}).empty());
}

TEST_CASE("eval evaluate: several plugs of several types") {
  SceneBuilder b;
  const auto node = b.transform("node");
  b.edit.set({node, transform::kTranslate}, math::Vec3{1, 2, 3});
  Diagnostics diagnostics;
  const auto values =
      eval::evaluate(b.scene,
                     {{node, transform::kTranslate, -1, 2},
                      {node, transform::kTranslate},
                      {node, transform::kRotation},
                      {node, transform::kWorld}},
                     {{{node, transform::kScale}, math::Vec3{2, 2, 2}}}, diagnostics);
  REQUIRE(values);
  CHECK(std::get<double>((*values)[0]) == 3);
  CHECK(std::get<math::Vec3>((*values)[1]) == math::Vec3{1, 2, 3});
  CHECK(std::get<math::Quat>((*values)[2]) == math::Quat{});
  CHECK(std::get<math::Affine>((*values)[3]).linear.y == math::Vec3{0, 2, 0});
}

TEST_CASE("eval evaluate: an error gives nothing") {
  SceneBuilder b;
  const auto node = b.transform("node");
  b.edit.connect({node, transform::kScale}, {node, transform::kScale});
  Diagnostics diagnostics;
  CHECK(!eval::evaluate(b.scene, {{node, transform::kScale}}, {}, diagnostics));
  CHECK(diagnostics.errors() == 1);
  CHECK(eval::worlds(b.scene, {node}).empty());
}

TEST_CASE("eval evaluate: frames in blocks, the last one short") {
  SceneBuilder b;
  const auto node = b.transform("node");
  Diagnostics diagnostics;
  const auto program =
      eval::compile(b.scene,
                    {{{node, transform::kTranslate}},
                     {b.formula("$0 + 1", {{node, transform::kTranslate, -1, 0}})}},
                    diagnostics);
  REQUIRE(program);
  for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 23u}) {
    std::vector<double> got;
    eval::for_frames(
        *program, count,
        [](eval::Instance& i, std::size_t frame, int lane) {
          i.input(0)[lane] = static_cast<double>(frame);
        },
        [&](const eval::Instance& i, std::size_t frame, int lane) {
          CHECK(got.size() == frame);
          got.push_back(i.output(0)[lane]);
        });
    REQUIRE(got.size() == count);
    for (std::size_t i = 0; i < count; ++i) CHECK(got[i] == static_cast<double>(i) + 1);
  }
}

TEST_CASE("eval evaluate: ranges of frames over threads, each frame once and on its own lane") {
  SceneBuilder b;
  const auto node = b.transform("node");
  Diagnostics diagnostics;
  const auto program =
      eval::compile(b.scene,
                    {{{node, transform::kTranslate}},
                     {b.formula("$0 + 1", {{node, transform::kTranslate, -1, 0}})}},
                    diagnostics);
  REQUIRE(program);
  struct Worker {
    eval::Instance& instance;
    std::vector<double>& got;
    void set(std::size_t first, int lanes) {
      for (int lane = 0; lane < lanes; ++lane)
        instance.input(0)[lane] = static_cast<double>(first) + lane;
    }
    void take(std::size_t first, int lanes) {
      for (int lane = 0; lane < lanes; ++lane)
        got[first + static_cast<std::size_t>(lane)] += instance.output(0)[lane];
    }
  };
  for (const unsigned jobs : {1u, 3u})
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{7}, eval::kRange, eval::kRange + 1, 5 * eval::kRange - 3}) {
      Threads threads(jobs);
      std::vector<double> got(count, 0.0);
      eval::for_ranges(*program, count, threads, [&](eval::Instance& instance, std::size_t) {
        return Worker{instance, got};
      });
      for (std::size_t i = 0; i < count; ++i) CHECK(got[i] == static_cast<double>(i) + 1);
    }
}

TEST_CASE("eval evaluate: what no input reaches does not vary") {
  SceneBuilder b;
  const auto moved = b.transform("moved"), still = b.transform("still");
  const auto below = b.transform("below", moved);
  Diagnostics diagnostics;
  const auto program = eval::compile(b.scene,
                                     {{{moved, transform::kTranslate}},
                                      {{moved, transform::kTranslate},
                                       {moved, transform::kScale},
                                       {still, transform::kTranslate},
                                       {below, transform::kWorld}}},
                                     diagnostics);
  REQUIRE(program);
  CHECK(eval::varying_outputs(*program) == std::vector<bool>{true, false, false, true});
}

}  // namespace
}  // namespace rigc
