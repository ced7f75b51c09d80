// SPDX-License-Identifier: MIT
// A body with legs and feet that tests of legs rig.
#include "modules/legs_helpers.h"

#include <fmt/format.h>

#include "base/text.h"
#include "support/rig.h"

namespace rigc::test {
namespace {

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
    text.replace(at, what.size(), with);
  return text;
}

/// Each line of a list of commands as an item of `tags`.
std::string items(const std::string& commands) {
  std::string out;
  for (const std::string_view line : split(commands, '\n')) {
    if (!line.empty()) out += fmt::format("      - {}\n", line);
  }
  return out;
}

constexpr const char* kBody = R"(joints:
  - name: root
    at: [0, 0, 0]
    local: root
    label: root
    tags:
      - {command: root, with: {drive: on}}
  - name: hips
    parent: root
    at: [0, 0.95, 0]
    local: torso
    label: hips
    tags:
      - {command: control, id: body, with: {drive: off}}
      - {command: control, id: hips, with: {parent: "./control#body"}}
)";

constexpr const char* kLeg = R"(  - name: thigh_{s}
    parent: hips
    at: [{x}0.1, 0.9, 0]
    local: leg_{s}
    label: upper
    tags:
      - {command: ik_fk_limb, with: {start: ., middle: leg_{s}.lower, end: leg_{s}.end, bend: forward, ik_fk: {ik}}}
)";

constexpr const char* kFoot =
    R"(  - {name: shin_{s}, parent: thigh_{s}, at: [{x}0.105, 0.5, 0.02], local: leg_{s}, label: lower}
  - {name: foot_{s}, parent: shin_{s}, at: [{x}0.11, 0.08, -0.01], local: leg_{s}, label: end}
  - name: ball_{s}
    parent: foot_{s}
    at: [{x}0.125, 0.02, 0.11]
    local: leg_{s}
    label: ball
    tags:
      - {command: control, with: {parent: leg_{s}.end, translate: off}}
  - {name: tip_{s}, parent: ball_{s}, at: [{x}0.135, 0, 0.19], local: leg_{s}, label: tip}
)";

}  // namespace

std::string legs(const std::string& more, double ik_fk, const std::string& body_more) {
  std::string text = kBody + items(body_more);
  for (const auto& [side, sign] : {std::pair{"l", ""}, {"r", "-"}}) {
    std::string leg = kLeg + items(more) + kFoot;
    leg = replaced(replaced(replaced(leg, "{s}", side), "{x}", sign), "{ik}",
                   fmt::format("{}", ik_fk));
    text += leg;
  }
  return template_of(text);
}

}  // namespace rigc::test
