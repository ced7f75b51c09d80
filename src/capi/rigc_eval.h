// SPDX-License-Identifier: MIT
// Evaluating rigs from C (C99) and from whatever calls C. A rig is opened from the bytes of its
// file, a program is compiled for the values that will change and the joints that are wanted, and
// instances run it, up to rigc_block_frames() frames at a time:
//
//   rigc_rig_open -> rigc_rig -> rigc_program_create -> rigc_program -> rigc_instance_create
//
// Threads: a rig and a program are immutable and may be used by any number of threads at once; an
// instance and a rigc_diagnostics by one thread at a time. Handles may be destroyed in any order:
// what an instance needs lives as long as it does. After rigc_instance_create nothing allocates
// memory, and nothing ever throws, prints, reads files or depends on the caller's rounding mode.
// The same bytes and values give the same bits on every machine and in every frame of a block.
//
// Space: right-handed, the units of the file, angles in degrees, quaternions x y z w, column
// vectors. World matrices are in the rig's space: that of the glTF node rigc_rig_info::space, or of
// the scene.
//
// Versions: functions and members of structs are only ever added, structs at their end. The caller
// says by `struct_size` (sizeof of the struct it was compiled with) which members it knows; members
// that the library does not know stay as they are. A break of this raises RIGC_EVAL_ABI and the
// library's soname.
//
// docs/c_api.md has an example. Test: tests/capi
#ifndef RIGC_EVAL_H
#define RIGC_EVAL_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define RIGC_EVAL_API __attribute__((visibility("default")))
#else
#define RIGC_EVAL_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define RIGC_EVAL_ABI 1

/// RIGC_EVAL_ABI of the library that runs.
RIGC_EVAL_API uint32_t rigc_eval_abi(void);
/// Version of rigc, "0.1.0".
RIGC_EVAL_API const char* rigc_eval_version(void);

// What a call came to. Where it is not RIGC_OK nothing was changed, and what is returned through
// pointers is as it was, except where a function says otherwise; handles are null then.
typedef int32_t rigc_status;
enum {
  RIGC_OK = 0,
  RIGC_ERROR_ARGUMENT = 1,   // a null pointer, an unknown struct_size, something named twice
  RIGC_ERROR_INDEX = 2,      // there is no such rig, control, channel, joint or frame
  RIGC_ERROR_VALUE = 3,      // a value that is not finite, or beyond 1e30
  RIGC_ERROR_SELECTION = 4,  // the program was not compiled for this channel or joint, or cannot be
  RIGC_ERROR_NOT_FINITE = 5,  // values so large that a joint's matrix has no finite numbers
  RIGC_ERROR_RIG = 6,         // the bytes are no rig that can be evaluated: see the diagnostics
  RIGC_ERROR_MEMORY = 7,
  RIGC_ERROR_INTERNAL = 8  // a mistake of the library
};
/// A sentence in English. Never null.
RIGC_EVAL_API const char* rigc_status_text(rigc_status status);

// ---- Diagnostics: what is wrong with a rig, as the command line of rigc says it ----

typedef struct rigc_diagnostics rigc_diagnostics;

typedef struct rigc_diagnostic {
  size_t struct_size;
  int32_t code;      // 215 is RIG0215 of docs/diagnostics.md
  int32_t is_error;  // 0: a warning
  const char* place;
  const char* message;
  const char* hint;  // may be empty
} rigc_diagnostic;

/// Null where there is no memory, which every function takes for "not wanted".
RIGC_EVAL_API rigc_diagnostics* rigc_diagnostics_create(void);
RIGC_EVAL_API void rigc_diagnostics_destroy(rigc_diagnostics* diagnostics);
/// What the last call that got them had to say. Texts stay valid until the next such call.
RIGC_EVAL_API uint32_t rigc_diagnostics_count(const rigc_diagnostics* diagnostics);
RIGC_EVAL_API rigc_status rigc_diagnostics_get(const rigc_diagnostics* diagnostics, uint32_t index,
                                               rigc_diagnostic* diagnostic);
/// All of them: `file: error[RIG0215]: message`, one below the other. Never null.
RIGC_EVAL_API const char* rigc_diagnostics_text(const rigc_diagnostics* diagnostics);

// ---- Rigs ----

typedef struct rigc_rig rigc_rig;

typedef struct rigc_open_options {
  size_t struct_size;
  const char* name;  // what diagnostics call the bytes; null: "memory"
  uint32_t rig;      // which of the file's rigs, in the order of their numbers; 0: the first
} rigc_open_options;

/// Opens a rig: `bytes` are a .glb or the text of a .gltf, and are not needed any longer when this
/// returns. Files that a .gltf names are not looked for: evaluation needs none of them. The rig
/// stands as in the file, with what animators set without keying it. `options` and `diagnostics`
/// may be null.
RIGC_EVAL_API rigc_status rigc_rig_open(const void* bytes, size_t size,
                                        const rigc_open_options* options,
                                        rigc_diagnostics* diagnostics, rigc_rig** rig);
