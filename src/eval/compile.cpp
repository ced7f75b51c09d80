// SPDX-License-Identifier: MIT
// Compiles what is demanded of a scene: from the outputs back through plugs, depth first with a
// stack of its own, each plug once; a plug that is still open when it is needed again closes a
// cycle. Components are plugs of their own, so translate.x may depend on translate.y.
// Test: tests/eval/compile_test.cpp
#include <algorithm>
#include <cassert>
#include <unordered_map>

#include <fmt/format.h>
#include "base/trace.h"
#include "eval/codes.h"
#include "eval/cycle.h"
#include "eval/emitter.h"
#include "eval/kernels/limit.h"
#include "eval/limits.h"
#include "eval/program.h"
#include "eval/rules.h"
#include "eval/values.h"

namespace rigc::eval {

namespace {

using scene::NodeId;
using scene::Plug;
using scene::Role;
namespace transform = scene::transform;

// All that the instructions of one node compute.
constexpr std::uint16_t kBlock = UINT16_MAX;

// Of a transform's own values there are up to three.
enum class Layer : std::uint8_t {
  limited,  // what everybody reads
  free,     // before limits and locks, where there are any
  beneath   // what a rotation is where nothing is connected into its Euler view; what that shows
};

// Something that is computed once.
struct Key {
  Plug plug;
  Layer layer = Layer::limited;
  bool operator==(const Key&) const = default;
};

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t h = key.plug.node.index;
    h = h * 0x9e3779b97f4a7c15u + key.plug.attribute;
    h = h * 0x9e3779b97f4a7c15u + static_cast<std::uint32_t>(key.plug.element);
    h = h * 0x9e3779b97f4a7c15u + static_cast<std::uint32_t>(key.plug.component) * 4 +
        static_cast<std::uint32_t>(key.layer);
    return static_cast<std::size_t>(h ^ (h >> 29));
  }
};

Plug whole(Plug plug) {
  plug.component = -1;
  return plug;
}

// How one key follows from others.
enum class Step : std::uint8_t {
  constant,  // the scene's value
  input,     // a slice of a request's input
  alias,     // a slice of what it needs
  gather,    // all it needs, one after the other
  from_euler,
  to_euler,
  limit,    // what it needs, clamped
  compose,  // translate, rotation, scale [, parent's world]
  block     // the instructions of a node
};

struct Plan {
  Step step = Step::constant;
  std::vector<Key> needs;
  std::uint32_t offset = 0;  // of an alias or input
  std::uint32_t width = 0;
};

class Compiler {
 public:
  Compiler(const scene::Scene& scene, Diagnostics& diagnostics)
      : scene_(scene),
        diagnostics_(diagnostics),
        before_(diagnostics.errors()),
        limits_(scene, diagnostics) {}

  std::optional<Program> compile(const Request& request) {
    const trace::Span span("compile");
    for (const Plug& plug : request.inputs) {
      if (check_input(plug)) add_input(plug);
    }
    std::vector<Operand> outputs;
    for (const Plug& plug : request.outputs) {
      if (!check_output(plug)) continue;
      resolve({plug});
      outputs.push_back(known_.at({plug}).operand);
    }
    if (diagnostics_.errors() != before_) return std::nullopt;
    return emitter_.finish(inputs_, outputs);
  }

 private:
  struct Known {
    bool open = true;
    Operand operand;
  };
  struct Frame {
    Key key;
    Plan plan;
    std::size_t next = 0;
  };

  // Requests.

  bool refuse(const Plug& plug, const std::string& why) {
    const bool there = plug.node.index < scene_.size();
    diagnostics_.report(codes::kBadRequest, there ? scene_[plug.node].origin.span : Span{},
                        there ? fmt::format("{}: {}", describe_node(scene_, plug.node), why) : why);
    return false;
  }

  bool check_output(const Plug& plug) {
    const auto type = scene_.type(plug);
    if (!type) return refuse(plug, "there is no such attribute");
    if (scene::width(*type) == 0) return refuse(plug, scene_.plug_name(plug) + " is data");
    return true;
  }

  bool check_input(const Plug& plug) {
    if (!check_output(plug)) return false;
    if (plug.component >= 0 || scene_.role(plug) != Role::input) {
      return refuse(plug, scene_.plug_name(plug) + " cannot vary from frame to frame");
    }
    return true;
  }

  void add_input(const Plug& plug) {
    const Operand operand = emitter_.input(numbers_of(scene_.value(plug)));
    inputs_.push_back(operand);
    varying_.emplace(Key{plug}, operand);
  }

  const Operand* input_at(const Plug& plug) const {
    const auto found = varying_.find({plug});
    return found == varying_.end() ? nullptr : &found->second;
  }

  // The walk.

