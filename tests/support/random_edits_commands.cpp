// SPDX-License-Identifier: MIT
// Random edits of a template: its commands and its part.
#include <fmt/format.h>

#include <algorithm>

#include "support/random_edits.h"

namespace rigc::test {
namespace {

void set(std::vector<std::pair<std::string, std::string>>& with, const std::string& name,
         const std::string& value) {
  for (auto& [key, now] : with) {
    if (key != name) continue;
    now = value;
    return;
  }
  with.emplace_back(name, value);
}

}  // namespace

std::string EditedTemplate::move_command(Random& random) {
  Joint* from = nullptr;
  Command* command = any_command(random, &from);
  if (!command || command->module == "attribute" || command->module == "root") return "";
  const bool drives_own = command->module == "control" && command->with.front().second == "on";
  Joint& to = joints_[any(joints_, random)];
  if (&to == from || drives_own) return "";
  const bool has_attribute =
      std::any_of(from->commands.begin(), from->commands.end(), [&](const Command& one) {
        return one.module == "attribute" && one.with.front().second == on_control(command->id);
      });
  if (has_attribute) return "";
  Command moved = *command;
  moved.was.emplace_back(from->names.front(), moved.id);
  from->commands.erase(from->commands.begin() + (command - from->commands.data()));
  to.commands.push_back(std::move(moved));
  return "command moved";
}

std::string EditedTemplate::rename_command(Random& random) {
  Joint* holder = nullptr;
  Command* command = any_command(random, &holder);
  if (!command) return "";
  const std::string id = number("id");
  for (Command& other : holder->commands)
    if (other.module == "attribute" && other.with.front().second == on_control(command->id))
      other.with.front().second = on_control(id);
  command->was.emplace_back(holder->names.front(), command->id);
  command->id = id;
  return "command renamed";
}

std::string EditedTemplate::change_look(Random& random) {
  Joint* holder = nullptr;
  Command* command = any_command(random, &holder);
  if (!command || (command->module != "control" && command->module != "fk_chain")) return "";
  const char* shapes[] = {"circle", "square", "cube", "sphere"};
  set(command->with, "shape", shapes[random.below(4)]);
  set(command->with, "color", random.chance(0.5) ? "red" : "green");
  const char* axes[] = {"x", "y", "z"};
  set(command->with, "axis", axes[random.below(3)]);
  return "look changed";
}

std::string EditedTemplate::switch_command(Random& random) {
  Joint* holder = nullptr;
  Command* command = any_command(random, &holder);
  if (!command || command->module == "root") return "";
  command->on = !command->on;
  // What is on a control that is not made cannot be made either.
  for (Command& other : holder->commands)
    if (other.module == "attribute" && other.with.front().second == on_control(command->id))
      other.on = command->on;
  if (command->module == "attribute") {
    for (const Command& other : holder->commands)
      if (command->with.front().second == on_control(other.id) && !other.on) command->on = false;
  }
  return "command switched";
}

std::string EditedTemplate::change_feature(Random& random) {
  Joint* holder = nullptr;
  Command* command = any_command(random, &holder);
  if (!command || command->module == "root") return "";
  // Each is a feature of its own: it is on where its command is.
  command->feature = command->feature.empty() ? number("feature") : "";
  return "feature changed";
}

std::string EditedTemplate::add_control(Random& random) {
  auto& joint = joints_[any(joints_, random)];
  joint.commands.push_back(control(random, false));
  return "control added";
}

std::string EditedTemplate::add_attribute(Random& random) {
  Joint* holder = nullptr;
  Command* command = any_command(random, &holder);
  if (!command || command->module != "control" || !command->on) return "";
  Command made = make("attribute", number("a"), {});
  made.with = {{"on", on_control(command->id)}, {"attribute", number("n")}};
  made.with.emplace_back("min", "-5");
  made.with.emplace_back("max", "5");
  holder->commands.push_back(std::move(made));
  return "attribute added";
}

std::string EditedTemplate::remove_command(Random& random) {
  Joint* holder = nullptr;
  Command* command = any_command(random, &holder);
  if (!command || command->module == "root") return "";
  const std::string id = command->id;
  holder->commands.erase(holder->commands.begin() + (command - holder->commands.data()));
  drop_attributes(*holder, id);
  return "command removed";
}

std::string EditedTemplate::rename_part(Random&) {
  if (!has_part_) return "";
  part_names_.push_back(number("part"));
  return "part renamed";
}

std::string EditedTemplate::switch_part(Random&) {
  has_part_ = !has_part_;
  return has_part_ ? "part added" : "part removed";
}

std::string EditedTemplate::turn_control(Random& random) {
  Joint* holder = nullptr;
  Command* command = any_command(random, &holder);
  if (!command || !options_.turns) return "";
  if (command->module == "control" || command->module == "fk_chain")
    set(command->with, "orient", orient(random));
  else if (command->module == "ik_fk_limb")
    set(command->with, "ik_orient", orient(random));
  else
    holder->rotate += random.chance(0.5) ? 90 : random.number(-90, 90);
  return "axes turned";
}

}  // namespace rigc::test
