// SPDX-License-Identifier: MIT
// What the steps of expanding share: the uses of templates, with their handles and groups, and the
// joints on their way to ExpandedJoint. Only for the expand*.cpp of this folder. Test:
// tests/templates/expand_test.cpp
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "templates/arguments.h"
#include "templates/expand.h"

namespace rigc::templates {

inline constexpr int kRoot = -1;       ///< hangs under nothing
inline constexpr int kAbsent = -2;     ///< taken away by a condition
inline constexpr int kAmbiguous = -3;  ///< a label of several joints
inline constexpr int kUnknown = -4;

/// What a template's words mean: names, labels and GROUP.LABEL of its joints and of its parts'
/// joints.
struct Handles {
  std::unordered_map<std::string, int> names;
  std::unordered_map<std::string, int> labels;
  /// Index of a joint, kAbsent, kAmbiguous or kUnknown.
  int find(const std::string& word) const;
  void add_label(const std::string& word, int joint);
};

/// One use of a template; the same index as its Instance.
struct Use {
  const Template* source = nullptr;
  const Part* part = nullptr;  ///< null: the main template
  int outer = -1;
  std::size_t depth = 0;
  std::string prefix;  ///< of joint names: `arm_l_hand_`
  Environment environment;
  Handles handles;
  int attach = kRoot;
  std::vector<int> joints;    ///< by index into source->joints; kAbsent
  std::vector<int> parts;     ///< by index into source->parts: uses; kAbsent
  bool mirrored = false;      ///< as seen in the main template's space
  bool lacks_joints = false;  ///< a part of it, or of one of these, is missing: that is reported
  int template_index = 0;
};

struct RawJoint {
  ExpandedJoint result;
  const Joint* source = nullptr;
  int use = 0;
  int parent = kRoot;
  int between[2] = {-1, -1};     ///< joints whose guides take it along; -1: none
  std::vector<bool> on_written;  ///< for each feature tag
};

class Expander {
 public:
  Expander(const Template& main, Library& library, const catalog::Catalogue& catalogue,
           Diagnostics& diagnostics)
      : main_(main), library_(library), catalogue_(catalogue), diagnostics_(diagnostics) {}
  std::optional<Expanded> run();

 private:
  // expand.cpp: parts and joints
  void add_use(const Template& source, const Part* part, int outer);
  void add_parts(int use);
  void add_joints(int use);
  void add_joint(int use, std::size_t index);
  void leave_out(const Part& part, int use);
  bool fits(const Span& span);
  int template_index(const Template& source);

  // expand_parameters.cpp
  bool bind_parameters(int use);
  bool bind_argument(Use& use, const Use& outer, const tags::Argument& argument);
  void check_groups(const Use& use);

  // expand_names.cpp
  void register_handles(int joint);
  std::string group_in_outer(const Use& use, const std::string& local) const;
  bool is_own_group(const Use& use, const std::string& local) const;
  std::string final_group(int use, std::string local) const;
  void add_group(int use, std::string local);
  void resolve_parents();
  void resolve_between();
  int resolve(int use, const std::string& word, const Span& span, const char* key);
  void find_absent(bool report_none_left);

  // expand_tags.cpp
  void add_tags(RawJoint& joint);
  void add_command(RawJoint& joint, const Command& command, int feature);
  void bind_value(const Use& use, const catalog::Descriptor& descriptor, int pinned,
                  const catalog::Parameter& parameter, tags::Argument& argument);
  void rename(int use, const catalog::Parameter& parameter, Literal& value);
  void collect_features();
  void check_declared_outside(const Use& use, const tags::FeatureTag& tag);

  // expand_keys.cpp
  void assign_keys();
  std::string path(const Use& use) const;
  std::vector<std::string> earlier_paths(const Use& use) const;
  std::string earlier_holder(const RawJoint& joint, const std::string& was) const;
  void pair_sides();
  void pair_uses(int a, int b);
  void pair_written();

  // expand.cpp: the result
  std::vector<int> order() const;
  Expanded finish();

  const Template& main_;
  Library& library_;
  const catalog::Catalogue& catalogue_;
  Diagnostics& diagnostics_;
  std::vector<Use> uses_;
  std::vector<RawJoint> joints_;
  std::vector<const Template*> templates_;
  tags::TaggedSkeleton skeleton_;
  std::set<std::string> groups_;  ///< of parts, that are in skeleton_.groups
  std::size_t joint_count_ = 0;   ///< with all joints of chains
  bool full_ = false;
  std::set<const Part*> left_out_;  ///< that were reported
  /// Tags that were reported: a part that is used twice has its mistakes once.
  std::set<std::pair<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>>> undeclared_;
};

}  // namespace rigc::templates
