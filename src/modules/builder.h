// SPDX-License-Identifier: MIT
// What a constructor is handed: its parameters, the scene to read, and the only way to change it.
// Test: tests/modules/builder_test.cpp
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/catalogue.h"
#include "modules/parameters.h"
#include "scene/edit.h"
#include "tags/tags.h"
#include "traversal/index.h"

namespace rigc::modules {

/// A node to make. Its identity and identifiers come from the joint it is made for and from the
/// command.
struct NewNode {
  scene::Kind kind = scene::Kind::transform;
  std::string role;
  NodeId joint;        ///< joint that it belongs to; invalid: the one that holds the command
  NodeId parent;       ///< of transforms; invalid: none
  std::string suffix;  ///< of its name, `_suffix` after the joint's name; empty: its role
};

class Builder {
 public:
  struct Job {
    const tags::TaggedSkeleton& skeleton;
    const catalog::Catalogue& catalogue;
    const traversal::Index& index;
    const tags::CommandTag& command;
    std::size_t joint = 0;  ///< index in skeleton of the joint that holds the command
    std::uint32_t command_index = 0;
    const tags::Geometry& geometry;  ///< of the model; empty without one
    double side_middle = 0;  ///< where the skeleton's middle lies along the character's left
    Diagnostics& diagnostics;
  };

  Builder(const Job& job, Parameters parameters, scene::Edit& edit);

  const Parameters& with() const { return parameters_; }
  const scene::Scene& scene() const { return edit_.scene(); }
  const tags::Character& character() const { return job_.skeleton.character; }
  const tags::TaggedSkeleton& skeleton() const { return job_.skeleton; }
  const catalog::Catalogue& catalogue() const { return job_.catalogue; }
  const traversal::Index& index() const { return job_.index; }
  double side_middle() const { return job_.side_middle; }
  const std::string& global() const { return job_.skeleton.global; }

  /// The joint that holds the command.
  NodeId joint() const { return joint_; }
  /// The joint on the other side that holds the same command; uid 0: none does, and what this
  /// command makes has its mirror image in what it makes itself, if anywhere.
  JointKey twin() const;
  /// The tagged joint behind a skeleton joint; null for nodes that commands made.
  const tags::TaggedJoint* tagged(NodeId joint) const;

  /// The vertices of the model that joints and all below them move, with their weight; in rig space
  /// at rest. Empty where there is no model.
  std::vector<tags::BoundVertex> vertices(const std::vector<NodeId>& joints) const;
  /// A mesh that joints of the rig move, by the name of its node or its own, in rig space at rest
  /// as the joint that holds the command moves it, or else the first one that does. Nothing where
  /// the model has none of this name, or there is no model; its `trouble` says why it cannot be
  /// used.
  std::optional<tags::Surface> surface(const std::string& name) const;

  NodeId make(const NewNode& node);
  void set(const Plug& plug, const scene::Value& value) { edit_.set(plug, value); }
  Plug add_attribute(NodeId node, scene::UserAttribute attribute) {
    return edit_.add_attribute(node, std::move(attribute));
  }
  void set_access(const Plug& user, bool keyable, bool hidden) {
    edit_.set_access(user, keyable, hidden);
  }
  /// Puts something between a plug and what drives it.
  void reconnect(const Plug& from, const Plug& to) { edit_.connect(from, to); }
  /// Refuses a plug that is connected already, whole or in part.
  void connect(const Plug& from, const Plug& to);
  /// Fails where something drives the plug, or a part of it.
  bool check_free(const Plug& plug, std::string_view parameter);
  void reparent(NodeId node, NodeId parent) { edit_.reparent(node, parent); }

  /// Checks the grammar of a formula; false where it is wrong (reported at the parameter).
  bool check_formula(std::string_view parameter, const BoundExpression& bound);

  /// Reports an error at a parameter (or, with an empty name, at the command); the constructor then
  /// returns.
  void fail(const Code& code, std::string_view parameter, std::string message,
            std::string hint = {});
  bool failed() const { return failed_; }
  /// Reports a warning there; the constructor goes on.
  void warn(const Code& code, std::string_view parameter, std::string message,
            std::string hint = {});

 private:
  Identifiers identifiers(NodeId joint) const;
  Job job_;
  Parameters parameters_;
  scene::Edit& edit_;
  NodeId joint_;
  std::map<std::pair<JointKey, std::string>, std::uint32_t> counters_;
  bool failed_ = false;
};

using Constructor = void (*)(Builder&);

struct Module {
  std::string_view name;
  Constructor construct;
};

/// Every built-in module, sorted by name.
std::span<const Module> registry();
const Module* find(std::string_view name);

}  // namespace rigc::modules
