// SPDX-License-Identifier: MIT
// A template that is edited at random, as riggers edit theirs from version to version. It is kept
// as data, so that every edit leaves a template that builds, and so that what was renamed and moved
// is declared with `was:` as a rigger would.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "math/math.h"
#include "support/skeletons.h"

namespace rigc::test {

/// Index of one of some things.
template <class T>
std::size_t any(const std::vector<T>& items, Random& random) {
  return random.below(items.size());
}

struct EditOptions {
  bool turns = false;       ///< edits that turn the axes of controls, so that keys are converted
  std::size_t groups = 3;   ///< limbs to begin with
  std::size_t longest = 4;  ///< joints in one
};

class EditedTemplate {
 public:
  EditedTemplate(std::uint64_t seed, const EditOptions& options);

  /// The template, named `edited`, and the part that it uses, which belongs into `edited_part.yaml`
  /// beside it.
  std::string text() const;
  static std::string part_text();

  /// One random edit; says which. The version stays.
  std::string edit(Random& random);

  /// The content of this template as a version that follows `now`: its commands say where versions
  /// up to `now` had what they make.
  EditedTemplate returning_from(const EditedTemplate& now) const;

  int version = 100;

 private:
  using Holder = std::pair<std::string, std::string>;  ///< first name of a joint, command id
  struct Command {
    int serial = 0, family = 0;  ///< itself, and the first command that it took its nodes from
    std::string module, id;
    std::vector<std::pair<std::string, std::string>> with;
    std::vector<Holder> was;
    bool on = true;
    std::string feature;  ///< that it belongs to; empty: none
  };
  struct Joint {
    std::vector<std::string> names;  ///< oldest first, the last is its name
    int parent = -1;                 ///< index
    math::Vec3 at;
    double rotate = 0;  ///< degrees about x, in the parent's space
    std::string local, label;
    std::vector<Command> commands;
  };
  /// What drives the joints of a group, so that no two commands fight for one.
  enum class Drive { none, chain, controls, limb };

  static std::string text_of(const Command& command);
  static std::string on_control(const std::string& id);
  int serial() { return next_++; }
  void remember_places();
  std::string any_edit(Random& random);
  std::string number(const char* word) { return word + std::to_string(serial()); }
  std::string orient(Random& random) const;
  Drive any_drive(Random& random) const;
  Command make(const std::string& module, const std::string& id,
               std::vector<std::pair<std::string, std::string>> with);
  Command control(Random& random, bool drives);
  void drive(const std::string& local, Drive drive, Random& random);
  std::vector<std::size_t> joints_of(const std::string& local) const;
  std::vector<std::string> groups() const;
  Drive drive_of(const std::string& local) const;
  bool is_pinned(std::size_t joint) const;
  void take(std::size_t joint);
  static void drop_attributes(Joint& joint, const std::string& control);
  Command* any_command(Random& random, Joint** holder);

  std::string add_joint(Random& random);
  std::string insert_joint(Random& random);
  std::string remove_joint(Random& random);
  std::string rename_joint(Random& random);
  std::string reorder_joints(Random& random);
  std::string reorder_commands(Random& random);
  std::string retype(Random& random);
  std::string split_group(Random& random);
  std::string move_joint(Random& random);
  std::string move_command(Random& random);
  std::string rename_command(Random& random);
  std::string change_look(Random& random);
  std::string switch_command(Random& random);
  std::string change_feature(Random& random);
  std::string add_control(Random& random);
  std::string add_attribute(Random& random);
  std::string remove_command(Random& random);
  std::string rename_part(Random& random);
  std::string switch_part(Random& random);
  std::string turn_control(Random& random);

  EditOptions options_;
  std::vector<Joint> joints_;  ///< in any order; the first is the root
  std::vector<std::string> part_names_ = {"flag"};
  bool has_part_ = true;
  int next_ = 0;
  std::vector<std::pair<int, Holder>> places_;  ///< where commands of a family have ever been
};

}  // namespace rigc::test
