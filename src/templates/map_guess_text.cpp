// SPDX-License-Identifier: MIT
// The file that a guess becomes. Test: tests/templates/map_guess_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/json.h"
#include "base/text.h"
#include "templates/map_guess.h"

namespace rigc::templates {
namespace {

constexpr std::size_t kColumn = 44;  // where comments begin

/// Needs no quotes in YAML.
bool is_plain(const std::string& name) {
  static const std::vector<std::string> kWords = {"true", "false", "null", "yes", "no",
                                                  "on",   "off",   "y",    "n"};
  if (starts_with(name, "/nodes/")) return true;
  std::string without_dots = name;
  std::replace(without_dots.begin(), without_dots.end(), '.', '_');
  return is_name(without_dots) && name[0] != '.' &&
         std::find(kWords.begin(), kWords.end(), lower(name)) == kWords.end();
}

std::string quoted(const std::string& name) { return is_plain(name) ? name : json::quote(name); }

/// What stands together in the file: a limb of one side.
std::string limb_of(const std::string& local) {
  const std::vector<std::string> words = words_of(local);
  if (words.empty()) return local;
  return words.size() > 1 && (words[1] == "l" || words[1] == "r") ? words[0] + "_" + words[1]
                                                                  : words[0];
}

class MapText {
 public:
  MapText(const Guess& guess, const tags::ForeignSkeleton& skeleton)
      : guess_(guess), skeleton_(skeleton), references_(bone_references(skeleton)) {}
  std::string run(const std::string& map_name, const std::string& model,
                  const std::string& template_name);

 private:
  void line(const std::string& text, const std::string& comment);
  void joint(const GuessLine& line);
  void missing(const GuessLine& line);
  void absent_group(const std::string& local, std::size_t begin, std::size_t end);
  void unmapped();
  const std::string& by(int bone) const { return references_[static_cast<std::size_t>(bone)]; }
  std::string shown(int bone) const;

  const Guess& guess_;
  const tags::ForeignSkeleton& skeleton_;
  std::vector<std::string> references_;
  std::string out_;
};

void MapText::line(const std::string& text, const std::string& comment) {
  out_ += "  " + text;
  if (!comment.empty())
    out_ += fmt::format("{:{}}# {}", "", text.size() < kColumn ? kColumn - text.size() : 1,
                        printable(comment, 200));
  out_ += "\n";
}

/// A bone in a comment: its name beside its number.
std::string MapText::shown(int bone) const {
  const std::string& name = skeleton_.joints[static_cast<std::size_t>(bone)].name;
  return by(bone) == name || name.empty()
             ? printable(by(bone), 60)
             : fmt::format("{} (\"{}\")", by(bone), printable(name, 60));
}

void MapText::missing(const GuessLine& entry) {
  const std::string key = entry.label.empty() ? entry.local : entry.local + "." + entry.label;
  std::vector<std::string> names;
  for (const int bone : entry.candidates) names.push_back(shown(bone));
  const std::string candidates = names.empty() ? "" : "; candidates: " + join(names, ", ");
  if (entry.required)
    line(key + ": ~", "not found: with ~ rigc makes a joint" + candidates);
  else if (entry.helper)
    line("# " + key + ":", "not found: rigc makes it");
  else
    line("# " + key + ":", "not found, not needed");
}

void MapText::joint(const GuessLine& entry) {
  if (entry.bones.empty()) return missing(entry);
  std::string text = entry.label.empty() ? entry.local : entry.local + "." + entry.label;
  std::vector<std::string> names;
  for (const int bone : entry.bones) names.push_back(quoted(by(bone)));
  text += entry.chain ? ": [" + join(names, ", ") + "]" : ": " + names.front();
  const std::string& name = skeleton_.joints[static_cast<std::size_t>(entry.bones.front())].name;
  const bool by_number = by(entry.bones.front()) != name && !name.empty();
  line(text, by_number ? fmt::format("{} (one of several \"{}\")", entry.why, printable(name, 40))
                       : entry.why);
}

/// Groups that the model has nothing of are one line.
void MapText::absent_group(const std::string& local, std::size_t begin, std::size_t end) {
  std::vector<std::string> labels;
  for (std::size_t i = begin; i < end; ++i)
    if (!guess_.lines[i].label.empty()) labels.push_back(guess_.lines[i].label);
  line("# " + local + ":",
       labels.empty() ? "not found, not needed" : "not found, not needed: ." + join(labels, ", ."));
}

void MapText::unmapped() {
  if (guess_.unmapped.empty()) return;
  out_ += fmt::format("\n# Bones that no line names ({}); they stay as they are:\n",
                      guess_.unmapped.size());
  for (const int bone : guess_.unmapped) {
    const int parent = skeleton_.joints[static_cast<std::size_t>(bone)].parent;
    out_ += "#   " + shown(bone) + (parent < 0 ? "" : ", below " + shown(parent)) + "\n";
  }
}

std::string MapText::run(const std::string& map_name, const std::string& model,
                         const std::string& template_name) {
  out_ = fmt::format("# A first guess at the bones of {} for the template {}, by rigc map.\n",
                     printable(model, 80), template_name);
  out_ +=
      "# Read it, correct it, keep it: `~` says that the model has no such bone; a bone without "
      "a name\n# of its own is /nodes/N, its number in the file.\n";
  for (const std::string& note : guess_.notes) out_ += "# " + printable(note, 200) + "\n";
  out_ += fmt::format("map: {}\njoints:\n", map_name);
  std::string limb;
  for (std::size_t i = 0; i < guess_.lines.size();) {
    const std::string& local = guess_.lines[i].local;
    std::size_t end = i;
    bool any = false;
    for (; end < guess_.lines.size() && guess_.lines[end].local == local; ++end)
      any = any || !guess_.lines[end].bones.empty() || guess_.lines[end].required ||
            guess_.lines[end].helper;
    if (!limb.empty() && limb != limb_of(local)) out_ += "\n";
    limb = limb_of(local);
    if (!any) absent_group(local, i, end);
    for (; any && i < end; ++i) joint(guess_.lines[i]);
    i = end;
  }
  unmapped();
  return std::move(out_);
}

}  // namespace

std::vector<std::string> bone_references(const tags::ForeignSkeleton& skeleton) {
  std::map<std::string, int> count;
  for (const tags::ForeignJoint& joint : skeleton.joints) ++count[joint.name];
  std::vector<std::string> out;
  for (const tags::ForeignJoint& joint : skeleton.joints) {
    const bool usable = !joint.name.empty() && count[joint.name] == 1 &&
                        !starts_with(joint.name, "/nodes/") &&
                        printable(joint.name, joint.name.size()) == joint.name &&
                        joint.name.find("{side}") == std::string::npos;
    out.push_back(usable ? joint.name : fmt::format("/nodes/{}", joint.node));
  }
  return out;
}

std::string map_text(const Guess& guess, const tags::ForeignSkeleton& skeleton,
                     const std::string& map_name, const std::string& model,
                     const std::string& template_name) {
  return MapText(guess, skeleton).run(map_name, model, template_name);
}

}  // namespace rigc::templates
