// SPDX-License-Identifier: MIT
// Random edits of a template: its joints.
#include "support/random_edits.h"

#include <fmt/format.h>

#include <algorithm>

namespace rigc::test {
namespace {

using math::Vec3;

std::string list_of(Vec3 v) { return fmt::format("[{:.4f}, {:.4f}, {:.4f}]", v.x, v.y, v.z); }

}  // namespace

EditedTemplate::EditedTemplate(std::uint64_t seed, const EditOptions& options) : options_(options) {
  Random random(seed);
  joints_.push_back({{"root"}, -1, {0, 0, 0}, 0, "base", "root", {}});
  Command root = make("root", "root", {{"drive", "on"}});
  joints_[0].commands.push_back(root);
  for (std::size_t g = 0; g < options.groups; ++g) {
    const std::string local = number("g");
    const std::size_t count = 3 + random.below(options.longest - 2);
    int parent = static_cast<int>(random.below(joints_.size()));
    Vec3 at = joints_[static_cast<std::size_t>(parent)].at + random.vector(0.4);
    const Vec3 way = math::normalised(random.vector(1));  // one draw a statement
    const Vec3 step = way * random.number(0.15, 0.4);
    for (std::size_t i = 0; i < count; ++i) {
      joints_.push_back({{number("j")}, parent, at, 0, local, "l" + std::to_string(i), {}});
      parent = static_cast<int>(joints_.size()) - 1;
      at = at + step + random.vector(0.05);
    }
    const auto chosen = any_drive(random);
    drive(local, chosen, random);
  }
}

std::string EditedTemplate::on_control(const std::string& id) { return "\"./control#" + id + "\""; }

std::string EditedTemplate::text() const {
  std::string out = fmt::format("rigc: 1\nname: edited\nversion: {}\njoints:\n", version);
  for (const Joint& joint : joints_) {
    out += fmt::format("  - name: {}\n    at: {}\n    local: {}\n    label: {}\n",
                       joint.names.back(), list_of(joint.at), joint.local, joint.label);
    if (joint.names.size() > 1) {
      std::string was;
      for (std::size_t i = 0; i + 1 < joint.names.size(); ++i)
        was += (i ? ", " : "") + joint.names[i];
      out += "    was: [" + was + "]\n";
    }
    if (joint.rotate != 0) out += fmt::format("    rotate: [{:.2f}, 0, 0]\n", joint.rotate);
    if (joint.parent >= 0)
      out += fmt::format("    parent: {}\n",
                         joints_[static_cast<std::size_t>(joint.parent)].names.back());
    if (!joint.commands.empty()) out += "    tags:\n";
    for (const Command& command : joint.commands) {
      if (command.feature.empty())
        out += "      - " + text_of(command) + "\n";
      else
        out += fmt::format("      - {{feature: {}, on: {}, commands: [{}]}}\n", command.feature,
                           command.on ? "on" : "off", text_of(command));
    }
  }
  if (!has_part_) return out;
  std::string was;
  for (std::size_t i = 0; i + 1 < part_names_.size(); ++i) was += (i ? ", " : "") + part_names_[i];
  return out + fmt::format("parts:\n  - {{template: edited_part, as: {}, attach: root{}}}\n",
                           part_names_.back(), was.empty() ? "" : ", was: [" + was + "]");
}

std::string EditedTemplate::text_of(const Command& command) {
  std::string out = fmt::format("{{command: {}, id: {}", command.module, command.id);
  if (!command.on && command.feature.empty()) out += ", \"on\": off";
  std::string was, with;
  for (const auto& [holder, id] : command.was) was += (was.empty() ? "" : ", ") + holder + "/" + id;
  for (const auto& [name, value] : command.with)
    with += fmt::format("{}\"{}\": {}", with.empty() ? "" : ", ", name, value);
  if (!was.empty()) out += ", was: [" + was + "]";
  if (!with.empty()) out += ", with: {" + with + "}";
  return out + "}";
}

std::string EditedTemplate::part_text() {
  return R"(rigc: 1
name: edited_part
version: 1
joints:
  - name: pole
    at: [0, 0, -0.5]
    local: edited_part
    label: pole
    tags:
      - command: control
        with: {shape: square, size: 0.2}
  - name: cloth
    parent: pole
    at: [0, 0.5, -0.5]
    local: edited_part
    label: cloth
    tags:
      - command: control
        with: {shape: circle, size: 0.1}
      - command: attribute
        with: {attribute: wind, min: -5, max: 5}
)";
}

