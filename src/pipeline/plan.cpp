// SPDX-License-Identifier: MIT
// Plan: the command list for people, programs and Graphviz. Test: tests/cli/cli_test.cpp
#include "pipeline/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text.h"
#include "gltf/vertices.h"
#include "selector/selector.h"

namespace rigc::pipeline {
namespace {

/// One command of the plan with what it made and what it read.
struct Row {
  const processor::Command* command;
  const tags::TaggedJoint* joint;
  const tags::CommandTag* tag;
  std::string place;  ///< file:line
  std::size_t nodes = 0;
  bool skipped = false;
  std::vector<processor::Processor::ResolvedArgument> arguments;
  std::set<std::size_t> uses;  ///< commands whose nodes it connects to
};

std::vector<Row> run_rows(const Prepared& prepared, processor::Processor& processor,
                          Diagnostics& diagnostics) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < prepared.end; ++i) {
    const processor::Command& command = prepared.commands.commands[i];
    Row row;
    row.command = &command;
    row.joint = &prepared.skeleton.joints[command.joint];
    row.tag = &tag_of(prepared.skeleton, command);
    row.place =
        fmt::format("{}:{}", diagnostics.sources().name(row.tag->span.file), row.tag->span.line);
    row.arguments = processor.resolved(i);
    const std::size_t before = processor.scene().size();
    if (!processor.step(diagnostics)) return rows;
    row.skipped = processor.skipped(i);
    row.nodes = processor.scene().size() - before;
    for (std::size_t n = before; n < processor.scene().size(); ++n) {
      const scene::Node& node = processor.scene()[scene::NodeId{static_cast<std::uint32_t>(n)}];
      if (node.parent.valid()) row.uses.insert(processor.scene()[node.parent].command);
      for (const auto& connection : node.inputs)
        row.uses.insert(processor.scene()[connection.from.node].command);
    }
    row.uses.erase(i);
    row.uses.erase(UINT32_MAX);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string as_text(const std::vector<Row>& rows) {
  std::string out;
  std::size_t width = 0;
  for (const Row& row : rows)
    width = std::max(width, row.joint->name.size() + row.tag->id.size() + 1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    const std::string module = row.tag->module == row.tag->id ? "" : " " + row.tag->module;
    out +=
        fmt::format("{:>4}  {:<8} {:<{}}{}  {}  {}\n", i + 1, catalog::name_of(row.command->stage),
                    printable(row.joint->name) + "/" + row.tag->id, width, module,
                    row.skipped ? "skipped" : fmt::format("{} nodes", row.nodes), row.place);
    if (!row.tag->comment.empty())
      out += fmt::format("{:16}# {}\n", "", printable(row.tag->comment));
    for (const auto& argument : row.arguments) {
      out += fmt::format("{:16}{}: {} -> {}\n", "", argument.name, argument.selector,
                         argument.found.empty() ? "nothing" : join(argument.found, ", "));
    }
  }
  out += fmt::format("{} commands\n", rows.size());
  return out;
}

std::string as_json(const std::vector<Row>& rows) {
  json::Writer w(2);
  w.begin_array();
  for (const Row& row : rows) {
    w.begin_object();
    w.member("stage", catalog::name_of(row.command->stage));
    w.member("joint", row.joint->name)
        .member("local", row.joint->ids.local)
        .member("label", row.joint->ids.label);
    w.member("module", row.tag->module)
        .member("id", row.tag->id)
        .member("comment", row.tag->comment);
    w.member("place", row.place).member("skipped", row.skipped).member("nodes", row.nodes);
    w.key("arguments").begin_array();
    for (const auto& argument : row.arguments) {
      w.begin_object()
          .member("name", argument.name)
          .member("selector", argument.selector)
          .key("found")
          .begin_array();
      for (const std::string& found : argument.found) w.value(found);
      w.end_array().end_object();
    }
    w.end_array().end_object();
  }
  w.end_array();
  return w.take() + "\n";
}

std::string as_dot(const std::vector<Row>& rows) {
  std::string out = "digraph plan {\n  rankdir=LR;\n  node [shape=box];\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out += fmt::format(
        "  c{} [label={}];\n", i,
        json::quote(rows[i].joint->name + "/" + rows[i].tag->id + "\n" + rows[i].tag->module));
    for (std::size_t use : rows[i].uses) out += fmt::format("  c{} -> c{};\n", use, i);
  }
  return out + "}\n";
}

}  // namespace

std::optional<std::string> plan(const BuildRequest& request, PlanForm form,
                                Diagnostics& diagnostics) {
  const auto prepared = prepare(request, diagnostics);
  if (!prepared) return std::nullopt;
  processor::Processor processor(
      prepared->skeleton, prepared->commands, prepared->catalogue, prepared->rig_id,
      prepared->model ? gltf::geometry_of(*prepared->model) : tags::Geometry{});
  const std::vector<Row> rows = run_rows(*prepared, processor, diagnostics);
  switch (form) {
    case PlanForm::json:
      return as_json(rows);
    case PlanForm::dot:
      return as_dot(rows);
    default:
      return as_text(rows);
  }
}

}  // namespace rigc::pipeline
