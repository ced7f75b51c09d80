// SPDX-License-Identifier: MIT
// Numbers and describes what is in a rig. Test: tests/capi/capi_test.cpp
#include "capi/rig.h"

#include <limits>

#include "gltf/rig.h"
#include "scene/access.h"
#include "scene/hierarchy.h"

namespace rigc::capi {
namespace {

using scene::Kind;
using scene::NodeId;
using scene::Plug;
namespace transform = scene::transform;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void copy(const scene::Value& value, double* to) {
  if (const auto* v = std::get_if<math::Vec3>(&value)) {
    to[0] = v->x, to[1] = v->y, to[2] = v->z;
  } else if (const auto* q = std::get_if<math::Quat>(&value)) {
    to[0] = q->x, to[1] = q->y, to[2] = q->z, to[3] = q->w;
  }
}

void copy(const math::Affine& a, double* to) {
  const math::Vec3 columns[] = {a.linear.x, a.linear.y, a.linear.z, a.origin};
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t r = 0; r < 3; ++r) to[4 * c + r] = columns[c][r];
    to[4 * c + 3] = c == 3 ? 1 : 0;
  }
}

int kind_of(scene::UserAttribute::Flavour flavour) {
  switch (flavour) {
    case scene::UserAttribute::Flavour::integer:
      return RIGC_INTEGER;
    case scene::UserAttribute::Flavour::boolean:
      return RIGC_BOOLEAN;
    case scene::UserAttribute::Flavour::angle:
      return RIGC_ANGLE;
    case scene::UserAttribute::Flavour::number:
      break;
  }
  return RIGC_NUMBER;
}

class Maker {
 public:
  Maker(const gltf::Rig& from, const std::vector<gltf::Standing>& standings)
      : from_(from), standings_(standings), built_(gltf::built_scene(from)) {}

  std::shared_ptr<const Rig> make(std::size_t rig_count, const Sources& sources) {
    Rig& rig = *rig_;
    rig.scene = from_.scene;
    rig.sources = sources;
    numbers_.assign(scene().size(), -1);
    for (const NodeId id : scene().nodes()) {
      if (scene()[id].kind == Kind::control) add_control(id);
      if (scene()[id].kind == Kind::joint) add_joint(id);
    }
    for (Control& control : rig.controls) control.info.parent = number_above(control.id);
    for (Joint& joint : rig.joints) joint.info.parent = number_above(joint.id);
    describe_rig(rig_count);
    return rig_;
  }

 private:
  const scene::Scene& scene() const { return rig_->scene; }

  const char* keep(std::string text) { return rig_->texts.emplace_back(std::move(text)).c_str(); }

  int gltf_node(NodeId id) const { return from_.nodes[id.index]; }

  /// Number of the nearest node above of the same kind.
  int number_above(NodeId id) const {
    NodeId at = scene()[id].parent;
    while (at.valid() && scene()[at].kind != scene()[id].kind) at = scene()[at].parent;
    return at.valid() ? numbers_[at.index] : -1;
  }

  void describe_rig(std::size_t rig_count) {
    rigc_rig_info& info = rig_->info;
    info = {};
    info.name = keep(from_.skeleton.name);
    info.global = keep(from_.skeleton.global);
    info.number = from_.id;
    info.rig_count = static_cast<std::uint32_t>(rig_count);
    info.control_count = static_cast<std::uint32_t>(rig_->controls.size());
    info.joint_count = static_cast<std::uint32_t>(rig_->joints.size());
    info.space = from_.ancestor;
    info.height = from_.skeleton.character.height;
    info.metre = from_.skeleton.character.unit;
  }

  void add_control(NodeId id) {
    const scene::Node& node = scene()[id];
    const auto number = static_cast<std::uint32_t>(rig_->controls.size());
    Control control{id, {}, static_cast<std::uint32_t>(rig_->channels.size())};
    const std::string identity = to_text(node.identity);
    control.info.identity = keep(identity);
    control.info.name = keep(node.name);
    control.info.local = keep(node.ids.local);
    control.info.label = keep(node.ids.label);
    control.info.module = keep(node.module);
    control.info.command = keep(node.identity.command);
    control.info.role = keep(node.identity.role);
    control.info.opposite =
        keep(std::get<std::string>(scene().value({id, scene::control::kOpposite})));
    control.info.node = gltf_node(id);
    add_transform_channels(id);
    for (std::size_t i = 0; i < node.user.size(); ++i) add_attribute(id, i);
    control.info.channel_count =
        static_cast<std::uint32_t>(rig_->channels.size()) - control.first_channel;
    numbers_[id.index] = static_cast<int>(number);
    rig_->control_numbers.emplace(identity, number);
    rig_->controls.push_back(control);
  }

