// SPDX-License-Identifier: MIT
// Splines: outputs rest where they rest, pass through controls, keep lengths, spread twist; what is
// defined where nothing is; no jumps; nodes that cannot be evaluated.
#include <doctest/doctest.h>

#include "eval/codes.h"
#include "tests/eval/sweep.h"

namespace rigc {
namespace {

using math::Affine;
using math::Quat;
using math::Vec3;
using scene::NodeId;
using scene::Plug;
using scene::Value;
using test::Random;
namespace at = scene::spline;
namespace transform = scene::transform;

/// Controls that rest where they are told, and outputs along the curve through them.
struct SplineScene : test::SceneBuilder {
  std::vector<NodeId> controls;
  NodeId base = transform("base"), spline = make(scene::Kind::spline, "spline");
  std::vector<Affine> places;

  SplineScene(const std::vector<Affine>& rests, const std::vector<double>& parameters,
              const std::vector<Affine>& outputs)
      : places(outputs) {
    edit.connect({base, transform::kWorld}, {spline, at::kBase});
    for (std::size_t i = 0; i < rests.size(); ++i) {
      const auto element = static_cast<std::int32_t>(i);
      controls.push_back(transform("control"));
      place(i, rests[i]);
      edit.connect({controls[i], transform::kWorld}, {spline, at::kControls, element});
      edit.set({spline, at::kRests, element}, rests[i]);
      edit.set({spline, at::kFollows, element}, 1.0);
    }
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      const auto element = static_cast<std::int32_t>(k);
      edit.set({spline, at::kParameters, element}, parameters[k]);
      edit.set({spline, at::kPlaces, element}, outputs[k]);
    }
  }

  void place(std::size_t i, const Affine& world) {
    const math::Trs trs = math::decompose(world);
    edit.set({controls[i], transform::kTranslate}, trs.translation);
    edit.set({controls[i], transform::kRotation}, trs.rotation);
    edit.set({controls[i], transform::kScale}, trs.scale);
  }
  void follow(double amount) {
    for (std::size_t i = 0; i < controls.size(); ++i)
      edit.set({spline, at::kFollows, static_cast<std::int32_t>(i)}, amount);
  }
  Plug world(std::size_t k) const { return {spline, at::kWorlds, static_cast<std::int32_t>(k)}; }
  Plug translate(std::size_t i) const { return {controls[i], transform::kTranslate}; }
  Plug rotate(std::size_t i) const { return {controls[i], transform::kRotate}; }

  std::vector<Affine> worlds() const {
    std::vector<Affine> found;
    for (std::size_t k = 0; k < places.size(); ++k)
      found.push_back(std::get<Affine>(value(world(k))));
    return found;
  }
  double error() const {
    double most = 0;
    const std::vector<Affine> now = worlds();
    for (std::size_t k = 0; k < now.size(); ++k)
      most = std::fmax(most, test::step_of(places[k], now[k]));
    return most;
  }
  test::Sweep sweep(const std::vector<Plug>& inputs) const {
    std::vector<Plug> outputs;
    for (std::size_t k = 0; k < places.size(); ++k) outputs.push_back(world(k));
    return {scene, inputs, outputs};
  }
};

/// Controls up the y axis, one a metre, with outputs at every half.
SplineScene tower(std::size_t controls, bool aims = false) {
  std::vector<Affine> rests, outputs;
  std::vector<double> parameters;
  for (std::size_t i = 0; i < controls; ++i)
    rests.push_back(math::translation({0, static_cast<double>(i), 0}));
  for (std::size_t k = 0; k < 2 * controls - 1; ++k) {
    parameters.push_back(static_cast<double>(k) / 2);
    outputs.push_back(math::translation({0, parameters.back(), 0}));
  }
  SplineScene made(rests, parameters, outputs);
  made.edit.set({made.spline, at::kAims}, aims ? 1.0 : 0.0);
  return made;
}

Quat turn_y(double degrees) { return math::from_euler_degrees({0, degrees, 0}); }
/// Of a frame about y, in degrees.
double angle_y(const Affine& world) {
  return math::degrees(math::atan2(world.linear.z.x, world.linear.z.z));
}

TEST_CASE("eval spline: worlds are the same whether or not somebody reads the length") {
  Random random(7);
  for (const bool aims : {false, true}) {
    SplineScene s = tower(4, aims);
    std::vector<eval::Setting> settings;
    for (std::size_t i = 0; i < s.controls.size(); ++i) {
      settings.push_back({s.translate(i), random.vector()});
      settings.push_back({{s.controls[i], transform::kRotation}, random.rotation()});
    }
    for (const double preserve : {0.0, 0.5}) {
      s.edit.set({s.spline, at::kPreserve}, preserve);
      std::vector<Plug> outputs;
      for (std::size_t k = 0; k < s.places.size(); ++k) outputs.push_back(s.world(k));
      Diagnostics diagnostics;
      const auto alone = eval::evaluate(s.scene, outputs, settings, diagnostics);
      outputs.push_back({s.spline, at::kLength});
      const auto measured = eval::evaluate(s.scene, outputs, settings, diagnostics);
      REQUIRE((alone && measured));
      CHECK(std::get<double>(measured->back()) > 1);
      for (std::size_t k = 0; k < alone->size(); ++k)
        CHECK(std::get<Affine>((*alone)[k]) == std::get<Affine>((*measured)[k]));
    }
  }
}

TEST_CASE("eval spline: at rest every output is where it rests, wherever that is") {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    std::vector<Affine> rests, outputs;
    std::vector<double> parameters;
    const std::size_t count = 2 + random.below(10);
    for (std::size_t k = 0; k < count; ++k) rests.push_back(math::compose(random.trs(false)));
    for (Affine& rest : rests) rest.linear = math::orthonormal(rest.linear);
    for (std::size_t k = 0; k < 1 + random.below(8); ++k) {
      parameters.push_back(random.between(parameters.empty() ? 0 : parameters.back(),
                                          static_cast<double>(count - 1)));
      outputs.push_back({math::matrix(random.rotation()), random.vector(2)});
    }
    SplineScene b(rests, parameters, outputs);
    b.edit.set({b.spline, at::kAims}, random.chance(50) ? 1.0 : 0.0);
    if (random.chance(50)) b.follow(random.between(0, 1));
    CHECK(b.error() < 1e-12);
    b.edit.set({b.spline, at::kPreserve}, random.between(0.1, 1));
    CHECK(b.error() < 1e-10);
    CHECK(b.number({b.spline, at::kStretch}) == doctest::Approx(1).epsilon(1e-13));
  }
}

