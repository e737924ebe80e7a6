# SPDX-License-Identifier: GPL-3.0-or-later
# hx_debian_documents(PACKAGE COMPONENT): licence and changelogs of a package. Those of Debian's packages have the
# names and forms that its policy asks for (HYPEREX_DEB, set by `make deb`); elsewhere the licence is enough.
option(HYPEREX_DEB "Install licence and changelogs as Debian's packages have them" OFF)
set(CPACK_PACKAGE_CONTACT "The Hyperex developers <hyperex@example.org>")
if(HYPEREX_DEB)
  execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} log -1 --format=%aD OUTPUT_VARIABLE commit_date
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT commit_date)  # an archive of the sources
    string(TIMESTAMP commit_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
  endif()
  set(debian ${PROJECT_BINARY_DIR}/debian)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/debian/changelog.in ${debian}/changelog.Debian @ONLY)
  configure_file(${PROJECT_SOURCE_DIR}/CHANGELOG.md ${debian}/changelog COPYONLY)
  # Without names and times: the same sources make the same package.
  execute_process(COMMAND gzip -9nf ${debian}/changelog.Debian ${debian}/changelog COMMAND_ERROR_IS_FATAL ANY)
endif()

function(hx_debian_documents package component)
  set(folder ${CMAKE_INSTALL_DATAROOTDIR}/doc/${package})
  if(HYPEREX_DEB)
    install(FILES ${PROJECT_SOURCE_DIR}/cmake/debian/copyright ${PROJECT_BINARY_DIR}/debian/changelog.Debian.gz
                  ${PROJECT_BINARY_DIR}/debian/changelog.gz
            DESTINATION ${folder} COMPONENT ${component} ${ARGN})
  else()
    install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${folder} RENAME copyright COMPONENT ${component} ${ARGN})
  endif()
endfunction()
