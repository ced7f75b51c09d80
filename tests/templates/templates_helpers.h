// SPDX-License-Identifier: MIT
// What the tests of src/templates share: templates from texts, files in memory folders, a model's
// skeleton.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "catalog/catalogue.h"
#include "templates/expand.h"
#include "templates/fit.h"
#include "templates/read.h"

namespace rigc::templates::testing {

/// A catalogue that all tests of the binary share.
const catalog::Catalogue& catalogue();

/// A folder of its own below the test output; files are written into it.
class Folder {
 public:
  explicit Folder(const std::string& name);
  std::string write(const std::string& name, const std::string& text) const;  ///< gives the path
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// `rigc: 1`, name and version before the rest.
std::string with_head(const std::string& rest, const std::string& name = "case");

std::optional<Template> read_text(const std::string& text, Diagnostics& diagnostics);
std::optional<Expanded> expand_file(const std::string& path, Diagnostics& diagnostics,
                                    const std::vector<std::string>& folders = {});
std::optional<Expanded> expand_text(const std::string& text, Diagnostics& diagnostics);
std::optional<tags::TaggedSkeleton> place_text(const std::string& text, Diagnostics& diagnostics);

/// The numbers of all diagnostics, in order.
std::vector<int> numbers(const Diagnostics& diagnostics);

/// Index of a joint by its name; fails the test where there is none.
std::size_t joint_named(const tags::TaggedSkeleton& skeleton, const std::string& name);

/// Path of the biped of this source tree, and its template folder.
std::string biped_path();
std::string template_folder();

/// The skeleton of a placed template as if a model had it: bones named by `name_of(joint)`, empty
/// names left out together with their joints, the whole moved into the space of `ancestor`.
template <class NameOf>
tags::ForeignSkeleton as_model(const tags::TaggedSkeleton& skeleton, const math::Affine& ancestor,
                               NameOf name_of) {
  tags::ForeignSkeleton model;
  model.ancestor_world = ancestor;
  std::vector<int> bone_of(skeleton.joints.size(), -1);
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    tags::ForeignJoint bone;
    bone.name = name_of(skeleton.joints[i]);
    const int parent = skeleton.joints[i].parent;
    const int above = parent < 0 ? -1 : bone_of[static_cast<std::size_t>(parent)];
    if (bone.name.empty()) {
      bone_of[i] = above;
      continue;
    }
    bone.node = 100 + static_cast<int>(i);
    bone.parent = above;
    bone.in_skin = true;
    bone.rest = inverse(ancestor) * skeleton.world(i);
    bone_of[i] = static_cast<int>(model.joints.size());
    model.joints.push_back(bone);
  }
  return model;
}

/// Xbot's skeleton in its bind pose; nothing where the corpus is not there.
std::optional<tags::ForeignSkeleton> read_xbot();

}  // namespace rigc::templates::testing
