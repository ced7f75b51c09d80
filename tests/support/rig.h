// SPDX-License-Identifier: MIT
// Rigs for tests, built from a template's text by the real path: read, expand, place, list, run. A
// test changes the skeleton between place and list to stand for other models (skeletons.h).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "catalog/catalogue.h"
#include "processor/processor.h"
#include "tags/tags.h"

namespace rigc::test {

/// The built-in modules and shapes, made once.
const catalog::Catalogue& catalogue();

/// The text as a skeleton; empty where it has errors.
std::optional<tags::TaggedSkeleton> skeleton_from(const std::string& yaml,
                                                  Diagnostics& diagnostics);

/// A template's run. Not movable: the processor refers to its members.
class Rig {
 public:
  using Change = std::function<void(tags::TaggedSkeleton&)>;

  /// Reads and lists; runs everything unless `run` is false. Only the text's errors stop it.
  /// `geometry`: what commands read of a model.
  explicit Rig(const std::string& yaml, const Change& change = {}, bool run = true,
               tags::Geometry geometry = {});
  Rig(const Rig&) = delete;

  bool listed() const { return processor_ != nullptr; }
  /// Whether everything ran without a diagnostic.
  bool clean() const { return listed() && diagnostics.all().empty(); }
  processor::Processor& processor() { return *processor_; }
  const traversal::Index& index() const { return processor_->index(); }
  const scene::Scene& scene() const { return processor_->scene(); }

  /// The nodes of a selector as seen from the first joint; none where it finds nothing.
  std::vector<scene::NodeId> nodes(const std::string& selector) const;
  /// The one node of a selector; fails the test where there is not exactly one.
  scene::NodeId node(const std::string& selector) const;
  /// The one plug of a selector with an attribute.
  scene::Plug plug(const std::string& selector) const;
  /// Rest matrix in rig space.
  math::Affine rest(const std::string& selector) const {
    return scene().rest_world(node(selector));
  }

  Diagnostics diagnostics;
  tags::TaggedSkeleton skeleton;
  processor::CommandList commands;

 private:
  std::unique_ptr<processor::Processor> processor_;
};

/// `RIG0460 12:5` for each diagnostic, in order, one a line.
std::string places(const Diagnostics& diagnostics);
/// `RIG0460` for each diagnostic, in order, joined by blanks.
std::string codes(const Diagnostics& diagnostics);
/// Everything as the command line prints it, for messages of failing tests.
std::string text(const Diagnostics& diagnostics);

/// `rigc: 1`, a name and a version before `joints:` and what follows.
std::string template_of(const std::string& joints);

}  // namespace rigc::test
