// SPDX-License-Identifier: MIT
// Shipped templates built in memory, all of whose controls can be moved.
#include "motion/moving_helpers.h"

#include <doctest/doctest.h>
#include <cmath>

#include "eval/values.h"
#include "pipeline/build.h"
#include "scene/access.h"

namespace rigc::test {

namespace {

std::string all_of(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics.all()) text += d.message + "\n";
  return text;
}

}  // namespace

Moving::Moving(const std::string& file) : name_(file) {
  pipeline::BuildRequest request;
  request.template_file = std::string(RIGC_SOURCE_DIR) + "/templates/" + file;
  Diagnostics diagnostics;
  const auto prepared = pipeline::prepare(request, diagnostics);
  std::size_t skipped = 0;
  if (prepared) {
    auto rig = pipeline::run_commands(*prepared, prepared->catalogue, {}, skipped, diagnostics);
    if (rig) scene_ = std::move(rig->scene);
  }
  REQUIRE_MESSAGE(diagnostics.errors() == 0, all_of(diagnostics));

  eval::Request wanted;
  for (const scene::NodeId id : scene_.nodes()) {
    if (scene_[id].kind == scene::Kind::control) add_keyables(id);
    if (!scene_[id].is_skeleton()) continue;
    joints_.push_back(id);
    wanted.outputs.push_back({id, scene::transform::kWorld});
    size_ = std::fmax(size_, math::length(scene_.rest_world(id).origin -
                                          scene_.rest_world(joints_.front()).origin));
  }
  for (const Keyable& keyable : keyables_) wanted.inputs.push_back(keyable.plug);
  program_ = eval::compile(scene_, wanted, diagnostics);
  REQUIRE_MESSAGE(program_, all_of(diagnostics));
}

/// Angles move as far as rotations do: two poses half a turn apart have no way between them.
constexpr double kTurn = 30;

void Moving::add_keyables(scene::NodeId control) {
  const scene::Node& node = scene_[control];
  const unsigned bits = scene::keyable_bits(scene_, control);
  const std::string name = node.ids.local + "." + node.name + "@";
  const auto add = [&](std::uint16_t attribute, Keyable::What what, const char* text) {
    const scene::Plug plug{control, attribute};
    keyables_.push_back(
        {plug, what, name + text, 0, 0, false, eval::numbers_of(scene_.value(plug))});
  };
  if (bits & scene::kTranslateBits)
    add(scene::transform::kTranslate, Keyable::What::translate, "translate");
  if (bits & scene::kRotateBits)
    add(scene::transform::kRotation, Keyable::What::rotation, "rotation");
  if (bits & scene::kScaleBits) add(scene::transform::kScale, Keyable::What::scale, "scale");
  for (std::size_t i = 0; i < node.user.size(); ++i) {
    const scene::UserAttribute& user = node.user[i];
    if (!user.keyable) continue;
    const scene::Plug plug{control, static_cast<std::uint16_t>(scene::kUserAttributes + i)};
    const bool angle = user.flavour == scene::UserAttribute::Flavour::angle;
    const double reach = angle ? kTurn : 1;
    double low = user.min.value_or(-reach), high = user.max.value_or(reach);
    if (angle) {
      low = std::fmax(low, user.value - kTurn);
      high = std::fmin(high, user.value + kTurn);
    }
    keyables_.push_back({plug,
                         Keyable::What::number,
                         name + user.name,
                         low,
                         high,
                         user.flavour == scene::UserAttribute::Flavour::integer,
                         {user.value}});
  }
}

std::vector<std::vector<double>> Moving::worlds(std::size_t frames, const Values& values,
                                                std::size_t shift) const {
  std::vector<std::vector<double>> result(frames);
  std::vector<double> numbers;
  eval::for_frames(
      *program_, frames + shift,
      [&](eval::Instance& instance, std::size_t place, int lane) {
        // Lanes before the first frame hold it too.
        const std::size_t frame = place < shift ? 0 : place - shift;
        for (std::size_t i = 0; i < keyables_.size(); ++i) {
          numbers = keyables_[i].rest;
          values(i, frame, numbers);
          eval::set_lane(instance.input(i), lane, numbers.data(), static_cast<int>(numbers.size()));
        }
      },
      [&](const eval::Instance& instance, std::size_t place, int lane) {
        if (place < shift) return;
        std::vector<double>& all = result[place - shift];
        all.resize(12 * joints_.size());
        for (std::size_t i = 0; i < joints_.size(); ++i)
          eval::get_lane(instance.output(i), lane, &all[12 * i], 12);
      });
  return result;
}

}  // namespace rigc::test