  void resolve(const Key& wanted) {
    if (known_.contains(wanted)) return;
    open(wanted);
    while (!stack_.empty()) {
      Frame& frame = stack_.back();
      if (frame.next == frame.plan.needs.size()) {
        Known& known = known_.at(frame.key);
        known.operand = build(frame.key, frame.plan);
        known.open = false;
        stack_.pop_back();
        continue;
      }
      const Key need = frame.plan.needs[frame.next++];
      const auto found = known_.find(need);
      if (found == known_.end()) {
        open(need);
      } else if (found->second.open) {
        report_ring(need);
      }
    }
  }

  void open(const Key& key) {
    // What a member of a cycle is worth does not matter: the program is not handed out.
    known_.emplace(key, Known{true, emitter_.constant(std::vector<double>(width_of(key), 0.0))});
    stack_.push_back({key, plan(key), 0});
  }

  void report_ring(const Key& start) {
    const auto begin = std::find_if(stack_.begin(), stack_.end(),
                                    [&](const Frame& frame) { return frame.key == start; });
    std::vector<Plug> ring;
    for (auto at = begin; at != stack_.end(); ++at) {
      if (at->key.plug.attribute != kBlock && at->key.layer == Layer::limited)
        ring.push_back(at->key.plug);
    }
    report_cycle(scene_, std::move(ring), diagnostics_);
  }

  std::uint32_t width_of(const Key& key) const {
    if (key.plug.attribute == kBlock) return 0;
    return static_cast<std::uint32_t>(scene::width(*scene_.type(key.plug)));
  }

  // Plans.

  bool is_transform(NodeId node) const { return scene::spec(scene_[node].kind).is_transform; }

  static Plan alias(const Key& of, std::uint32_t offset, std::uint32_t width) {
    return {Step::alias, {of}, offset, width};
  }

  Plan plan(const Key& key) const {
    const Plug& plug = key.plug;
    if (plug.attribute == kBlock) return plan_block(plug.node);
    if (key.layer == Layer::limited && limits_.apply_to(plug)) return plan_limited(plug);
    if (plug.component >= 0) return plan_component(key);
    if (scene_.role(plug) == Role::output) {
      return is_transform(plug.node) ? plan_world(plug) : plan_output(plug);
    }
    return plan_whole(key);
  }

  Plan plan_block(NodeId node) const {
    Plan plan{Step::block, {}, 0, 0};
    for (const Plug& read : rule(scene_[node].kind).reads(scene_, node))
      plan.needs.push_back({read});
    return plan;
  }

  Plan plan_output(const Plug& plug) const {
    const OutputPlace place = rule(scene_[plug.node].kind).place(plug);
    const Key block{{plug.node, kBlock}};
    return {place.euler ? Step::to_euler : Step::alias, {block}, place.offset, place.width};
  }

  // A parent that is no transform has no place in space; what it hangs under counts.
  std::optional<NodeId> transform_above(NodeId node) const {
    for (NodeId at = scene_[node].parent; at.valid(); at = scene_[at].parent) {
      if (is_transform(at)) return at;
    }
    return std::nullopt;
  }

  Plan plan_world(const Plug& plug) const {
    const auto above = transform_above(plug.node);
    if (plug.attribute == transform::kParent) {
      if (!above) return {};
      return alias({{*above, transform::kWorld}}, 0, 12);
    }
    Plan plan{Step::compose,
              {{{plug.node, transform::kTranslate}},
               {{plug.node, transform::kRotation}},
               {{plug.node, transform::kScale}}},
              0,
              12};
    if (above) plan.needs.push_back({{*above, transform::kWorld}});
    return plan;
  }

  bool is_rotation(const Plug& plug) const {
    return is_transform(plug.node) && plug.attribute == transform::kRotation;
  }
  bool is_euler_view(const Plug& plug) const {
    return is_transform(plug.node) && plug.attribute == transform::kRotate;
  }

  // Connections into the components of a plug, which lie in order.
  bool has_component_source(const Plug& plug) const {
    const auto& inputs = scene_[plug.node].inputs;
    const auto after =
        std::upper_bound(inputs.begin(), inputs.end(), plug,
                         [](const Plug& p, const scene::Connection& c) { return p < c.to; });
    return after != inputs.end() && whole(after->to) == plug;
  }

  bool euler_rules(NodeId node) const {
    const Plug rotate{node, transform::kRotate};
    return scene_.source(rotate) || has_component_source(rotate) || input_at(rotate);
  }

  Plan plan_limited(const Plug& plug) const {
    if (plug.component >= 0)
      return alias({whole(plug)}, static_cast<std::uint32_t>(plug.component), 1);
    if (is_euler_view(plug)) return {Step::to_euler, {{{plug.node, transform::kRotation}}}, 0, 4};
    return {Step::limit, {{plug, Layer::free}}, 0, width_of({plug})};
  }

