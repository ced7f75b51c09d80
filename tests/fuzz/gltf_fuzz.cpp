// SPDX-License-Identifier: MIT
// Any bytes as a glTF file: what opens goes on through skeletons, rigs and clips, and comes out of
// a patch as it went in. Files that it names are not there: its folder does not exist.
#include <cstdint>
#include <string>

#include "gltf/clips.h"
#include "gltf/file.h"
#include "gltf/patch.h"
#include "gltf/rig.h"
#include "gltf/skeletons.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace rigc;

constexpr const char* kName = "/nowhere/fuzz/model.gltf";

std::string bytes_of(const gltf::Output& output) {
  Diagnostics diagnostics;
  std::string bytes;
  for (const Bytes& piece : output.pieces) bytes += piece.text(diagnostics).value_or("");
  return bytes;
}

void read_all(const gltf::File& file, Diagnostics& diagnostics) {
  for (const char* rest : {"bind", "nodes"}) {
    const fuzz::Stage stage(diagnostics);
    const auto skeletons = gltf::read_skeletons(file, rest, diagnostics);
    stage.ended(skeletons.has_value(), "read_skeletons: empty exactly when an error was reported");
  }
  const fuzz::Stage clip_stage(diagnostics);
  const auto clips = gltf::read_clips(file, diagnostics);
  clip_stage.ended(clips.has_value(), "read_clips: empty exactly when an error was reported");
  const fuzz::Stage rig_stage(diagnostics);
  const auto rigs = gltf::read_rigs(file, diagnostics);
  if (!rig_stage.ended(rigs.has_value(), "read_rigs: empty exactly when an error was reported"))
    return;
  for (const gltf::Rig& rig : *rigs) {
    const fuzz::Stage stage(diagnostics);
    const auto standings = gltf::standings(file, rig, diagnostics);
    stage.ended(standings.has_value(), "standings: empty exactly when an error was reported");
  }
  if (rigs->empty()) return;
  gltf::Patch patch(file);
  gltf::strip_rigs(patch, file, *rigs);
  const auto output = patch.finish(file.binary, diagnostics);
  fuzz::expect(output.has_value(), "rigs that can be read can be stripped");
  Diagnostics again;
  const auto stripped = gltf::open(kName, bytes_of(*output), again);
  if (!stripped) std::fprintf(stderr, "%s\n", render(again, false).c_str());
  fuzz::expect(stripped.has_value() || !output->extra_files.empty(), "a stripped file opens");
}

void write_back(const gltf::File& file, const std::string& bytes) {
  Diagnostics diagnostics;
  gltf::Patch nothing(file);
  const auto same = nothing.finish(file.binary, diagnostics);
  fuzz::expect(same && same->unchanged && bytes_of(*same) == bytes, "nothing changed: same bytes");

  gltf::Patch patch(file);
  const int nodes = patch.count("nodes");
  patch.append("nodes", R"({"name":"more"})");
  const auto longer = patch.finish(file.binary, diagnostics);
  fuzz::expect(longer.has_value(), "a node can be appended");
  const auto changed = gltf::open(kName, bytes_of(*longer), diagnostics);
  if (!changed) std::fprintf(stderr, "%s\n", render(diagnostics, false).c_str());
  fuzz::expect(changed.has_value(), "a file with one more node opens");
  gltf::Patch back(*changed);
  back.truncate("nodes", nodes);
  const auto shorter = back.finish(file.binary, diagnostics);
  fuzz::expect(shorter.has_value(), "a node can be taken away");
  const auto restored = gltf::open(kName, bytes_of(*shorter), diagnostics);
  fuzz::expect(restored.has_value(), "a node appended and taken away: the file opens");
  if (nodes == 0 && file.root()["nodes"]) return;  // only `before` of a rig tells an empty list
  fuzz::expect(restored->root().text() == file.root().text(),
               "a node appended and taken away: same JSON");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  Diagnostics diagnostics;
  const fuzz::Stage stage(diagnostics);
  const auto file = gltf::open(kName, bytes, diagnostics);
  if (stage.ended(file.has_value(), "open: empty exactly when an error was reported")) {
    write_back(*file, bytes);
    read_all(*file, diagnostics);
  }
  render(diagnostics, true);
  return 0;
}
