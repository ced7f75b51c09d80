// SPDX-License-Identifier: MIT
// Shots for tests of updates.
#include "pipeline/shot_helpers.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "eval/clip_inputs.h"
#include "eval/evaluate.h"
#include "gltf/clips.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "scene/access.h"
#include "scene/edit.h"

namespace rigc::test {
namespace {

namespace fs = std::filesystem;
using anim::Path;
using scene::NodeId;
namespace transform = scene::transform;

std::string said(const Diagnostics& diagnostics) { return render(diagnostics, false); }

class Animator {
 public:
  Animator(unsigned seed, const Animation& how) : random_(seed), how_(how) {}

  anim::Clip clip(const std::vector<gltf::Rig>& rigs, int number) {
    anim::Clip clip;
    clip.name = fmt::format("clip {}", number);
    shared_ = times();
    for (const gltf::Rig& rig : rigs) {
      for (const NodeId id : rig.scene.nodes()) {
        if (rig.scene[id].kind != scene::Kind::control) continue;
        for (const Path path : {Path::translation, Path::rotation, Path::scale})
          if (chance(how_.share * (path == Path::scale ? how_.scale_share : 1)))
            add(clip, rig.nodes[id.index], path, "", rig.skeleton.character.height);
        for (const scene::UserAttribute& attribute : rig.scene[id].user)
          if (attribute.keyable && chance(how_.share))
            add(clip, rig.nodes[id.index], Path::attribute, attribute.name, 1);
      }
    }
    return clip;
  }

  /// Values without keys, as another program would write them into the file's nodes.
  void set_values(nlohmann::ordered_json& nodes, const std::vector<gltf::Rig>& rigs) {
    for (const gltf::Rig& rig : rigs) {
      for (const NodeId id : rig.scene.nodes()) {
        if (rig.scene[id].kind != scene::Kind::control) continue;
        auto& node = nodes[static_cast<std::size_t>(rig.nodes[id.index])];
        const double size = 0.1 * rig.skeleton.character.height;
        if (chance(how_.value_share))
          node["translation"] = {signed_number(size), signed_number(size), signed_number(size)};
        if (chance(how_.value_share)) {
          const std::vector<float> q = rotation();
          node["rotation"] = {q[0], q[1], q[2], q[3]};
        }
        for (const scene::UserAttribute& attribute : rig.scene[id].user)
          if (attribute.keyable && chance(how_.value_share))
            node["extras"][attribute.name] = number_of(attribute);
      }
    }
  }

 private:
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  bool chance(double share) { return unit() < share; }
  float signed_number(double size) { return static_cast<float>((unit() * 2 - 1) * size); }

  double number_of(const scene::UserAttribute& attribute) {
    const double low = attribute.min.value_or(-2), high = attribute.max.value_or(2);
    const double value = low + unit() * (high - low);
    using Flavour = scene::UserAttribute::Flavour;
    const bool whole =
        attribute.flavour == Flavour::integer || attribute.flavour == Flavour::boolean;
    return static_cast<double>(static_cast<float>(whole ? static_cast<int>(value) : value));
  }

  std::vector<float> rotation() {
    math::Quat q{unit() - 0.5, unit() - 0.5, unit() - 0.5, 1 + unit()};
    q = math::normalised(q);
    return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
            static_cast<float>(q.w)};
  }

  std::shared_ptr<const std::vector<float>> times() {
    std::vector<float> out;
    float at = static_cast<float>(unit());
    for (std::size_t i = 0; i < how_.keys; ++i) {
      out.push_back(at);
      at += 0.1f + static_cast<float>(unit());
    }
    return std::make_shared<const std::vector<float>>(out);
  }

  void add(anim::Clip& clip, int node, Path path, const std::string& attribute, double height) {
    anim::Channel channel;
    channel.node = node;
    channel.path = path;
    channel.attribute = attribute;
    anim::Curve& curve = channel.curve;
    curve.width = path == Path::attribute ? 1 : path == Path::rotation ? 4 : 3;
    curve.interpolation = static_cast<anim::Interpolation>(random_() % 3);
    curve.times = chance(0.6) ? shared_ : times();
    const bool cubic = curve.interpolation == anim::Interpolation::cubic;
    for (std::size_t key = 0; key < curve.times->size(); ++key) {
      for (int part = 0; part < (cubic ? 3 : 1); ++part) {
        const bool tangent = cubic && part != 1;
        if (path == Path::rotation && !tangent) {
          const auto q = rotation();
          curve.values.insert(curve.values.end(), q.begin(), q.end());
          continue;
        }
        for (int i = 0; i < curve.width; ++i) {
          const double size = path == Path::translation ? 0.1 * height : 0.4;
          curve.values.push_back(signed_number(size) +
                                 (path == Path::scale && !tangent ? 1.0f : 0.0f));
        }
      }
    }
    clip.channels.push_back(std::move(channel));
  }

