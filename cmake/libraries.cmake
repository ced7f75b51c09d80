# SPDX-License-Identifier: MIT
# Who links which library: each is included in one or two files only.
target_link_libraries(rigc_base PRIVATE yaml-cpp Threads::Threads)
target_include_directories(rigc_base SYSTEM PRIVATE ${XXHASH_INCLUDE})
target_link_libraries(rigc_gltf PRIVATE TinyGLTF::TinyGLTF)

# Descriptors and shapes compiled into the binary as data.
include(cmake/embed.cmake)
