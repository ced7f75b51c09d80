// SPDX-License-Identifier: MIT
// Diagnostics for callers of rigc_eval.h. Test: tests/capi/capi_test.cpp
#include "capi/handles.h"

namespace rigc::capi {

void Reporting::hand_over() const {
  if (!to_) return;
  for (const Diagnostic& one : diagnostics.all())
    to_->entries.push_back({one.code->number, one.code->severity == Severity::error,
                            describe(one.place, diagnostics.sources()), one.message, one.hint});
  to_->text = render(diagnostics, false);
}

}  // namespace rigc::capi
