// SPDX-License-Identifier: MIT
// Reads one template file: YAML to Template, checked completely as far as one file can be, all
// errors in one run. Parts are not opened here. Test: tests/templates/read_test.cpp
#pragma once

#include <cstdint>
#include <optional>

#include "base/diagnostics.h"
#include "catalog/catalogue.h"
#include "templates/template.h"

namespace rigc::templates {

/// `file` is a number from Diagnostics::sources().
std::optional<Template> read(std::uint32_t file, const catalog::Catalogue& catalogue,
                             Diagnostics& diagnostics);

}  // namespace rigc::templates
