# SPDX-License-Identifier: GPL-3.0-or-later
# GCC 12's -Wrestrict misfires on std::string + in every optimised build (GCC bug 105651).
set(HYPEREX_WARNINGS -Wall -Wextra -Wshadow $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
# Several sources are compiled as one (docs/building.md): most of the time goes into headers of Eigen
# and others, which are read once for all of them. For tools that look at one file (clang-tidy) and
# to find missing includes: OFF.
option(HYPEREX_UNITY "Compile the sources of a room some at a time" ON)
set(HYPEREX_UNITY_SOURCES 16)  # more: little less time in all, more after a change of one of them
if(HYPEREX_UNITY)
  # Names of a source's own are those of a header to GCC.
  list(APPEND HYPEREX_WARNINGS $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
function(hx_unity target)
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${HYPEREX_UNITY} UNITY_BUILD_BATCH_SIZE ${HYPEREX_UNITY_SOURCES}
    OPTIMIZE_DEPENDENCIES ON)  # a room is compiled beside those it links to
endfunction()

# A third of the compiler's time goes into -O3. What computes gets it; LEVEL is for the rest:
#   O2  moves and writes what others computed    O1  reads options and prints
# A function of a header is in the program once, by whichever object is linked first: what multiplies
# matrices is not O1.
function(hx_optimise target level)
  target_compile_options(${target} PRIVATE $<$<AND:$<CONFIG:Release>,$<COMPILE_LANGUAGE:CXX>>:-${level}>)
endfunction()

option(HYPEREX_WERROR "Warnings are errors: for CI, as newer compilers warn of other things" OFF)
if(HYPEREX_WERROR)
  list(APPEND HYPEREX_WARNINGS -Werror)
endif()

# What is generated and included: all that a tool which reads the sources needs to be built.
add_custom_target(hx_generated)

# One room of the house: a static library hx_NAME from the sources listed by hand.
#   hx_room(io LEVEL O2 SOURCES ply.cpp stl.cpp LINKS hx_core hx_geometry)
# PARTS: its folders, in an order in which each includes only those before it (tests/layout).
# Before it has sources, a room is an interface library, so that others can link to it. Projects that
# take this one in with add_subdirectory link to hyperex::NAME, as they would to the installed one.
# HEADERS: those that are installed. They and what they include need Eigen alone (tests/install).
function(hx_room name)
  cmake_parse_arguments(ROOM "" "LEVEL" "PARTS;SOURCES;HEADERS;LINKS;PRIVATE_LINKS" ${ARGN})
  set(target hx_${name})
  if(ROOM_SOURCES)
    add_library(${target} STATIC ${ROOM_SOURCES})
    target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/src)
    target_compile_options(${target} PRIVATE ${HYPEREX_WARNINGS})
    target_compile_features(${target} PUBLIC cxx_std_20)
    # For shared libraries and for Python; calls within a file may be inlined as in a program.
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_compile_options(${target} PRIVATE
      $<$<AND:$<CXX_COMPILER_ID:GNU,Clang>,$<COMPILE_LANGUAGE:CXX>>:-fno-semantic-interposition>)
    target_link_libraries(${target} PUBLIC ${ROOM_LINKS} PRIVATE ${ROOM_PRIVATE_LINKS})
    hx_unity(${target})
    if(ROOM_LEVEL)
      hx_optimise(${target} ${ROOM_LEVEL})
    endif()
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(${target} INTERFACE ${ROOM_LINKS})
  endif()
  add_library(hyperex::${name} ALIAS ${target})
  set_property(GLOBAL APPEND PROPERTY HYPEREX_ROOMS ${name})
  hx_install_headers(${name} ${ROOM_HEADERS})
endfunction()

# hx_install_headers(fem form/system.hpp): to include/hyperex/fem/form.
function(hx_install_headers room)
  if(NOT HYPEREX_INSTALL)
    return()
  endif()
  foreach(header ${ARGN})
    get_filename_component(folder ${room}/${header} DIRECTORY)
    install(FILES ${PROJECT_SOURCE_DIR}/src/hyperex/${room}/${header}
            DESTINATION include/hyperex/${folder} COMPONENT dev)
  endforeach()
endfunction()

# The tests of one room: an executable test_NAME, each of its cases one CTest.
#   hx_test(io SOURCES ply_test.cpp LINKS hx_io)
# LEVEL: O1 by default, which takes the compiler a quarter less time. O2 for tests that multiply
# matrices themselves.
# TIMEOUT: seconds a case may take, 600 by default.
# TOGETHER: the name of a suite whose cases share costly data. It is one CTest, in one process.
# Cases may read real data under ${PROJECT_SOURCE_DIR}/../shared and must skip where it is absent.
# Each bears its folder under tests/ as label: ctest -L unit/io, and the time by room at ctest's end.
function(hx_test name)
  cmake_parse_arguments(T "" "LEVEL;TIMEOUT;TOGETHER" "SOURCES;LINKS" ${ARGN})
  add_executable(test_${name} ${T_SOURCES})
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/tests)
  target_compile_options(test_${name} PRIVATE ${HYPEREX_WARNINGS})
  hx_unity(test_${name})
  if(NOT T_LEVEL)
    set(T_LEVEL O1)
  endif()
  hx_optimise(test_${name} ${T_LEVEL})
  target_compile_definitions(test_${name} PRIVATE
    HYPEREX_SOURCE_DIR="${PROJECT_SOURCE_DIR}" HYPEREX_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared"
    HYPEREX_PROGRAM="${PROJECT_BINARY_DIR}/bin/hyperex")
  target_link_libraries(test_${name} PRIVATE ${T_LINKS} GTest::gtest_main GTest::gmock)
  file(RELATIVE_PATH room ${PROJECT_SOURCE_DIR}/tests ${CMAKE_CURRENT_SOURCE_DIR})
  include(GoogleTest)
  set(timeout 600)
  if(T_TIMEOUT)
    set(timeout ${T_TIMEOUT})
  endif()
  if(HYPEREX_TSAN)  # a whole run takes minutes there
    set(timeout 2400)
  endif()
  set(others)
  if(T_TOGETHER)
    set(others TEST_FILTER "-${T_TOGETHER}.*")
    add_test(NAME ${name}.${T_TOGETHER} COMMAND test_${name} --gtest_filter=${T_TOGETHER}.*)
    set_tests_properties(${name}.${T_TOGETHER} PROPERTIES TIMEOUT ${timeout} LABELS ${room})
  endif()
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60 ${others}
                       PROPERTIES TIMEOUT ${timeout} LABELS ${room})
endfunction()
