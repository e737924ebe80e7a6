# SPDX-License-Identifier: GPL-3.0-or-later
# Examples, the licence, third-party notices and changelogs, where Debian's packages have them.
# Left out are the scenes of the thesis' experiments, and the study, which writes beside itself. The
# last three take data that `hyperex sample out/sample` makes beside a copy of the examples.
include(HyperexDebian)
set(examples ${PROJECT_SOURCE_DIR}/examples)
set(examples_folder ${CMAKE_INSTALL_DATAROOTDIR}/doc/hyperex/examples)
if(HYPEREX_COMPONENTS STREQUAL all AND HYPEREX_PROGRAM)
  install(FILES ${examples}/mouth_open.toml ${examples}/stiff_cheek.toml ${examples}/variants.toml
                ${examples}/demo.toml ${examples}/smile_arkit.csv
                ${examples}/one_sided_smile.toml ${examples}/one_sided_smile.csv
                ${examples}/second_face.toml ${examples}/flawed_scan.toml
                ${examples}/recorded_smile.toml
          DESTINATION ${examples_folder} COMPONENT program)
  install(FILES ${examples}/blender/play_weights.py DESTINATION ${examples_folder}/blender
          COMPONENT program)
  install(FILES ${examples}/rig/vrm_expressions.toml DESTINATION ${examples_folder}/rig
          COMPONENT program)
  hx_debian_documents(hyperex program)
  install(FILES ${PROJECT_SOURCE_DIR}/THIRD_PARTY.md
          DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/hyperex COMPONENT program)
endif()
install(DIRECTORY ${examples}/cpp DESTINATION ${examples_folder} COMPONENT dev
        FILES_MATCHING PATTERN *.cpp PATTERN *.hpp PATTERN CMakeLists.txt)
hx_debian_documents(libhyperex-dev dev)
if(TARGET hyperex_python)
  install(DIRECTORY ${examples}/python DESTINATION ${examples_folder}
          COMPONENT python EXCLUDE_FROM_ALL FILES_MATCHING PATTERN *.py)
  hx_debian_documents(python3-hyperex python EXCLUDE_FROM_ALL)
endif()