  std::mt19937_64 random_;
  const Animation& how_;
  std::shared_ptr<const std::vector<float>> shared_;
};

std::string numbers(const std::vector<float>& values) {
  std::string out;
  for (const float value : values) out += fmt::format("{} ", value);
  return out;
}

std::string text_of(const scene::Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  if (const auto* v = std::get_if<math::Vec3>(&value))
    return fmt::format("{} {} {}", v->x, v->y, v->z);
  const auto& q = std::get<math::Quat>(value);
  return fmt::format("{} {} {} {}", q.x, q.y, q.z, q.w);
}

std::string path_name(const anim::Channel& channel) {
  if (channel.path == Path::attribute) return channel.attribute;
  return channel.path == Path::rotation ? "rotation"
         : channel.path == Path::scale  ? "scale"
                                        : "translation";
}

std::string with_rig(Identity identity, const gltf::Rig& rig) {
  identity.rig = 0;
  return rig.skeleton.global + " " + to_text(identity);
}

}  // namespace

std::string fresh_folder(const std::string& name) {
  const std::string folder = test_out(name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

void write_text(const std::string& path, const std::string& text) {
  fs::create_directories(fs::path(path).parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

void build_rig(const std::string& template_file, const std::string& out, const std::string& model,
               const std::string& global) {
  pipeline::BuildRequest request;
  request.template_file = template_file;
  request.model = model;
  request.global = global;
  request.paths.templates = {templates_folder()};
  Diagnostics diagnostics;
  const auto built = pipeline::build(request, out, diagnostics);
  REQUIRE_MESSAGE(built, said(diagnostics));
}

const gltf::Rig& Shot::rig(const std::string& global) const {
  for (const gltf::Rig& one : rigs)
    if (global.empty() || one.skeleton.global == global) return one;
  FAIL("no rig " << global);
  return rigs.front();
}

Shot read_shot(const std::string& path) {
  Diagnostics diagnostics;
  Shot shot;
  shot.file = gltf::open(path, diagnostics);
  REQUIRE_MESSAGE(shot.file, said(diagnostics));
  auto rigs = gltf::read_rigs(*shot.file, diagnostics);
  REQUIRE_MESSAGE(rigs, said(diagnostics));
  shot.rigs = *std::move(rigs);
  auto clips = gltf::read_clips(*shot.file, diagnostics);
  REQUIRE_MESSAGE(clips, said(diagnostics));
  shot.clips = std::move(clips->clips);
  return shot;
}

void animate(const std::string& path, unsigned seed, const Animation& how) {
  Animator animator(seed, how);
  Shot shot = read_shot(path);
  if (how.value_share > 0) {
    Character character = load_character(path);
    animator.set_values(character.json["nodes"], shot.rigs);
    save_glb(character, path);
    shot = read_shot(path);
  }
  std::vector<gltf::ClipChange> changes;
  for (int i = 0; i < how.clips; ++i)
    changes.push_back({animator.clip(shot.rigs, static_cast<int>(shot.clips.size()) + i), {}});
  gltf::Patch patch(*shot.file);
  gltf::write_clips(patch, *shot.file, changes);
  Diagnostics diagnostics;
  std::uint64_t bytes = 0;
  REQUIRE_MESSAGE(pipeline::write_output(patch, *shot.file, path, bytes, diagnostics),
                  said(diagnostics));
}

std::map<JointKey, math::Affine> pose_at(const Shot& shot, const gltf::Rig& rig, int clip,
                                         double seconds) {
  std::vector<NodeId> joints;
  for (const NodeId id : rig.scene.nodes())
    if (rig.scene[id].is_skeleton()) joints.push_back(id);
  std::vector<eval::Setting> settings;
  if (clip >= 0) {
    const anim::Clip& keys = shot.clips[static_cast<std::size_t>(clip)];
    for (const eval::ClipInput& input : eval::clip_inputs(rig.scene, rig.nodes, keys)) {
      double n[4];
      anim::sample(*input.curve, input.plug.attribute == transform::kRotation, seconds, n);
      scene::Value value = n[0];
      if (input.curve->width == 3) value = math::Vec3{n[0], n[1], n[2]};
      if (input.curve->width == 4) value = math::Quat{n[0], n[1], n[2], n[3]};
      settings.push_back({input.plug, value});
    }
  }
  const auto worlds = eval::worlds(rig.scene, joints, settings);
  REQUIRE(worlds.size() == joints.size());
  std::map<JointKey, math::Affine> out;
  for (std::size_t i = 0; i < joints.size(); ++i)
    out[rig.scene[joints[i]].identity.owner] = worlds[i];
  return out;
}

double motion_difference(const Shot& a, const Shot& b, const std::string& global, bool* exact) {
  const gltf::Rig& first = a.rig(global);
  const gltf::Rig& second = b.rig(global);
  REQUIRE(a.clips.size() == b.clips.size());
  if (exact) *exact = true;
  double largest = 0;
  const double height = first.skeleton.character.height;
  const auto compare = [&](int clip, double time) {
    const auto p = pose_at(a, first, clip, time), q = pose_at(b, second, clip, time);
    for (const auto& [key, world] : p) {
      const auto found = q.find(key);
      if (found == q.end()) continue;
      if (exact && !(world == found->second)) *exact = false;
      largest = std::max(largest, math::length(world.origin - found->second.origin) / height);
      for (const math::Vec3& d :
           {world.linear.x - found->second.linear.x, world.linear.y - found->second.linear.y,
            world.linear.z - found->second.linear.z})
        largest = std::max(largest, math::length(d) * 0.1);
    }
  };
  compare(-1, 0);
  for (std::size_t i = 0; i < a.clips.size(); ++i) {
    const double first_time = anim::first_time(a.clips[i]), last = anim::last_time(a.clips[i]);
    for (int k = 0; k <= 7; ++k)
      compare(static_cast<int>(i), first_time + (last - first_time) * k / 7.0);
  }
  return largest;
}

std::vector<std::string> keys_of(const Shot& shot) {
  std::map<int, std::string> owners;
  std::vector<std::string> lines;
  for (const gltf::Rig& rig : shot.rigs) {
    for (const NodeId id : rig.scene.nodes())
      if (rig.nodes[id.index] >= 0)
        owners[rig.nodes[id.index]] = with_rig(rig.scene[id].identity, rig);
    for (const gltf::Orphan& orphan : rig.orphans) {
      const std::string owner = with_rig(orphan.identity, rig);
      owners[orphan.node] = owner;
      const auto add = [&](const char* name, const scene::Value& value, const scene::Value& rest) {
        if (!(value == rest))
          lines.push_back(fmt::format("{} value {} {}", owner, name, text_of(value)));
      };
      add("translation", orphan.local.translation, orphan.rest.translation);
      add("rotation", orphan.local.rotation, orphan.rest.rotation);
      add("scale", orphan.local.scale, orphan.rest.scale);
      for (const scene::UserAttribute& attribute : orphan.attributes)
        if (attribute.value != attribute.initial)
          lines.push_back(fmt::format("{} value {} {}", owner, attribute.name, attribute.value));
    }
    for (const gltf::Posed& posed : rig.posed) {
      const std::string owner = with_rig(rig.scene[posed.plug.node].identity, rig);
      const std::string name = rig.scene.plug_name(posed.plug);
      lines.push_back(fmt::format("{} value {} {}", owner,
                                  name == "translate" ? "translation" : name,
                                  text_of(rig.scene.value(posed.plug))));
    }
  }
  for (const anim::Clip& clip : shot.clips) {
    for (const anim::Channel& channel : clip.channels) {
      const auto owner = owners.find(channel.node);
      lines.push_back(fmt::format("{} {} {} {} at {}: {}",
                                  owner == owners.end() ? "?" : owner->second, clip.name,
                                  path_name(channel), static_cast<int>(channel.curve.interpolation),
                                  numbers(*channel.curve.times), numbers(channel.curve.values)));
    }
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

pipeline::Rebuilt rebuild(const std::string& path, const pipeline::RebuildRequest& request) {
  Diagnostics diagnostics;
  const auto rebuilt =
      pipeline::rebuild(request, catalog::Catalogue(), {path, path, ""}, diagnostics);
  REQUIRE_MESSAGE(rebuilt, said(diagnostics));
  return *rebuilt;
}

pipeline::Rebuilt unbuild(const std::string& path) {
  pipeline::RebuildRequest request;
  request.unbuild = true;
  return rebuild(path, request);
}

pipeline::FileResult update(const std::string& path, const std::string& templates,
                            pipeline::UpdateSettings settings) {
  settings.paths.templates = {templates};
  Diagnostics diagnostics;
  const auto updater = pipeline::Updater::make(settings, diagnostics);
  REQUIRE_MESSAGE(updater, said(diagnostics));
  const auto result = updater->update({path, path, ""}, diagnostics);
  REQUIRE_MESSAGE(diagnostics.ok(), said(diagnostics));
  return result;
}

}  // namespace rigc::test
