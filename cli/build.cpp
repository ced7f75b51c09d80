// SPDX-License-Identifier: MIT
// rigc build: template to rig. Test: tests/cli/cli_test.cpp
#include "pipeline/build.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "cli/timing.h"

namespace rigc::cli {
namespace {

std::size_t count_controls(const scene::Scene& scene) {
  std::size_t controls = 0;
  for (scene::NodeId id : scene.nodes()) controls += scene[id].kind == scene::Kind::control ? 1 : 0;
  return controls;
}

std::string size_text(std::uint64_t bytes) {
  return bytes < 1024 * 1024 ? fmt::format("{} KB", (bytes + 1023) / 1024)
                             : fmt::format("{:.1f} MB", static_cast<double>(bytes) / (1024 * 1024));
}

/// How long a beginning two names share, up to an underscore: arm_l_hand of fingers.
std::size_t shared_begin(const std::string& a, const std::string& b) {
  std::size_t shared = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()) && a[i] == b[i]; ++i)
    if (a[i] == '_') shared = i;
  return shared;
}

/// Names of joints in a row; four and more neighbours that begin alike are counted.
std::string name_list(const std::vector<std::string>& names) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < names.size();) {
    std::size_t end = i + 1;
    std::size_t begin = end < names.size() ? shared_begin(names[i], names[end]) : 0;
    while (end < names.size() && begin > 0 &&
           shared_begin(names[i], names[end]) >= std::min(begin, std::size_t{5})) {
      begin = std::min(begin, shared_begin(names[i], names[end]));
      ++end;
    }
    if (end - i < 4) end = i + 1;
    parts.push_back(end - i == 1 ? names[i]
                                 : fmt::format("{}_* ({})", names[i].substr(0, begin), end - i));
    i = end;
  }
  return printable(join(parts, ", "), 300);
}

std::string fit_text(const templates::FitReport& fit) {
  std::string out = fmt::format("  fitted with map \"{}\": {} joints matched, {:.2f} m tall\n",
                                fit.map, fit.matched.size(), fit.height_metres);
  const auto line = [&](const char* what, const std::vector<std::string>& names) {
    if (!names.empty()) out += fmt::format("  {:<9} {}\n", what, name_list(names));
  };
  line("made:", fit.helpers);
  line("left out:", fit.dropped);
  line("twist:", fit.twists);
  line("not used:", fit.extra);
  return out;
}

std::string summary_json(const pipeline::Built& built, const std::string& out) {
  json::Writer w(2);
  w.begin_object().member("file", out).member("bytes", static_cast<std::size_t>(built.bytes));
  w.member("joints", built.rig.skeleton.joints.size())
      .member("controls", count_controls(built.rig.scene));
  w.member("commands", built.rig.commands.size()).member("skipped", built.skipped);
  w.key("fit")
      .begin_object()
      .member("map", built.fit.map)
      .member("height_metres", built.fit.height_metres)
      .member("misfit", built.fit.misfit);
  w.key("matched").begin_array();
  for (const auto& match : built.fit.matched) {
    w.begin_object()
        .member("joint", match.joint)
        .member("bone", match.bone)
        .member("node", match.node)
        .end_object();
  }
  w.end_array();
  for (const auto& [name, names] : {std::pair{"dropped", &built.fit.dropped},
                                    {"helpers", &built.fit.helpers},
                                    {"twists", &built.fit.twists},
                                    {"extra", &built.fit.extra}}) {
    w.key(name).begin_array();
    for (const std::string& value : *names) w.value(value);
    w.end_array();
  }
  w.end_object().end_object();
  return w.take() + "\n";
}

class Build final : public Command {
 public:
  std::string name() const override { return "build"; }
  std::string summary() const override { return "Build a rig from a template"; }
  std::vector<std::string> examples() const override {
    return {"rigc build templates/biped.yaml -o biped.glb",
            "rigc build biped.yaml --model hero.glb -o hero_rig.glb",
            "rigc build biped.yaml -o b.glb --feature arm_l/ikfk=off --group hand_r=off"};
  }
  void declare(Options& options) override {
    declare_build(options, request_);
    options.text("-o,--output", "OUT.glb", out_, true, "File to write (.glb or .gltf)");
    options.text("--guides", "GUIDES.yaml", request_.guides, false,
                 "Joints that were moved and controls that were edited: see `rigc guides`");
    options.flag("--skeleton-only", request_.skeleton_only,
                 "Make the skeleton with its tags, run nothing");
    options.flag("--split-weights", request_.split_weights,
                 "Let the model's skins share their weights with joints that the rig makes");
    declare_timing(options, timing_);
    declare_paths(options, request_.paths);
  }
  void run(Session& session) override {
    run_timed(timing_, session, [&] { build(session); });
  }

 private:
  void build(Session& session) {
    const auto built = pipeline::build(request_, out_, session.diagnostics);
    if (!built) return;
    if (session.json) {
      session.out = summary_json(*built, out_);
      return;
    }
    session.out = fmt::format("{}: {} joints, {} controls, {} commands{}, {}\n", printable(out_),
                              built->rig.skeleton.joints.size(), count_controls(built->rig.scene),
                              built->rig.commands.size(),
                              built->skipped ? fmt::format(" ({} skipped)", built->skipped) : "",
                              size_text(built->bytes));
    if (!request_.model.empty()) session.out += fit_text(built->fit);
  }

  pipeline::BuildRequest request_;
  std::string out_;
  Timing timing_;
};

}  // namespace

std::unique_ptr<Command> make_build() { return std::make_unique<Build>(); }

}  // namespace rigc::cli
