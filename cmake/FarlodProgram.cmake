# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
include(GNUInstallDirs)

# Where the build leaves manual pages and completions, as PROGRAM.1, PROGRAM.bash and PROGRAM.zsh
set(FARLOD_DOCUMENTS_DIR ${PROJECT_BINARY_DIR}/documents)

# Pages are made of what --help says; without help2man, programs are installed without
find_program(FARLOD_HELP2MAN help2man)

# Installs a program, with its manual page and its completions. A program of its own writes the completions, from the options as
# CLI11 knows them: an option that is added appears in all three. No option of the program itself could do that without becoming a
# part of what users may rely on.
#   farlod_program(svf): the program farlod-svf, whose options are those of the library farlod::svf_options
function(farlod_program word)
  set(name farlod-${word})
  set(writer ${name}-documents)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/program_documents.cpp.in ${FARLOD_DOCUMENTS_DIR}/${word}_documents.cpp @ONLY)
  add_executable(${writer} ${FARLOD_DOCUMENTS_DIR}/${word}_documents.cpp)
  target_link_libraries(${writer} PRIVATE farlod::${word}_options)
  farlod_warnings(${writer})
  farlod_runs_once(${writer})
  set_target_properties(${writer} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${FARLOD_DOCUMENTS_DIR}/bin)

  set(stem ${FARLOD_DOCUMENTS_DIR}/${name})
  add_custom_command(OUTPUT ${stem}.bash ${stem}.zsh
    COMMAND ${writer} ${FARLOD_DOCUMENTS_DIR} DEPENDS ${writer} COMMENT "Completions of ${name}" VERBATIM)
  set(page)
  if(FARLOD_HELP2MAN)
    set(page ${stem}.1)
    add_custom_command(OUTPUT ${page} COMMAND ${PROJECT_SOURCE_DIR}/cmake/manual_page $<TARGET_FILE:${name}> ${page}
      DEPENDS ${name} ${PROJECT_SOURCE_DIR}/cmake/manual_page COMMENT "Manual page of ${name}" VERBATIM)
  endif()
  add_custom_target(${writer}_written ALL DEPENDS ${page} ${stem}.bash ${stem}.zsh)
  if(NOT FARLOD_WITH_INSTALL)
    return()
  endif()
  install(TARGETS ${name} RUNTIME COMPONENT programs)
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT programs)
  install(FILES ${stem}.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ${name} COMPONENT programs)
  install(FILES ${stem}.zsh DESTINATION ${FARLOD_ZSH_COMPLETION_DIR} RENAME _${name} COMPONENT programs)
endfunction()

# Debian's zsh looks into vendor-completions for what its packages bring, and into site-functions below /usr/local
set(FARLOD_ZSH_COMPLETION_DIR ${CMAKE_INSTALL_DATADIR}/zsh/site-functions CACHE STRING "Where completions for zsh are installed")
