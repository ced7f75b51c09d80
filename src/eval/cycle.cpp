// SPDX-License-Identifier: MIT
// The message about a cycle. Test: tests/eval/cycle_test.cpp
#include "eval/cycle.h"

#include <algorithm>

#include <fmt/format.h>
#include "base/text.h"
#include "eval/codes.h"
#include "eval/rules.h"

namespace rigc::eval {

namespace {

// A ring of a hundred thousand nodes is not worth a message of megabytes.
constexpr std::size_t kMostLines = 200;

}  // namespace

void report_cycle(const scene::Scene& scene, std::vector<scene::Plug> ring,
                  Diagnostics& diagnostics) {
  // The same cycle reads the same wherever the walk entered it.
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
  std::string lines;
  for (std::size_t i = 0; i < ring.size() && i < kMostLines; ++i) {
    const scene::Plug& plug = ring[i];
    const Origin& origin = scene[plug.node].origin;
    lines += fmt::format("{}{} of {}", i == 0 ? "" : "\n  needs ", printable(scene.plug_name(plug)),
                         describe_node(scene, plug.node));
    if (origin.span.known())
      lines += fmt::format(", {}", describe(origin.span, diagnostics.sources()));
  }
  if (ring.size() > kMostLines) lines += fmt::format("\n  ... {} more", ring.size() - kMostLines);
  lines += "\n  needs the first again";
  diagnostics.report(
      codes::kCycle, scene[ring.front().node].origin.span,
      fmt::format("{} attribute{} depend on each other in a ring, through {} of {}", ring.size(),
                  ring.size() == 1 ? "" : "s", printable(scene.plug_name(ring.front())),
                  describe_node(scene, ring.front().node)),
      std::move(lines));
}

}  // namespace rigc::eval
