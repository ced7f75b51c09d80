// SPDX-License-Identifier: MIT
// The canonical text of a scene: nodes of the skeleton first, then by command, in the order made;
// what differs from the kind's defaults; nodes as ordinals of the dump.
// Test: tests/scene/dump_test.cpp
#include <algorithm>

#include <fmt/format.h>
#include "base/json.h"
#include "base/text.h"
#include "scene/scene.h"
#include "scene/storage.h"

namespace rigc::scene {

namespace {

class Dump {
 public:
  explicit Dump(const Scene& scene) : scene_(scene), order_(scene.nodes()), ordinal_(scene.size()) {
    // UINT32_MAX, the skeleton, wraps to the front.
    std::stable_sort(order_.begin(), order_.end(), [&](NodeId a, NodeId b) {
      return scene[a].command + 1 < scene[b].command + 1;
    });
    for (std::size_t i = 0; i < order_.size(); ++i) ordinal_[order_[i].index] = i;
  }

  std::string text() {
    for (const NodeId id : order_) node(id);
    return std::move(out_);
  }

 private:
  void node(NodeId id) {
    const Node& n = scene_[id];
    out_ +=
        fmt::format("node {} {} {}\n", ordinal_[id.index], spec(n.kind).name, json::quote(n.name));
    out_ += fmt::format("  identity {}\n", to_text(n.identity));
    out_ += fmt::format("  ids {} {} {}\n", json::quote(n.ids.global), json::quote(n.ids.local),
                        json::quote(n.ids.label));
    if (!n.is_skeleton()) out_ += fmt::format("  command {}\n", n.command);
    if (n.origin.span.known() || !n.origin.joint.empty() || !n.origin.command.empty()) {
      out_ += fmt::format("  origin {}:{} {} {}\n", n.origin.span.line, n.origin.span.column,
                          json::quote(n.origin.joint), json::quote(n.origin.command));
    }
    if (n.parent.valid()) out_ += fmt::format("  parent {}\n", ordinal_[n.parent.index]);
    if (!n.children.empty()) {
      out_ += "  children";
      for (const NodeId child : n.children) out_ += fmt::format(" {}", ordinal_[child.index]);
      out_ += '\n';
    }
    values(id, n);
    for (const UserAttribute& attribute : n.user) user(attribute);
    for (const Connection& c : n.inputs) {
      out_ += fmt::format("  {} <- {} {}\n", scene_.plug_name(c.to), ordinal_[c.from.node.index],
                          scene_.plug_name(c.from));
    }
  }

  void values(NodeId id, const Node& n) {
    const auto attributes = spec(n.kind).attributes;
    for (std::size_t i = 0; i < attributes.size(); ++i) {
      // The Euler view is a view: the rotation itself is written.
      if (spec(n.kind).is_transform && i == transform::kRotate) continue;
      const Value initial = initial_value(attributes[i]);
      for (std::size_t e = 0; e < n.attributes[i].size(); ++e) {
        const Value& value = n.attributes[i][e];
        if (!attributes[i].array && value == initial) continue;
        const auto element = attributes[i].array ? static_cast<std::int32_t>(e) : -1;
        const Plug plug{id, static_cast<std::uint16_t>(i), element};
        out_ += fmt::format("  {}", scene_.plug_name(plug));
        std::visit([this](const auto& v) { write(v); }, value);
        out_ += '\n';
      }
    }
  }

  void user(const UserAttribute& attribute) {
    static constexpr std::string_view kFlavours[] = {"number", "integer", "boolean", "angle"};
    out_ += fmt::format("  user {} {}", json::quote(attribute.name),
                        kFlavours[static_cast<std::size_t>(attribute.flavour)]);
    write(attribute.value);
    out_ += " initial";
    write(attribute.initial);
    if (attribute.min) (out_ += " min"), write(*attribute.min);
    if (attribute.max) (out_ += " max"), write(*attribute.max);
    if (attribute.keyable) out_ += " keyable";
    out_ += attribute.hidden ? " hidden\n" : "\n";
  }

  void write(double v) { (out_ += ' ') += number_text(v); }
  void write(const math::Vec3& v) {
    for (const double c : {v.x, v.y, v.z}) write(c);
  }
  void write(const math::Quat& q) {
    for (const double c : {q.x, q.y, q.z, q.w}) write(c);
  }
  void write(const math::Affine& a) {
    for (const math::Vec3& v : {a.linear.x, a.linear.y, a.linear.z, a.origin}) write(v);
  }
  void write(const std::string& s) { (out_ += ' ') += json::quote(s); }
  void write(const std::vector<double>& numbers) {
    for (const double n : numbers) write(n);
  }

  const Scene& scene_;
  std::vector<NodeId> order_;
  std::vector<std::size_t> ordinal_;  // by node index
  std::string out_;
};

}  // namespace

std::string Scene::dump() const { return Dump(*this).text(); }

}  // namespace rigc::scene
