# SPDX-License-Identifier: GPL-3.0-or-later
# The npm package of the canonical face and the landmark networks, and node to unpack it with:
# FACE_MESH_PACKAGE, NODE.
set(FACE_MESH_PACKAGE ${PROJECT_SOURCE_DIR}/web/node_modules/@mediapipe/face_mesh)
if(NOT EXISTS ${FACE_MESH_PACKAGE})
  message(FATAL_ERROR "The npm packages are not installed: run scripts/setup.sh (or npm ci in web/)")
endif()
find_program(NODE node REQUIRED)
