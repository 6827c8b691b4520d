# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0

# Library, as our CMake files name it, and the Debian package that links with it
set(debian_packages
  "EXPAT::EXPAT=libexpat1-dev"
  "GDAL::GDAL=libgdal-dev"
  ".*(GeographicLib|farlod::geographiclib).*=libgeographiclib-dev"
  "OpenEXR::OpenEXR(Core)?=libopenexr-dev"
  "PROJ::proj=libproj-dev"
  "PkgConfig::ERFA=liberfa-dev"
  "PkgConfig::XXHASH=libxxhash-dev"
  "TBB::tbb=libtbb-dev"
  "embree=libembree-dev"
  "fmt::fmt=libfmt-dev"
  "gmp=libgmp-dev"
  "mpfr=libmpfr-dev")

function(farlod_debian_package_of out library)
  foreach(row ${debian_packages})
    string(REGEX MATCH "^(.*)=(.*)$" row ${row})
    set(package ${CMAKE_MATCH_2})
    if(library MATCHES "^(${CMAKE_MATCH_1})$")
      set(${out} ${package} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  message(FATAL_ERROR "libfarlod-dev links ${library}: name its Debian package in ${CMAKE_CURRENT_FUNCTION_LIST_FILE}")
endfunction()

# The packages without which nobody can find and link these static libraries of ours, sorted
#   farlod_debian_link_dependencies(result farlod_runtime...)
function(farlod_debian_link_dependencies out)
  # farlodConfig.cmake finds one of them by pkg-config
  set(packages "pkgconf | pkg-config")
  set(waiting ${ARGN})
  set(done)
  while(waiting)
    list(POP_FRONT waiting library)
    # What a static library keeps to itself is linked all the same
    string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" library "${library}")
    if(library IN_LIST done OR library MATCHES "^(::@.*|-.*)$")
      continue()
    endif()
    list(APPEND done ${library})
    if(library MATCHES "^farlod(::|_)")
      get_target_property(libraries ${library} INTERFACE_LINK_LIBRARIES)
      if(libraries)
        list(APPEND waiting ${libraries})
      endif()
    else()
      farlod_debian_package_of(package ${library})
      list(APPEND packages ${package})
    endif()
  endwhile()
  list(SORT packages)
  list(REMOVE_DUPLICATES packages)
  list(JOIN packages ", " packages)
  set(${out} "${packages}" PARENT_SCOPE)
endfunction()
