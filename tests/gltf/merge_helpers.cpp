// SPDX-License-Identifier: MIT
// What the tests of merging share.
#include "merge_helpers.h"

#include <doctest/doctest.h>

#include "base/text.h"
#include "file_helpers.h"

namespace rigc::gltf::test {

json::Value at(const json::Value& root, const std::string& pointer) {
  json::Value value = root;
  for (const std::string_view step : split(std::string_view(pointer).substr(1), '/')) {
    const auto index = parse_integer(step);
    if (value.is_object()) {
      value = value[step];
    } else {
      const auto items = value.items();
      REQUIRE_MESSAGE((index && static_cast<std::size_t>(*index) < items.size()), pointer);
      value = items[static_cast<std::size_t>(*index)];
    }
  }
  return value;
}

File opened(const std::string& text, const std::string& bin, const std::string& name) {
  Diagnostics diagnostics;
  auto file = gltf::open(name, Bytes(glb(text, bin)), diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  return *std::move(file);
}

std::optional<File> merged(const std::deque<File>& files, Diagnostics& diagnostics,
                           const MergeOptions& options) {
  Patch patch(files.front());
  if (!merge(patch, files, options, diagnostics)) return std::nullopt;
  const auto output = patch.finish(options.binary, diagnostics);
  REQUIRE(output);
  const std::string folder = make_folder("broken/merged");
  for (const ExtraFile& extra : output->extra_files)
    write_bytes(folder + "/" + extra.name, text(extra.bytes));
  auto file = gltf::open(folder + (options.binary ? "/m.glb" : "/m.gltf"), Bytes(whole(*output)),
                         diagnostics);
  REQUIRE_MESSAGE(file, render(diagnostics, false));
  return file;
}

}  // namespace rigc::gltf::test