std::string EditedTemplate::orient(Random& random) const {
  const char* words[] = {"character", "world", "joint", "bone"};
  return words[random.below(options_.turns ? 4 : 2)];
}

/// A limb's FK controls lie along bones: they turn with joints that come and go.
EditedTemplate::Drive EditedTemplate::any_drive(Random& random) const {
  return static_cast<Drive>(1 + random.below(options_.turns ? 3 : 2));
}

EditedTemplate::Command EditedTemplate::make(
    const std::string& module, const std::string& id,
    std::vector<std::pair<std::string, std::string>> with) {
  const int number = serial();
  return {number, number, module, id, std::move(with), {}, true, {}};
}

EditedTemplate::Command EditedTemplate::control(Random& random, bool drives) {
  Command out = make("control", number("c"), {});
  out.with = {{"drive", drives ? "on" : "off"},
              {"size", fmt::format("{:.2f}", random.number(0.1, 1))}};
  out.with.emplace_back("orient", orient(random));
  return out;
}

std::vector<std::size_t> EditedTemplate::joints_of(const std::string& local) const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < joints_.size(); ++i)
    if (joints_[i].local == local) found.push_back(i);
  const auto depth = [&](std::size_t joint) {
    int count = 0;
    for (int at = static_cast<int>(joint); at >= 0;
         at = joints_[static_cast<std::size_t>(at)].parent)
      ++count;
    return count;
  };
  std::sort(found.begin(), found.end(),
            [&](std::size_t a, std::size_t b) { return depth(a) < depth(b); });
  return found;
}

std::vector<std::string> EditedTemplate::groups() const {
  std::vector<std::string> out;
  for (const Joint& joint : joints_)
    if (joint.local != "base" && std::find(out.begin(), out.end(), joint.local) == out.end())
      out.push_back(joint.local);
  return out;
}

/// Commands of other joints may drive a group: they name it.
EditedTemplate::Drive EditedTemplate::drive_of(const std::string& local) const {
  for (const Joint& joint : joints_) {
    for (const Command& command : joint.commands) {
      for (const auto& [name, value] : command.with) {
        if (name == "joints" && value == "\"" + local + "[*]\"") return Drive::chain;
        if (name == "start" && value == local + ".l0") return Drive::limb;
        if (name == "drive" && value == "on" && joint.local == local) return Drive::controls;
      }
    }
  }
  return Drive::none;
}

void EditedTemplate::drive(const std::string& local, Drive drive, Random& random) {
  const std::vector<std::size_t> joints = joints_of(local);
  Joint& first = joints_[joints.front()];
  if (drive == Drive::controls) {
    for (const std::size_t joint : joints) {
      Command made = control(random, true);
      joints_[joint].commands.insert(joints_[joint].commands.begin(), std::move(made));
    }
  } else if (drive == Drive::chain) {
    Command made = make("fk_chain", number("f"), {});
    made.with = {{"joints", "\"" + local + "[*]\""}, {"orient", orient(random)}};
    first.commands.push_back(std::move(made));
  } else if (drive == Drive::limb) {
    Command made = make("ik_fk_limb", number("i"), {});
    for (std::size_t i = 0; i < 3; ++i) joints_[joints[i]].label = "l" + std::to_string(i);
    for (std::size_t i = 3; i < joints.size(); ++i) joints_[joints[i]].label = number("l");
    made.with = {{"start", local + ".l0"},
                 {"middle", local + ".l1"},
                 {"end", local + ".l2"},
                 {"bend", "forward"},
                 {"ik_fk", fmt::format("{:.2f}", random.number(0, 1))}};
    first.commands.push_back(std::move(made));
  }
}

/// Joints that a limb names cannot go.
bool EditedTemplate::is_pinned(std::size_t joint) const {
  return joint == 0 || drive_of(joints_[joint].local) == Drive::limb;
}

/// Takes a joint away; what hung on it hangs on its parent.
void EditedTemplate::take(std::size_t index) {
  const int parent = joints_[index].parent;
  joints_.erase(joints_.begin() + static_cast<std::ptrdiff_t>(index));
  for (Joint& joint : joints_) {
    if (joint.parent == static_cast<int>(index)) joint.parent = parent;
    if (joint.parent > static_cast<int>(index)) --joint.parent;
  }
}

