# SPDX-License-Identifier: MIT
# Compiles modules.d/ and shapes/ into rigc_catalog (see tools/embed and src/catalog).
