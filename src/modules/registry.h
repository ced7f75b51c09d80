// SPDX-License-Identifier: MIT
// Constructors of the built-in modules, one for each file of the families' folders. A new module is
// one declaration here and one row in registry.cpp. Test: tests/modules/registry_test.cpp
#pragma once

namespace rigc::modules {

class Builder;

void aim_constraint(Builder& b);
void aim_matrix(Builder& b);
void attribute(Builder& b);
void auto_clavicle(Builder& b);
void auto_hip(Builder& b);
void auto_pole(Builder& b);
void blend(Builder& b);
void blend_matrix(Builder& b);
void chain(Builder& b);
void clamp(Builder& b);
void clavicle(Builder& b);
void compose(Builder& b);
void condition(Builder& b);
void connect(Builder& b);
void control(Builder& b);
void control_set(Builder& b);
void decompose(Builder& b);
void display_layer(Builder& b);
void distance(Builder& b);
void driven_key(Builder& b);
void edit_shape(Builder& b);
void expression(Builder& b);
void fingertip_ik(Builder& b);
void fk_chain(Builder& b);
void foot_roll(Builder& b);
void gimbal(Builder& b);
void hand(Builder& b);
void hold_matrix(Builder& b);
void ik_fk_limb(Builder& b);
void ik_handle(Builder& b);
void joint(Builder& b);
void leg_3(Builder& b);
void limb_stretch(Builder& b);
void limb_wrist(Builder& b);
void limits(Builder& b);
void lock(Builder& b);
void look_at(Builder& b);
void morph_targets(Builder& b);
void multiply_matrix(Builder& b);
void neck_head(Builder& b);
void orient_constraint(Builder& b);
void parent(Builder& b);
void parent_constraint(Builder& b);
void pick_matrix(Builder& b);
void pivot(Builder& b);
void point_constraint(Builder& b);
void pole_vector(Builder& b);
void pose_reader(Builder& b);
void proxy_mesh(Builder& b);
void remap(Builder& b);
void ribbon(Builder& b);
void root(Builder& b);
void scale_constraint(Builder& b);
void set(Builder& b);
void space_switch(Builder& b);
void spine_fk(Builder& b);
void spine_ik(Builder& b);
void squash_stretch(Builder& b);
void state_machine(Builder& b);
void transform(Builder& b);
void twist_joints(Builder& b);
void vector_foot(Builder& b);
void vector_operation(Builder& b);
void wheel(Builder& b);

}  // namespace rigc::modules