TEST_CASE("eval spline: outputs at controls go with them") {
  Random random(2);
  SplineScene b = tower(4);
  for (int i = 0; i < 100; ++i) {
    for (std::size_t k = 0; k < 4; ++k)
      b.place(k, {math::matrix(random.rotation()), random.vector(2)});
    const auto now = b.worlds();
    for (std::size_t k = 0; k < 4; ++k) {
      const auto control = std::get<Affine>(b.value({b.controls[k], transform::kWorld}));
      CHECK(test::step_of(control, now[2 * k]) < 1e-11);
    }
  }
}

TEST_CASE("eval spline: moved, turned and scaled as a whole it moves as one") {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    SplineScene b = tower(3, i % 2 == 0);
    b.edit.set({b.spline, at::kPreserve}, random.chance(50) ? 1.0 : 0.0);
    const double size = random.between(0.01, 100);
    const Affine by = math::compose({random.vector(5), random.rotation(), {size, size, size}});
    b.edit.set({b.base, transform::kScale}, Vec3{size, size, size});
    for (std::size_t k = 0; k < 3; ++k)
      b.place(k, by * math::translation({0, static_cast<double>(k), 0}));
    const auto now = b.worlds();
    for (std::size_t k = 0; k < now.size(); ++k) {
      CHECK(test::distance(now[k].origin, by * b.places[k].origin) < 1e-12 * size);
      CHECK(test::step_of(Affine{now[k].linear, {}}, Affine{by.linear, {}}) < 1e-12 * size);
    }
    CHECK(b.number({b.spline, at::kStretch}) == doctest::Approx(1).epsilon(1e-12));
    CHECK(b.number({b.spline, at::kLength}) == doctest::Approx(2).epsilon(1e-12));
  }
}

TEST_CASE("eval spline: lengths are kept, stretched, or anything between") {
  SplineScene b = tower(3, true);
  b.place(2, math::compose({{1, 2.5, 0.5}, math::from_euler_degrees({20, 0, -40}), {1, 1, 1}}));
  for (const double preserve : {0.0, 0.25, 1.0}) {
    b.edit.set({b.spline, at::kPreserve}, preserve);
    const auto now = b.worlds();
    CHECK(test::distance(now[0].origin, {0, 0, 0}) < 1e-14);
    double longest = 0;
    for (std::size_t k = 1; k < now.size(); ++k) {
      const double length = math::length(now[k].origin - now[k - 1].origin);
      if (preserve == 1) CHECK(length == doctest::Approx(0.5).epsilon(1e-13));
      longest = std::fmax(longest, length);
      // An output points at the next one.
      const Vec3 along = now[k - 1].linear.y;
      CHECK(test::distance(now[k - 1].origin + along * length, now[k].origin) < 1e-13);
    }
    if (preserve == 0) {
      CHECK(test::distance(now.back().origin, {1, 2.5, 0.5}) < 1e-14);
      CHECK(longest > 0.6);
    }
  }
  CHECK(b.number({b.spline, at::kStretch}) > 1.2);
}

