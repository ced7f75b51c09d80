// SPDX-License-Identifier: MIT
// Values of a scene node in RIGC_rig. Test: tests/gltf/rig_json_test.cpp
#include "gltf/rig_json_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/text.h"
#include "gltf/rig_codes.h"
#include "gltf/rig_json.h"
#include "gltf/rig_json_data.h"
#include "scene/storage.h"

namespace rigc::gltf {
namespace {

using scene::AttributeSpec;
using scene::NodeId;
using scene::Plug;
using scene::Type;
using scene::Value;

constexpr std::array<std::string_view, 4> kFlavours = {"number", "integer", "boolean", "angle"};
constexpr std::size_t kMostUser = 900;  // plugs number them in 16 bits from 1000; nobody needs more

/// Whether an attribute is stored: outputs are computed, and `rotate` is a view of `rotation`.
bool is_stored(const scene::KindSpec& kind, std::size_t attribute) {
  if (kind.attributes[attribute].role == scene::Role::output) return false;
  return !kind.is_transform || attribute != scene::transform::kRotate;
}

struct Write {
  json::Writer& writer;
  void operator()(double number) const { writer.value(number); }
  void operator()(const math::Vec3& v) const { writer.numbers(&v.x, 3); }
  void operator()(const math::Quat& q) const { writer.numbers(&q.x, 4); }
  void operator()(const std::string& text) const { writer.value(text); }
  void operator()(const std::vector<double>& list) const {
    writer.numbers(list.data(), list.size());
  }
  void operator()(const math::Affine& a) const {
    std::array<double, 12> n;
    std::size_t i = 0;
    for (const math::Vec3& v : {a.linear.x, a.linear.y, a.linear.z, a.origin})
      for (std::size_t c = 0; c < 3; ++c) n[i++] = v[c];
    writer.numbers(n.data(), n.size());
  }
};

/// In arrays `null` stands for the initial value: most matrices of solvers are connected.
void write_elements(json::Writer& writer, const AttributeSpec& attribute,
                    const std::vector<Value>& elements) {
  const Value initial = scene::initial_value(attribute);
  writer.begin_array();
  for (const Value& element : elements) {
    if (attribute.type != Type::number && element == initial)
      writer.null();
    else
      std::visit(Write{writer}, element);
  }
  writer.end_array();
}

void write_attributes(json::Writer& writer, const scene::Node& node) {
  const scene::KindSpec& kind = scene::spec(node.kind);
  bool open = false;
  for (std::size_t i = 0; i < kind.attributes.size(); ++i) {
    const AttributeSpec& attribute = kind.attributes[i];
    const std::vector<Value>& stored = node.attributes[i];
    if (!is_stored(kind, i)) continue;
    if (attribute.array ? stored.empty() : stored[0] == scene::initial_value(attribute)) continue;
    if (!open) writer.key("values").begin_object();
    open = true;
    writer.key(attribute.name);
    if (attribute.array)
      write_elements(writer, attribute, stored);
    else
      std::visit(Write{writer}, stored[0]);
  }
  if (open) writer.end_object();
}

void write_user(json::Writer& writer, const scene::Node& node) {
  if (node.user.empty()) return;
  writer.key("user").begin_array();
  for (const scene::UserAttribute& attribute : node.user) {
    writer.begin_object().member("name", attribute.name);
    writer.member("flavour", name_of(attribute.flavour)).member("value", attribute.value);
    writer.member("initial", attribute.initial);
    if (attribute.min) writer.member("min", *attribute.min);
    if (attribute.max) writer.member("max", *attribute.max);
    if (!attribute.keyable) writer.member("keyable", false);
    if (attribute.hidden) writer.member("hidden", true);
    writer.end_object();
  }
  writer.end_array();
}

std::optional<Value> read_value(const json::Value& value, JsonReader& reader, Type type) {
  const auto as = [&](auto out) -> std::optional<Value> {
    if (!reader.read(value, out)) return std::nullopt;
    return Value(std::move(out));
  };
  switch (type) {
    case Type::number:
      return as(0.0);
    case Type::vec3:
      return as(math::Vec3{});
    case Type::quat:
      return as(math::Quat{});
    case Type::matrix:
      return as(math::Affine{});
    case Type::text:
      return as(std::string{});
    case Type::numbers:
      break;
  }
  return as(std::vector<double>{});
}

void read_attribute(const json::Value& value, JsonReader& reader, SceneMaker& maker,
                    const Plug& plug, const AttributeSpec& attribute) {
  if (!attribute.array) {
    if (const auto read = read_value(value, reader, attribute.type)) maker.set(plug, *read);
    return;
  }
  if (!value.is_array())
    return reader.fail(codes::kRigValue, value, fmt::format("\"{}\" is a list", attribute.name));
  if (value.size() > kMostElements || !maker.takes_array(value.size()))
    return reader.fail(codes::kRigTooLarge, value,
                       fmt::format("\"{}\" has more than {} elements, or all arrays too many",
                                   attribute.name, kMostElements));
  if (!reader.spend(value, value.size())) return;
  Plug element = plug;
  element.element = 0;
  for (const json::Value& item : value.items()) {
    const auto read = item.kind() == json::ValueKind::null
                          ? std::optional<Value>(scene::initial_value(attribute))
                          : read_value(item, reader, attribute.type);
    if (!read) return;
    maker.set(element, *read);
    ++element.element;
  }
}

void read_user(const json::Value& item, JsonReader& reader, SceneMaker& maker, NodeId id) {
  scene::UserAttribute attribute;
  std::string flavour;
  reader.get(item, "name", attribute.name, Need::required);
  reader.get(item, "flavour", flavour, Need::required);
  reader.get(item, "value", attribute.value, Need::required);
  reader.get(item, "initial", attribute.initial, Need::required);
  double bound = 0;
  if (reader.get(item, "min", bound)) attribute.min = bound;
  if (reader.get(item, "max", bound)) attribute.max = bound;
  reader.get(item, "keyable", attribute.keyable);
  reader.get(item, "hidden", attribute.hidden);
  if (!reader.ok()) return;
  const auto known = parse_flavour(flavour);
  if (!known)
    return reader.fail(codes::kRigWord, item["flavour"],
                       fmt::format("attributes are number, integer, boolean or angle, not \"{}\"",
                                   printable(flavour)));
  attribute.flavour = *known;
  if (!is_name(attribute.name) || attribute.name == "rigc")
    return reader.fail(codes::kRigText, item["name"],
                       fmt::format("\"{}\" is no name of an attribute", printable(attribute.name)));
  if (maker.scene().find_plug(id, attribute.name))
    return reader.fail(codes::kRigDuplicate, item["name"],
                       fmt::format("the node has an attribute \"{}\" already", attribute.name));
  maker.add_attribute(id, std::move(attribute));
}

/// `weights[1]`, `translate.x`; names of attributes have no dots.
std::optional<Plug> find_plug(const scene::Scene& scene, NodeId id, std::string_view path) {
  const std::size_t dot = path.rfind('.');
  const auto plug = dot == std::string_view::npos
                        ? scene.find_plug(id, path)
                        : scene.find_plug(id, path.substr(0, dot), path.substr(dot + 1));
  if (!plug || (dot != std::string_view::npos && plug->component < 0)) return std::nullopt;
  return plug;
}

/// Whether a plug of an array names an element that is there: outputs have as many as are asked
/// for.
bool exists(const scene::Scene& scene, const Plug& plug) {
  if (plug.element < 0 || scene.role(plug) == scene::Role::output) return true;
  return static_cast<std::size_t>(plug.element) <
         scene[plug.node].attributes[plug.attribute].size();
}

void read_input(const json::Value& item, JsonReader& reader, SceneMaker& maker, NodeId id) {
  const scene::Scene& scene = maker.scene();
  const auto parts = item.items();
  std::string to_path, from_path;
  std::int64_t from_node = 0;
  if (parts.size() != 3)
    return reader.fail(codes::kRigType, item, "a connection is [to, node, from]");
  const auto last = static_cast<std::int64_t>(scene.size()) - 1;
  if (!reader.read(parts[0], to_path) || !reader.whole(parts[1], 0, last, from_node) ||
      !reader.read(parts[2], from_path))
    return;
  const auto to = find_plug(scene, id, to_path);
  const auto from = find_plug(scene, {static_cast<std::uint32_t>(from_node)}, from_path);
  if (!to || !exists(scene, *to) || scene.role(*to) != scene::Role::input)
    return reader.fail(codes::kRigConnection, parts[0],
                       fmt::format("the node has no input \"{}\"", printable(to_path)));
  if (!from)
    return reader.fail(
        codes::kRigConnection, parts[2],
        fmt::format("node {} has no attribute \"{}\"", from_node, printable(from_path)));
  if (scene.type(*to) != scene.type(*from))
    return reader.fail(codes::kRigConnection, item,
                       fmt::format("\"{}\" is a {}, \"{}\" a {}", printable(from_path),
                                   scene::name_of(*scene.type(*from)), printable(to_path),
                                   scene::name_of(*scene.type(*to))));
  if (scene.source(*to))
    return reader.fail(codes::kRigDuplicate, parts[0],
                       fmt::format("\"{}\" is connected twice", printable(to_path)));
  maker.connect(*from, *to);
}

}  // namespace

std::string_view name_of(scene::UserAttribute::Flavour flavour) {
  return kFlavours[static_cast<std::size_t>(flavour)];
}

std::optional<scene::UserAttribute::Flavour> parse_flavour(std::string_view name) {
  const auto found = std::find(kFlavours.begin(), kFlavours.end(), name);
  if (found == kFlavours.end()) return std::nullopt;
  return static_cast<scene::UserAttribute::Flavour>(found - kFlavours.begin());
}

void write_values(json::Writer& writer, const scene::Scene& scene, NodeId id) {
  const scene::Node& node = scene[id];
  write_attributes(writer, node);
  write_user(writer, node);
  if (node.inputs.empty()) return;
  writer.key("inputs").begin_array();
  for (const scene::Connection& connection : node.inputs) {
    writer.begin_array().value(scene.plug_name(connection.to));
    writer.value(connection.from.node.index).value(scene.plug_name(connection.from)).end_array();
  }
  writer.end_array();
}

void read_values(const json::Value& object, JsonReader& reader, SceneMaker& maker, NodeId id) {
  const scene::KindSpec& kind = scene::spec(maker.scene()[id].kind);
  for (const auto& [name, value] : reader.members(object, "values")) {
    std::size_t attribute = 0;
    while (attribute < kind.attributes.size() && kind.attributes[attribute].name != name)
      ++attribute;
    if (attribute == kind.attributes.size() || !is_stored(kind, attribute)) {
      reader.fail(codes::kRigWord, value,
                  fmt::format("a {} stores no \"{}\"", kind.name, printable(name)));
      continue;
    }
    const Plug plug{id, static_cast<std::uint16_t>(attribute)};
    read_attribute(value, reader, maker, plug, kind.attributes[attribute]);
  }
  check_data(object["values"], reader, maker.scene(), id);
  for (const json::Value& item : reader.objects(object, "user", kMostUser))
    read_user(item, reader, maker, id);
}

void read_inputs(const json::Value& object, JsonReader& reader, SceneMaker& maker, NodeId id) {
  for (const json::Value& item : reader.items(object, "inputs"))
    read_input(item, reader, maker, id);
}

}  // namespace rigc::gltf
