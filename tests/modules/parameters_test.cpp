// SPDX-License-Identifier: MIT
// Arguments become typed parameters: every type, defaults, pins, optional selectors, expressions.
#include "modules/parameters.h"

#include <doctest/doctest.h>

#include "support/rig.h"
#include "traversal/codes.h"

using namespace rigc;
using catalog::ParameterType;
using math::Vec3;

namespace {

const std::string kScene = test::template_of(R"(joints:
  - name: base
    at: [0, 0, 0]
    local: base
    label: base
    tags: [{command: control, with: {}}]
  - {name: tip, parent: base, at: [0, 1, 0], local: base, label: tip}
)");

Literal list(std::initializer_list<Literal> items) {
  Literal out;
  out.kind = Literal::Kind::list;
  out.items = items;
  return out;
}

/// One parameter of one command, bound in the scene above.
struct Binding {
  test::Rig rig{kScene};
  Diagnostics diagnostics;
  catalog::Parameter parameter;
  tags::CommandTag command;
  catalog::Descriptor descriptor;
  double unit = 1;

  explicit Binding(ParameterType type) {
    REQUIRE(rig.clean());
    parameter.name = "p";
    parameter.type = type;
  }
  Binding& with(Literal value) {
    command.with.push_back({"p", {}, std::move(value)});
    return *this;
  }
  std::optional<std::variant<modules::Parameters, modules::Skipped>> bind() {
    descriptor.parameters = {parameter};
    const traversal::Context context{
        rig.scene(), rig.index(), rig.skeleton.global, rig.node("base.base"), {}};
    return modules::bind(command, descriptor, unit, context, diagnostics);
  }
  modules::Parameters parameters() {
    auto bound = bind();
    INFO(test::text(diagnostics));
    REQUIRE(bound);
    REQUIRE(std::holds_alternative<modules::Parameters>(*bound));
    return std::get<modules::Parameters>(*bound);
  }
};

}  // namespace

TEST_CASE("modules parameters: numbers, flags, texts and vectors") {
  for (const auto type : {ParameterType::number, ParameterType::integer, ParameterType::angle}) {
    CHECK(Binding(type).with(Literal::of(3.0)).parameters().number("p") == 3);
  }
  CHECK(Binding(ParameterType::boolean).with(Literal::of(true)).parameters().flag("p"));
  for (const auto type : {ParameterType::text, ParameterType::enumeration}) {
    CHECK(Binding(type).with(Literal::of("circle")).parameters().text("p") == "circle");
  }
  const Literal vector = list({Literal::of(1.0), Literal::of(2.0), Literal::of(3.0)});
  CHECK(Binding(ParameterType::vec3).with(vector).parameters().vec3("p") == Vec3{1, 2, 3});
  CHECK(Binding(ParameterType::numbers).with(vector).parameters().numbers("p") ==
        std::vector<double>{1, 2, 3});
  CHECK(Binding(ParameterType::value).with(vector).parameters().literal("p") == vector);
}

TEST_CASE("modules parameters: lengths are in rig units, plain numbers are not") {
  Binding length(ParameterType::length);
  length.unit = 100;
  CHECK(length.with(Literal::of(0.5)).parameters().number("p") == 50);
  Binding number(ParameterType::number);
  number.unit = 100;
  CHECK(number.with(Literal::of(0.5)).parameters().number("p") == 0.5);
  const Literal vector = list({Literal::of(1.0), Literal::of(2.0), Literal::of(3.0)});
  Binding offset(ParameterType::vec3);
  offset.unit = 100;
  offset.parameter.unit = "metre";
  CHECK(offset.with(vector).parameters().vec3("p") == Vec3{100, 200, 300});
  Binding direction(ParameterType::vec3);
  direction.unit = 100;
  CHECK(direction.with(vector).parameters().vec3("p") == Vec3{1, 2, 3});
}

TEST_CASE("modules parameters: colours by name or by numbers") {
  CHECK(Binding(ParameterType::color).with(Literal::of("white")).parameters().vec3("p") ==
        Vec3{1, 1, 1});
  const Literal rgb = list({Literal::of(0.1), Literal::of(0.2), Literal::of(0.3)});
  CHECK(Binding(ParameterType::color).with(rgb).parameters().vec3("p") == Vec3{0.1, 0.2, 0.3});
  CHECK_FALSE(modules::color_from(Literal::of("no such colour")));
}

TEST_CASE("modules parameters: curves are flattened with their interpolations") {
  const Literal curve = list({list({Literal::of(0.0), Literal::of(1.0)}),
                              list({Literal::of(0.5), Literal::of(2.0), Literal::of("none")}),
                              list({Literal::of(0.7), Literal::of(2.5), Literal::of("smooth")}),
                              list({Literal::of(1.0), Literal::of(3.0), Literal::of("spline")})});
  CHECK(Binding(ParameterType::curve).with(curve).parameters().numbers("p") ==
        std::vector<double>{0, 1, 1, 0.5, 2, 0, 0.7, 2.5, 2, 1, 3, 3});
}

TEST_CASE("modules parameters: lists of texts, tables by rows") {
  const Literal names = list({Literal::of("low"), Literal::of("high")});
  CHECK(Binding(ParameterType::texts).with(names).parameters().texts("p") ==
        std::vector<std::string>{"low", "high"});
  CHECK(Binding(ParameterType::texts).with(Literal::of("low")).parameters().texts("p") ==
        std::vector<std::string>{"low"});
  const Literal rows = list(
      {list({Literal::of(1.0), Literal::of(2.0)}), list({Literal::of(3.0), Literal::of(4.0)})});
  CHECK(Binding(ParameterType::table).with(rows).parameters().table("p") ==
        std::vector<std::vector<double>>{{1, 2}, {3, 4}});
}