/// Attributes of a control that is no longer made.
void EditedTemplate::drop_attributes(Joint& joint, const std::string& control) {
  std::erase_if(joint.commands, [&](const Command& one) {
    return one.module == "attribute" && one.with.front().second == on_control(control);
  });
}

EditedTemplate::Command* EditedTemplate::any_command(Random& random, Joint** holder) {
  Joint& joint = joints_[any(joints_, random)];
  if (joint.commands.empty()) return nullptr;
  *holder = &joint;
  return &joint.commands[any(joint.commands, random)];
}

std::string EditedTemplate::add_joint(Random& random) {
  const std::size_t parent = any(joints_, random);
  Joint joint{{number("j")},
              static_cast<int>(parent),
              joints_[parent].at + random.vector(0.3),
              0,
              number("g"),
              "l0",
              {}};
  joint.commands.push_back(control(random, true));
  joints_.push_back(std::move(joint));
  return "joint added";
}

std::string EditedTemplate::insert_joint(Random& random) {
  const auto all = groups();
  if (all.empty()) return "";
  const std::string local = all[any(all, random)];
  const Drive drive = drive_of(local);
  if (drive == Drive::limb) return "";
  const auto joints = joints_of(local);
  const std::size_t above = joints[any(joints, random)];
  Joint joint{{number("j")},
              static_cast<int>(above),
              joints_[above].at + random.vector(0.1),
              0,
              local,
              number("l"),
              {}};
  if (drive == Drive::controls) joint.commands.push_back(control(random, true));
  const int index = static_cast<int>(joints_.size());
  for (Joint& below : joints_)
    if (below.parent == static_cast<int>(above) && below.local == local) below.parent = index;
  joints_.push_back(std::move(joint));
  return "joint inserted";
}

std::string EditedTemplate::remove_joint(Random& random) {
  const std::size_t joint = any(joints_, random);
  if (is_pinned(joint)) return "";
  const std::string& local = joints_[joint].local;
  if (joints_of(local).size() == 1 && drive_of(local) == Drive::chain) return "";
  // Joints between two of a group go from between; the command of a chain goes with its joint.
  take(joint);
  return "joint removed";
}

std::string EditedTemplate::rename_joint(Random& random) {
  joints_[any(joints_, random)].names.push_back(number("renamed"));
  return "joint renamed";
}

std::string EditedTemplate::reorder_joints(Random& random) {
  if (joints_.size() < 3) return "";
  const std::size_t a = 1 + random.below(joints_.size() - 1);
  const std::size_t b = 1 + random.below(joints_.size() - 1);
  std::swap(joints_[a], joints_[b]);
  for (Joint& joint : joints_) {
    if (joint.parent == static_cast<int>(a))
      joint.parent = static_cast<int>(b);
    else if (joint.parent == static_cast<int>(b))
      joint.parent = static_cast<int>(a);
  }
  return "joints reordered";
}

std::string EditedTemplate::reorder_commands(Random& random) {
  std::vector<Command>& commands = joints_[any(joints_, random)].commands;
  if (commands.size() < 2) return "";
  const std::size_t at = random.below(commands.size() - 1);
  // An attribute comes after the control that it is on.
  if (commands[at + 1].module == "attribute") return "";
  std::swap(commands[at], commands[at + 1]);
  return "commands reordered";
}

/// Another module drives a group: under the same id, declared with `was:`, or as something new.
std::string EditedTemplate::retype(Random& random) {
  const auto all = groups();
  if (all.empty()) return "";
  const std::string local = all[any(all, random)];
  const auto joints = joints_of(local);
  const Drive now = drive_of(local);
  const auto next = any_drive(random);
  if (next == now || (next == Drive::limb && joints.size() < 3)) return "";
  if (next == Drive::limb) {
    // A limb wants its three joints in one line.
    for (std::size_t i = 1; i < 3; ++i)
      if (joints_[joints[i]].parent != static_cast<int>(joints[i - 1])) return "";
  }
  std::vector<std::pair<std::string, Command>> gone;
  for (Joint& joint : joints_) {
    const auto drives = [&](const Command& command) {
      return std::any_of(command.with.begin(), command.with.end(), [&](const auto& argument) {
        const auto& [name, value] = argument;
        return (name == "joints" && value == "\"" + local + "[*]\"") ||
               (name == "start" && value == local + ".l0") ||
               (name == "drive" && value == "on" && joint.local == local);
      });
    };
    const std::size_t before = gone.size();
    for (const Command& command : joint.commands)
      if (drives(command)) gone.emplace_back(joint.names.front(), command);
    std::erase_if(joint.commands, drives);
    for (std::size_t i = before; i < gone.size(); ++i) drop_attributes(joint, gone[i].second.id);
  }
  drive(local, next, random);
  // Modules orient their controls each in its way: keys that follow are converted.
  if (gone.size() != 1 || next == Drive::controls || !options_.turns) return "retyped";
  Joint& first = joints_[joints.front()];
  Command& command = first.commands.back();
  const auto& [holder, before] = gone.front();
  command.family = before.family;
  if (holder == first.names.front() && random.chance(0.5)) {
    command.id = before.id;
    return "retyped under its id";
  }
  command.was.emplace_back(holder, before.id);
  return "retyped, declared";
}

