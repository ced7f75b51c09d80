// SPDX-License-Identifier: MIT
// Adopt what came through Blender, where it is installed.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/files.h"
#include "pipeline/adopt_helpers.h"

namespace rigc {

namespace {

using anim::Path;
using test::adopted;
using test::bytes_of;
using test::clip_of;
using test::find;
using test::make_shot;
using test::near;
using test::OtherProgram;
using test::rig_of;
using test::value_at;
using test::WalkShot;

/// Imports, runs the lines of an edit, exports; false (with a message) where there is no Blender.
bool through_blender(const std::string& in, const std::string& out, int fps,
                     const std::string& edit) {
  if (std::system("command -v blender >/dev/null 2>&1") != 0) {
    MESSAGE("no blender: its round trip is not tested");
    return false;
  }
  // What Blender writes is not ours to validate: that folder is left out.
  std::filesystem::create_directories(test::test_out("broken"));
  const std::string script = out + ".py";
  std::ofstream(script) << fmt::format(
      "import numpy\nnumpy.bool = bool\nimport bpy\n"
      "bpy.ops.wm.read_factory_settings(use_empty=True)\n"
      "bpy.context.scene.render.fps = {}\n"
      "bpy.ops.import_scene.gltf(filepath='{}', bone_heuristic='BLENDER')\n"
      "def find(identity):\n"
      "    return [o for o in bpy.data.objects if o.get('rigc') == identity][0]\n"
      "{}"
      "bpy.ops.export_scene.gltf(filepath='{}', export_format='GLB', export_extras=True,\n"
      "                          export_frame_range=False)\n",
      fps, in, edit, out);
  const std::string command = "blender -b --factory-startup --python-exit-code 3 --python '" +
                              script + "' >'" + out + ".log' 2>&1";
  std::remove(out.c_str());
  REQUIRE(std::system(command.c_str()) == 0);
  REQUIRE(file_exists(out));
  return true;
}

}  // namespace

TEST_CASE("adopt: through Blender and back without an edit") {
  for (const int fps : {24, 30}) {
    CAPTURE(fps);
    const WalkShot shot = make_shot("blender");
    const std::string edited = test::test_out("broken/adopt_blender_edited.glb");
    if (!through_blender(shot.path, edited, fps, "")) return;
    const std::string out = test::test_out("adopt_blender_out.glb");
    const auto report = adopted(edited, shot.path, out, true);
    CHECK(report.transforms + report.attributes + report.joints == 0);
    REQUIRE(report.clips.size() == 1);
    CHECK(report.clips[0].changed + report.clips[0].added == 0);
    CHECK(bytes_of(out) == bytes_of(shot.path));
  }
}

TEST_CASE("adopt: a control moved, a key changed, a property set and a joint moved in Blender") {
  const WalkShot shot = make_shot("blender_edit");
  const std::string edited = test::test_out("broken/adopt_blender_edit_edited.glb");
  const gltf::Rig before = rig_of(shot.path);
  const std::string edit = fmt::format(
      "free = find('{}')\n"
      "free.location = (0.1, -0.3, 0.2)\n"  // x, -z, y
      "find('{}')['ik_fk'] = 0.25\n"
      "action = find('{}').animation_data.nla_tracks[0].strips[0].action\n"
      "curve = [f for f in action.fcurves if f.data_path == 'location' and f.array_index == 2][0]\n"
      "key = curve.keyframe_points[1]\n"
      "key.co.y += 0.5\nkey.handle_left.y += 0.5\nkey.handle_right.y += 0.5\n"
      "curve.update()\n"
      "armature = [o for o in bpy.data.objects if o.type == 'ARMATURE'][0]\n"
      "bpy.context.view_layer.objects.active = armature\n"
      "bpy.ops.object.mode_set(mode='EDIT')\n"
      "bone = armature.data.edit_bones['head_head']\n"
      "bone.head.z += 0.03\nbone.tail.z += 0.03\n"
      "bpy.ops.object.mode_set(mode='OBJECT')\n",
      shot.identity(shot.free), shot.identity(shot.settings), shot.identity(shot.body));
  if (!through_blender(shot.path, edited, 24, edit)) return;
  const std::string out = test::test_out("adopt_blender_edit_out.glb");
  const auto report = adopted(edited, shot.path, out);
  CHECK(report.transforms == 1);
  CHECK(report.attributes == 1);
  REQUIRE(report.clips.size() == 1);
  CHECK(report.clips[0].changed == 1);
  CHECK(report.clips[0].added == 0);
  const anim::Clip after = clip_of(out, "walk");
  CHECK(near(value_at(after, shot.body, Path::translation, 0.5), {0.1, 0.55, 0}, 1e-4));
  CHECK(near(value_at(after, shot.body, Path::translation, 0), {0, 0, 0}, 1e-4));
  CHECK(find(after, shot.settings, Path::attribute));
  const auto there = test::load_glb(shot.path).json, here = test::load_glb(out).json;
  CHECK(here["extensions"]["RIGC_rig"] == there["extensions"]["RIGC_rig"]);
  const auto& free = here["nodes"][static_cast<std::size_t>(shot.free)];
  CHECK(near(free["translation"], {0.1, 0.2, 0.3}, 1e-4));
  CHECK(here["nodes"][static_cast<std::size_t>(shot.settings)]["extras"]["ik_fk"] == 0.25);

  const std::string placed = test::test_out("adopt_blender_edit_placed.glb");
  const auto with_joints = adopted(edited, shot.path, placed, true);
  const gltf::Rig rig = rig_of(placed);
  for (std::size_t i = 0; i < rig.skeleton.joints.size(); ++i) {
    const math::Vec3 moved = rig.skeleton.world(i).origin - before.skeleton.world(i).origin;
    // Eyes and the tip hang on the head, and are no bones in Blender.
    const std::string& local = rig.skeleton.joints[i].ids.local;
    const double height = local.starts_with("head") && local != "head_neck" ? 0.03 : 0;
    CHECK_MESSAGE(math::length(moved - math::Vec3{0, height, 0}) < 1e-4,
                  rig.skeleton.joints[i].name, moved.x, " ", moved.y, " ", moved.z);
  }
  CHECK(with_joints.joints == 1);
}

}  // namespace rigc
