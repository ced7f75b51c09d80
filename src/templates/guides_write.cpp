// SPDX-License-Identifier: MIT
// Writing guides, for people to read and edit. Test: tests/templates/guides_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/text.h"
#include "templates/codes.h"
#include "templates/guides.h"
#include "templates/yaml_text.h"

namespace rigc::templates {
namespace {

using math::Vec3;

class Writer {
 public:
  Writer(const tags::TaggedSkeleton& skeleton, const Expanded& expanded, const Guides* before,
         bool centimetres, Diagnostics& diagnostics)
      : skeleton_(skeleton),
        before_(before),
        names_(guide_names(skeleton, &expanded)),
        centimetres_(centimetres),
        diagnostics_(diagnostics) {}
  std::string run(const std::vector<std::pair<std::string, std::string>>& controls);

 private:
  void head();
  void joints();
  void joint(std::size_t index, std::size_t width);
  void gone();
  void controls(const std::vector<std::pair<std::string, std::string>>& controls);
  std::string edit(const ControlEdit& edit) const;
  std::string numbers(const Literal& list, double factor) const;
  std::string place(Vec3 metres) const;
  const Guide* before(std::size_t joint) const;

  const tags::TaggedSkeleton& skeleton_;
  const Guides* before_;
  std::vector<std::string> names_;  ///< by joint
  bool centimetres_;
  Diagnostics& diagnostics_;
  std::string out_;
  std::set<const Guide*> written_;
};

/// A hundredth of a millimetre is as near as anybody puts a joint.
std::string Writer::place(Vec3 metres) const {
  const double unit = centimetres_ ? 100 : 1, decimals = centimetres_ ? 1e3 : 1e5;
  const auto text = [&](double x) {
    return number_text(std::nearbyint(x * unit * decimals) / decimals);
  };
  return fmt::format("[{}, {}, {}]", text(metres.x), text(metres.y), text(metres.z));
}

/// What an earlier file says of a joint, by any of its names.
const Guide* Writer::before(std::size_t joint) const {
  if (!before_) return nullptr;
  const tags::TaggedJoint& tagged = skeleton_.joints[joint];
  int number = 0;
  for (std::size_t i = 0; i < joint; ++i)
    number += skeleton_.joints[i].ids.local == tagged.ids.local ? 1 : 0;
  const std::string numbered = fmt::format("{}[{}]", tagged.ids.local, number);
  for (const Guide& guide : before_->joints)
    if (guide.name == names_[joint] || guide.name == to_text(tagged.key) ||
        (!tagged.ids.local.empty() && guide.name == numbered))
      return &guide;
  return nullptr;
}

void Writer::head() {
  out_ += fmt::format(
      "# Guides of {}: where its joints are and what its controls look like. Edit `at` to move a\n"
      "# joint; `fitted` says where it was, so that what you moved stays when this file is "
      "written\n"
      "# again. Build with `rigc build ... --guides FILE`.\n"
      "guides: {}\n",
      skeleton_.name, skeleton_.name);
  if (centimetres_) out_ += "units: centimetre\n";
  if (before_ && before_->mirror != Guides::Mirror::none)
    out_ += fmt::format("mirror: {}\n",
                        before_->mirror == Guides::Mirror::left_to_right   ? "left_to_right"
                        : before_->mirror == Guides::Mirror::right_to_left ? "right_to_left"
                                                                           : "both");
  else
    out_ += "# mirror: left_to_right       # what is moved on the left is moved on the right too\n";
}

void Writer::joint(std::size_t index, std::size_t width) {
  const Vec3 fitted = to_template(skeleton_.character, skeleton_.world(index).origin);
  const Guide* old = before(index);
  if (old) written_.insert(old);
  const std::string name = names_[index] + ":";
  if (skeleton_.joints[index].foreign_node >= 0) {
    out_ += fmt::format("  # {:<{}} {}  the model's own\n", name, width, place(fitted));
    if (old && old->moved())
      out_ += fmt::format("  {:<{}} {{at: {}}}\n", name, width, place(old->at));
    return;
  }
  if (old && old->moved() && !old->fitted && is_same_place(old->at, fitted)) {
    out_ += fmt::format("  {:<{}} {}\n", name, width, place(fitted));  // held where it is
    return;
  }
  const Vec3 at = old && old->moved() ? old->at : fitted;
  out_ += fmt::format("  {:<{}} {{at: {}, fitted: {}}}\n", name, width, place(at), place(fitted));
}

void Writer::joints() {
  std::size_t width = 0;
  for (const std::string& name : names_) width = std::max(width, name.size() + 1);
  out_ += "\njoints:\n";
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (!names_[i].empty()) joint(i, width);
  gone();
}

/// What was moved and is not there any more is not lost.
void Writer::gone() {
  if (!before_) return;
  for (const Guide& guide : before_->joints) {
    if (written_.count(&guide) != 0 || !guide.moved()) continue;
    diagnostics_.report(codes::kGuideGone, guide.span,
                        fmt::format("there is no joint \"{}\" any more", printable(guide.name, 60)),
                        "its place stays in the file as a comment");
    out_ += fmt::format("  # gone: {}: {{at: {}}}\n", printable(guide.name), place(guide.at));
  }
}

std::string Writer::numbers(const Literal& list, double factor) const {
  std::vector<std::string> texts;
  for (const Literal& item : list.items) texts.push_back(number_text(item.number * factor));
  return "[" + join(texts, ", ") + "]";
}

std::string Writer::edit(const ControlEdit& edit) const {
  std::vector<std::string> parts;
  for (const tags::Argument& argument : edit.with) {
    const Literal& value = argument.value;
    const bool length = argument.name == "offset" && centimetres_;
    const std::string text = value.kind == Literal::Kind::list   ? numbers(value, length ? 100 : 1)
                             : value.kind == Literal::Kind::text ? yaml_text(value.text)
                                                                 : number_text(value.number);
    parts.push_back(argument.name + ": " + text);
  }
  return fmt::format("  {}: {{{}}}\n", yaml_text(edit.control), join(parts, ", "));
}

void Writer::controls(const std::vector<std::pair<std::string, std::string>>& controls) {
  const bool edited = before_ && !before_->controls.empty();
  out_ += "\ncontrols:\n";
  if (edited)
    for (const ControlEdit& control : before_->controls) out_ += edit(control);
  out_ +=
      "  # Take the mark off a line to edit a control: another shape, size (times), offset (along\n"
      "  # its axes), rotate (degrees), color.\n";
  std::set<std::string> written;
  if (edited)
    for (const ControlEdit& control : before_->controls) written.insert(control.control);
  for (const auto& [control, shape] : controls)
    if (written.count(control) == 0)
      out_ += fmt::format("  # {}: {{shape: {}, size: 1}}\n", control, shape);
}

std::string Writer::run(const std::vector<std::pair<std::string, std::string>>& list) {
  head();
  joints();
  controls(list);
  return std::move(out_);
}

}  // namespace

std::string guides_text(const tags::TaggedSkeleton& skeleton, const Expanded& expanded,
                        const Guides* before, bool centimetres,
                        const std::vector<std::pair<std::string, std::string>>& controls,
                        Diagnostics& diagnostics) {
  return Writer(skeleton, expanded, before, centimetres, diagnostics).run(controls);
}

}  // namespace rigc::templates
