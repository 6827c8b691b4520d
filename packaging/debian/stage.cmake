# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
# CPack runs this when the files of all packages lie in their places, before it packs them. Debian wants some of them
# elsewhere, and others besides, which `cmake --install` leaves out.

# Same sources, same bytes: what has a date has that of the sources
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND git -C ${CPACK_FARLOD_SOURCE_DIR} log -1 --format=%ct
    OUTPUT_VARIABLE seconds OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT seconds)
    file(TIMESTAMP ${CPACK_FARLOD_SOURCE_DIR}/CHANGELOG.md seconds %s UTC)
  endif()
  set(ENV{SOURCE_DATE_EPOCH} ${seconds})
endif()
string(TIMESTAMP FARLOD_PACKAGE_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)

function(compress)
  execute_process(COMMAND gzip --best --no-name --force ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# What every package has in its folder below /usr/share/doc
function(add_documents root package)
  set(folder ${root}/usr/share/doc/${package})
  set(FARLOD_PACKAGE ${package})
  configure_file(${CPACK_FARLOD_SOURCE_DIR}/packaging/debian/changelog.in ${folder}/changelog.Debian @ONLY)
  configure_file(${CPACK_FARLOD_SOURCE_DIR}/CHANGELOG.md ${folder}/changelog COPYONLY)
  compress(${folder}/changelog ${folder}/changelog.Debian)
  configure_file(${CPACK_FARLOD_SOURCE_DIR}/packaging/debian/copyright ${folder}/copyright COPYONLY)
  set(overrides ${CPACK_FARLOD_SOURCE_DIR}/packaging/debian/${package}.lintian-overrides)
  if(EXISTS ${overrides})
    configure_file(${overrides} ${root}/usr/share/lintian/overrides/${package} COPYONLY)
  endif()
endfunction()

function(stage root package)
  add_documents(${root} ${package})
  file(GLOB pages ${root}/usr/share/man/man*/*[0-9])
  if(pages)
    compress(${pages})
  endif()
  # Debian's zsh does not look into /usr/share/zsh/site-functions
  if(EXISTS ${root}/usr/share/zsh/site-functions)
    file(RENAME ${root}/usr/share/zsh/site-functions ${root}/usr/share/zsh/vendor-completions)
  endif()
  # Neither the build nor the user's umask is to be seen
  execute_process(COMMAND chmod -R u=rwX,go=rX ${root} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND find ${root} -exec touch --no-dereference --date=@$ENV{SOURCE_DATE_EPOCH} {} +
    COMMAND_ERROR_IS_FATAL ANY)
endfunction()

foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} name)
  stage(${CPACK_TEMPORARY_DIRECTORY}/${component} ${CPACK_DEBIAN_${name}_PACKAGE_NAME})
endforeach()