RIGC_EVAL_API void rigc_rig_destroy(rigc_rig* rig);

// Texts of a rig are UTF-8, never null, and live as long as the rig. Names are for people; what a
// thing is, in every version of its template, is its identity (docs/RIGC_rig.md).

typedef struct rigc_rig_info {
  size_t struct_size;
  const char* name;    // of the template
  const char* global;  // what this rig is called in selectors
  uint32_t number;     // first part of its identities
  uint32_t rig_count;  // rigs in the file
  uint32_t control_count;
  uint32_t joint_count;
  int32_t space;  // glTF node whose space is the rig's; -1: the scene
  double height;  // of the character at rest
  double metre;   // length of a metre of the template
} rigc_rig_info;
RIGC_EVAL_API rigc_status rigc_rig_get_info(const rigc_rig* rig, rigc_rig_info* info);

typedef struct rigc_control_info {
  size_t struct_size;
  const char* identity;
  const char* name;
  const char* local;     // group in selectors; may be empty
  const char* label;     // in the group; may be empty
  const char* module;    // that made it
  const char* command;   // id of its command
  const char* role;      // what the module made it for
  const char* opposite;  // identity of the control on the other side; may be empty
  int32_t node;          // glTF node; -1: the file has none any longer
  int32_t parent;        // nearest control above it; -1: none
  uint32_t channel_count;
} rigc_control_info;
/// Controls are numbered from 0 in the order in which the rig was built.
RIGC_EVAL_API rigc_status rigc_rig_get_control(const rigc_rig* rig, uint32_t control,
                                               rigc_control_info* info);

// Every control has these channels, and behind them one for each of its own attributes.
enum { RIGC_TRANSLATION = 0, RIGC_ROTATION = 1, RIGC_SCALE = 2, RIGC_FIRST_ATTRIBUTE = 3 };

// Kinds of channels.
enum {
  RIGC_VECTOR = 0,      // x y z, in the parent's space
  RIGC_QUATERNION = 1,  // x y z w
  RIGC_NUMBER = 2,
  RIGC_INTEGER = 3,
  RIGC_BOOLEAN = 4,  // 0 or 1
  RIGC_ANGLE = 5     // degrees
};

typedef struct rigc_channel_info {
  size_t struct_size;
  const char* name;  // "translation", "rotation", "scale", or the attribute's
  int32_t kind;
  uint32_t width;  // numbers in a value: 1, 3, 4
  // Components as bits, x 1, y 2, z 4; of a rotation its angles about x y z. An attribute has x.
  uint32_t keyable;  // animators may set them; others keep their value whatever is set
  uint32_t hidden;   // a list of attributes leaves them out
  uint32_t driven;   // the rig computes them; what is set does not count
  double value[4];   // as the file stands: what it is until it is set
  double initial[4];
  double minimum, maximum;  // of an attribute, for sliders; infinite where there is none
} rigc_channel_info;
RIGC_EVAL_API rigc_status rigc_rig_get_channel(const rigc_rig* rig, uint32_t control,
                                               uint32_t channel, rigc_channel_info* info);

typedef struct rigc_joint_info {
  size_t struct_size;
  const char* identity;
  const char* name;
  const char* local;
  const char* label;
  int32_t node;     // glTF node; -1: the file has none any longer
  int32_t parent;   // nearest joint above it in the rig; -1: none
  int32_t is_bone;  // 0: a helper among the controls
  double rest[16];  // world matrix as built, column by column
} rigc_joint_info;
/// Joints are numbered from 0, parents first.
RIGC_EVAL_API rigc_status rigc_rig_get_joint(const rigc_rig* rig, uint32_t joint,
                                             rigc_joint_info* info);

/// Numbers of what has this identity; RIGC_ERROR_INDEX where nothing has.
RIGC_EVAL_API rigc_status rigc_rig_find_control(const rigc_rig* rig, const char* identity,
                                                uint32_t* control);
RIGC_EVAL_API rigc_status rigc_rig_find_joint(const rigc_rig* rig, const char* identity,
                                              uint32_t* joint);
/// The channel of a control by its name.
RIGC_EVAL_API rigc_status rigc_rig_find_channel(const rigc_rig* rig, uint32_t control,
                                                const char* name, uint32_t* channel);

// ---- Programs ----

typedef struct rigc_program rigc_program;

typedef struct rigc_channel {
  uint32_t control;
  uint32_t channel;
} rigc_channel;

typedef struct rigc_program_options {
  size_t struct_size;
  /// Channels that will change; all others keep the value that the file has, and all that follows
  /// from them alone is computed once, here: the fewer the faster. Null: every keyable channel of
  /// every control. A channel that is not keyable is RIGC_ERROR_SELECTION.
  const rigc_channel* inputs;
  size_t input_count;
  /// Joints that are wanted; what they do not need is not computed. Null: all that are bones.
  const uint32_t* joints;
  size_t joint_count;
} rigc_program_options;

