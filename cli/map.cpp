// SPDX-License-Identifier: MIT
// rigc map: a first guess at a model's map. Test: tests/cli/map_test.cpp
#include "pipeline/map.h"

#include <fmt/format.h>

#include "base/files.h"
#include "base/text.h"
#include "cli/command.h"

namespace rigc::cli {
namespace {

using templates::GuessLine;

class Map final : public Command {
 public:
  std::string name() const override { return "map"; }
  std::string summary() const override {
    return "Guess which bone of a model is which joint, as a map file to edit";
  }
  std::vector<std::string> examples() const override {
    return {"rigc map hero.glb -o hero.yaml",
            "rigc map wolf.glb -o wolf.yaml --template quadruped"};
  }
  void declare(Options& options) override {
    request_.template_file = "biped";
    options.positional("MODEL", request_.model, true, "Character (.glb, .gltf, .vrm)");
    options.text("-o,--output", "MAP.yaml", out_, false, "File to write (default: print it)");
    options.text("--template", "TEMPLATE", request_.template_file, false,
                 "Template that the model is to get: a file, or the name of one that comes with "
                 "rigc (default: biped)");
    options.text("--skeleton", "NODE", request_.skeleton, false,
                 "Skeleton of the model, by a node's name or number");
    options.text("--rest", "REST", request_.rest, false,
                 "Pose of the model to look at: bind (default), nodes, or CLIP@SECONDS");
    declare_paths(options, request_.paths);
  }
  void run(Session& session) override {
    const auto map = pipeline::guess_map(request_, out_, session.diagnostics);
    if (!map) return;
    if (!out_.empty() && !write_file(out_, {map->yaml}, session.diagnostics)) return;
    if (session.json)
      session.out = map->json;
    else
      session.out = out_.empty() ? map->yaml : summary(map->guess);
  }

 private:
  std::string summary(const templates::Guess& guess) const {
    std::string out = fmt::format(
        "{}: {} by name, {} by a word and their place, {} by their place alone, {} required not "
        "found, {} bones left\n",
        printable(out_), guess.count(GuessLine::Sure::name), guess.count(GuessLine::Sure::word),
        guess.count(GuessLine::Sure::place), guess.missing_required(), guess.unmapped.size());
    for (const std::string& note : guess.notes) out += "  " + printable(note, 300) + "\n";
    return out +
           fmt::format("next: read it, then\n  rigc build {} --model {} --map {} -o {}_rig.glb\n",
                       printable(request_.template_file), printable(request_.model),
                       printable(out_), printable(stem_of(request_.model)));
  }

  pipeline::BuildRequest request_;
  std::string out_;
};

}  // namespace

std::unique_ptr<Command> make_map() { return std::make_unique<Map>(); }

}  // namespace rigc::cli
