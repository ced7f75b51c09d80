// SPDX-License-Identifier: MIT
// Diagnostic codes 650..699: files and what they hold (rigs: rig_codes.h).
// Test: every code is provoked by a test in tests/gltf.
#pragma once

#include "base/diagnostics.h"

namespace rigc::gltf::codes {

// Container.
inline constexpr Code kGlbHeader{650, Severity::error, "bad .glb header",
                                 "A .glb begins with `glTF`, version 2 and the length of the whole "
                                 "file. The file is damaged, cut "
                                 "off, or of another version."};
inline constexpr Code kGlbChunk{651, Severity::error, "bad .glb chunk",
                                "The chunks of a .glb fill the file exactly, each a multiple of 4 "
                                "bytes long: first JSON, then at "
                                "most one BIN. The file is damaged."};
inline constexpr Code kGlbTooLarge{
    652, Severity::error, ".glb too large",
    "Lengths in a .glb have 32 bits. Write a .gltf with a buffer file of its own."};
inline constexpr Code kChunksLost{
    653, Severity::warning, "extra chunks are not written",
    "Chunks after BIN belong to extensions that rigc does not know; a .gltf cannot hold them."};

// Properties.
inline constexpr Code kAssetVersion{
    654, Severity::error, "not glTF 2",
    "The file does not say `asset.version` 2.x, or asks for a newer minor version than 2.0."};
inline constexpr Code kWrongType{
    655, Severity::error, "wrong type of property",
    "The property is there, but its value is of another JSON type than glTF 2.0 says."};
inline constexpr Code kMissing{656, Severity::error, "missing property",
                               "glTF 2.0 requires this property."};
inline constexpr Code kIndex{
    657, Severity::error, "index out of range",
    "The number names an element of a top-level array that does not exist."};
inline constexpr Code kValue{
    658, Severity::error, "value not allowed",
    "glTF 2.0 lists the values, or the range, that this property may have."};

// Hierarchy.
inline constexpr Code kTwoParents{660, Severity::error, "node with two parents",
                                  "Every node is the child of at most one node, and only once."};
inline constexpr Code kNodeCycle{661, Severity::error, "node is its own ancestor",
                                 "Following `children` must never lead back."};
inline constexpr Code kTransform{662, Severity::error, "bad node transform",
                                 "translation and scale have 3 numbers, rotation 4, matrix 16, and "
                                 "a node has either a matrix or "
                                 "the others."};
inline constexpr Code kZeroRotation{663, Severity::error, "rotation of zero length",
                                    "A quaternion of length zero is no rotation."};

// Buffers and accessors.
inline constexpr Code kBufferUri{
    665, Severity::error, "bad URI",
    "Buffers are named by a path beside the file or hold a base64 data URI."};
inline constexpr Code kBufferEscapes{
    666, Severity::error, "buffer outside the file's folder",
    "For safety only files in the folder of the model, or in folders inside it, are opened."};
inline constexpr Code kBufferShort{667, Severity::error, "buffer too short",
                                   "The buffer has fewer bytes than its byteLength says. It is cut "
                                   "off or belongs to another file."};
inline constexpr Code kViewRange{
    668, Severity::error, "buffer view beyond its buffer",
    "byteOffset + byteLength of the view must lie inside the buffer's byteLength."};
inline constexpr Code kStride{
    669, Severity::error, "bad byteStride",
    "byteStride is a multiple of 4 from 4 to 252 and not below the size of an element."};
inline constexpr Code kAccessorRange{
    670, Severity::error, "accessor beyond its buffer view",
    "The last element of the accessor must lie inside the buffer view."};
inline constexpr Code kSparse{
    671, Severity::error, "bad sparse accessor",
    "Indices of a sparse accessor rise strictly and stay below its count."};
inline constexpr Code kNoData{672, Severity::error, "data cannot be read",
                              "The accessor's bytes are compressed by an extension, or there are "
                              "none. Save the model without "
                              "compression of animations and skins."};
inline constexpr Code kNotFinite{673, Severity::error, "number is not finite",
                                 "Animations and skins may not hold NaN or infinite numbers."};

// Skins and animations.
inline constexpr Code kSkinJoints{675, Severity::error, "bad list of joints",
                                  "A skin has at least one joint, each at most once."};
inline constexpr Code kSkinMatrices{
    676, Severity::error, "bad inverse bind matrices",
    "inverseBindMatrices is an accessor of float MAT4 with at least one matrix a joint."};
inline constexpr Code kBindSingular{
    677, Severity::error, "inverse bind matrix cannot be inverted",
    "The joint's bind pose is not defined. Repair the skin, or build with `--rest nodes`."};
inline constexpr Code kSampler{678, Severity::error, "bad animation sampler",
                               "Input is float SCALAR; output has one element a key (three with "
                               "CUBICSPLINE), of the type that "
                               "the target needs."};
inline constexpr Code kTimes{679, Severity::error, "times do not rise",
                             "Key times are not negative and rise strictly."};
inline constexpr Code kReader{
    680, Severity::error, "glTF reader refused the file",
    "The library that reads nodes and animations found something that rigc's own checks did not."};

// Rest pose.
inline constexpr Code kRest{
    685, Severity::error, "unknown rest pose",
    "The rest pose is `bind`, `nodes`, or the name of a clip and a time: `CLIP@SECONDS`."};

// What the rest of the file says about them.
inline constexpr Code kNotAffine{
    690, Severity::error, "inverse bind matrix is not affine",
    "The last row of an inverse bind matrix is 0 0 0 1. Repair the skin, or build with `--rest "
    "nodes`."};
inline constexpr Code kRestUndefined{
    691, Severity::error, "rest pose of a joint is not defined",
    "Where a joint rests cannot be computed: a node above the skeleton has scale 0, or numbers are "
    "too large. Repair the nodes above it."};
inline constexpr Code kPointer{
    692, Severity::error, "animation pointer to nowhere",
    "A channel of KHR_animation_pointer names its target by a JSON pointer, and the node that it "
    "names must exist."};
inline constexpr Code kTooMany{
    693, Severity::error, "absurd number of elements",
    "The file has so many nodes, accessors or the like in so few bytes that reading them would "
    "take "
    "memory out of proportion. It is damaged or made to do harm."};
inline constexpr Code kBufferNotFile{
    694, Severity::error, "buffer is no file",
    "The buffer's URI names a folder, a device, a FIFO or a socket. Only regular files are read."};

// Files beside the output.
inline constexpr Code kCopyClash{
    686, Severity::error, "another file is in the way",
    "The model names a file, an image or a buffer, that has to lie beside the output too; a file "
    "with other content lies there already and is not replaced."};
inline constexpr Code kNotCopied{
    687, Severity::warning, "file is not copied",
    "The model names a file that cannot be copied beside the output: it does not exist, or it lies "
    "outside the model's folder. The output names it as the model does."};

inline constexpr const Code* kGltfCodes[] = {
    &kGlbHeader,     &kGlbChunk,  &kGlbTooLarge,   &kChunksLost,  &kAssetVersion, &kWrongType,
    &kMissing,       &kIndex,     &kValue,         &kTwoParents,  &kNodeCycle,    &kTransform,
    &kZeroRotation,  &kBufferUri, &kBufferEscapes, &kBufferShort, &kViewRange,    &kStride,
    &kAccessorRange, &kSparse,    &kNoData,        &kNotFinite,   &kSkinJoints,   &kSkinMatrices,
    &kBindSingular,  &kSampler,   &kTimes,         &kReader,      &kRest,         &kCopyClash,
    &kNotCopied,     &kNotAffine, &kRestUndefined, &kPointer,     &kTooMany,      &kBufferNotFile};

}  // namespace rigc::gltf::codes
