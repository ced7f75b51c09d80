// SPDX-License-Identifier: MIT
// Rigs for tests, built from a template's text by the real path.
#include "support/rig.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "selector/selector.h"
#include "templates/expand.h"
#include "templates/library.h"
#include "templates/read.h"
#include "traversal/resolve.h"

namespace rigc::test {

const catalog::Catalogue& catalogue() {
  static const catalog::Catalogue kCatalogue;
  return kCatalogue;
}

std::optional<tags::TaggedSkeleton> skeleton_from(const std::string& yaml,
                                                  Diagnostics& diagnostics) {
  const auto file = diagnostics.sources().add("test.yaml", yaml);
  const auto read = templates::read(file, catalogue(), diagnostics);
  if (!read) return std::nullopt;
  templates::Library library({}, catalogue());
  const auto expanded = templates::expand(*read, library, catalogue(), diagnostics);
  return expanded ? templates::place(*expanded, diagnostics) : std::nullopt;
}

Rig::Rig(const std::string& yaml, const Change& change, bool run, tags::Geometry geometry) {
  auto placed = skeleton_from(yaml, diagnostics);
  if (!placed) return;
  skeleton = std::move(*placed);
  if (change) change(skeleton);
  auto listed = processor::list(skeleton, catalogue(), diagnostics);
  if (!listed) return;
  commands = std::move(*listed);
  processor_ = std::make_unique<processor::Processor>(skeleton, commands, catalogue(), 0,
                                                      std::move(geometry));
  if (run) processor_->run(diagnostics);
}

std::vector<scene::NodeId> Rig::nodes(const std::string& selector) const {
  Diagnostics quiet;
  const auto parsed = selector::parse(selector, {}, quiet);
  if (!parsed) return {};
  const traversal::Context context{scene(),
                                   processor_->index(),
                                   skeleton.global,
                                   processor_->index().joint(skeleton.joints.front().key),
                                   {}};
  const auto found = traversal::resolve(*parsed, context, quiet);
  return found ? found->nodes : std::vector<scene::NodeId>{};
}

scene::NodeId Rig::node(const std::string& selector) const {
  const auto found = nodes(selector);
  INFO(selector << "\n" << text(diagnostics));
  REQUIRE(found.size() == 1);
  return found.front();
}

scene::Plug Rig::plug(const std::string& selector) const {
  const std::size_t at = selector.find('@');
  REQUIRE(at != std::string::npos);
  const std::string attribute = selector.substr(at + 1);
  const std::size_t dot = attribute.find('.');
  const auto found =
      scene().find_plug(node(selector.substr(0, at)), attribute.substr(0, dot),
                        dot == std::string::npos ? std::string() : attribute.substr(dot + 1));
  INFO(selector);
  REQUIRE(found);
  return *found;
}

std::string places(const Diagnostics& diagnostics) {
  std::string out;
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    const Span& span = diagnostic.place.span;
    out += fmt::format("RIG{:04} {}:{}\n", diagnostic.code->number, span.line, span.column);
  }
  return out;
}

std::string codes(const Diagnostics& diagnostics) {
  std::string out;
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    out += fmt::format("{}RIG{:04}", out.empty() ? "" : " ", diagnostic.code->number);
  }
  return out;
}

std::string text(const Diagnostics& diagnostics) { return render(diagnostics, false); }

std::string template_of(const std::string& joints) {
  return "rigc: 1\nname: test\nversion: 1\n" + joints;
}

}  // namespace rigc::test
