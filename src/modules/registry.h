// SPDX-License-Identifier: MIT
// Constructors of the built-in modules, one for each file of the families' folders. A new module is
// one declaration here and one row in registry.cpp. Test: tests/modules/registry_test.cpp
#pragma once

namespace rigc::modules {

class Builder;

void aim_constraint(Builder& b);
void attribute(Builder& b);
void connect(Builder& b);
void control(Builder& b);
void control_set(Builder& b);
void display_layer(Builder& b);
void expression(Builder& b);
void fk_chain(Builder& b);
void ik_fk_limb(Builder& b);
void ik_handle(Builder& b);
void joint(Builder& b);
void limits(Builder& b);
void lock(Builder& b);
void look_at(Builder& b);
void orient_constraint(Builder& b);
void parent(Builder& b);
void parent_constraint(Builder& b);
void point_constraint(Builder& b);
void pole_vector(Builder& b);
void proxy_mesh(Builder& b);
void remap(Builder& b);
void root(Builder& b);
void scale_constraint(Builder& b);
void set(Builder& b);
void spine_fk(Builder& b);
void transform(Builder& b);

}  // namespace rigc::modules