TEST_CASE("eval spline: it becomes no shorter and no longer than it may") {
  SplineScene b = tower(3);
  b.edit.set({b.spline, at::kLeast}, 0.9);
  b.edit.set({b.spline, at::kMost}, 1.25);
  const auto length_at = [&](double size) {
    for (const std::size_t k : {1u, 2u})
      b.place(k, math::translation({0, static_cast<double>(k) * size, 0}));
    return b.worlds().back().origin.y / 2;
  };
  for (const double free : {0.9, 0.95, 1.0, 1.1, 1.25})
    CHECK(length_at(free) == doctest::Approx(free).epsilon(1e-13));
  for (const double more : {1.3, 2.0, 50.0})
    CHECK(length_at(more) == doctest::Approx(1.25).epsilon(1e-12));
  for (const double less : {0.8, 0.1, 1e-6})
    CHECK(length_at(less) == doctest::Approx(0.9).epsilon(1e-12));
  b.edit.set({b.spline, at::kPreserve}, 0.5);
  CHECK(length_at(1.2) == doctest::Approx(1.1).epsilon(1e-12));
  CHECK(length_at(1.6) == doctest::Approx(1.25).epsilon(1e-12));
}

TEST_CASE("eval spline: kept lengths run on beyond the end of a curve that is too short") {
  SplineScene b = tower(3);
  b.edit.set({b.spline, at::kPreserve}, 1.0);
  b.place(1, math::translation({0, 0.5, 0}));
  b.place(2, math::translation({0, 1, 0}));
  const auto now = b.worlds();
  for (std::size_t k = 0; k < now.size(); ++k) CHECK(test::step_of(now[k], b.places[k]) < 1e-14);
  CHECK(b.number({b.spline, at::kStretch}) == doctest::Approx(0.5));
}

TEST_CASE("eval spline: twist between controls is spread evenly, up to nearly a half turn") {
  for (const double twist : {90.0, -120.0, 179.0}) {
    SplineScene b = tower(2);
    b.place(1, math::compose({{0, 1, 0}, turn_y(twist), {1, 1, 1}}));
    CHECK(angle_y(b.worlds()[1]) == doctest::Approx(twist / 2).epsilon(1e-9));
    CHECK(angle_y(b.worlds()[2]) == doctest::Approx(twist).epsilon(1e-9));
  }
  // The numbers have no such limit.
  SplineScene b = tower(3);
  for (const std::int32_t i : {0, 1, 2}) b.edit.set({b.spline, at::kTwists, i}, 300.0 * i);
  const auto now = b.worlds();
  CHECK(angle_y(now[1]) == doctest::Approx(150));
  CHECK(angle_y(now[2]) == doctest::Approx(-60));
  CHECK(angle_y(now[3]) == doctest::Approx(90));
}

TEST_CASE("eval spline: the curve leaves a control where that turns, or as its neighbours lie") {
  SplineScene b = tower(3);
  b.place(2, math::compose({{0, 2, 0}, math::from_euler_degrees({0, 0, -60}), {1, 1, 1}}));
  CHECK(b.worlds()[3].origin.x < -0.05);
  CHECK(math::length(b.worlds()[1].origin - Vec3{0, 0.5, 0}) < 1e-14);
  b.follow(0);
  CHECK(test::distance(b.worlds()[3].origin, {0, 1.5, 0}) < 1e-14);
  // Around a middle control that stands aside the curve is an arc: the same on both sides.
  b.place(2, math::translation({0, 2, 0}));
  b.place(1, math::translation({0.4, 1, 0}));
  const auto now = b.worlds();
  CHECK(test::distance(now[1].origin, {now[3].origin.x, 2 - now[3].origin.y, 0}) < 1e-14);
  CHECK(now[1].origin.x > 0.25);
}

TEST_CASE("eval spline: all controls in one place") {
  for (const double preserve : {0.0, 1.0}) {
    SplineScene b = tower(3);
    b.edit.set({b.spline, at::kPreserve}, preserve);
    for (const std::size_t k : {0u, 1u, 2u}) b.place(k, math::translation({1, 2, 3}));
    const auto now = b.worlds();
    for (std::size_t k = 0; k < now.size(); ++k) {
      // The direction is that of the controls, along which kept lengths run on.
      const Vec3 along{0, preserve * static_cast<double>(k) / 2, 0};
      CHECK(test::step_of(now[k], math::translation(Vec3{1, 2, 3} + along)) < 1e-14);
    }
    CHECK(b.number({b.spline, at::kLength}) == 0);
    CHECK(b.number({b.spline, at::kStretch}) == 0);
  }
}