TEST_CASE("modules parameters: selectors become nodes and plugs") {
  Binding node(ParameterType::node);
  const auto one = node.with(Literal::of("./control")).parameters();
  CHECK(one.node("p") == node.rig.node("base.base/control"));
  Binding nodes(ParameterType::nodes);
  const auto several =
      nodes.with(list({Literal::of("base.tip"), Literal::of("base[*]")})).parameters();
  CHECK(several.nodes("p") == std::vector{nodes.rig.node("base.tip"), nodes.rig.node("base.base"),
                                          nodes.rig.node("base.tip")});
  Binding plug(ParameterType::plug);
  const auto bound = plug.with(Literal::of("./control@translate.x")).parameters();
  CHECK(bound.plug("p") == plug.rig.plug("base.base/control@translate.x"));
}

TEST_CASE("modules parameters: defaults count where nothing is written, and may be left out") {
  Binding number(ParameterType::number);
  number.parameter.default_value = Literal::of(7.0);
  CHECK(number.parameters().number("p") == 7);
  Binding optional(ParameterType::node);
  const auto left_out = optional.parameters();
  CHECK_FALSE(left_out.has("p"));
  CHECK_FALSE(left_out.node("p").valid());
  CHECK(left_out.nodes("p").empty());
  Binding self(ParameterType::node);
  self.parameter.default_value = Literal::of(".");
  CHECK(self.parameters().node("p") == self.rig.node("base.base"));
}

TEST_CASE("modules parameters: a required selector that is optional and empty skips the command") {
  Binding node(ParameterType::node);
  node.parameter.required = true;
  const auto bound = node.with(Literal::of("base.toe?")).bind();
  REQUIRE(bound);
  REQUIRE(std::holds_alternative<modules::Skipped>(*bound));
  CHECK(std::get<modules::Skipped>(*bound).parameter == "p");
  Binding optional(ParameterType::node);
  CHECK_FALSE(optional.with(Literal::of("base.toe?")).parameters().has("p"));
  Binding nodes(ParameterType::nodes);
  nodes.parameter.required = true;
  nodes.with(list({Literal::of("base.toe?"), Literal::of("base.tip")}));
  CHECK(nodes.parameters().nodes("p") == std::vector{nodes.rig.node("base.tip")});
}

TEST_CASE("modules parameters: an absent rig counts as left out, with a warning") {
  Binding node(ParameterType::node);
  CHECK_FALSE(node.with(Literal::of("sword:grip")).parameters().has("p"));
  CHECK(test::codes(node.diagnostics) == "RIG0426");
  Binding fallback(ParameterType::node);
  fallback.parameter.default_value = Literal::of(".");
  CHECK(fallback.with(Literal::of("sword:grip")).parameters().node("p") ==
        fallback.rig.node("base.base"));
}

TEST_CASE("modules parameters: one node means exactly one, of the right kind") {
  Binding several(ParameterType::node);
  CHECK_FALSE(several.with(Literal::of("base[*]")).bind());
  CHECK(test::codes(several.diagnostics) == "RIG0421");
  CHECK(several.diagnostics.all().front().hint.find("base.tip") != std::string::npos);
  Binding kind(ParameterType::node);
  kind.parameter.kind = "joint";
  CHECK_FALSE(kind.with(Literal::of("./control")).bind());
  CHECK(test::codes(kind.diagnostics) == "RIG0422");
  Binding right(ParameterType::nodes);
  right.parameter.kind = "joint";
  CHECK(right.with(Literal::of("base[*]")).parameters().nodes("p").size() == 2);
}

TEST_CASE("modules parameters: all wrong arguments of a command are reported at once") {
  Binding binding(ParameterType::node);
  binding.descriptor.parameters = {binding.parameter, binding.parameter};
  binding.descriptor.parameters[1].name = "q";
  binding.command.with = {{"p", {}, Literal::of("base.toe")}, {"q", {}, Literal::of("base[*]")}};
  const traversal::Context context{binding.rig.scene(),
                                   binding.rig.index(),
                                   binding.rig.skeleton.global,
                                   binding.rig.node("base.base"),
                                   {}};
  CHECK_FALSE(modules::bind(binding.command, binding.descriptor, 1, context, binding.diagnostics));
  CHECK(test::codes(binding.diagnostics) == "RIG0420 RIG0421");
}

TEST_CASE("modules parameters: expressions are cut at their braces") {
  Binding formula(ParameterType::expression);
  const auto bound =
      formula.with(Literal::of("{./control@translate.x} * 2 + {base.tip@rotate.y}")).parameters();
  CHECK(bound.expression("p").code == "$0 * 2 + $1");
  CHECK(bound.expression("p").plugs ==
        std::vector{formula.rig.plug("base.base/control@translate.x"),
                    formula.rig.plug("base.tip@rotate.y")});
  Binding number(ParameterType::expression);
  CHECK(number.with(Literal::of(2.5)).parameters().expression("p").code == "2.5");

  Binding vector(ParameterType::expression);
  CHECK_FALSE(vector.with(Literal::of("{./control@translate}")).bind());
  CHECK(test::codes(vector.diagnostics) == "RIG0424");
  Binding several(ParameterType::expression);
  CHECK_FALSE(several.with(Literal::of("{base[*]@translate.x}")).bind());
  CHECK(test::codes(several.diagnostics) == "RIG0421");
  Binding skipped(ParameterType::expression);
  const auto result = skipped.with(Literal::of("{base.toe@translate.x?} + 1")).bind();
  REQUIRE(result);
  CHECK(std::holds_alternative<modules::Skipped>(*result));
}
