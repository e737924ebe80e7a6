# SPDX-License-Identifier: GPL-3.0-or-later
# What makes an installed program at home on a desktop: manual pages made of its help texts (where
# help2man is installed), completion for bash, an icon, and the type of scene files.
if(HYPEREX_COMPONENTS STREQUAL all AND HYPEREX_PROGRAM)
  set(desktop ${PROJECT_SOURCE_DIR}/cmake/hyperex)
  set(share ${CMAKE_INSTALL_DATAROOTDIR})
  install(FILES ${desktop}/hyperex.bash DESTINATION ${share}/bash-completion/completions
          RENAME hyperex COMPONENT program)
  install(FILES ${desktop}/hyperex-studio.desktop DESTINATION ${share}/applications COMPONENT program)
  install(FILES ${desktop}/hyperex.xml DESTINATION ${share}/mime/packages COMPONENT program)
  install(FILES ${desktop}/hyperex.svg DESTINATION ${share}/icons/hicolor/scalable/apps COMPONENT program)

  find_program(HELP2MAN help2man)
  find_program(GZIP gzip)
  if(HELP2MAN AND GZIP)
    set(pages)
    foreach(command hyperex run new check studio sweep landmarks mesh compare symmetry track presets ct)
      set(page hyperex-${command})
      set(call "$<TARGET_FILE:hyperex> ${command}")
      if(command STREQUAL hyperex)
        set(page hyperex)
        set(call "$<TARGET_FILE:hyperex>")
      endif()
      set(file ${PROJECT_BINARY_DIR}/man/${page}.1)
      add_custom_command(OUTPUT ${file}.gz
        COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/man
        COMMAND ${HELP2MAN} --no-info --name "${PROJECT_DESCRIPTION}"
                --version-string "hyperex ${PROJECT_VERSION}" --output ${file} ${call}
        COMMAND ${GZIP} --best --no-name --force ${file}
        DEPENDS hyperex VERBATIM)
      list(APPEND pages ${file}.gz)
    endforeach()
    add_custom_target(man DEPENDS ${pages})
    install(DIRECTORY ${PROJECT_BINARY_DIR}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
            COMPONENT program FILES_MATCHING PATTERN *.1.gz)
  endif()
endif()
