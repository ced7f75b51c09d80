// SPDX-License-Identifier: MIT
// What the tests of law 8 share: files with everything that the corpus has or lacks, random
// mutations of them, rigs that fit onto any file, and what a rig may change in one.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "gltf/rig.h"

namespace rigc::test::lossless {

/// A file's bytes with the path by which it is opened: buffers are looked for beside it.
struct Sample {
  std::string name;
  std::string path;
  std::string bytes;
};

/// A fresh folder below RIGC_TEST_OUT/lossless.
std::string folder(const std::string& name);

/// Every file of the corpus, with its buffers and images beside it in `folder`.
std::vector<Sample> corpus_samples(const std::string& folder);
/// What the corpus lacks: odd containers, buffers and texts, written into `folder`.
std::vector<Sample> made_samples(const std::string& folder);

/// Below `end`, which is above 0.
std::size_t below(std::mt19937_64& random, std::size_t end);

/// The sample with other spelling, order, white space, unknown members and chunks; still valid for
/// rigc.
Sample mutated(const Sample& sample, std::mt19937_64& random);

gltf::File opened(const Sample& sample);
std::string bytes_of(const gltf::Output& output);
/// Finishes a patch and opens what came out, whose new buffer files go beside the sample.
Sample finished(gltf::Patch& patch, const Sample& sample, bool binary);

/// A rig on some nodes of the file, joints of skins if there are any, with controls, shapes and
/// what hangs under joints; with helper joints of its own where `helpers`.
gltf::Rig rig_for(const gltf::File& file, std::mt19937_64& random, std::uint32_t id, bool helpers,
                  int& ancestor);

/// Checks that nothing but what a rig may change differs: extras.rigc of its joints, children of
/// ours at the end of lists, roots at the end of scenes' lists, elements at the end of arrays,
/// RIGC_rig and its entry in extensionsUsed, byteLength of the buffer that took our bytes.
void expect_kept(const gltf::File& before, const gltf::File& after, const gltf::Rig& rig);

/// Writes the rig and gives the file with it, which was checked by expect_kept.
Sample rigged(const Sample& sample, gltf::Rig& rig, int ancestor);
/// All rigs out again, with all that they brought.
Sample stripped(const Sample& sample);

/// Writes a sample where the validator sees it; `model`: another sample's path whose messages it
/// may have.
void show(const Sample& sample, const std::string& path, const std::string& model);

}  // namespace rigc::test::lossless
