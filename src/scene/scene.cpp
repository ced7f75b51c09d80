// SPDX-License-Identifier: MIT
// Reading a scene: values, plugs by name, rest transforms. Test: tests/scene/scene_test.cpp
#include "scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>

#include "scene/formula.h"
#include "scene/storage.h"

namespace rigc::scene {

namespace {

constexpr std::string_view kComponents = "xyzw";

// `weights[2]` is attribute `weights`, element 2; nothing where brackets hold no number.
struct ElementName {
  std::string_view attribute;
  std::int32_t element = -1;
};

std::optional<ElementName> parse_element(std::string_view name) {
  const std::size_t open = name.find('[');
  if (open == std::string_view::npos) return ElementName{name, -1};
  if (name.back() != ']') return std::nullopt;
  const std::string_view digits = name.substr(open + 1, name.size() - open - 2);
  std::int32_t element = -1;
  const auto end = digits.data() + digits.size();
  const auto result = std::from_chars(digits.data(), end, element);
  if (result.ec != std::errc() || result.ptr != end || element < 0) return std::nullopt;
  return ElementName{name.substr(0, open), element};
}

std::optional<std::uint16_t> find_attribute(const Node& node, std::string_view name) {
  const auto attributes = spec(node.kind).attributes;
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    if (attributes[i].name == name) return static_cast<std::uint16_t>(i);
  }
  for (std::size_t i = 0; i < node.user.size(); ++i) {
    if (node.user[i].name == name) return static_cast<std::uint16_t>(kUserAttributes + i);
  }
  return std::nullopt;
}

/// What the program of a compute node gives.
std::vector<Formula::Named> outputs_of(const Node& node) {
  if (node.kind != Kind::compute || node.attributes[compute::kCode].empty()) return {};
  Diagnostics unheard;
  const auto program =
      parse_program(std::get<std::string>(node.attributes[compute::kCode][0]), {}, unheard);
  return program ? program->outputs : std::vector<Formula::Named>{};
}

/// An output by the name that the program gives it.
std::optional<Plug> find_output(const Node& node, NodeId id, std::string_view name) {
  for (const Formula::Named& output : outputs_of(node)) {
    if (output.name == name) return Plug{id, compute::output_of(output.type), output.element};
  }
  return std::nullopt;
}

}  // namespace

Value initial_value(const AttributeSpec& attribute) {
  switch (attribute.type) {
    case Type::number:
      return attribute.initial;
    case Type::vec3:
      return math::Vec3{attribute.initial, attribute.initial, attribute.initial};
    case Type::quat:
      return math::Quat{};
    case Type::matrix:
      return math::Affine{};
    case Type::text:
      return std::string{};
    case Type::numbers:
      break;
  }
  return std::vector<double>{};
}

double component(const Value& value, int index) {
  if (const auto* v = std::get_if<math::Vec3>(&value)) return (*v)[static_cast<std::size_t>(index)];
  const auto& q = std::get<math::Quat>(value);
  return index == 0 ? q.x : index == 1 ? q.y : index == 2 ? q.z : q.w;
}

void set_component(Value& value, int index, double number) {
  if (auto* v = std::get_if<math::Vec3>(&value)) {
    (*v)[static_cast<std::size_t>(index)] = number;
    return;
  }
  auto& q = std::get<math::Quat>(value);
  (index == 0 ? q.x : index == 1 ? q.y : index == 2 ? q.z : q.w) = number;
}

std::vector<NodeId> Scene::nodes() const {
  std::vector<NodeId> ids(nodes_.size());
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i].index = static_cast<std::uint32_t>(i);
  return ids;
}

Value Scene::value(const Plug& plug) const {
  assert(type(plug));
  const Node& node = (*this)[plug.node];
  if (plug.attribute >= kUserAttributes) return node.user[plug.attribute - kUserAttributes].value;
  const auto& stored = node.attributes[plug.attribute];
  const auto element = static_cast<std::size_t>(plug.element < 0 ? 0 : plug.element);
  if (element >= stored.size()) {
    const Value initial = initial_value(spec(node.kind).attributes[plug.attribute]);
    return plug.component < 0 ? initial : Value(component(initial, plug.component));
  }
  if (plug.component < 0) return stored[element];
  return component(stored[element], plug.component);
}

double Scene::number(const Plug& plug) const { return std::get<double>(value(plug)); }

std::optional<Plug> Scene::source(const Plug& plug) const {
  const auto& inputs = (*this)[plug.node].inputs;
  const auto found =
      std::lower_bound(inputs.begin(), inputs.end(), plug,
                       [](const Connection& c, const Plug& to) { return c.to < to; });
  if (found == inputs.end() || found->to != plug) return std::nullopt;
  return found->from;
}

