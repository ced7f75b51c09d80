// SPDX-License-Identifier: MIT
// A program as text. Test: tests/eval/program_test.cpp
#include "eval/program.h"

#include <span>

#include <fmt/format.h>
#include "base/text.h"
#include "eval/kernels/table.h"

namespace rigc::eval {

namespace {

// r5 is one row, r5+3 are rows 5, 6 and 7.
std::string text_of(const Register& r) {
  return r.width == 1 ? fmt::format("r{}", r.row) : fmt::format("r{}+{}", r.row, r.width);
}

// [1 2 3]: the kernel's own table.
std::string table_text(std::span<const double> numbers) {
  std::string out;
  for (const double n : numbers) out += (out.empty() ? " [" : " ") + number_text(n);
  return out.empty() ? out : out + "]";
}

// input r5+3  # translate of control hip
std::string ports_text(std::string_view what, const std::vector<Register>& registers,
                       const std::vector<scene::Plug>* plugs, const scene::Scene& scene) {
  std::string out;
  for (std::size_t i = 0; i < registers.size(); ++i) {
    out += fmt::format("{} {}", what, text_of(registers[i]));
    if (plugs) {
      const scene::Plug& plug = (*plugs)[i];
      const scene::Node& node = scene[plug.node];
      out += fmt::format("  # {} of {} {}", printable(scene.plug_name(plug)), spec(node.kind).name,
                         printable(node.name));
    }
    out += '\n';
  }
  return out;
}

}  // namespace

std::string Program::dump(const scene::Scene& scene, const Request* request,
                          const Sources* sources) const {
  std::string out = fmt::format("rows {}\n", rows);
  out += ports_text("input", inputs, request ? &request->inputs : nullptr, scene);
  for (const Constant& c : constants) out += fmt::format("r{} = {}\n", c.row, number_text(c.value));
  for (const Instruction& i : instructions) {
    out += fmt::format("{} = {}", text_of(i.out), row(i.op).name);
    for (std::uint32_t a = 0; a < i.argument_count; ++a) {
      out += fmt::format(" {}", text_of(arguments[i.first_argument + a]));
    }
    out += table_text(std::span(data).subspan(i.data, i.data_count));
    const scene::Node& node = scene[scene::NodeId{i.node}];
    out += fmt::format("  # {} {}", spec(node.kind).name, printable(node.name));
    const Span& span = node.origin.span;
    if (sources && span.known()) out += fmt::format(", {}:{}", sources->name(span.file), span.line);
    out += '\n';
  }
  out += ports_text("output", outputs, request ? &request->outputs : nullptr, scene);
  return out;
}

}  // namespace rigc::eval
