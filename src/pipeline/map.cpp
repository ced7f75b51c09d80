// SPDX-License-Identifier: MIT
// Map: reads template and model, has the map guessed, and gives it as YAML and JSON.
// Test: tests/pipeline/map_test.cpp
#include "pipeline/map.h"

#include "base/files.h"
#include "base/json.h"
#include "base/text.h"
#include "gltf/skeletons.h"
#include "templates/library.h"

namespace rigc::pipeline {
namespace {

using templates::GuessLine;

const char* word_of(GuessLine::Sure sure) {
  switch (sure) {
    case GuessLine::Sure::name:
      return "name";
    case GuessLine::Sure::word:
      return "word";
    case GuessLine::Sure::place:
      return "place";
    default:
      return "missing";
  }
}

std::string as_json(const templates::Guess& guess, const tags::ForeignSkeleton& skeleton,
                    const std::string& map_name) {
  const std::vector<std::string> references = templates::bone_references(skeleton);
  json::Writer w(2);
  const auto bones = [&](const char* key, const std::vector<int>& list) {
    w.key(key).begin_array();
    for (const int bone : list) {
      const tags::ForeignJoint& joint = skeleton.joints[static_cast<std::size_t>(bone)];
      w.begin_object()
          .member("bone", references[static_cast<std::size_t>(bone)])
          .member("name", joint.name)
          .member("node", joint.node)
          .end_object();
    }
    w.end_array();
  };
  w.begin_object().member("map", map_name).member("nearest", guess.nearest);
  w.member("fits", guess.fits).key("joints").begin_array();
  for (const GuessLine& line : guess.lines) {
    w.begin_object().member("local", line.local).member("label", line.label);
    w.member("joint", line.joint).member("required", line.required);
    w.member("sure", word_of(line.sure)).member("why", line.why);
    bones("bones", line.bones);
    bones("candidates", line.candidates);
    w.end_object();
  }
  w.end_array();
  bones("unmapped", guess.unmapped);
  w.key("notes").begin_array();
  for (const std::string& note : guess.notes) w.value(note);
  w.end_array().end_object();
  return w.take() + "\n";
}

/// A map's name from that of its file.
std::string name_of(const std::string& out) {
  std::string name = stem_of(out);
  for (char& c : name)
    if (!is_name(std::string("a") + c)) c = '_';
  return is_name(name) ? name : "guess";
}

}  // namespace

std::optional<MapGuess> guess_map(const BuildRequest& request, const std::string& out,
                                  Diagnostics& diagnostics) {
  catalog::Catalogue catalogue;
  if (!add_modules(request.paths, catalogue, diagnostics)) return std::nullopt;
  templates::Library library(templates::template_folders(request.paths.templates), catalogue);
  const templates::Template* main = library.open(request.template_file, diagnostics);
  if (!main) return std::nullopt;
  const auto expanded = templates::expand(*main, library, catalogue, diagnostics);
  const auto model = gltf::open(request.model, diagnostics);
  if (!expanded || !model) return std::nullopt;
  const auto skeletons = gltf::read_skeletons(*model, request.rest, diagnostics);
  if (!skeletons) return std::nullopt;
  const tags::ForeignSkeleton* skeleton = choose_skeleton(*skeletons, request, diagnostics);
  if (!skeleton) return std::nullopt;
  auto guess = templates::guess_map(*expanded, *skeleton, library.folders(), diagnostics);
  if (!guess) return std::nullopt;
  const std::string name = name_of(out);
  const std::string file = request.model.substr(request.model.find_last_of('/') + 1);
  MapGuess result;
  result.yaml = templates::map_text(*guess, *skeleton, name, file, main->name);
  result.json = as_json(*guess, *skeleton, name);
  result.guess = *std::move(guess);
  return result;
}

}  // namespace rigc::pipeline
