// SPDX-License-Identifier: MIT
// A template as it was written, checked on its own: format 1 with the span of everything. Lengths
// are in metres whatever the file's `units`. Made by read.h, used by expand.h. Test:
// tests/templates/read_test.cpp
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catalog/descriptor.h"
#include "catalog/shape.h"
#include "math/math.h"
#include "tags/tags.h"

namespace rigc::templates {

/// `if: $fingers >= 3`, `if: $stretch`, `if: not $stretch`: whether a joint, tag or part is there
/// at all.
struct Condition {
  enum class Operator : std::uint8_t {
    is_true,
    is_false,
    equal,
    not_equal,
    less,
    less_equal,
    greater,
    greater_equal
  };
  std::string parameter;  ///< without its `$`
  Operator op = Operator::is_true;
  Literal value;  ///< of a comparison
  Span span;
};

/// `orient: {aim: +y, toward: elbow, up: +z, up_toward: [0, 0, 1]}`.
struct Orient {
  math::Vec3 aim{0, 1, 0};  ///< the joint's axis that points at `toward`; unit, along x, y or z
  std::string toward;       ///< a joint; empty: the next joint of the chain, or the first child
  math::Vec3 up{0, 0, 1};   ///< the joint's axis that is turned to `up_toward`; unit, across `aim`
  math::Vec3 up_toward{0, 0, 1};  ///< direction in the template's model space
  Span span;
};

/// Where a joint stands, as written.
struct Placement {
  enum class Space : std::uint8_t { parent /* translate */, model /* at */ };
  Space space = Space::parent;
  math::Vec3 position;           ///< metres
  math::Quat rotation;           ///< in parent space
  std::optional<Orient> orient;  ///< in place of `rotation`
  math::Vec3 scale{1, 1, 1};
};

/// `guide: {between: [elbow, wrist], at: 0.5}`: moves along with both until it is moved itself.
struct Between {
  std::vector<std::string> joints;  ///< two names or labels
  double share = 0.5;               ///< of the way from the first to the second
  Span span;
};

/// A number that may come from a parameter.
struct Count {
  int value = 1;
  std::string parameter;  ///< without its `$`; empty: `value` counts
  Span span;
};

/// `chain: {count: 3, to: [0, 1.4, 0]}`: joints in a straight line, the first at the joint's own
/// place; or `chain: {count: 2, steps: [{translate: [0, 0.2, 0]}]}`: each placed below the one
/// before.
struct Chain {
  Count count;
  math::Vec3 to;                 ///< of the last joint, metres, model space; unless there are steps
  std::vector<math::Trs> steps;  ///< of the joints after the first, metres: none or count - 1
  Span span;
};

struct Command {
  tags::CommandTag tag;  ///< `feature` indexes Joint::features; arguments may be `$parameter`
  std::optional<Condition> condition;
};

struct Feature {
  tags::FeatureTag tag;
  bool on_written = false;  ///< else the catalogue's default counts
  std::optional<Condition> condition;
};

struct Joint {
  std::string name;
  std::string parent;  ///< a joint or label; empty: a root (of a part: hangs on `attach`)
  Placement placement;
  std::optional<Chain> chain;
  std::optional<Between> between;
  Identifiers ids;        ///< `global` empty: the template's
  bool optional = false;  ///< may be missing in a fitted model
  bool helper = false;    ///< not a bone: made by rigc where a fitted model has no such joint
  std::vector<std::string> was;  ///< earlier names, oldest first
  std::optional<std::uint64_t> uid;
  std::vector<std::uint64_t> earlier_uids;  ///< written behind `uid`
  bool mirrored = false;  ///< its frame is one of the mirrored side, as in a part with `mirror:`
  /// The joint on the other side (a name or label; empty: none), where names do not say it.
  std::optional<std::string> opposite;
  Span opposite_span;
  std::optional<Condition> condition;
  std::vector<Feature> features;
  std::vector<Command> commands;  ///< top to bottom
  Span span;                      ///< of the name
  Span parent_span;
};

/// Another template whose joints join this one.
struct Part {
  std::string reference;  ///< `parts/arm`
  std::string as;
  std::vector<std::string> was;  ///< earlier `as`, oldest first
  std::string attach;  ///< a joint or label of the outer template; empty: as the outer one's roots
  std::optional<int> mirror;  ///< 0 x, 1 y, 2 z: reflected at that plane of the outer model space
  math::Vec3 at;              ///< origin of the part in outer model space, metres
  math::Quat rotation;        ///< of the part in outer model space
  double size = 1;            ///< scales the part's positions
  std::vector<tags::Argument> with;
  std::vector<std::pair<std::string, std::string>>
      groups;  ///< needed group -> group of the outer template
  std::optional<Condition> condition;
  Span span;  ///< of the reference
  Span as_span, attach_span, groups_span;
};

struct Template {
  std::uint32_t file = 0;  ///< into Diagnostics::sources()
  std::string folder;      ///< of the file: where its parts are looked for first
  std::string reference;   ///< how it was asked for, never absolute: `biped.yaml`, `parts/arm`
  std::string digest;      ///< of the text
  std::string name;
  std::vector<std::string> was;  ///< names of templates whose uids it keeps, oldest first
  int version = 1;
  std::string description;
  std::string preview;
  std::string global;          ///< default global group
  double metres_per_unit = 1;  ///< of the file
  bool has_catalogue = false;  ///< `features:` was written
  std::vector<tags::FeatureDeclaration> features;
  std::vector<std::pair<std::string, int>> module_pins;
  std::vector<catalog::Parameter> parameters;
  std::vector<std::string> needs;                           ///< local groups of the outer template
  std::vector<std::pair<std::string, std::string>> groups;  ///< each with the one above it
  std::vector<Joint> joints;
  std::vector<Part> parts;
  std::vector<catalog::Shape> shapes;
  Span span;  ///< of the name

  const catalog::Parameter* find_parameter(std::string_view parameter) const;
  const tags::FeatureDeclaration* find_feature(std::string_view feature) const;
  /// The local group that a part's user names by `as` alone: the template's own name or an earlier
  /// one.
  bool is_main_group(std::string_view local) const;
};

}  // namespace rigc::templates
