# SPDX-License-Identifier: GPL-3.0-or-later
# OpenCV by its pieces: Debian puts OpenCVConfig.cmake into libopencv-dev alone, which brings every
# module with it (172 packages instead of 100). Targets opencv_core, opencv_imgproc and so on, as in
# OpenCV's own configuration.
#   find_package(OpenCV 4.5 REQUIRED COMPONENTS core imgproc)
find_path(OpenCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
find_path(OpenCV_CONFIG_INCLUDE_DIR opencv2/cvconfig.h PATH_SUFFIXES opencv4)
if(OpenCV_INCLUDE_DIR)
  set(_opencv_version_file ${OpenCV_INCLUDE_DIR}/opencv2/core/version.hpp)
  foreach(part MAJOR MINOR REVISION)
    file(STRINGS ${_opencv_version_file} _opencv_line REGEX "#define CV_VERSION_${part} ")
    string(REGEX MATCH "[0-9]+" OpenCV_VERSION_${part} "${_opencv_line}")
  endforeach()
  set(OpenCV_VERSION ${OpenCV_VERSION_MAJOR}.${OpenCV_VERSION_MINOR}.${OpenCV_VERSION_REVISION})
endif()
foreach(component ${OpenCV_FIND_COMPONENTS})
  find_library(OpenCV_${component}_LIBRARY opencv_${component})
  find_path(OpenCV_${component}_HEADER opencv2/${component}.hpp PATHS ${OpenCV_INCLUDE_DIR})
  if(OpenCV_${component}_LIBRARY AND OpenCV_${component}_HEADER)
    set(OpenCV_${component}_FOUND TRUE)
  endif()
  mark_as_advanced(OpenCV_${component}_LIBRARY OpenCV_${component}_HEADER)
endforeach()
mark_as_advanced(OpenCV_INCLUDE_DIR OpenCV_CONFIG_INCLUDE_DIR)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCV REQUIRED_VARS OpenCV_INCLUDE_DIR VERSION_VAR OpenCV_VERSION
                                  HANDLE_COMPONENTS)
foreach(component ${OpenCV_FIND_COMPONENTS})
  if(OpenCV_${component}_FOUND AND NOT TARGET opencv_${component})
    add_library(opencv_${component} UNKNOWN IMPORTED GLOBAL)
    set_target_properties(opencv_${component} PROPERTIES
      IMPORTED_LOCATION ${OpenCV_${component}_LIBRARY}
      INTERFACE_INCLUDE_DIRECTORIES "${OpenCV_INCLUDE_DIR}")
    if(OpenCV_CONFIG_INCLUDE_DIR)
      set_property(TARGET opencv_${component} APPEND PROPERTY
                   INTERFACE_INCLUDE_DIRECTORIES ${OpenCV_CONFIG_INCLUDE_DIR})
    endif()
  endif()
endforeach()
