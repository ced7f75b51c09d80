// SPDX-License-Identifier: MIT
// Finds destinations and converts values. Test: tests/update/remap_test.cpp
#include "update/remap.h"

#include <algorithm>
#include <cmath>

#include "update/settle.h"

namespace rigc::update {
namespace {

namespace transform = scene::transform;
using scene::Plug;

std::uint16_t attribute_of(anim::Path path) {
  return path == anim::Path::rotation ? transform::kRotation
         : path == anim::Path::scale  ? transform::kScale
                                      : transform::kTranslate;
}

/// Whether connections decide a whole property, or a part of it.
bool is_driven(const scene::Scene& scene, const Plug& plug) {
  const auto& inputs = scene[plug.node].inputs;
  return std::any_of(inputs.begin(), inputs.end(), [&](const scene::Connection& connection) {
    return connection.to.attribute == plug.attribute ||
           (plug.attribute == transform::kRotation &&
            connection.to.attribute == transform::kRotate);
  });
}

}  // namespace

Remap::Remap(const std::vector<Source>& sources, const std::vector<std::optional<Match>>& matches,
             const scene::Scene& old, const scene::Scene& fresh, const Options& options)
    : sources_(sources), matches_(matches), old_(old), fresh_(fresh), options_(options) {
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const bool moves = matches[i] && scene::spec(sources[i].kind).is_transform;
    conversions_.push_back(moves && !options.keep_local
                               ? Conversion(sources[i].frame, frame_of(fresh, matches[i]->to))
                               : Conversion());
  }
}

bool Remap::is_attribute(const Source& source, const std::string& attribute) const {
  if (!source.node.valid()) return true;
  const auto& user = old_[source.node].user;
  return std::any_of(user.begin(), user.end(),
                     [&](const auto& one) { return one.name == attribute && one.keyable; });
}

Destination Remap::find(std::size_t index, const Property& property) const {
  const Source& source = sources_[index];
  Destination out;
  const bool attribute = property.path == anim::Path::attribute;
  // Meshes have no transform that means anything to the rig.
  if (property.path == anim::Path::weights || source.kind == scene::Kind::mesh ||
      (attribute && !is_attribute(source, property.attribute))) {
    out.kind = Destination::Kind::foreign;
    return out;
  }
  if (!matches_[index]) return out;
  const scene::NodeId node = matches_[index]->to;
  if (!attribute) {
    if (!scene::spec(fresh_[node].kind).is_transform) return out;
    out.plug = {node, attribute_of(property.path)};
    // What the old rig drove already had no effect there either, and stays where it is; so do
    // keys on joints, which rigs drive.
    const bool was_driven =
        source.node.valid() && is_driven(old_, {source.node, out.plug.attribute});
    if (!is_driven(fresh_, out.plug) || was_driven || source.kind == scene::Kind::joint)
      out.kind = Destination::Kind::property;
    return out;
  }
  out.attribute = property.attribute;
  const auto changes = options_.changes.find(fresh_[node].module);
  if (changes != options_.changes.end()) {
    for (const catalog::AttributeChange& change : changes->second) {
      if (change.was != out.attribute) continue;
      out.attribute = change.name;
      out.offset = out.offset * change.factor + change.offset;
      out.factor *= change.factor;
    }
  }
  const auto& user = fresh_[node].user;
  for (std::size_t i = 0; i < user.size(); ++i) {
    if (user[i].name != out.attribute || !user[i].keyable) continue;
    out.plug = {node, static_cast<std::uint16_t>(scene::kUserAttributes + i)};
    const bool was_driven = source.node.valid() && [&] {
      const auto plug = old_.find_plug(source.node, property.attribute);
      return plug && is_driven(old_, *plug);
    }();
    if (!is_driven(fresh_, out.plug) || was_driven) out.kind = Destination::Kind::property;
  }
  return out;
}

bool changes_values(const Property& property, const Destination& destination,
                    const Conversion& conversion) {
  if (destination.kind != Destination::Kind::property) return false;
  return property.path == anim::Path::attribute ? !destination.is_identity()
                                                : !conversion.is_identity();
}

std::optional<scene::Value> converted(const scene::Value& value, const Property& property,
                                      const Destination& destination,
                                      const Conversion& conversion) {
  if (!changes_values(property, destination, conversion)) return value;
  if (const auto* number = std::get_if<double>(&value))
    return settled(*number, *number * destination.factor + destination.offset);
  if (const auto* rotation = std::get_if<math::Quat>(&value))
    return settled(*rotation, conversion.rotation(*rotation));
  const auto* vector = std::get_if<math::Vec3>(&value);
  if (!vector) return std::nullopt;
  if (property.path == anim::Path::translation)
    return settled(*vector, conversion.translation(*vector));
  const bool uniform = vector->x == vector->y && vector->x == vector->z;
  if (!conversion.keeps_scale() && !uniform) return std::nullopt;
  return settled(*vector, conversion.scale(*vector));
}

bool convert(anim::Curve& curve, const Property& property, const Destination& destination,
             const Conversion& conversion) {
  if (!changes_values(property, destination, conversion)) return true;
  if (property.path != anim::Path::attribute) return conversion.apply(property.path, curve);
  const bool cubic = curve.interpolation == anim::Interpolation::cubic;
  for (std::size_t i = 0; i < curve.values.size(); ++i) {
    const bool tangent = cubic && i % 3 != 1;
    const double value = curve.values[i] * destination.factor;
    curve.values[i] = static_cast<float>(tangent ? value : value + destination.offset);
  }
  return true;
}

}  // namespace rigc::update
