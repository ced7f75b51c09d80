// SPDX-License-Identifier: MIT
// Where keys and values go, property by property, and what becomes of their numbers.
#include "update/remap.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "support/rig.h"

namespace rigc {
namespace {

using anim::Path;
using catalog::AttributeChange;
using update::Conversion;
using update::Destination;
using update::Property;

/// One control with an attribute; `more` are further commands of its joint.
std::string lamp(const std::string& attribute = "glow", const std::string& more = "",
                 const std::string& orient = "character") {
  return test::template_of(R"(joints:
  - name: base
    local: lamp
    label: base
    at: [0, 0, 0]
    orient: {aim: +x, toward: tip, up: +z}
    tags:
      - {command: control, with: {scale: on, orient: )" +
                           orient + R"(}}
      - {command: attribute, with: {attribute: )" +
                           attribute + "}}\n" + more +
                           R"(  - {name: tip, parent: base, at: [0, 1, 0]}
)");
}

const std::string kDriven = R"(      - {command: transform, id: t}
      - {command: connect, with: {from: "./transform#t@translate", to: "./control@translate"}}
      - {command: expression, with: {to: "./control@rotate.x", value: "1 + 2"}}
      - {command: expression, id: e, with: {to: "./control@glow", value: "1 + 2"}}
)";

/// The control's way from one rig to another.
struct Way {
  test::Rig old, fresh;
  std::vector<update::Source> sources;
  std::vector<std::optional<update::Match>> matches;
  update::Options options;
  std::optional<update::Remap> remap;
  std::size_t control = 0;

  Way(const std::string& from, const std::string& to, update::Options how = {})
      : old(from), fresh(to), options(std::move(how)) {
    REQUIRE_MESSAGE(old.listed(), test::text(old.diagnostics));
    REQUIRE_MESSAGE(fresh.listed(), test::text(fresh.diagnostics));
    REQUIRE_MESSAGE(old.diagnostics.ok(), test::text(old.diagnostics));
    REQUIRE_MESSAGE(fresh.diagnostics.ok(), test::text(fresh.diagnostics));
    sources = update::sources_of(old.scene());
    matches = update::match(sources, fresh.scene(), fresh.skeleton, test::catalogue());
    remap.emplace(sources, matches, old.scene(), fresh.scene(), options);
    while (sources[control].kind != scene::Kind::control) ++control;
  }
  Destination find(Path path, const std::string& attribute = "") const {
    return remap->find(control, {path, attribute});
  }
  std::string plug(const Destination& destination) const {
    return fresh.scene().plug_name(destination.plug);
  }
};

update::Options changes(const std::vector<AttributeChange>& list) {
  update::Options out;
  out.changes["control"] = list;
  return out;
}

anim::Curve curve_of(const std::vector<float>& values, anim::Interpolation interpolation) {
  anim::Curve curve;
  curve.interpolation = interpolation;
  curve.times = std::make_shared<const std::vector<float>>(std::vector<float>{0, 1});
  curve.values = values;
  return curve;
}

using Kind = Destination::Kind;

}  // namespace

TEST_CASE("remap: transforms and attributes go to the properties of the same name") {
  const Way way(lamp(), lamp());
  for (const Path path : {Path::translation, Path::rotation, Path::scale})
    CHECK(way.find(path).kind == Kind::property);
  CHECK(way.plug(way.find(Path::rotation)) == "rotation");
  const Destination glow = way.find(Path::attribute, "glow");
  CHECK(glow.kind == Kind::property);
  CHECK(glow.attribute == "glow");
  CHECK(glow.is_identity());
  CHECK(way.plug(glow) == "glow");
}

TEST_CASE("remap: an attribute that is gone has no destination, one of others stays with them") {
  const Way way(lamp(), lamp("shine"));
  CHECK(way.find(Path::attribute, "glow").kind == Kind::none);
  CHECK(way.find(Path::attribute, "studio_note").kind == Kind::foreign);
  CHECK(way.find(Path::weights).kind == Kind::foreign);
}

TEST_CASE("remap: a node that is gone has no destinations") {
  const Way way(lamp(), test::template_of("joints: [{name: other}]\n"));
  CHECK(way.find(Path::translation).kind == Kind::none);
  CHECK(way.find(Path::attribute, "glow").kind == Kind::none);
  CHECK(way.find(Path::attribute, "studio_note").kind == Kind::foreign);
}

TEST_CASE("remap: what the new rig drives has no room for keys, unless it had none before") {
  const Way way(lamp(), lamp("glow", kDriven));
  CHECK(way.find(Path::translation).kind == Kind::none);
  CHECK(way.find(Path::rotation).kind == Kind::none);
  CHECK(way.find(Path::scale).kind == Kind::property);
  CHECK(way.find(Path::attribute, "glow").kind == Kind::none);
  const Way same(lamp("glow", kDriven), lamp("glow", kDriven));
  CHECK(same.find(Path::translation).kind == Kind::property);
  CHECK(same.find(Path::rotation).kind == Kind::property);
  CHECK(same.find(Path::attribute, "glow").kind == Kind::property);
}

TEST_CASE("remap: an attribute that a newer module renamed, with another unit") {
  const Way way(lamp(), lamp("shine"), changes({{"glow", "shine", 100, 5}}));
  const Destination shine = way.find(Path::attribute, "glow");
  CHECK(shine.kind == Kind::property);
  CHECK(shine.attribute == "shine");
  const Property property{Path::attribute, "glow"};
  CHECK(update::changes_values(property, shine, Conversion()));
  CHECK(update::converted(2.0, property, shine, Conversion()) == scene::Value(205.0));
  anim::Curve linear = curve_of({1, 2}, anim::Interpolation::linear);
  CHECK(update::convert(linear, property, shine, Conversion()));
  CHECK(linear.values == std::vector<float>{105, 205});
  // Tangents are differences: they know no offset.
  anim::Curve cubic = curve_of({1, 2, 3, 4, 5, 6}, anim::Interpolation::cubic);
  CHECK(update::convert(cubic, property, shine, Conversion()));
  CHECK(cubic.values == std::vector<float>{100, 205, 300, 400, 505, 600});
}

TEST_CASE("remap: changes of several versions follow on one another") {
  const Way way(lamp(), lamp("shine"),
                changes({{"glow", "light", 10, 1}, {"light", "shine", 2, 3}}));
  const Destination shine = way.find(Path::attribute, "glow");
  CHECK(shine.attribute == "shine");
  // (x * 10 + 1) * 2 + 3
  CHECK(update::converted(1.0, {Path::attribute, "glow"}, shine, Conversion()) ==
        scene::Value(25.0));
}

TEST_CASE("remap: a control whose zero turned is converted, or not where that is declined") {
  const Way way(lamp(), lamp("glow", "", "joint"));
  CHECK(!way.remap->conversion(way.control).is_identity());
  const Property moved{Path::translation, {}};
  CHECK(update::changes_values(moved, way.find(Path::translation),
                               way.remap->conversion(way.control)));
  update::Options keep;
  keep.keep_local = true;
  const Way kept(lamp(), lamp("glow", "", "joint"), keep);
  CHECK(kept.remap->conversion(kept.control).is_identity());
  CHECK(Way(lamp(), lamp()).remap->conversion(way.control).is_identity());
}

TEST_CASE("remap: values without keys are converted as keys are") {
  update::Frame turned;
  turned.space = math::matrix(math::axis_angle({0, 0, 1}, math::kPi / 2));
  const Conversion right_angle({}, turned);
  turned.space = math::matrix(math::axis_angle({0, 0, 1}, 0.5));
  const Conversion oblique({}, turned);
  Destination there;
  there.kind = Kind::property;
  const Property translation{Path::translation, {}}, scale{Path::scale, {}},
      rotation{Path::rotation, {}};
  const scene::Value v = math::Vec3{1, 2, 3}, uniform = math::Vec3{2, 2, 2};
  CHECK(update::converted(v, translation, there, right_angle) ==
        scene::Value(math::Vec3{2, -1, 3}));
  CHECK(update::converted(v, scale, there, right_angle) == scene::Value(math::Vec3{2, 1, 3}));
  CHECK(update::converted(uniform, scale, there, oblique) == uniform);
  CHECK(!update::converted(v, scale, there, oblique));
  const math::Quat q{0.5, 0.5, 0.5, 0.5};
  CHECK(update::converted(q, rotation, there, right_angle) ==
        scene::Value(math::Quat{0.5, -0.5, 0.5, 0.5}));
  // An orphan keeps its numbers until it is back.
  CHECK(update::converted(v, translation, Destination(), right_angle) == v);
}

TEST_CASE("remap: values that go there and back are the same to the bit, whatever they were") {
  std::mt19937_64 random(3);
  const auto next = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  const auto vector = [&] {
    const double x = next(), y = next(), z = next();
    return math::Vec3{x, y, z};
  };
  const auto turn = [&] {
    const math::Vec3 axis = vector();
    return math::axis_angle(math::normalised(axis), 3 * next());
  };
  const auto frame = [&] {
    update::Frame out;
    out.space = math::matrix(turn());
    out.rest.translation = vector() * 50.0;
    out.rest.rotation = turn();
    return out;
  };
  Destination there;
  there.kind = Kind::property;
  const Property translation{Path::translation, {}}, rotation{Path::rotation, {}};
  for (int i = 0; i < 500; ++i) {
    const update::Frame a = frame(), b = frame();
    const Conversion to(a, b), from(b, a);
    const auto trip = [&](const scene::Value& value, const Property& property) {
      const auto away = update::converted(value, property, there, to);
      const auto back = update::converted(*away, property, there, from);
      CHECK(update::converted(*back, property, there, to) == away);
      CHECK(update::converted(*update::converted(*back, property, there, to), property, there,
                              from) == back);
      return *back;
    };
    const math::Vec3 v = vector() * 100.0;
    CHECK(math::length(std::get<math::Vec3>(trip(v, translation)) - v) < 1e-11);
    const auto single = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    const math::Vec3 floats{single(v.x), single(v.y), single(v.z)};
    CHECK(trip(floats, translation) == scene::Value(floats));
    const math::Quat q = turn();
    CHECK(std::abs(math::dot(std::get<math::Quat>(trip(q, rotation)), q)) > 1 - 1e-14);
  }
}

}  // namespace rigc
