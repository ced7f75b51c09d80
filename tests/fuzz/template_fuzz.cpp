// SPDX-License-Identifier: MIT
// Any text as a template: what can be read goes on through expand, place, list and the processor.
// Parts are those that come with rigc.
#include <cstdint>
#include <string>

#include "processor/processor.h"
#include "templates/expand.h"
#include "templates/library.h"
#include "templates/read.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace rigc;

const std::string kFolder = std::string(RIGC_SOURCE_DIR) + "/templates";

/// Large skeletons cost time and show nothing that small ones do not.
constexpr std::size_t kMostJoints = 300;

void run(const tags::TaggedSkeleton& skeleton, const catalog::Catalogue& catalogue,
         Diagnostics& diagnostics) {
  const fuzz::Stage listing(diagnostics);
  const auto commands = processor::list(skeleton, catalogue, diagnostics);
  if (!listing.ended(commands.has_value(), "list: empty exactly when an error was reported"))
    return;
  processor::Processor processor(skeleton, *commands, catalogue);
  const std::string before = processor.scene().dump();
  const fuzz::Stage running(diagnostics);
  running.ended(processor.run(diagnostics), "run: false exactly when an error was reported");
  while (processor.step_back()) continue;
  fuzz::expect(processor.scene().dump() == before, "all commands undone: the scene is as it was");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const catalog::Catalogue catalogue;
  Diagnostics diagnostics;
  const std::uint32_t file = diagnostics.sources().add(
      kFolder + "/fuzz.yaml", std::string(reinterpret_cast<const char*>(data), size));
  const fuzz::Stage reading(diagnostics);
  const auto main = templates::read(file, catalogue, diagnostics);
  if (reading.ended(main.has_value(), "read: empty exactly when an error was reported")) {
    templates::Library library({kFolder}, catalogue);
    const fuzz::Stage expanding(diagnostics);
    const auto expanded = templates::expand(*main, library, catalogue, diagnostics);
    if (expanding.ended(expanded.has_value(), "expand: empty exactly when an error was reported")) {
      const fuzz::Stage placing(diagnostics);
      const auto skeleton = templates::place(*expanded, diagnostics);
      if (placing.ended(skeleton.has_value(), "place: empty exactly when an error was reported") &&
          skeleton->joints.size() <= kMostJoints)
        run(*skeleton, catalogue, diagnostics);
    }
  }
  render(diagnostics, true);
  return 0;
}
