// SPDX-License-Identifier: MIT
// Skeletons by main template, and back. Test: tests/tags/mains_test.cpp
#include "tags/mains.h"

#include <algorithm>
#include <map>

namespace rigc::tags {
namespace {

/// By template: which main one it belongs to, counted from 0.
std::vector<std::size_t> mains_of(const TaggedSkeleton& skeleton) {
  std::vector<std::size_t> out;
  for (const TemplateReference& reference : skeleton.templates)
    out.push_back(out.empty() ? 0 : out.back() + (reference.main ? 1 : 0));
  return out;
}

std::size_t main_of(const std::vector<std::size_t>& mains, const TaggedJoint& joint) {
  const auto index = static_cast<std::size_t>(joint.template_index);
  return index < mains.size() ? mains[index] : 0;
}

std::vector<JointKey> keys_above(const TaggedSkeleton& skeleton, int joint) {
  std::vector<JointKey> out;
  for (; joint >= 0; joint = skeleton.joints[static_cast<std::size_t>(joint)].parent)
    out.push_back(skeleton.joints[static_cast<std::size_t>(joint)].key);
  return out;
}

/// Adds what has a name that is not there yet.
template <class Item, class Name>
void unite(std::vector<Item>& all, const std::vector<Item>& more, Name name) {
  for (const Item& item : more)
    if (std::none_of(all.begin(), all.end(),
                     [&](const Item& other) { return name(other) == name(item); }))
      all.push_back(item);
}

void unite_declarations(TaggedSkeleton& out, const TaggedSkeleton& more) {
  const auto name = [](const auto& item) { return item.name; };
  unite(out.features, more.features, name);
  unite(out.shapes, more.shapes, name);
  unite(out.module_pins, more.module_pins, [](const auto& pin) { return pin.first; });
}

/// Index of the first of these joints that is there; -1 without any.
int find_any(const std::map<JointKey, int>& joints, const std::vector<JointKey>& keys) {
  for (const JointKey& key : keys)
    if (const auto found = joints.find(key); found != joints.end()) return found->second;
  return -1;
}

}  // namespace

std::size_t main_count(const TaggedSkeleton& skeleton) {
  const auto mains = mains_of(skeleton);
  return mains.empty() ? 1 : mains.back() + 1;
}

std::vector<Main> split_mains(const TaggedSkeleton& skeleton) {
  const std::vector<std::size_t> mains = mains_of(skeleton);
  std::vector<Main> out(main_count(skeleton));
  std::vector<int> first(out.size(), 0);  // template of each main
  for (Main& main : out) {
    main.skeleton = skeleton;
    main.skeleton.joints.clear();
    main.skeleton.templates.clear();
  }
  for (std::size_t i = 0; i < mains.size(); ++i) {
    TaggedSkeleton& part = out[mains[i]].skeleton;
    if (part.templates.empty()) {
      first[mains[i]] = static_cast<int>(i);
      if (i > 0) part.name = skeleton.templates[i].name;
    }
    part.templates.push_back(skeleton.templates[i]);
    part.templates.back().main = false;
  }
  std::vector<int> places;  // by joint: index in its part
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    TaggedJoint joint = skeleton.joints[i];
    const std::size_t number = main_of(mains, joint);
    Main& main = out[number];
    if (joint.parent >= 0) {
      const auto above = static_cast<std::size_t>(joint.parent);
      if (main_of(mains, skeleton.joints[above]) == number) {
        joint.parent = places[above];
      } else {
        main.attached.emplace_back(joint.key, keys_above(skeleton, joint.parent));
        joint.rest = math::decompose(skeleton.world(i));
        joint.parent = -1;
      }
    }
    joint.template_index -= first[number];
    places.push_back(static_cast<int>(main.skeleton.joints.size()));
    main.skeleton.joints.push_back(std::move(joint));
  }
  return out;
}

TaggedSkeleton join_mains(const std::vector<Main>& mains) {
  TaggedSkeleton out = mains.front().skeleton;
  std::map<JointKey, int> joints;
  const auto know = [&](std::size_t from) {
    for (std::size_t i = from; i < out.joints.size(); ++i)
      joints[out.joints[i].key] = static_cast<int>(i);
    for (std::size_t i = from; i < out.joints.size(); ++i)
      for (const JointKey& was : out.joints[i].was) joints.emplace(was, static_cast<int>(i));
  };
  know(0);
  for (std::size_t number = 1; number < mains.size(); ++number) {
    const Main& main = mains[number];
    const std::size_t before = out.joints.size();
    const auto templates = static_cast<int>(out.templates.size());
    for (TaggedJoint joint : main.skeleton.joints) {
      joint.template_index += templates;
      if (joint.parent >= 0) {
        joint.parent += static_cast<int>(before);
      } else {
        for (const auto& [root, above] : main.attached)
          if (root == joint.key) joint.parent = find_any(joints, above);
        if (joint.parent >= 0) {
          const math::Affine world = out.world(static_cast<std::size_t>(joint.parent));
          joint.rest = math::decompose(math::inverse(world) * math::compose(joint.rest));
        }
      }
      out.joints.push_back(std::move(joint));
    }
    out.templates.insert(out.templates.end(), main.skeleton.templates.begin(),
                         main.skeleton.templates.end());
    if (static_cast<std::size_t>(templates) < out.templates.size())
      out.templates[static_cast<std::size_t>(templates)].main = true;
    unite_declarations(out, main.skeleton);
    know(before);
  }
  return out;
}

}  // namespace rigc::tags