/// Compiles a rig. `options` and `diagnostics` may be null.
RIGC_EVAL_API rigc_status rigc_program_create(const rigc_rig* rig,
                                              const rigc_program_options* options,
                                              rigc_diagnostics* diagnostics,
                                              rigc_program** program);
RIGC_EVAL_API void rigc_program_destroy(rigc_program* program);

/// Inputs and joints in the order in which rows of numbers have them.
RIGC_EVAL_API uint32_t rigc_program_input_count(const rigc_program* program);
RIGC_EVAL_API uint32_t rigc_program_joint_count(const rigc_program* program);
/// `offset`: of the input's first number in a row of inputs. May be null.
RIGC_EVAL_API rigc_status rigc_program_get_input(const rigc_program* program, uint32_t index,
                                                 rigc_channel* channel, uint32_t* offset);
RIGC_EVAL_API rigc_status rigc_program_get_joint(const rigc_program* program, uint32_t index,
                                                 uint32_t* joint);
/// Numbers in a row of inputs: the widths of all of them.
RIGC_EVAL_API uint32_t rigc_program_input_width(const rigc_program* program);

// ---- Instances ----

typedef struct rigc_instance rigc_instance;

/// Frames that an instance holds and evaluates at once. One takes as long as all of them.
RIGC_EVAL_API uint32_t rigc_block_frames(void);

RIGC_EVAL_API rigc_status rigc_instance_create(const rigc_program* program,
                                               rigc_instance** instance);
RIGC_EVAL_API void rigc_instance_destroy(rigc_instance* instance);
/// What was wrong with the last call for this instance that failed. Never null.
RIGC_EVAL_API const char* rigc_instance_message(const rigc_instance* instance);

#define RIGC_ALL_FRAMES UINT32_MAX

/// Sets a channel in one frame of the block, or in all of them. `values`: [width]. Every value must
/// be finite and within 1e30; quaternions are made unit ones, the zero one the identity. Values
/// stay until they are set again.
RIGC_EVAL_API rigc_status rigc_instance_set(rigc_instance* instance, uint32_t frame,
                                            uint32_t control, uint32_t channel,
                                            const double* values);
/// Sets every input in frames 0 to `frames` - 1 of the block. `values`: [frames][input_width]; may
/// be null where the program has no inputs.
RIGC_EVAL_API rigc_status rigc_instance_set_rows(rigc_instance* instance, uint32_t frames,
                                                 const double* values);
/// Every input as it was when the instance was made.
RIGC_EVAL_API rigc_status rigc_instance_reset(rigc_instance* instance);

/// Evaluates the block. What is read afterwards belongs to the values that were set before.
RIGC_EVAL_API rigc_status rigc_instance_run(rigc_instance* instance);

/// World matrix of a joint of the program, column by column, the translation at 12 to 14. On
/// RIGC_ERROR_NOT_FINITE it is all zeros; the float one also where it is beyond floats.
RIGC_EVAL_API rigc_status rigc_instance_get_world(rigc_instance* instance, uint32_t frame,
                                                  uint32_t joint, double matrix[16]);
RIGC_EVAL_API rigc_status rigc_instance_get_world_f(rigc_instance* instance, uint32_t frame,
                                                    uint32_t joint, float matrix[16]);
/// The same for all joints of the program, in its order. `matrices`: [joint_count][16].
RIGC_EVAL_API rigc_status rigc_instance_get_worlds(rigc_instance* instance, uint32_t frame,
                                                   double* matrices);
RIGC_EVAL_API rigc_status rigc_instance_get_worlds_f(rigc_instance* instance, uint32_t frame,
                                                     float* matrices);

typedef struct rigc_trs {
  double translation[3];
  double rotation[4];
  double scale[3];
} rigc_trs;
/// What the joint's glTF node has to be set to, relative to its parent in the file; without shear,
/// which it cannot have. On RIGC_ERROR_NOT_FINITE it is at rest in its parent.
RIGC_EVAL_API rigc_status rigc_instance_get_local(rigc_instance* instance, uint32_t frame,
                                                  uint32_t joint, rigc_trs* local);

/// Any number of frames, block by block: set_rows, run, get_worlds. `inputs`:
/// [frames][input_width], null as there, `matrices`: [frames][joint_count][16]. Stops at the first
/// block with a value that cannot be set; matrices of earlier ones are there. Joints whose matrix
/// is not finite have zeros, all others what they should have, and the result is
/// RIGC_ERROR_NOT_FINITE.
RIGC_EVAL_API rigc_status rigc_instance_evaluate(rigc_instance* instance, size_t frames,
                                                 const double* inputs, double* matrices);
RIGC_EVAL_API rigc_status rigc_instance_evaluate_f(rigc_instance* instance, size_t frames,
                                                   const double* inputs, float* matrices);

#ifdef __cplusplus
}
#endif

#endif