std::string EditedTemplate::split_group(Random& random) {
  const auto all = groups();
  if (all.empty()) return "";
  const std::string local = all[any(all, random)];
  const auto joints = joints_of(local);
  const Drive drive = drive_of(local);
  if (joints.size() < 4 || drive == Drive::limb) return "";
  const std::string second = number("g");
  for (std::size_t i = 2; i < joints.size(); ++i) joints_[joints[i]].local = second;
  if (drive != Drive::chain) return "group split";
  for (const Joint& joint : joints_) {
    for (const Command& command : joint.commands) {
      const auto& value = command.with.front().second;
      if (command.module != "fk_chain" || value != "\"" + local + "[*]\"") continue;
      Command made = command;
      made.serial = serial();
      made.id = number("f");
      made.was = command.was;
      made.was.emplace_back(joint.names.front(), command.id);
      made.with.front().second = "\"" + second + "[*]\"";
      joints_[joints[2]].commands.push_back(std::move(made));
      return "chain split";
    }
  }
  return "group split";
}

std::string EditedTemplate::move_joint(Random& random) {
  Joint& joint = joints_[any(joints_, random)];
  joint.at = joint.at + random.vector(0.1);
  return "joint moved";
}

std::string EditedTemplate::edit(Random& random) {
  remember_places();
  std::string done = any_edit(random);
  remember_places();
  return done;
}

std::string EditedTemplate::any_edit(Random& random) {
  using Edit = std::string (EditedTemplate::*)(Random&);
  const Edit edits[] = {&EditedTemplate::add_joint,      &EditedTemplate::insert_joint,
                        &EditedTemplate::remove_joint,   &EditedTemplate::rename_joint,
                        &EditedTemplate::reorder_joints, &EditedTemplate::reorder_commands,
                        &EditedTemplate::retype,         &EditedTemplate::split_group,
                        &EditedTemplate::move_joint,     &EditedTemplate::move_command,
                        &EditedTemplate::rename_command, &EditedTemplate::change_look,
                        &EditedTemplate::switch_command, &EditedTemplate::change_feature,
                        &EditedTemplate::add_control,    &EditedTemplate::add_attribute,
                        &EditedTemplate::remove_command, &EditedTemplate::rename_part,
                        &EditedTemplate::switch_part,    &EditedTemplate::turn_control};
  // Templates of a hundred versions do not grow without end.
  while (joints_.size() > 16) {
    const std::string done = remove_joint(random);
    if (!done.empty()) return done;
  }
  while (true) {
    const Edit chosen = edits[random.below(std::size(edits))];
    const std::string done = (this->*chosen)(random);
    if (!done.empty()) return done;
  }
}

void EditedTemplate::remember_places() {
  for (const Joint& joint : joints_) {
    for (const Command& command : joint.commands) {
      const std::pair<int, Holder> place{command.family, {joint.names.front(), command.id}};
      if (std::find(places_.begin(), places_.end(), place) == places_.end())
        places_.push_back(place);
    }
  }
}

EditedTemplate EditedTemplate::returning_from(const EditedTemplate& now) const {
  EditedTemplate out = *this;
  out.version = now.version + 1;
  out.next_ = std::max(next_, now.next_);
  out.places_ = now.places_;
  for (Joint& joint : out.joints_) {
    for (Command& command : joint.commands) {
      command.was.clear();
      for (const auto& [family, place] : now.places_)
        if (family == command.family && place != Holder{joint.names.front(), command.id})
          command.was.push_back(place);
    }
  }
  return out;
}

}  // namespace rigc::test
