// SPDX-License-Identifier: MIT
// The compiled program of a rig, as text or JSON. Test: tests/pipeline/plan_program_test.cpp
#include <cmath>

#include <fmt/format.h>

#include "base/text.h"
#include "eval/kernels/table.h"
#include "eval/program.h"
#include "gltf/vertices.h"
#include "pipeline/codes.h"
#include "pipeline/plan.h"
#include "scene/access.h"

namespace rigc::pipeline {
namespace {

using eval::Program;
using scene::NodeId;
namespace transform = scene::transform;

bool is_rig_file(const std::string& name) {
  return ends_with(name, ".glb") || ends_with(name, ".gltf") || ends_with(name, ".vrm");
}

/// What animators may key, and where joints then are.
eval::Request playing(const scene::Scene& scene) {
  eval::Request request;
  for (const NodeId id : scene.nodes()) {
    const scene::Node& node = scene[id];
    if (node.kind == scene::Kind::joint) request.outputs.push_back({id, transform::kWorld});
    if (node.kind != scene::Kind::control) continue;
    const unsigned keyable = scene::keyable_bits(scene, id);
    if (keyable & scene::kTranslateBits) request.inputs.push_back({id, transform::kTranslate});
    if (keyable & scene::kRotateBits) request.inputs.push_back({id, transform::kRotation});
    if (keyable & scene::kScaleBits) request.inputs.push_back({id, transform::kScale});
    for (std::size_t i = 0; i < node.user.size(); ++i) {
      if (!node.user[i].keyable) continue;
      request.inputs.push_back({id, static_cast<std::uint16_t>(scene::kUserAttributes + i)});
    }
  }
  return request;
}

/// Rows that hold constants, without what inputs hold until they are set.
std::size_t constants_of(const Program& program) {
  std::size_t count = program.constants.size();
  for (const eval::Register& input : program.inputs) count -= input.width;
  return count;
}

std::size_t bytes_of(const Program& program) {
  return std::size_t{program.rows} * eval::kLanes * sizeof(double);
}

std::string as_text(const Program& program, const scene::Scene& scene, const eval::Request& request,
                    const Sources& sources) {
  return program.dump(scene, &request, &sources) +
         fmt::format("{} instructions, {} rows, {} constants, {} bytes a block of {} frames\n",
                     program.instructions.size(), program.rows, constants_of(program),
                     bytes_of(program), eval::kLanes);
}

void write_register(json::Writer& w, const eval::Register& r) {
  w.begin_object().member("row", r.row).member("width", r.width).end_object();
}

void write_ports(json::Writer& w, std::string_view name,
                 const std::vector<eval::Register>& registers,
                 const std::vector<scene::Plug>& plugs, const scene::Scene& scene) {
  w.key(name).begin_array();
  for (std::size_t i = 0; i < registers.size(); ++i) {
    w.begin_object()
        .member("identity", to_text(scene[plugs[i].node].identity))
        .member("name", scene[plugs[i].node].name)
        .member("attribute", scene.plug_name(plugs[i]))
        .key("register");
    write_register(w, registers[i]);
    w.end_object();
  }
  w.end_array();
}

void write_instruction(json::Writer& w, const Program& program, const eval::Instruction& i,
                       const scene::Scene& scene, const Sources& sources) {
  const scene::Node& node = scene[NodeId{i.node}];
  w.begin_object().member("operation", eval::row(i.op).name).key("result");
  write_register(w, i.out);
  w.key("arguments").begin_array();
  for (std::uint32_t a = 0; a < i.argument_count; ++a)
    write_register(w, program.arguments[i.first_argument + a]);
  w.end_array().key("data").begin_array();
  for (std::uint32_t d = 0; d < i.data_count; ++d) {
    const double number = program.data[i.data + d];
    std::isfinite(number) ? w.value(number) : w.null();  // a side without a bound
  }
  w.end_array().member("kind", spec(node.kind).name).member("name", node.name);
  const Span& span = node.origin.span;
  if (span.known()) w.member("file", sources.name(span.file)).member("line", span.line);
  w.end_object();
}

void write_program(json::Writer& w, const Program& program, const scene::Scene& scene,
                   const eval::Request& request, const Sources& sources) {
  w.begin_object()
      .member("rows", program.rows)
      .member("constants", constants_of(program))
      .member("bytes", bytes_of(program))
      .member("frames", eval::kLanes);
  write_ports(w, "inputs", program.inputs, request.inputs, scene);
  w.key("instructions").begin_array();
  for (const eval::Instruction& i : program.instructions)
    write_instruction(w, program, i, scene, sources);
  w.end_array();
  write_ports(w, "outputs", program.outputs, request.outputs, scene);
  w.end_object();
}

/// The scenes to show: of the rig that a template gives, or of those in a file.
std::optional<std::vector<scene::Scene>> scenes_of(const BuildRequest& request,
                                                   Diagnostics& diagnostics) {
  std::vector<scene::Scene> scenes;
  if (is_rig_file(request.template_file)) {
    const auto file = gltf::open(request.template_file, diagnostics);
    if (!file) return std::nullopt;
    auto rigs = gltf::read_rigs(*file, diagnostics);
    if (!rigs) return std::nullopt;
    if (rigs->empty()) {
      diagnostics.report(codes::kNoRig, Place(request.template_file),
                         "the file has no rig to show");
      return std::nullopt;
    }
    for (gltf::Rig& rig : *rigs) scenes.push_back(std::move(rig.scene));
    return scenes;
  }
  const auto prepared = prepare(request, diagnostics);
  if (!prepared) return std::nullopt;
  std::size_t skipped = 0;
  const auto geometry = prepared->model ? gltf::geometry_of(*prepared->model) : tags::Geometry{};
  auto rig = run_commands(*prepared, prepared->catalogue, geometry, skipped, diagnostics);
  if (!rig) return std::nullopt;
  scenes.push_back(std::move(rig->scene));
  return scenes;
}

}  // namespace

std::optional<std::string> plan_program(const BuildRequest& request, PlanForm form,
                                        Diagnostics& diagnostics) {
  const auto scenes = scenes_of(request, diagnostics);
  if (!scenes) return std::nullopt;
  std::string text;
  json::Writer w(2);
  w.begin_array();
  for (const scene::Scene& scene : *scenes) {
    const eval::Request played = playing(scene);
    const auto program = eval::compile(scene, played, diagnostics);
    if (!program) return std::nullopt;
    if (form == PlanForm::json) {
      write_program(w, *program, scene, played, diagnostics.sources());
    } else {
      text += as_text(*program, scene, played, diagnostics.sources());
    }
  }
  w.end_array();
  return form == PlanForm::json ? w.take() + "\n" : text;
}

}  // namespace rigc::pipeline
