// SPDX-License-Identifier: MIT
// The rows of the table of node kinds, checked against the indices in kinds.h when compiled.
// Test: tests/scene/kinds_test.cpp
#include "scene/kinds.h"

#include <array>

namespace rigc::scene {

namespace {

constexpr bool kArray = true, kSingle = false, kKeyable = true, kFixed = false;
constexpr auto kIn = Role::input, kOut = Role::output, kData = Role::data;

constexpr auto kTransform = std::to_array<AttributeSpec>({
    {"translate", Type::vec3, kIn, kSingle, kKeyable, 0, "Position in the parent's space."},
    {"rotation", Type::quat, kIn, kSingle, kKeyable, 0, "Rotation in the parent's space."},
    {"scale", Type::vec3, kIn, kSingle, kKeyable, 1, "Scale along the own axes."},
    {"rotate", Type::vec3, kIn, kSingle, kKeyable, 0, "The rotation as angles, X then Y then Z."},
    {"visible", Type::number, kIn, kSingle, kKeyable, 1, "0 hides the node and what is under it."},
    {"world", Type::matrix, kOut, kSingle, kFixed, 0, "Transform in the rig's space."},
    {"parent", Type::matrix, kOut, kSingle, kFixed, 0, "The parent's world."},
});

template <std::size_t n, std::size_t m>
constexpr std::array<AttributeSpec, n + m> joined(const std::array<AttributeSpec, n>& first,
                                                  const std::array<AttributeSpec, m>& second) {
  std::array<AttributeSpec, n + m> all{};
  for (std::size_t i = 0; i < n; ++i) all[i] = first[i];
  for (std::size_t i = 0; i < m; ++i) all[n + i] = second[i];
  return all;
}

constexpr auto kControl = joined(
    kTransform,
    std::to_array<AttributeSpec>({
        {"shape", Type::text, kData, kSingle, kFixed, 0, "Name of the shape."},
        {"points", Type::numbers, kData, kSingle, kFixed, 0,
         "Polylines: a count, then its points, repeated."},
        {"color", Type::vec3, kData, kSingle, kFixed, 1, "Colour of the shape, sRGB 0 to 1."},
        {"keyable", Type::number, kData, kSingle, kFixed, 7,
         "What animators key: 1 translate, 2 rotate, 4 scale, added up."},
        {"opposite", Type::text, kData, kSingle, kFixed, 0,
         "Identity of the control on the other side."},
        {"mirror", Type::numbers, kData, kSingle, kFixed, 0,
         "Signs with which translations are copied to the opposite."},
        {"locked_components", Type::number, kData, kSingle, kFixed, 0,
         "Components that keep their value: 1 2 4 translate x y z, 8 16 32 rotate, 64 128 256 "
         "scale, added up."},
        {"hidden_components", Type::number, kData, kSingle, kFixed, 0,
         "Components that a list of attributes leaves out, added up in the same way."},
    }));

constexpr auto kConstraint = std::to_array<AttributeSpec>({
    {"parent", Type::matrix, kIn, kSingle, kFixed, 0, "Parent space of the driven transform."},
    {"targets", Type::matrix, kIn, kArray, kFixed, 0, "Worlds of the targets."},
    {"weights", Type::number, kIn, kArray, kFixed, 1,
     "Influence of each target, relative to their sum."},
    {"offsets", Type::matrix, kData, kArray, kFixed, 0,
     "The driven rest as seen from each target."},
    {"translate", Type::vec3, kOut, kSingle, kFixed, 0, "Position in the parent's space."},
    {"rotation", Type::quat, kOut, kSingle, kFixed, 0, "Rotation in the parent's space."},
    {"scale", Type::vec3, kOut, kSingle, kFixed, 1, "Scale relative to the parent."},
    {"rotate", Type::vec3, kOut, kSingle, kFixed, 0, "The rotation as angles."},
});

constexpr auto kAim = std::to_array<AttributeSpec>({
    {"parent", Type::matrix, kIn, kSingle, kFixed, 0, "Parent space of the driven transform."},
    {"targets", Type::matrix, kIn, kArray, kFixed, 0, "Worlds of the targets."},
    {"weights", Type::number, kIn, kArray, kFixed, 1,
     "Influence of each target, relative to their sum."},
    {"position", Type::vec3, kIn, kSingle, kFixed, 0, "The driven transform's translate."},
    {"up_target", Type::matrix, kIn, kSingle, kFixed, 0, "What up is measured by."},
    {"up_mode", Type::number, kData, kSingle, kFixed, 0,
     "0: up_vector in rig space; 1: toward up_target; 2: up_vector turned by up_target."},
    {"up_vector", Type::vec3, kIn, kSingle, kFixed, 0, "Direction of up."},
    {"offset", Type::quat, kData, kSingle, kFixed, 0,
     "Driven rest rotation seen from the aim frame."},
    {"rotation", Type::quat, kOut, kSingle, kFixed, 0, "Rotation in the parent's space."},
    {"rotate", Type::vec3, kOut, kSingle, kFixed, 0, "The rotation as angles."},
});

constexpr auto kIk2 = std::to_array<AttributeSpec>({
    {"base", Type::matrix, kIn, kSingle, kFixed, 0, "Parent space of the start joint."},
    {"goal", Type::matrix, kIn, kSingle, kFixed, 0, "Where the end joint shall be."},
    {"pole", Type::matrix, kIn, kSingle, kFixed, 0, "What the middle joint points at."},
    {"twist", Type::number, kIn, kSingle, kFixed, 0, "Degrees about the line from start to goal."},
    {"start", Type::vec3, kIn, kSingle, kFixed, 0, "Translate of the start joint."},
    {"middle", Type::vec3, kIn, kSingle, kFixed, 0, "Translate of the middle joint."},
    {"end", Type::vec3, kIn, kSingle, kFixed, 0, "Translate of the end joint."},
    {"start_scale", Type::vec3, kIn, kSingle, kFixed, 1, "Scale of the start joint."},
    {"middle_scale", Type::vec3, kIn, kSingle, kFixed, 1, "Scale of the middle joint."},
    {"goal_offset", Type::vec3, kData, kSingle, kFixed, 0,
     "End joint's rest position as seen from the goal."},
    {"offsets", Type::quat, kData, kArray, kFixed, 0,
     "Rest rotations of the joints seen from their bone frames."},
    {"normal", Type::vec3, kData, kSingle, kFixed, 0,
     "Bend normal in base space where the pole gives none."},
    {"start_world", Type::matrix, kOut, kSingle, kFixed, 0, "Solved world of the start joint."},
    {"middle_world", Type::matrix, kOut, kSingle, kFixed, 0, "Solved world of the middle joint."},
    {"start_twist", Type::number, kIn, kSingle, kFixed, 0,
     "Degrees that the start joint is turned about its bone."},
    {"middle_twist", Type::number, kIn, kSingle, kFixed, 0,
     "Degrees that the middle joint is turned about its bone."},
});

constexpr auto kIkChain = std::to_array<AttributeSpec>({
    {"base", Type::matrix, kIn, kSingle, kFixed, 0, "Parent space of the first joint."},
    {"goal", Type::matrix, kIn, kSingle, kFixed, 0, "Where the last joint shall be."},
    {"pole", Type::matrix, kIn, kSingle, kFixed, 0, "What the bend points at."},
    {"has_pole", Type::number, kData, kSingle, kFixed, 0, "1 where the pole counts."},
    {"twist", Type::number, kIn, kSingle, kFixed, 0,
     "Degrees about the line from the first joint to the goal."},
    {"translates", Type::vec3, kIn, kArray, kFixed, 0, "Translates of the joints, first to last."},
    {"rests", Type::quat, kData, kArray, kFixed, 0, "Rest rotations of the joints."},
    {"iterations", Type::number, kData, kSingle, kFixed, 32, "Passes of the solver."},
    {"goal_offset", Type::vec3, kData, kSingle, kFixed, 0,
     "Last joint's rest position as seen from the goal."},
    {"rotations", Type::quat, kOut, kArray, kFixed, 0,
     "Solved rotations of all joints but the last."},
});

constexpr auto kExpression = std::to_array<AttributeSpec>({
    {"code", Type::text, kData, kSingle, kFixed, 0, "The formula; $0, $1, ... are the inputs."},
    {"inputs", Type::number, kIn, kArray, kFixed, 0, "What the formula reads."},
    {"output", Type::number, kOut, kSingle, kFixed, 0, "The result."},
});

constexpr auto kRemap = std::to_array<AttributeSpec>({
    {"input", Type::number, kIn, kSingle, kFixed, 0, "What is mapped."},
    {"input_min", Type::number, kIn, kSingle, kFixed, 0, "Input at the curve's start."},
    {"input_max", Type::number, kIn, kSingle, kFixed, 1, "Input at the curve's end."},
    {"output_min", Type::number, kIn, kSingle, kFixed, 0, "Output where the curve is 0."},
    {"output_max", Type::number, kIn, kSingle, kFixed, 1, "Output where the curve is 1."},
    {"points", Type::numbers, kData, kSingle, kFixed, 0,
     "Position, value, interpolation of each point of the curve."},
    {"clamp", Type::number, kData, kSingle, kFixed, 1, "1 holds the ends, 0 extends them in line."},
    {"output", Type::number, kOut, kSingle, kFixed, 0, "The result."},
});

constexpr auto kMesh = std::to_array<AttributeSpec>({
    {"joints", Type::matrix, kIn, kArray, kFixed, 0, "Worlds of the joints."},
    {"parts", Type::numbers, kData, kSingle, kFixed, 0,
     "Style, ends, side, sizes and colour of each part."},
});

constexpr auto kLimits = std::to_array<AttributeSpec>({
    {"node", Type::matrix, kIn, kSingle, kFixed, 0, "World of the transform that is limited."},
    {"bounds", Type::numbers, kData, kSingle, kFixed, 0,
     "Channel (0 1 2 translate, 3 4 5 rotate, 6 7 8 scale), 0 min or 1 max, value of each bound."},
    {"order", Type::text, kData, kSingle, kFixed, 0, "Order of the angles about fixed axes."},
    {"axes", Type::quat, kData, kSingle, kFixed, 0, "Axes that are limited, parent space."},
    {"origin", Type::vec3, kData, kSingle, kFixed, 0, "Where translate counts as 0."},
    {"rest", Type::quat, kData, kSingle, kFixed, 0, "Rotation that counts as none."},
});

constexpr auto kDisplayLayer = std::to_array<AttributeSpec>({
    {"layer", Type::text, kData, kSingle, kFixed, 0, "Name of the layer."},
    {"visible", Type::number, kIn, kSingle, kFixed, 1, "0 hides its members."},
    {"mode", Type::text, kData, kSingle, kFixed, 0, "normal, template or reference."},
    {"color", Type::numbers, kData, kSingle, kFixed, 0, "Colour, sRGB 0 to 1; or none."},
    {"members", Type::matrix, kIn, kArray, kFixed, 0, "Worlds of its members."},
});

constexpr auto kControlSet = std::to_array<AttributeSpec>({
    {"set", Type::text, kData, kSingle, kFixed, 0, "Name of the set."},
    {"parent", Type::text, kData, kSingle, kFixed, 0, "Name of the set that it is in."},
    {"members", Type::matrix, kIn, kArray, kFixed, 0, "Worlds of its controls."},
});

constexpr auto kCompute = std::to_array<AttributeSpec>({
    {"code", Type::text, kData, kSingle, kFixed, 0,
     "The program; it names what it takes and gives."},
    {"numbers", Type::number, kIn, kArray, kFixed, 0, "Numbers that it takes."},
    {"vectors", Type::vec3, kIn, kArray, kFixed, 0, "Vectors that it takes."},
    {"rotations", Type::quat, kIn, kArray, kFixed, 0, "Rotations that it takes."},
    {"matrices", Type::matrix, kIn, kArray, kFixed, 0, "Matrices that it takes."},
    {"number", Type::number, kOut, kArray, kFixed, 0, "Numbers that it gives."},
    {"vector", Type::vec3, kOut, kArray, kFixed, 0, "Vectors that it gives."},
    {"rotation", Type::quat, kOut, kArray, kFixed, 0, "Rotations that it gives."},
    {"matrix", Type::matrix, kOut, kArray, kFixed, 0, "Matrices that it gives."},
});

constexpr auto kSpline = std::to_array<AttributeSpec>({
    {"base", Type::matrix, kIn, kSingle, kFixed, 0, "Lengths are measured in its scale."},
    {"controls", Type::matrix, kIn, kArray, kFixed, 0, "What the curve passes through."},
    {"preserve", Type::number, kIn, kSingle, kFixed, 0,
     "0: outputs stretch with the curve; 1: they keep their distances."},
    {"twists", Type::number, kIn, kArray, kFixed, 0,
     "Degrees about the curve at each control, or none."},
    {"rests", Type::matrix, kData, kArray, kFixed, 0, "Controls at rest, base space."},
    {"follows", Type::number, kData, kArray, kFixed, 1,
     "How much the curve's direction turns with each control."},
    {"parameters", Type::number, kData, kArray, kFixed, 0,
     "Place of each output along the curve: i at control i."},
    {"places", Type::matrix, kData, kArray, kFixed, 0, "Outputs at rest, base space."},
    {"aims", Type::number, kData, kSingle, kFixed, 0,
     "1: outputs point at the next one; 0: along the curve."},
    {"worlds", Type::matrix, kOut, kArray, kFixed, 0, "Where the outputs are."},
    {"length", Type::number, kOut, kSingle, kFixed, 0, "Length of the curve, in base units."},
    {"stretch", Type::number, kOut, kSingle, kFixed, 1, "The same relative to rest."},
    {"least", Type::number, kIn, kSingle, kFixed, 0,
     "How short the way of the outputs may become."},
    {"most", Type::number, kIn, kSingle, kFixed, 1e6, "How long it may become."},
});

constexpr auto kSkinSplit = std::to_array<AttributeSpec>({
    {"joints", Type::matrix, kIn, kArray, kFixed, 0,
     "Worlds of the bone's joint, of its end, and of the joints that take a share."},
    {"fractions", Type::numbers, kData, kSingle, kFixed, 0,
     "Where along the bone all weights are of one joint: of the bone's, then of the others."},
    {"line", Type::numbers, kData, kSingle, kFixed, 0,
     "Points of a line in the space of the bone's joint that stands for the bone."},
    {"surface", Type::text, kData, kSingle, kFixed, 0, "Whose vertices alone share."},
});

constexpr auto kMorph = std::to_array<AttributeSpec>({
    {"targets", Type::text, kData, kSingle, kFixed, 0, "Names of morph targets, a line each."},
    {"weights", Type::number, kIn, kArray, kFixed, 0, "The weight of each."},
});

constexpr auto kMatch = std::to_array<AttributeSpec>({
    {"limb", Type::text, kData, kSingle, kFixed, 0, "Name of the limb."},
    {"joints", Type::matrix, kIn, kArray, kFixed, 0, "Worlds of start, middle and end."},
    {"fk", Type::matrix, kIn, kArray, kFixed, 0, "Worlds of the controls that turn these."},
    {"ik", Type::matrix, kIn, kSingle, kFixed, 0, "World of the control of the end."},
    {"pole", Type::matrix, kIn, kSingle, kFixed, 0, "World of the control of the middle."},
    {"solver", Type::matrix, kIn, kSingle, kFixed, 0, "The solver's world of the start."},
    {"switch", Type::number, kIn, kSingle, kFixed, 0, "0 is FK, 1 is IK."},
    {"meanings", Type::text, kData, kSingle, kFixed, 0, "A word for each of the numbers."},
    {"numbers", Type::number, kIn, kArray, kFixed, 0, "Attributes of the limb."},
    {"held", Type::matrix, kIn, kArray, kFixed, 0, "Worlds of controls that go along with it."},
});

constexpr auto kSpaces = std::to_array<AttributeSpec>({
    {"control", Type::matrix, kIn, kSingle, kFixed, 0, "World of the control."},
    {"names", Type::text, kData, kSingle, kFixed, 0, "Names of the spaces."},
    {"number", Type::number, kIn, kSingle, kFixed, 0, "Which one it follows; 0 is the first."},
    {"shares", Type::number, kIn, kArray, kFixed, 0, "How much each counts beside it."},
});

constexpr std::array<KindSpec, static_cast<std::size_t>(Kind::count)> kKinds = {{
    {Kind::joint, "joint", true, kTransform},
    {Kind::transform, "transform", true, kTransform},
    {Kind::control, "control", true, kControl},
    {Kind::handle, "handle", true, kTransform},
    {Kind::point_constraint, "point_constraint", false, kConstraint},
    {Kind::orient_constraint, "orient_constraint", false, kConstraint},
    {Kind::scale_constraint, "scale_constraint", false, kConstraint},
    {Kind::parent_constraint, "parent_constraint", false, kConstraint},
    {Kind::aim_constraint, "aim_constraint", false, kAim},
    {Kind::ik_two_bone, "ik_two_bone", false, kIk2},
    {Kind::ik_chain, "ik_chain", false, kIkChain},
    {Kind::expression, "expression", false, kExpression},
    {Kind::remap, "remap", false, kRemap},
    {Kind::mesh, "mesh", false, kMesh},
    {Kind::limits, "limits", false, kLimits},
    {Kind::display_layer, "display_layer", false, kDisplayLayer},
    {Kind::control_set, "control_set", false, kControlSet},
    {Kind::compute, "compute", false, kCompute},
    {Kind::spline, "spline", false, kSpline},
    {Kind::skin_split, "skin_split", false, kSkinSplit},
    {Kind::match, "match", false, kMatch},
    {Kind::morph, "morph", false, kMorph},
    {Kind::spaces, "spaces", false, kSpaces},
}};

constexpr bool complete() {
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (static_cast<std::size_t>(kKinds[i].kind) != i || kKinds[i].name.empty()) return false;
  }
  return true;
}
static_assert(complete());

// A name at each index that kinds.h gives: the two cannot drift apart.
struct At {
  std::uint16_t index;
  std::string_view name;
};
template <std::size_t n, std::size_t m>
constexpr bool matches(const std::array<AttributeSpec, n>& table, const At (&indices)[m]) {
  for (const At& at : indices) {
    if (at.index >= n || table[at.index].name != at.name) return false;
  }
  return true;
}

constexpr At kTransformAt[] = {
    {transform::kTranslate, "translate"}, {transform::kRotation, "rotation"},
    {transform::kScale, "scale"},         {transform::kRotate, "rotate"},
    {transform::kVisible, "visible"},     {transform::kWorld, "world"},
    {transform::kParent, "parent"}};
static_assert(std::size(kTransform) == transform::kCount &&
              std::size(kTransformAt) == transform::kCount);
static_assert(matches(kTransform, kTransformAt) && matches(kControl, kTransformAt));

constexpr At kControlAt[] = {{control::kShape, "shape"},
                             {control::kPoints, "points"},
                             {control::kColor, "color"},
                             {control::kKeyable, "keyable"},
                             {control::kOpposite, "opposite"},
                             {control::kMirror, "mirror"},
                             {control::kLocked, "locked_components"},
                             {control::kHidden, "hidden_components"}};
static_assert(std::size(kControl) == transform::kCount + std::size(kControlAt) &&
              matches(kControl, kControlAt));

constexpr At kConstraintAt[] = {
    {constraint::kParent, "parent"},       {constraint::kTargets, "targets"},
    {constraint::kWeights, "weights"},     {constraint::kOffsets, "offsets"},
    {constraint::kTranslate, "translate"}, {constraint::kRotation, "rotation"},
    {constraint::kScale, "scale"},         {constraint::kRotate, "rotate"}};
static_assert(std::size(kConstraint) == std::size(kConstraintAt) &&
              matches(kConstraint, kConstraintAt));

constexpr At kAimAt[] = {{aim::kParent, "parent"},      {aim::kTargets, "targets"},
                         {aim::kWeights, "weights"},    {aim::kPosition, "position"},
                         {aim::kUpTarget, "up_target"}, {aim::kUpMode, "up_mode"},
                         {aim::kUpVector, "up_vector"}, {aim::kOffset, "offset"},
                         {aim::kRotation, "rotation"},  {aim::kRotate, "rotate"}};
static_assert(std::size(kAim) == std::size(kAimAt) && matches(kAim, kAimAt));

constexpr At kIk2At[] = {{ik2::kBase, "base"},
                         {ik2::kGoal, "goal"},
                         {ik2::kPole, "pole"},
                         {ik2::kTwist, "twist"},
                         {ik2::kStart, "start"},
                         {ik2::kMiddle, "middle"},
                         {ik2::kEnd, "end"},
                         {ik2::kStartScale, "start_scale"},
                         {ik2::kMiddleScale, "middle_scale"},
                         {ik2::kGoalOffset, "goal_offset"},
                         {ik2::kOffsets, "offsets"},
                         {ik2::kNormal, "normal"},
                         {ik2::kStartWorld, "start_world"},
                         {ik2::kMiddleWorld, "middle_world"},
                         {ik2::kStartTwist, "start_twist"},
                         {ik2::kMiddleTwist, "middle_twist"}};
static_assert(std::size(kIk2) == std::size(kIk2At) && matches(kIk2, kIk2At));

constexpr At kIkChainAt[] = {{ik_chain::kBase, "base"},
                             {ik_chain::kGoal, "goal"},
                             {ik_chain::kPole, "pole"},
                             {ik_chain::kHasPole, "has_pole"},
                             {ik_chain::kTwist, "twist"},
                             {ik_chain::kTranslates, "translates"},
                             {ik_chain::kRests, "rests"},
                             {ik_chain::kIterations, "iterations"},
                             {ik_chain::kGoalOffset, "goal_offset"},
                             {ik_chain::kRotations, "rotations"}};
static_assert(std::size(kIkChain) == std::size(kIkChainAt) && matches(kIkChain, kIkChainAt));

constexpr At kExpressionAt[] = {
    {expression::kCode, "code"}, {expression::kInputs, "inputs"}, {expression::kOutput, "output"}};
static_assert(std::size(kExpression) == std::size(kExpressionAt) &&
              matches(kExpression, kExpressionAt));

constexpr At kRemapAt[] = {{remap::kInput, "input"},          {remap::kInputMin, "input_min"},
                           {remap::kInputMax, "input_max"},   {remap::kOutputMin, "output_min"},
                           {remap::kOutputMax, "output_max"}, {remap::kPoints, "points"},
                           {remap::kClamp, "clamp"},          {remap::kOutput, "output"}};
static_assert(std::size(kRemap) == std::size(kRemapAt) && matches(kRemap, kRemapAt));

constexpr At kMeshAt[] = {{mesh::kJoints, "joints"}, {mesh::kParts, "parts"}};
static_assert(std::size(kMesh) == std::size(kMeshAt) && matches(kMesh, kMeshAt));

constexpr At kLimitsAt[] = {{limits::kNode, "node"},     {limits::kBounds, "bounds"},
                            {limits::kOrder, "order"},   {limits::kAxes, "axes"},
                            {limits::kOrigin, "origin"}, {limits::kRest, "rest"}};
static_assert(std::size(kLimits) == std::size(kLimitsAt) && matches(kLimits, kLimitsAt));

constexpr At kDisplayLayerAt[] = {{display_layer::kLayer, "layer"},
                                  {display_layer::kVisible, "visible"},
                                  {display_layer::kMode, "mode"},
                                  {display_layer::kColor, "color"},
                                  {display_layer::kMembers, "members"}};
static_assert(std::size(kDisplayLayer) == std::size(kDisplayLayerAt) &&
              matches(kDisplayLayer, kDisplayLayerAt));

constexpr At kControlSetAt[] = {{control_set::kSet, "set"},
                                {control_set::kParent, "parent"},
                                {control_set::kMembers, "members"}};
static_assert(std::size(kControlSet) == std::size(kControlSetAt) &&
              matches(kControlSet, kControlSetAt));

constexpr At kComputeAt[] = {{compute::kCode, "code"},         {compute::kNumbers, "numbers"},
                             {compute::kVectors, "vectors"},   {compute::kRotations, "rotations"},
                             {compute::kMatrices, "matrices"}, {compute::kNumberOut, "number"},
                             {compute::kVectorOut, "vector"},  {compute::kRotationOut, "rotation"},
                             {compute::kMatrixOut, "matrix"}};
static_assert(std::size(kCompute) == std::size(kComputeAt) && matches(kCompute, kComputeAt));

constexpr At kSplineAt[] = {{spline::kBase, "base"},
                            {spline::kControls, "controls"},
                            {spline::kPreserve, "preserve"},
                            {spline::kTwists, "twists"},
                            {spline::kRests, "rests"},
                            {spline::kFollows, "follows"},
                            {spline::kParameters, "parameters"},
                            {spline::kPlaces, "places"},
                            {spline::kAims, "aims"},
                            {spline::kWorlds, "worlds"},
                            {spline::kLength, "length"},
                            {spline::kStretch, "stretch"},
                            {spline::kLeast, "least"},
                            {spline::kMost, "most"}};
static_assert(std::size(kSpline) == std::size(kSplineAt) && matches(kSpline, kSplineAt));

constexpr At kSkinSplitAt[] = {{skin_split::kJoints, "joints"},
                               {skin_split::kFractions, "fractions"},
                               {skin_split::kLine, "line"},
                               {skin_split::kSurface, "surface"}};
static_assert(std::size(kSkinSplit) == std::size(kSkinSplitAt) &&
              matches(kSkinSplit, kSkinSplitAt));

constexpr At kMorphAt[] = {{morph::kTargets, "targets"}, {morph::kWeights, "weights"}};
static_assert(std::size(kMorph) == std::size(kMorphAt) && matches(kMorph, kMorphAt));

constexpr At kMatchAt[] = {{match::kLimb, "limb"},       {match::kJoints, "joints"},
                           {match::kFk, "fk"},           {match::kIk, "ik"},
                           {match::kPole, "pole"},       {match::kSolver, "solver"},
                           {match::kSwitch, "switch"},   {match::kMeanings, "meanings"},
                           {match::kNumbers, "numbers"}, {match::kHeld, "held"}};
static_assert(std::size(kMatch) == std::size(kMatchAt) && matches(kMatch, kMatchAt));

constexpr At kSpacesAt[] = {{spaces::kControl, "control"},
                            {spaces::kNames, "names"},
                            {spaces::kNumber, "number"},
                            {spaces::kShares, "shares"}};
static_assert(std::size(kSpaces) == std::size(kSpacesAt) && matches(kSpaces, kSpacesAt));

}  // namespace

const KindSpec& spec(Kind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

std::optional<Kind> parse_kind(std::string_view name) {
  for (const KindSpec& row : kKinds) {
    if (row.name == name) return row.kind;
  }
  return std::nullopt;
}

}  // namespace rigc::scene
