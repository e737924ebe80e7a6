# SPDX-License-Identifier: GPL-3.0-or-later
# What is installed for programmers (docs/library.md): the rooms as two shared libraries, so that who
# links to them needs Eigen's headers and none of the packages that Hyperex itself is built with.
#   libhyperex_fem  core and fem: the solver, without faces
#   libhyperex      all other rooms; links to the first
# The program and the tests link to the rooms themselves.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(CheckCXXSourceCompiles)

# Memory that Eigen aligned on one side is freed on the other: both must align alike, whatever
# instructions (-march=native) the other side is compiled for.
set(CMAKE_REQUIRED_INCLUDES ${EIGEN3_INCLUDE_DIRS})
foreach(bytes 16 32 64)
  check_cxx_source_compiles("#include <Eigen/Core>
    static_assert(EIGEN_MAX_ALIGN_BYTES == ${bytes}); int main() {}" HYPEREX_EIGEN_ALIGNS_TO_${bytes})
  if(HYPEREX_EIGEN_ALIGNS_TO_${bytes})
    set(HYPEREX_EIGEN_ALIGNMENT ${bytes})
    break()
  endif()
endforeach()
unset(CMAKE_REQUIRED_INCLUDES)

# hx_shared_library(TARGET NAME ROOMS core fem LINKS ...): lib<TARGET>, exported as hyperex::NAME.
function(hx_shared_library target name)
  cmake_parse_arguments(L "" "" "ROOMS;LINKS" ${ARGN})
  set(objects ${L_ROOMS})
  list(TRANSFORM objects REPLACE "(.+)" "$<TARGET_OBJECTS:hx_\\1>")
  set(archives ${L_ROOMS})  # for what the rooms link to: of themselves nothing is left to take
  list(TRANSFORM archives PREPEND hx_)
  add_library(lib${target} SHARED ${objects})
  set_target_properties(lib${target} PROPERTIES
    OUTPUT_NAME ${target} EXPORT_NAME ${name} LINKER_LANGUAGE CXX
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib INSTALL_RPATH "$ORIGIN")
  target_include_directories(lib${target} INTERFACE $<INSTALL_INTERFACE:include>)
  target_compile_features(lib${target} INTERFACE cxx_std_20)
  target_link_libraries(lib${target} PUBLIC Eigen3::Eigen PRIVATE ${L_LINKS} ${archives})
  # Templates of Eigen, CGAL and others that are compiled into it stay inside.
  set(exports ${PROJECT_SOURCE_DIR}/cmake/exported_symbols.map)
  target_link_options(lib${target} PRIVATE -Wl,--version-script=${exports} -Wl,--no-undefined)
  set_property(TARGET lib${target} APPEND PROPERTY LINK_DEPENDS ${exports})
  install(TARGETS lib${target} EXPORT ${target}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT dev)
  install(EXPORT ${target} NAMESPACE hyperex:: FILE ${target}-targets.cmake
    DESTINATION ${package_folder} COMPONENT dev)
endfunction()

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/hyperex)
set(fem_rooms core fem)
hx_shared_library(hyperex_fem fem ROOMS ${fem_rooms})
target_compile_definitions(libhyperex_fem INTERFACE
  EIGEN_MAX_ALIGN_BYTES=${HYPEREX_EIGEN_ALIGNMENT}
  # What malloc gives is aligned to 16 bytes and needs no header of Eigen's own.
  $<$<EQUAL:${HYPEREX_EIGEN_ALIGNMENT},16>:EIGEN_MALLOC_ALREADY_ALIGNED=1>)
install(FILES ${PROJECT_SOURCE_DIR}/src/hyperex/fem.hpp DESTINATION include/hyperex COMPONENT dev)
hx_install_headers(geometry types.hpp)
if(HYPEREX_COMPONENTS STREQUAL all)
  set(face_rooms ${HYPEREX_ROOMS})
  list(REMOVE_ITEM face_rooms ${fem_rooms})
  hx_shared_library(hyperex hyperex ROOMS ${face_rooms} LINKS libhyperex_fem)
  target_link_libraries(libhyperex INTERFACE libhyperex_fem)
  install(FILES ${PROJECT_SOURCE_DIR}/src/hyperex/hyperex.hpp DESTINATION include/hyperex
          COMPONENT dev)
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/hyperexConfig.cmake.in
  ${PROJECT_BINARY_DIR}/hyperexConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hyperexConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hyperexConfig.cmake
              ${PROJECT_BINARY_DIR}/hyperexConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT dev)
