# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DWEB=... -DPAGE=.../report.html -P build_page.cmake: type-checks and builds the page.
cmake_minimum_required(VERSION 3.25)
find_program(npm npm)
if(NOT npm)
  message(FATAL_ERROR "npm is missing: the replay page in web/ is built with it (apt-get install npm)")
endif()
if(NOT EXISTS ${WEB}/node_modules/vite)
  message(FATAL_ERROR "${WEB}/node_modules is missing: run `npm ci` in ${WEB} once")
endif()
get_filename_component(folder ${PAGE} DIRECTORY)
execute_process(COMMAND ${npm} run --silent build -- --outDir ${folder} --emptyOutDir --logLevel warn
  WORKING_DIRECTORY ${WEB} OUTPUT_VARIABLE log ERROR_VARIABLE log RESULT_VARIABLE failed)
if(failed OR NOT EXISTS ${PAGE})
  message(FATAL_ERROR "building the replay page failed:\n${log}")
endif()
# Vite gives the file a new time only when it writes it; the build must see one in any case.
file(TOUCH ${PAGE})