  void add_transform_channels(NodeId id) {
    const unsigned keyable = scene::keyable_bits(scene(), id);
    const unsigned hidden = scene::bits_at(scene(), id, scene::control::kHidden);
    const unsigned driven = scene::driven_bits(scene(), id);
    const std::uint16_t attributes[] = {transform::kTranslate, transform::kRotation,
                                        transform::kScale};
    static constexpr const char* kNames[] = {"translation", "rotation", "scale"};
    for (unsigned i = 0; i < 3; ++i) {
      Channel channel{{id, attributes[i]}, {}};
      rigc_channel_info& info = channel.info;
      info.name = kNames[i];
      info.kind = i == RIGC_ROTATION ? RIGC_QUATERNION : RIGC_VECTOR;
      info.width = i == RIGC_ROTATION ? 4 : 3;
      info.keyable = keyable >> (3 * i) & 7;
      info.hidden = hidden >> (3 * i) & 7;
      info.driven = driven >> (3 * i) & 7;
      copy(scene().value(channel.plug), info.value);
      copy(built_.value(channel.plug), info.initial);
      info.minimum = -kInfinity;
      info.maximum = kInfinity;
      rig_->channels.push_back(channel);
    }
  }

  void add_attribute(NodeId id, std::size_t index) {
    const scene::UserAttribute& attribute = scene()[id].user[index];
    Channel channel{{id, static_cast<std::uint16_t>(scene::kUserAttributes + index)}, {}};
    rigc_channel_info& info = channel.info;
    info.name = keep(attribute.name);
    info.kind = kind_of(attribute.flavour);
    info.width = 1;
    info.keyable = attribute.keyable ? 1 : 0;
    info.hidden = attribute.hidden ? 1 : 0;
    info.driven = scene().source(channel.plug) ? 1 : 0;
    info.value[0] = attribute.value;
    info.initial[0] = attribute.initial;
    info.minimum = attribute.min.value_or(-kInfinity);
    info.maximum = attribute.max.value_or(kInfinity);
    rig_->channels.push_back(channel);
  }

  void add_joint(NodeId id) {
    const scene::Node& node = scene()[id];
    const auto number = static_cast<std::uint32_t>(rig_->joints.size());
    Joint joint{id, {}, transform_above(scene(), id), {}};
    if (gltf_node(id) >= 0) {
      joint.base = standings_[id.index].base;
      joint.between = standings_[id.index].between;
    }
    const std::string identity = to_text(node.identity);
    joint.info.identity = keep(identity);
    joint.info.name = keep(node.name);
    joint.info.local = keep(node.ids.local);
    joint.info.label = keep(node.ids.label);
    joint.info.node = gltf_node(id);
    joint.info.is_bone = is_bone(scene(), id) ? 1 : 0;
    copy(built_.rest_world(id), joint.info.rest);
    numbers_[id.index] = static_cast<int>(number);
    rig_->joint_numbers.emplace(identity, number);
    rig_->joints.push_back(joint);
  }

  const gltf::Rig& from_;
  const std::vector<gltf::Standing>& standings_;
  const scene::Scene built_;
  std::shared_ptr<Rig> rig_ = std::make_shared<Rig>();
  std::vector<int> numbers_;  // of controls and joints, by scene node
};

}  // namespace

const Channel* Rig::channel(std::uint32_t control, std::uint32_t channel) const {
  if (control >= controls.size() || channel >= controls[control].info.channel_count) return nullptr;
  return &channels[controls[control].first_channel + channel];
}

std::shared_ptr<const Rig> open(const Source& source, Diagnostics& diagnostics) {
  const auto file =
      gltf::open(source.name, source.bytes, diagnostics, gltf::OtherFiles::left_alone);
  if (!file) return nullptr;
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  if (!rigs || source.rig >= rigs->size()) return nullptr;
  const gltf::Rig& rig = (*rigs)[source.rig];
  const auto standings = gltf::standings(*file, rig, diagnostics);
  if (!standings) return nullptr;
  return Maker(rig, *standings).make(rigs->size(), diagnostics.sources());
}

}  // namespace rigc::capi
