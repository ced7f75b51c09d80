// SPDX-License-Identifier: MIT
// Map: a first guess at which bone of a model is which joint of a template, as a map file to edit.
// Test: tests/pipeline/map_test.cpp
#pragma once

#include <optional>
#include <string>

#include "pipeline/build.h"
#include "templates/map_guess.h"

namespace rigc::pipeline {

/// What a guess is about, and the file that it becomes.
struct MapGuess {
  templates::Guess guess;
  std::string yaml;
  std::string json;
};

/// Uses the request's template, model, skeleton, rest and paths. `out`: the file to be, whose name
/// the map gets; empty: none.
std::optional<MapGuess> guess_map(const BuildRequest& request, const std::string& out,
                                  Diagnostics& diagnostics);

}  // namespace rigc::pipeline
