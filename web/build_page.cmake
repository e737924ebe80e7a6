# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DWEB=... -DPAGE=.../NAME.html -P build_page.cmake: builds ${WEB}/NAME.html.
# cmake -DWEB=... -DCHECKED=FILE -P build_page.cmake: type-checks all pages' scripts, and touches FILE.
cmake_minimum_required(VERSION 3.25)
find_program(NODE node REQUIRED)
if(NOT EXISTS ${WEB}/node_modules/vite)
  message(FATAL_ERROR "${WEB}/node_modules is missing: run scripts/setup.sh (or npm ci in ${WEB})")
endif()
# What `npm run build` does, without npm: node alone is needed here.
if(CHECKED)
  execute_process(
    COMMAND ${NODE} node_modules/typescript/bin/tsc --noEmit
    WORKING_DIRECTORY ${WEB} OUTPUT_VARIABLE log ERROR_VARIABLE log RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "the types of ${WEB} do not fit:\n${log}")
  endif()
  file(TOUCH ${CHECKED})
  return()
endif()
get_filename_component(folder ${PAGE} DIRECTORY)
get_filename_component(name ${PAGE} NAME)
# --emptyOutDir false: the other page lies in the same folder.
execute_process(
  COMMAND ${CMAKE_COMMAND} -E env HYPEREX_PAGE=${name} ${NODE} node_modules/vite/bin/vite.js build
          --outDir ${folder} --emptyOutDir false --logLevel warn
  WORKING_DIRECTORY ${WEB} OUTPUT_VARIABLE log ERROR_VARIABLE log RESULT_VARIABLE failed)
if(failed OR NOT EXISTS ${PAGE})
  message(FATAL_ERROR "building the page ${name} failed:\n${log}")
endif()
# Vite gives the file a new time only when it writes it; the build must see one in any case.
file(TOUCH ${PAGE})
