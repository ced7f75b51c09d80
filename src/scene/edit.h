// SPDX-License-Identifier: MIT
// The only way to change a scene: each change is written to a journal, and undo replays the journal
// backwards, so that constructors need no destructors of their own. Test: tests/scene/edit_test.cpp
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "scene/scene.h"

namespace rigc::scene {

/// Told of nodes as they come and go (an index keeps itself current).
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void added(const Scene& scene, NodeId node) = 0;
  virtual void removing(const Scene& scene, NodeId node) = 0;
};

/// What one command changed, in order; each entry holds what was there before.
class Journal {
 public:
  bool empty() const { return entries_.empty(); }
  std::size_t size() const { return entries_.size(); }

 private:
  friend class Edit;
  struct Made {
    NodeId node;
  };
  struct Parented {
    NodeId node;
    NodeId before;
    std::size_t place_before;
  };
  struct Set {
    Plug plug;
    std::vector<Value> before;
  };
  struct UserAdded {
    NodeId node;
  };
  struct UserSet {
    NodeId node;
    std::size_t index;
    UserAttribute before;
  };
  struct Connected {
    Plug to;
    std::optional<Plug> before;
  };
  using Entry = std::variant<Made, Parented, Set, UserAdded, UserSet, Connected>;
  std::vector<Entry> entries_;
};

class Edit {
 public:
  /// `observer` may be null.
  Edit(Scene& scene, Journal& journal, Observer* observer)
      : scene_(scene), journal_(journal), observer_(observer) {}

  const Scene& scene() const { return scene_; }

  /// A node with its kind's default values. `node` brings kind, name, ids, identity, command,
  /// origin, parent.
  NodeId make(Node node);
  void reparent(NodeId node, NodeId parent);
  /// The plug exists, is no output, and the value has its type (asserted: callers checked). Setting
  /// element n of an array that has n elements appends. A component is set in place. Setting
  /// `rotate` sets the rotation; setting the angles that it has changes nothing.
  void set(const Plug& plug, const Value& value);
  /// Adds a user attribute and gives its plug; the name is new on the node (asserted).
  Plug add_attribute(NodeId node, UserAttribute attribute);
  /// What animators may do with a user attribute.
  void set_access(const Plug& user, bool keyable, bool hidden);
  /// Replaces a connection that is there. Types are equal (asserted). Connecting to element n of an
  /// array that has n elements appends one.
  void connect(const Plug& from, const Plug& to);
  void disconnect(const Plug& to);

  /// Undoes everything in the journal, last change first, and empties it.
  static void undo(Scene& scene, Journal& journal, Observer* observer);

 private:
  Scene& scene_;
  Journal& journal_;
  Observer* observer_;
};

}  // namespace rigc::scene