  Plan plan_whole(const Key& key) const {
    const Plug& plug = key.plug;
    const std::uint32_t width = width_of(key);
    if (is_rotation(plug) && key.layer != Layer::beneath && euler_rules(plug.node)) {
      return {Step::from_euler, {{{plug.node, transform::kRotate}, key.layer}}, 0, 4};
    }
    if (is_euler_view(plug) && key.layer == Layer::beneath) {
      return {Step::to_euler, {{{plug.node, transform::kRotation}, Layer::beneath}}, 0, 4};
    }
    if (has_component_source(plug)) {
      Plan plan{Step::gather, {}, 0, width};
      for (std::uint32_t c = 0; c < width; ++c) {
        Plug component = plug;
        component.component = static_cast<std::int8_t>(c);
        plan.needs.push_back({component, key.layer});
      }
      return plan;
    }
    if (const auto source = scene_.source(plug)) return alias({*source}, 0, width);
    if (input_at(plug)) return {Step::input, {}, 0, width};
    if (is_euler_view(plug)) return alias({plug, Layer::beneath}, 0, width);
    return {};
  }

  Plan plan_component(const Key& key) const {
    const Plug& plug = key.plug;
    const auto component = static_cast<std::uint32_t>(plug.component);
    if (scene_.role(plug) == Role::output) return alias({whole(plug)}, component, 1);
    if (is_rotation(plug) && key.layer != Layer::beneath && euler_rules(plug.node)) {
      return alias({whole(plug), key.layer}, component, 1);
    }
    if (const auto source = scene_.source(plug)) return alias({*source}, 0, 1);
    if (const auto source = scene_.source(whole(plug))) return alias({*source}, component, 1);
    if (input_at(whole(plug))) return {Step::input, {}, component, 1};
    if (is_euler_view(plug)) return alias({whole(plug), Layer::beneath}, component, 1);
    return {};
  }

  // Building.

  Operand build(const Key& key, const Plan& plan) {
    const std::uint32_t node = key.plug.node.index;
    std::vector<Operand> operands;
    for (const Key& need : plan.needs) operands.push_back(known_.at(need).operand);
    switch (plan.step) {
      case Step::constant:
        return emitter_.constant(constant_of(key.plug));
      case Step::input:
        return slice(*input_at(whole(key.plug)), plan.offset, plan.width);
      case Step::alias:
        return part(key, operands[0], plan);
      case Step::gather:
        return emitter_.emit(Op::gather, operands, {}, plan.width, node);
      case Step::from_euler:
        return emitter_.emit(Op::from_euler, operands, {}, 4, node);
      case Step::to_euler:
        return emitter_.emit(Op::to_euler, {part(key, operands[0], plan)}, {}, 3, node);
      case Step::limit:
        return build_limited(key.plug, operands[0]);
      case Step::compose:
        return build_world(operands, node);
      case Step::block:
        break;
    }
    return build_block(key.plug.node, operands);
  }

  // A block may have fewer outputs than somebody asks for, and none where its node is wrong.
  Operand part(const Key& key, Operand whole_of, const Plan& plan) {
    if (plan.offset <= whole_of.width && plan.width <= whole_of.width - plan.offset) {
      return slice(whole_of, plan.offset, plan.width);
    }
    if (diagnostics_.errors() == before_) {
      refuse(key.plug, fmt::format("it has no {}", scene_.plug_name(key.plug)));
    }
    return emitter_.constant(std::vector<double>(plan.width, 0.0));
  }

  // Outputs have no value in the scene: the one that is constant is the parent of a root.
  std::vector<double> constant_of(const Plug& plug) const {
    if (scene_.role(plug) == Role::output) return numbers_of(math::Affine{});
    return numbers_of(scene_.value(plug));
  }

  Operand build_limited(const Plug& plug, Operand value) {
    for (const Limit& limit : *limits_.of(plug.node)) {
      if (limit.attribute != plug.attribute) continue;
      const Op op = is_rotation(plug) ? Op::limit_rotation : Op::limit_vector;
      value = emitter_.emit(op, {value}, limit_data(limit.space), value.width, limit.by.index);
    }
    return value;
  }

  Operand build_world(const std::vector<Operand>& operands, std::uint32_t node) {
    const Operand local =
        emitter_.emit(Op::compose, {operands[0], operands[1], operands[2]}, {}, 12, node);
    if (operands.size() == 3) return local;
    return emitter_.emit(Op::multiply, {operands[3], local}, {}, 12, node);
  }

  Operand build_block(NodeId node, const std::vector<Operand>& operands) {
    const auto emitted =
        rule(scene_[node].kind).emit(emitter_, scene_, node, operands, diagnostics_);
    return emitted ? *emitted : emitter_.constant({});
  }

  const scene::Scene& scene_;
  Diagnostics& diagnostics_;
  std::size_t before_;
  Limits limits_;
  Emitter emitter_;
  std::vector<Operand> inputs_;
  std::unordered_map<Key, Operand, KeyHash> varying_;
  std::unordered_map<Key, Known, KeyHash> known_;
  std::vector<Frame> stack_;
};

}  // namespace

std::optional<Program> compile(const scene::Scene& scene, const Request& request,
                               Diagnostics& diagnostics) {
  return Compiler(scene, diagnostics).compile(request);
}

}  // namespace rigc::eval
