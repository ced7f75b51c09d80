// SPDX-License-Identifier: MIT
// Reading guides: YAML to Guides, lengths in metres. Test: tests/templates/guides_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/files.h"
#include "base/text.h"
#include "base/yaml.h"
#include "templates/arguments.h"
#include "templates/codes.h"
#include "templates/format.h"
#include "templates/guides.h"

namespace rigc::templates {
namespace {

constexpr std::uint64_t kMostBytes = 4 << 20;
/// Written places have five decimals of a metre: what differs by less is the same place.
constexpr double kSamePlace = 0.6e-5;

class GuidesReader {
 public:
  GuidesReader(const yaml::Node& root, const catalog::Descriptor* descriptor,
               Diagnostics& diagnostics)
      : root_(root), descriptor_(descriptor), diagnostics_(diagnostics) {}
  Guides run();

 private:
  void read_head();
  void read_joints(const yaml::Node& node);
  void read_joint(const yaml::Node::Entry& entry);
  void read_controls(const yaml::Node& node);
  void read_control(const yaml::Node::Entry& entry);
  std::optional<math::Vec3> metres(const yaml::Node& node, std::string_view what);

  const yaml::Node& root_;
  const catalog::Descriptor* descriptor_;
  Diagnostics& diagnostics_;
  Guides out_;
};

std::optional<math::Vec3> GuidesReader::metres(const yaml::Node& node, std::string_view what) {
  const auto numbers = yaml::as_numbers(node, 3, what, diagnostics_);
  if (!numbers) return std::nullopt;
  const double unit = out_.centimetres ? 0.01 : 1;
  return math::Vec3{(*numbers)[0], (*numbers)[1], (*numbers)[2]} * unit;
}

void GuidesReader::read_head() {
  if (const yaml::Node* name = root_.find("guides")) {
    out_.template_span = name->span;
    out_.template_name = yaml::as_name(*name, "guides", diagnostics_).value_or("");
  } else {
    diagnostics_.report(codes::kMissingKey, root_.span, "guides need `guides: TEMPLATE`",
                        "`rigc guides TEMPLATE -o guides.yaml` writes them");
  }
  const auto word = [&](const char* key) -> std::string {
    const yaml::Node* node = root_.find(key);
    if (!node) return {};
    const auto text = yaml::as_text(*node, key, diagnostics_);
    const auto& words = guides_format().words(key);
    if (!text || std::find(words.begin(), words.end(), *text) != words.end())
      return text.value_or("");
    diagnostics_.report(codes::kUnknownWord, node->span,
                        fmt::format("{}: \"{}\" is not known", key, printable(*text, 60)),
                        suggest(*text, words));
    return {};
  };
  out_.centimetres = word("units") == "centimetre";
  const std::string mirror = word("mirror");
  out_.mirror = mirror == "left_to_right"           ? Guides::Mirror::left_to_right
                : mirror == "right_to_left"         ? Guides::Mirror::right_to_left
                : mirror == "both" || mirror == "x" ? Guides::Mirror::both
                                                    : Guides::Mirror::none;
}

void GuidesReader::read_joint(const yaml::Node::Entry& entry) {
  Guide guide;
  guide.name = entry.key;
  guide.span = entry.key_span;
  std::optional<math::Vec3> at;
  if (entry.value.is_sequence()) {
    at = metres(entry.value, entry.key);
  } else {
    if (!yaml::check_section(entry.value, guide_format(), diagnostics_)) return;
    if (const yaml::Node* fitted = entry.value.find("fitted"))
      guide.fitted = metres(*fitted, "fitted");
    if (const yaml::Node* place = entry.value.find("at"))
      at = metres(*place, "at");
    else
      at = guide.fitted;
    if (!at && entry.value.entries.empty())
      diagnostics_.report(codes::kMissingKey, entry.key_span, "a guide needs `at: [x, y, z]`");
  }
  if (!at) return;
  guide.at = *at;
  out_.joints.push_back(std::move(guide));
}

void GuidesReader::read_joints(const yaml::Node& node) {
  if (node.is_null()) return;
  if (!node.is_map()) {
    diagnostics_.report(codes::kBadGuide, node.span, "`joints` is a map",
                        "write `arm_l.elbow: [0.45, 1.43, -0.04]`");
    return;
  }
  for (const yaml::Node::Entry& entry : node.entries) read_joint(entry);
}

void GuidesReader::read_control(const yaml::Node::Entry& entry) {
  if (!yaml::check_section(entry.value, control_edit_format(), diagnostics_)) return;
  ControlEdit edit;
  edit.control = entry.key;
  edit.span = entry.key_span;
  for (const yaml::Node::Entry& argument : entry.value.entries) {
    const catalog::Parameter* parameter = descriptor_ ? descriptor_->find(argument.key) : nullptr;
    auto value = literal_from(argument.value, diagnostics_);
    if (!parameter || !value || !check_value(*parameter, *value, diagnostics_)) continue;
    to_metres(*parameter, out_.centimetres ? 0.01 : 1, *value);
    edit.with.push_back({argument.key, argument.key_span, *std::move(value)});
  }
  out_.controls.push_back(std::move(edit));
}

void GuidesReader::read_controls(const yaml::Node& node) {
  if (node.is_null()) return;
  if (!node.is_map()) {
    diagnostics_.report(codes::kBadGuide, node.span, "`controls` is a map",
                        "write `arm_l.wrist/control: {size: 1.2}`");
    return;
  }
  for (const yaml::Node::Entry& entry : node.entries) read_control(entry);
}

Guides GuidesReader::run() {
  read_head();
  if (const yaml::Node* joints = root_.find("joints")) read_joints(*joints);
  if (const yaml::Node* controls = root_.find("controls")) read_controls(*controls);
  return std::move(out_);
}

}  // namespace

bool is_same_place(math::Vec3 a, math::Vec3 b) {
  const math::Vec3 way = a - b;
  return std::max({way.x, -way.x, way.y, -way.y, way.z, -way.z}) < kSamePlace;
}

bool Guide::moved() const { return !fitted || !is_same_place(at, *fitted); }

std::optional<Guides> read_guides(std::uint32_t file, const catalog::Catalogue& catalogue,
                                  Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.errors();
  const auto root = yaml::read(file, diagnostics);
  if (!root) return std::nullopt;
  if (!yaml::check_section(*root, guides_format(), diagnostics) && !root->is_map())
    return std::nullopt;
  Guides guides = GuidesReader(*root, catalogue.find("edit_shape"), diagnostics).run();
  if (diagnostics.errors() != errors_before) return std::nullopt;
  return guides;
}

std::optional<Guides> open_guides(const std::string& path, const catalog::Catalogue& catalogue,
                                  Diagnostics& diagnostics) {
  auto text = read_file(path, kMostBytes, diagnostics);
  if (!text) return std::nullopt;
  return read_guides(diagnostics.sources().add(path, *std::move(text)), catalogue, diagnostics);
}

}  // namespace rigc::templates
