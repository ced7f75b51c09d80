// SPDX-License-Identifier: MIT
// Where keys and values of an old rig go in the new one, property by property. Test:
// tests/update/remap_test.cpp
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "anim/clip.h"
#include "catalog/changes.h"
#include "update/convert.h"
#include "update/match.h"

namespace rigc::update {

/// A property of a node: its translation, rotation, scale, or an attribute of a user.
struct Property {
  anim::Path path = anim::Path::translation;
  std::string attribute;  ///< of Path::attribute
};

struct Destination {
  enum class Kind : std::uint8_t {
    property,  ///< of a node of the new rig
    foreign,  ///< an attribute that is not the rig's: it stays with its node, whatever that becomes
    none      ///< the new rig has no such property: an orphan
  };
  Kind kind = Kind::none;
  scene::Plug plug;               ///< of the new rig, where kind is `property`
  std::string attribute;          ///< its name
  double factor = 1, offset = 0;  ///< of attributes
  bool is_identity() const { return factor == 1 && offset == 0; }
};

struct Options {
  bool keep_local = false;  ///< keys stay as they are where a zero has turned
  std::map<std::string, std::vector<catalog::AttributeChange>>
      changes;  ///< by module of the new rig
};

class Remap {
 public:
  /// Views its arguments, which outlive it. `old` and `fresh` as they were built.
  Remap(const std::vector<Source>& sources, const std::vector<std::optional<Match>>& matches,
        const scene::Scene& old, const scene::Scene& fresh, const Options& options);

  Destination find(std::size_t source, const Property& property) const;
  const Conversion& conversion(std::size_t source) const { return conversions_[source]; }

 private:
  bool is_attribute(const Source& source, const std::string& attribute) const;
  const std::vector<Source>& sources_;
  const std::vector<std::optional<Match>>& matches_;
  const scene::Scene& old_;
  const scene::Scene& fresh_;
  const Options& options_;
  std::vector<Conversion> conversions_;
};

/// A value of a property, converted for its destination; nothing where it cannot be said there. It
/// is the same to the bit after ways there and back (settle.h).
std::optional<scene::Value> converted(const scene::Value& value, const Property& property,
                                      const Destination& destination, const Conversion& conversion);
/// The same for all keys of a curve; false where it stays as it is because it cannot be said.
bool convert(anim::Curve& curve, const Property& property, const Destination& destination,
             const Conversion& conversion);
/// Whether converting changes any value of the property.
bool changes_values(const Property& property, const Destination& destination,
                    const Conversion& conversion);

}  // namespace rigc::update
