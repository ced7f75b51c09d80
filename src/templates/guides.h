// SPDX-License-Identifier: MIT
// Guides: a small YAML file that lies over a template (and a model) and says where a rigger has put
// joints and what controls look like. Places are in the template's model space: metres, X to the
// character's left, Y up, Z forward. The format by example is docs/guides.md. Test:
// tests/templates/guides_test.cpp
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/catalogue.h"
#include "templates/expand.h"

namespace rigc::templates {

/// Written places have five decimals of a metre: what differs by less is the same place.
bool is_same_place(math::Vec3 a, math::Vec3 b);

/// `arm_l.elbow: {at: [0.45, 1.43, -0.04], fitted: [0.45, 1.42, -0.04]}`, or `at` alone as a list.
struct Guide {
  std::string name;  ///< GROUP.LABEL, GROUP[INDEX], a joint's handle or key
  math::Vec3 at;
  std::optional<math::Vec3> fitted;  ///< where the joint stood when the file was written
  Span span;                         ///< of the name
  /// Whether somebody has moved it. Without `fitted` nobody knows: then it counts as moved.
  bool moved() const;
};

/// `arm_l.wrist/ik_fk_limb.ik: {shape: cube, size: 1.2}`: parameters of the module edit_shape.
struct ControlEdit {
  std::string control;               ///< a selector
  std::vector<tags::Argument> with;  ///< empty: as the template has it
  Span span;                         ///< of the selector
};

struct Guides {
  enum class Mirror : std::uint8_t { none, left_to_right, right_to_left, both };
  std::string template_name;
  Span template_span;
  bool centimetres = false;  ///< of the file; what is read is in metres
  Mirror mirror = Mirror::none;
  std::vector<Guide> joints;
  std::vector<ControlEdit> controls;
};

/// Reads a guides file; `file` is a number from Diagnostics::sources().
std::optional<Guides> read_guides(std::uint32_t file, const catalog::Catalogue& catalogue,
                                  Diagnostics& diagnostics);
/// The same by path.
std::optional<Guides> open_guides(const std::string& path, const catalog::Catalogue& catalogue,
                                  Diagnostics& diagnostics);

/// How a guides file calls the joints of a skeleton, by joint; empty: it has no guide.
/// `expanded` (of the same template; may be null) knows the handles of joints without a group.
std::vector<std::string> guide_names(const tags::TaggedSkeleton& skeleton,
                                     const Expanded* expanded);

/// What guides make of a skeleton.
struct Guided {
  Moves places;  ///< of joints that go elsewhere than they were fitted
  /// By joint: how far it was moved itself, in the rig's space.
  std::vector<std::optional<math::Vec3>> moved;
  std::vector<std::string> put_back;  ///< joints that were moved before and are not any more
};

/// Where guides put the joints of a skeleton that stands as it was fitted: those that were moved
/// themselves, by this file or, where it does not mention them, before (tags::Guiding::moved),
/// those that mirror one of the file, a limb whose first joint was moved, what hangs on it, and
/// joints between two others. Bones of a model stay; moving one is an error. `expanded` (may be
/// null) knows handles.
std::optional<Guided> find_moves(const Guides& guides, const Expanded* expanded,
                                 const tags::TaggedSkeleton& fitted, Diagnostics& diagnostics);

/// The template's own skeleton with moved joints: what `orient:` says is done anew. `placed`: as it
/// is without.
std::optional<tags::TaggedSkeleton> place(const Expanded& expanded,
                                          const tags::TaggedSkeleton& placed, const Moves& moves,
                                          Diagnostics& diagnostics);
/// The same for a skeleton whose template is not at hand: joints that lay along their bone with one
/// of their axes turn with it, others turn with what they hang on.
void move_joints(tags::TaggedSkeleton& skeleton, const Moves& moves);

/// Gives the edits of controls to the skeleton as commands; earlier ones of controls that the file
/// does not mention stay. Gives the controls that were edited before and are not any more.
std::vector<std::string> add_control_edits(const Guides& guides,
                                           const catalog::Catalogue& catalogue,
                                           tags::TaggedSkeleton& skeleton,
                                           Diagnostics& diagnostics);
/// The edits that a skeleton has from guides.
std::vector<ControlEdit> control_edits(const tags::TaggedSkeleton& skeleton);
/// Carries the edits of controls over to another version of the template's skeleton.
void keep_control_edits(tags::TaggedSkeleton& fresh, const tags::TaggedSkeleton& old,
                        const std::vector<int>& counterparts);

/// The text of a guides file for a skeleton as it was placed or fitted. What was moved or edited in
/// `before` (may be null) stays; a guide of it that no joint has any more becomes a comment and is
/// reported. `controls`: selectors of all controls, to choose from, and their shapes.
std::string guides_text(const tags::TaggedSkeleton& skeleton, const Expanded& expanded,
                        const Guides* before, bool centimetres,
                        const std::vector<std::pair<std::string, std::string>>& controls,
                        Diagnostics& diagnostics);

/// From the space of a rig to the template's model space, and back.
math::Vec3 to_template(const tags::Character& character, math::Vec3 rig);
math::Vec3 to_rig(const tags::Character& character, math::Vec3 metres);

}  // namespace rigc::templates
