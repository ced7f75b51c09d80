// SPDX-License-Identifier: MIT
// Query: what a selector resolves to in a file. Test: tests/pipeline/inspect_test.cpp
#include <fmt/format.h>

#include "base/text.h"
#include "gltf/rig.h"
#include "pipeline/codes.h"
#include "pipeline/inspect.h"
#include "selector/selector.h"
#include "traversal/resolve.h"

namespace rigc::pipeline {
namespace {

/// The rig that the selector's global group names, or the only one.
const gltf::Rig* choose_rig(const std::vector<gltf::Rig>& rigs, const selector::Selector& selector,
                            const std::string& path, Diagnostics& diagnostics) {
  const std::string& global = selector.choices.front().global;
  std::vector<std::string> names;
  for (const gltf::Rig& rig : rigs) {
    names.push_back(rig.skeleton.global);
    if (rig.skeleton.global == global || (global.empty() && rigs.size() == 1)) return &rig;
  }
  if (rigs.empty()) {
    diagnostics.report(codes::kNoRig, Place(path), "the file has no rig to ask");
  } else {
    diagnostics.report(codes::kNotOneSelector, Place(path),
                       global.empty()
                           ? fmt::format("the file has {} rigs", rigs.size())
                           : fmt::format("the file has no rig \"{}\"", printable(global)),
                       suggest(global, names));
  }
  return nullptr;
}

std::string render_found(const gltf::Rig& rig, const traversal::Found& found, bool as_json) {
  json::Writer w(2);
  std::string text;
  w.begin_array();
  for (std::size_t i = 0; i < found.nodes.size(); ++i) {
    const scene::NodeId id = found.nodes[i];
    const scene::Node& node = rig.scene[id];
    w.begin_object()
        .member("node", rig.nodes[id.index])
        .member("kind", scene::spec(node.kind).name);
    w.member("name", node.name).member("local", node.ids.local).member("label", node.ids.label);
    const std::string plug = found.plugs.empty() ? "" : rig.scene.plug_name(found.plugs[i]);
    if (!plug.empty()) w.member("attribute", plug);
    w.end_object();
    text +=
        fmt::format("{}{}{}\n", traversal::describe(rig.scene, id), plug.empty() ? "" : " @", plug);
  }
  w.end_array();
  return as_json ? w.take() + "\n" : text;
}

}  // namespace

std::optional<std::string> query(const std::string& path, const std::string& text, bool as_json,
                                 Diagnostics& diagnostics) {
  Span span{diagnostics.sources().add("selector", text), 1, 1,
            static_cast<std::uint32_t>(text.size())};
  const auto selector = selector::parse(text, span, diagnostics);
  if (!selector) return std::nullopt;
  const auto file = gltf::open(path, diagnostics);
  if (!file) return std::nullopt;
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  if (!rigs) return std::nullopt;
  const gltf::Rig* rig = choose_rig(*rigs, *selector, path, diagnostics);
  if (!rig || rig->scene.size() == 0) return std::nullopt;
  traversal::Index index;
  for (scene::NodeId id : rig->scene.nodes()) index.added(rig->scene, id);
  const traversal::Context context{rig->scene, index, rig->skeleton.global, scene::NodeId{0}, {}};
  const auto found = traversal::resolve(*selector, context, diagnostics);
  if (!found) return std::nullopt;
  return render_found(*rig, *found, as_json);
}

}  // namespace rigc::pipeline