TEST_CASE("eval spline: a base or controls without size") {
  SplineScene b = tower(3);
  b.edit.set({b.spline, at::kPreserve}, 1.0);
  b.edit.set({b.base, transform::kScale}, Vec3{0, 0, 0});
  for (const Affine& world : b.worlds()) CHECK(test::distance(world.origin, {}) < 1e-14);
  CHECK(b.number({b.spline, at::kStretch}) == 0);
  b.edit.set({b.base, transform::kScale}, Vec3{1, 1, 1});
  for (const std::size_t k : {0u, 1u, 2u})
    b.edit.set({b.controls[k], transform::kScale}, Vec3{0, 0, 0});
  CHECK(b.error() < 1e-14);
}

TEST_CASE("eval spline: controls that rest in one place leave the outputs where they rest") {
  const Affine place = math::translation({1, 1, 1});
  SplineScene b({place, place, place}, {0, 1.5}, {place, math::translation({1, 2, 1})});
  CHECK(b.error() < 1e-15);
  b.edit.set({b.spline, at::kPreserve}, 1.0);
  CHECK(b.error() < 1e-15);
  CHECK(b.number({b.spline, at::kStretch}) == 1);
}

TEST_CASE("eval continuity: spline, a control all around and through its neighbour") {
  for (const bool aims : {false, true}) {
    for (const double preserve : {0.0, 0.5, 1.0}) {
      SplineScene b = tower(4, aims);
      b.edit.set({b.spline, at::kPreserve}, preserve);
      test::check_steps(
          b.sweep({b.translate(3)}),
          [](double t) {
            return std::vector<Value>{Vec3{0, 2, 0} + test::on_circle(t) * 1.2};
          },
          [](double h) { return 60 * h; });
      // Past the control before it: the curve is as steep as it is short.
      test::check_steps(
          b.sweep({b.translate(3)}),
          [](double t) {
            return std::vector<Value>{Vec3{-0.3 + 0.6 * t, 2 + 0.02, 0}};
          },
          [](double h) { return 250 * h; });
    }
  }
}

TEST_CASE("eval continuity: spline, a control that turns, up to the half turn") {
  SplineScene b = tower(3);
  test::check_steps(
      b.sweep({b.rotate(1)}),
      [](double t) {
        return std::vector<Value>{Vec3{0, -175 + 350 * t, 0}};
      },
      [](double h) { return 8 * h * math::kPi; });
  test::check_steps(
      b.sweep({b.rotate(2)}),
      [](double t) {
        return std::vector<Value>{Vec3{0, 30, -170 + 340 * t}};
      },
      [](double h) { return 60 * h; });
}

TEST_CASE("eval spline: nodes that cannot be evaluated say why") {
  const auto error_of = [](const SplineScene& b) {
    Diagnostics diagnostics;
    REQUIRE(!eval::compile(b.scene, {{}, {b.world(0)}}, diagnostics));
    REQUIRE(diagnostics.errors() == 1);
    CHECK(diagnostics.all()[0].code == &eval::codes::kBadNode);
    return diagnostics.all()[0].message;
  };
  const auto says = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  {
    SplineScene b = tower(3);
    b.edit.set({b.spline, at::kParameters, 1}, 1.5);
    CHECK(says(error_of(b), "parameters do not rise"));
    b.edit.set({b.spline, at::kParameters, 1}, 0.5);
    b.edit.set({b.spline, at::kParameters, 4}, 2.5);
    CHECK(says(error_of(b), "parameters do not rise"));
    b.edit.set({b.spline, at::kParameters, 4}, 2.0);
    b.edit.set({b.spline, at::kTwists, 0}, 1.0);
    CHECK(says(error_of(b), "3 controls and 1 twists"));
  }
  {
    SplineScene b = tower(3);
    b.edit.set({b.spline, at::kParameters, 5}, 2.0);
    CHECK(says(error_of(b), "6 parameters and 5 places"));
    b.edit.set({b.spline, at::kRests, 3}, Affine{});
    CHECK(says(error_of(b), "3 controls, 4 of them at rest"));
  }
  CHECK(says(error_of(SplineScene({Affine{}}, {0}, {Affine{}})), "it has 1 controls, not 2 to 32"));
  CHECK(says(error_of(SplineScene({Affine{}, Affine{}}, {}, {})), "it has 0 outputs"));
}

}  // namespace
}  // namespace rigc
