# SPDX-License-Identifier: GPL-3.0-or-later
# ITK by its pieces, with the GDCM that reads DICOM for it: Debian's ITKConfig.cmake asks for all of
# ITK's own dependencies (HDF5, and programs of GDCM that other packages hold), and warns of those
# that are absent.
#   find_package(ITK 5.2 REQUIRED)     the target ITK::ITK
find_path(ITK_INCLUDE_DIR itkImage.h PATH_SUFFIXES ITK-5.2 ITK-5.3 ITK)
find_path(GDCM_INCLUDE_DIR gdcmReader.h PATH_SUFFIXES gdcm-3.0 gdcm)
if(ITK_INCLUDE_DIR)
  file(STRINGS ${ITK_INCLUDE_DIR}/itkConfigure.h _itk_lines REGEX "#define ITK_VERSION_(MAJOR|MINOR) ")
  string(REGEX REPLACE ".*MAJOR +([0-9]+).*MINOR +([0-9]+).*" "\\1.\\2" ITK_VERSION "${_itk_lines}")
endif()
set(_itk_found)
foreach(_itk_part ITKCommon ITKIOImageBase ITKIONIFTI ITKIONRRD itksys itkvnl itkvnl_algo)
  find_library(ITK_${_itk_part}_LIBRARY NAMES ${_itk_part}-${ITK_VERSION} ${_itk_part})
  mark_as_advanced(ITK_${_itk_part}_LIBRARY)
  list(APPEND _itk_found ITK_${_itk_part}_LIBRARY)
endforeach()
foreach(_itk_part gdcmMSFF gdcmDSED gdcmDICT gdcmCommon)
  find_library(GDCM_${_itk_part}_LIBRARY ${_itk_part})
  mark_as_advanced(GDCM_${_itk_part}_LIBRARY)
  list(APPEND _itk_found GDCM_${_itk_part}_LIBRARY)
endforeach()
mark_as_advanced(ITK_INCLUDE_DIR GDCM_INCLUDE_DIR)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ITK REQUIRED_VARS ITK_INCLUDE_DIR GDCM_INCLUDE_DIR ${_itk_found}
                                  VERSION_VAR ITK_VERSION)
if(ITK_FOUND AND NOT TARGET ITK::ITK)
  add_library(ITK::ITK INTERFACE IMPORTED GLOBAL)
  set_target_properties(ITK::ITK PROPERTIES
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${ITK_INCLUDE_DIR};${GDCM_INCLUDE_DIR}"
    INTERFACE_INCLUDE_DIRECTORIES "${ITK_INCLUDE_DIR};${GDCM_INCLUDE_DIR}")
  foreach(_itk_library ${_itk_found})
    set_property(TARGET ITK::ITK APPEND PROPERTY INTERFACE_LINK_LIBRARIES ${${_itk_library}})
  endforeach()
endif()