std::optional<Type> Scene::type(const Plug& plug) const {
  if (plug.node.index >= nodes_.size()) return std::nullopt;
  const Node& node = (*this)[plug.node];
  if (plug.attribute >= kUserAttributes) {
    const bool exists = plug.attribute - kUserAttributes < static_cast<int>(node.user.size());
    if (!exists || plug.element >= 0 || plug.component >= 0) return std::nullopt;
    return Type::number;
  }
  const auto attributes = spec(node.kind).attributes;
  if (plug.attribute >= attributes.size()) return std::nullopt;
  const AttributeSpec& attribute = attributes[plug.attribute];
  if (attribute.array != (plug.element >= 0)) return std::nullopt;
  // One past the end is a plug too: setting or connecting it appends. Solvers have as many outputs
  // as they need.
  const auto count = static_cast<std::int32_t>(node.attributes[plug.attribute].size());
  if (attribute.array && attribute.role != Role::output && plug.element > count)
    return std::nullopt;
  if (plug.component < 0) return attribute.type;
  const int components = attribute.type == Type::vec3 ? 3 : attribute.type == Type::quat ? 4 : 0;
  if (plug.component >= components) return std::nullopt;
  return Type::number;
}

std::optional<Plug> Scene::find_plug(NodeId node, std::string_view attribute,
                                     std::string_view component_name) const {
  const auto name = parse_element(attribute);
  if (!name) return std::nullopt;
  auto found = find_output((*this)[node], node, attribute);
  if (const auto index = find_attribute((*this)[node], name->attribute); index && !found)
    found = Plug{node, *index, name->element, -1};
  if (!found) return std::nullopt;
  Plug plug = *found;
  if (!component_name.empty()) {
    const std::size_t at =
        component_name.size() == 1 ? kComponents.find(component_name[0]) : std::string_view::npos;
    if (at == std::string_view::npos) return std::nullopt;
    plug.component = static_cast<std::int8_t>(at);
  }
  if (!type(plug)) return std::nullopt;
  return plug;
}

std::vector<std::string> Scene::plug_names(NodeId id) const {
  const Node& node = (*this)[id];
  std::vector<std::string> names;
  const auto attributes = spec(node.kind).attributes;
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    if (!attributes[i].array) {
      names.emplace_back(attributes[i].name);
      continue;
    }
    for (std::size_t e = 0; e < node.attributes[i].size(); ++e) {
      names.push_back(fmt::format("{}[{}]", attributes[i].name, e));
    }
  }
  for (const UserAttribute& attribute : node.user) names.push_back(attribute.name);
  for (const Formula::Named& output : outputs_of(node)) names.push_back(output.name);
  return names;
}

std::string Scene::plug_name(const Plug& plug) const {
  const Node& node = (*this)[plug.node];
  std::string name = plug.attribute >= kUserAttributes
                         ? node.user[plug.attribute - kUserAttributes].name
                         : std::string(spec(node.kind).attributes[plug.attribute].name);
  if (plug.element >= 0) name += fmt::format("[{}]", plug.element);
  if (plug.component >= 0)
    name += fmt::format(".{}", kComponents[static_cast<std::size_t>(plug.component)]);
  return name;
}

Role Scene::role(const Plug& plug) const {
  if (plug.attribute >= kUserAttributes) return Role::input;
  return spec((*this)[plug.node].kind).attributes[plug.attribute].role;
}

math::Trs Scene::stored(NodeId id) const {
  const Node& node = (*this)[id];
  assert(spec(node.kind).is_transform);
  return {std::get<math::Vec3>(node.attributes[transform::kTranslate][0]),
          std::get<math::Quat>(node.attributes[transform::kRotation][0]),
          std::get<math::Vec3>(node.attributes[transform::kScale][0])};
}

math::Trs Scene::local(NodeId id) const {
  math::Trs trs = stored(id);
  trs.rotation = math::normalised(trs.rotation);
  return trs;
}

math::Affine Scene::rest_world(NodeId id) const {
  std::vector<NodeId> path;
  for (NodeId at = id; at.valid(); at = (*this)[at].parent) path.push_back(at);
  math::Affine world;
  for (auto at = path.rbegin(); at != path.rend(); ++at) {
    if (spec((*this)[*at].kind).is_transform) world = world * math::compose(stored(*at));
  }
  return world;
}

}  // namespace rigc::scene
