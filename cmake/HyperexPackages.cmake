# SPDX-License-Identifier: GPL-3.0-or-later
# Debian packages (`make deb`): hyperex (program and libraries), libhyperex-dev (headers and CMake
# files), python3-hyperex where the Python module is built. What each needs at run time is found by
# dpkg-shlibdeps.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENT_PROGRAM_GROUP hyperex)
set(CPACK_COMPONENT_LIBRARY_GROUP hyperex)
set(CPACK_COMPONENTS_ALL program library dev)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The package's own libraries are not to be looked for among installed ones.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)
set(CPACK_DEBIAN_HYPEREX_PACKAGE_NAME hyperex)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_HYPEREX_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/triggers)
# The first line is the synopsis.
set(CPACK_COMPONENT_GROUP_HYPEREX_DESCRIPTION "recorded expressions re-enacted on scanned faces
 Hyperex moves a 3D scan of a face with a recording of how that face moved,
 through a finite-element model of its soft tissue, and shows the expression
 that the same muscles would make in other tissue.")
set(CPACK_DEBIAN_HYPEREX_DESCRIPTION "${CPACK_COMPONENT_GROUP_HYPEREX_DESCRIPTION}")
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libhyperex-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "hyperex (= ${PROJECT_VERSION}-1), libeigen3-dev")
set(CPACK_COMPONENT_DEV_DESCRIPTION "Hyperex as a C++ library: headers and CMake package
 A program finds the library by find_package(hyperex); the examples show how.")
set(CPACK_DEBIAN_DEV_DESCRIPTION "${CPACK_COMPONENT_DEV_DESCRIPTION}")
if(TARGET hyperex_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-hyperex)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  # Compiled for one version of Python, and its arrays are NumPy's.
  math(EXPR next_minor "${HYPEREX_PYTHON_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${HYPEREX_PYTHON_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
  # What Python itself wrote into the package's folder when root imported it.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/python3-hyperex/prerm)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Hyperex as a Python module
 Scans, recordings, tissue and simulations as objects whose arrays are NumPy's.")
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "${CPACK_COMPONENT_PYTHON_DESCRIPTION}")
endif()
include(CPack)
