// SPDX-License-Identifier: MIT
// The main of every test binary. A filter that matches nothing fails instead of passing.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

int main(int argc, char** argv) {
  doctest::Context context(argc, argv);
  context.setOption("no-path-filenames", true);
  return context.run();
}
