// SPDX-License-Identifier: MIT
// Carries keys, values and orphans of a rig over to its successor. Test:
// tests/pipeline/update_test.cpp
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "anim/clip.h"
#include "catalog/catalogue.h"
#include "catalog/changes.h"
#include "gltf/channels.h"
#include "gltf/rig.h"
#include "update/remap.h"
#include "update/verify.h"

namespace rigc::pipeline {

/// What becomes of the keys of one property of a control, for people.
struct CarriedProperty {
  std::string from, to;      ///< `arm_l.elbow/ik_fk_limb.fk@rotation`; `to` empty: an orphan
  std::string rule;          ///< identity, was, replaces, label; of an orphan empty
  std::size_t channels = 0;  ///< of all clips; 0: a value without keys
  bool converted = false;    ///< its values were changed
  bool returned = false;     ///< it was an orphan before
};

struct CarryReport {
  std::vector<std::string> controls_added, controls_removed, controls_moved;
  std::vector<std::string> joints_added, joints_removed;
  std::size_t kept_channels = 0;         ///< to the same property of the same control, as they are
  std::size_t kept_values = 0;           ///< values without keys, likewise
  std::vector<CarriedProperty> changed;  ///< remapped, converted, orphaned or back
  std::vector<std::string> inexact;      ///< properties whose values cannot be said exactly
  /// Properties that a new module has another value of, so that what was keyed on the one before
  /// plays on.
  std::vector<std::string> set;
  std::size_t orphans = 0;         ///< properties that remain without a node
  std::size_t new_orphans = 0;     ///< that had one before
  std::size_t baked_channels = 0;  ///< on joints, which a bake made for the old rig
};

/// Compares in one clip.
struct ClipComparison {
  std::string clip;  ///< empty: what stands without a clip
  update::Comparison comparison;
};

class Carrier {
 public:
  /// `fresh` was built for the skeleton of `old`, which was read from the file that has `clips`.
  /// `used`: nodes of the file that channels drive or that others have added to.
  Carrier(const gltf::Rig& old, gltf::Rig& fresh, const std::vector<anim::Clip>& clips,
          const std::set<int>& used, const catalog::Catalogue& catalogue, update::Options options);

  /// Finds where everything goes: sets values and orphans of `fresh`.
  void run();
  const CarryReport& report() const { return report_; }
  gltf::Replacement replacement(const Sources& sources) {
    return {&old_, &fresh_, places_, sources};
  }
  /// Compares how the rigs play in clips on their controls, and without a clip; an empty list where
  /// one of them is taken apart, nothing where one cannot be evaluated.
  std::optional<std::vector<ClipComparison>> compare(Diagnostics& diagnostics) const;
  /// To be called when the nodes of `fresh` are known.
  std::vector<gltf::ChannelEdit> edits() const;

 private:
  /// Where a channel goes.
  struct Move {
    std::size_t clip = 0, channel = 0;  ///< indices in clips_
    update::Destination destination;
    int orphan = -1;  ///< of fresh_.orphans, where the destination is none
    bool stays = false;
    std::optional<anim::Curve> curve;  ///< converted
  };

  int node_of(std::size_t source) const;
  std::size_t first_orphan() const;
  const gltf::Orphan& old_orphan(std::size_t source) const;
  bool is_foreign(std::size_t source) const;
  void find_places();
  void succeed();
  void set_as_before(const Identity& successor, const catalog::AttributeValue& wanted);
  void remember(const Identity& replaced, const catalog::AttributeValue& wanted);
  void move_channels();
  void move_channel(std::size_t clip, std::size_t channel, std::size_t source);
  void move_values();
  void move_value(std::size_t source, const update::Property& property, const scene::Value& value);
  int orphan_of(std::size_t source);
  void hold(std::size_t source, const update::Property& property);
  void keep_used_nodes();
  void count(std::size_t source, const update::Property& property,
             const update::Destination& destination, bool keyed, bool converted);
  void report_nodes();
  std::string describe_source(std::size_t source) const;
  std::vector<bool> concerned_clips() const;
  std::vector<anim::Clip> moved_clips(const std::vector<bool>& wanted) const;

  const gltf::Rig& old_;
  gltf::Rig& fresh_;
  const std::vector<anim::Clip>& clips_;
  const std::set<int>& used_;
  const catalog::Catalogue& catalogue_;
  update::Options options_;
  scene::Scene built_;
  std::vector<update::Source> sources_;
  std::vector<std::optional<update::Match>> matches_;
  std::vector<int> places_;
  std::vector<bool> source_node_taken_;  ///< by source: its glTF node is a place of `fresh`
  std::map<int, std::size_t> by_node_;   ///< glTF node to source
  std::vector<int> orphans_;             ///< by source: index in fresh_.orphans, -1
  std::vector<Move> moves_;
  /// What has keys by clip, or a value: an orphan does not come back where something else is.
  std::set<std::pair<std::size_t, scene::Plug>> keyed_;
  std::set<scene::Plug> set_;
  std::map<std::string, std::size_t> changed_;  ///< by description: index in report_.changed
  std::set<std::pair<std::size_t, std::string>> implied_;  ///< source and attribute: see succeed()
  std::optional<update::Remap> remap_;
  CarryReport report_;
};

/// `arm_l.elbow/ik_fk_limb#left.fk`.
std::string describe(const Identifiers& ids, const std::string& module, const Identity& identity,
                     const std::string& name);

}  // namespace rigc::pipeline
