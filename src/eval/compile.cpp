// SPDX-License-Identifier: MIT
// Compiles what is demanded of a scene: from the outputs back through plugs, depth first with a
// stack of its own, each plug once; a plug that is still open when it is needed again closes a
// cycle. Components are plugs of their own, so translate.x may depend on translate.y.
// Test: tests/eval/compile_test.cpp
#include <algorithm>
#include <array>
#include <cassert>
#include <unordered_map>

#include <fmt/format.h>
#include "base/trace.h"
#include "eval/codes.h"
#include "eval/cycle.h"
#include "eval/emitter.h"
#include "eval/limits.h"
#include "eval/program.h"
#include "eval/rules.h"
#include "eval/schedule.h"
#include "eval/values.h"
#include "eval/worlds.h"
#include "scene/hierarchy.h"

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
  block     // the instructions of a node, or of one output of it
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
        limits_(scene, diagnostics),
        worlds_(scene.size()) {
    known_.reserve(2 * scene.size());
  }

  std::optional<Program> compile(const Request& request) {
    const trace::Span span("compile");
    for (const Plug& plug : request.inputs) {
      if (check_input(plug)) add_input(plug);
    }
    sort_inputs();
    std::vector<Operand> outputs;
    for (const Plug& plug : request.outputs) {
      if (check_output(plug)) outputs.push_back(resolve({plug}));
    }
    if (diagnostics_.errors() != before_) return std::nullopt;
    return schedule(emitter_, inputs_, outputs);
  }

 private:
  struct Known {
    bool there = false;
    bool open = true;
    Operand operand;
  };
  struct Frame {
    Key key;
    Plan plan;
    std::vector<Operand> operands;  // of what it needs, as far as that is known
  };
  struct Varying {
    Plug plug;
    Operand operand;
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
    varying_.push_back({plug, operand});
  }

  void sort_inputs() {
    std::ranges::stable_sort(varying_, {}, &Varying::plug);
    first_varying_.assign(scene_.size() + 1, 0);
    for (const Varying& v : varying_) ++first_varying_[v.plug.node.index + 1];
    for (std::size_t i = 1; i < first_varying_.size(); ++i)
      first_varying_[i] += first_varying_[i - 1];
  }

  const Operand* input_at(const Plug& plug) const {
    const std::uint32_t node = plug.node.index;
    for (std::uint32_t i = first_varying_[node]; i < first_varying_[node + 1]; ++i) {
      if (varying_[i].plug == plug) return &varying_[i].operand;
    }
    return nullptr;
  }

  // The walk.

  // Worlds, the most of what is known, lie in the order of nodes.
  bool is_world(const Key& key) const {
    return key.plug.attribute == transform::kWorld && key.layer == Layer::limited &&
           is_transform(key.plug.node) && key.plug.element < 0 && key.plug.component < 0;
  }

  Known& known(const Key& key) {
    return is_world(key) ? worlds_[key.plug.node.index] : known_[key];
  }

  const Known* find(const Key& key) const {
    if (is_world(key)) {
      const Known& world = worlds_[key.plug.node.index];
      return world.there ? &world : nullptr;
    }
    const auto found = known_.find(key);
    return found == known_.end() ? nullptr : &found->second;
  }

  // What takes no instruction is not remembered.
  static bool at_hand(const Plan& plan) {
    return plan.step == Step::constant || plan.step == Step::input;
  }

  Operand resolve(const Key& wanted) {
    Operand result = nothing_;
    if (!take(wanted, result)) {
      run();
      take(wanted, result);
    }
    return result;
  }

  // Whether it is known already or needs no walk; else it is opened.
  bool take(const Key& key, Operand& result) {
    if (const Known* found = find(key)) {
      if (found->open) report_ring(key);
      result = found->operand;
      return true;
    }
    Plan plan = this->plan(key);
    if (at_hand(plan)) {
      result = build(key, plan, {});
      return true;
    }
    // What a member of a cycle is worth does not matter: the program is not handed out.
    known(key) = {true, true, slice(nothing_, 0, width_of(key))};
    stack_.push_back({key, std::move(plan), {}});
    return false;
  }

  void run() {
    while (!stack_.empty()) {
      const std::size_t top = stack_.size() - 1;
      const std::size_t next = stack_[top].operands.size();
      if (next == stack_[top].plan.needs.size()) {
        const Frame frame = std::move(stack_.back());
        const Operand operand = build(frame.key, frame.plan, frame.operands);
        known(frame.key) = {true, false, operand};
        stack_.pop_back();
        continue;
      }
      Operand operand;
      if (take(stack_[top].plan.needs[next], operand)) stack_[top].operands.push_back(operand);
    }
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

  Plan plan(const Key& key) {
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

  Plan plan_output(const Plug& plug) {
    const KindRule& of = rule(scene_[plug.node].kind);
    if (of.reads_of) {
      Plan plan{Step::block, {}, 0, 0};
      for (const Plug& read : of.reads_with(programs_, scene_, plug)) plan.needs.push_back({read});
      return plan;
    }
    const OutputPlace place = of.place(plug);
    const Key block{{plug.node, kBlock}};
    return {place.euler ? Step::to_euler : Step::alias, {block}, place.offset, place.width};
  }

  Plan plan_world(const Plug& plug) const {
    const NodeId above = transform_above(scene_, plug.node);
    if (plug.attribute == transform::kParent) {
      if (!above.valid()) return {};
      return alias({{above, transform::kWorld}}, 0, 12);
    }
    Plan plan{Step::compose,
              {{{plug.node, transform::kTranslate}},
               {{plug.node, transform::kRotation}},
               {{plug.node, transform::kScale}}},
              0,
              12};
    if (above.valid()) plan.needs.push_back({{above, transform::kWorld}});
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

  Operand build(const Key& key, const Plan& plan, const std::vector<Operand>& operands) {
    const std::uint32_t node = key.plug.node.index;
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
    return build_block(key.plug, operands);
  }

  // A block may have fewer outputs than somebody asks for, and none where its node is wrong.
  Operand part(const Key& key, Operand whole_of, const Plan& plan) {
    if (plan.offset <= whole_of.width && plan.width <= whole_of.width - plan.offset) {
      return slice(whole_of, plan.offset, plan.width);
    }
    if (diagnostics_.errors() == before_) {
      refuse(key.plug, fmt::format("it has no {}", scene_.plug_name(key.plug)));
    }
    return slice(nothing_, 0, plan.width);
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
    Placement placement{{}, operands[0], operands[1], operands[2]};
    if (operands.size() > 3) placement.parent = operands[3];
    return emit_world(emitter_, placement, node);
  }

  Operand build_block(const Plug& plug, const std::vector<Operand>& operands) {
    const KindRule& of = rule(scene_[plug.node].kind);
    if (plug.attribute != kBlock) {
      const auto emitted = of.emit_of(emitter_, programs_, scene_, plug, operands, diagnostics_);
      return emitted ? *emitted : slice(nothing_, 0, width_of({plug}));
    }
    const auto emitted = of.emit(emitter_, scene_, plug.node, operands, diagnostics_);
    return emitted ? *emitted : slice(nothing_, 0, 0);
  }

  const scene::Scene& scene_;
  Diagnostics& diagnostics_;
  std::size_t before_;
  Limits limits_;
  Emitter emitter_;
  Programs programs_;
  Operand nothing_ = emitter_.constant(std::array<double, 12>{});  // of what is wrong
  std::vector<Operand> inputs_;
  std::vector<Varying> varying_;              // inputs, in the order of their plugs
  std::vector<std::uint32_t> first_varying_;  // by node
  std::vector<Known> worlds_;                 // by node: world of a transform
  std::unordered_map<Key, Known, KeyHash> known_;
  std::vector<Frame> stack_;
};

}  // namespace

std::optional<Program> compile(const scene::Scene& scene, const Request& request,
                               Diagnostics& diagnostics) {
  return Compiler(scene, diagnostics).compile(request);
}

}  // namespace rigc::eval
