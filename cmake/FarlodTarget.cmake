# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0

# Warnings that all our code is free of.
function(farlod_warnings target)
  # In a unit of several files, names of one file may be local names of another, and each file looks like a header
  set(of_units $<IF:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,-Wshadow=local$<SEMICOLON>-Wno-subobject-linkage,-Wshadow>)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion ${of_units} $<$<BOOL:${FARLOD_WARNINGS_AS_ERRORS}>:-Werror>)
  # g++ 12 sees an overlap in every `"literal" + std::string` (GCC bug 105651)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
endfunction()

# Declares the headers below some folders as public, so that the target all_verify_interface_header_sets compiles each alone.
#   farlod_public_headers(target BASE folder-that-includes-start-from FOLDERS folder...)
function(farlod_public_headers target)
  cmake_parse_arguments(H "" "BASE" "FOLDERS" ${ARGN})
  get_target_property(type ${target} TYPE)
  set(scope PUBLIC)
  if(type STREQUAL INTERFACE_LIBRARY)
    set(scope INTERFACE)
  endif()
  set(headers)
  foreach(folder ${H_FOLDERS})
    file(GLOB_RECURSE found CONFIGURE_DEPENDS ${H_BASE}/${folder}/*.hpp)
    list(APPEND headers ${found})
  endforeach()
  # A header named for its library belongs to that library's wrapper
  list(FILTER headers EXCLUDE REGEX "_(cgal|embree)\\.hpp$")
  target_sources(${target} ${scope} FILE_SET HEADERS BASE_DIRS ${H_BASE} FILES ${headers})
  set_target_properties(${target} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
endfunction()

# What can be linked into a shared library, ours or a stranger's (a module of Python is one). Shows nothing but what FARLOD_EXPORT
# marks, so that calls among our own functions take no detour.
function(farlod_for_shared_library target)
  set_target_properties(${target} PROPERTIES
    POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# For code that runs once in a program, such as that of its options: -O1 takes two thirds of the time of -O3
function(farlod_runs_once target)
  if(CMAKE_BUILD_TYPE STREQUAL Release)
    target_compile_options(${target} PRIVATE -O1)
  endif()
endfunction()

# A library of ours. Its sources are listed by its folder, or by the folders below it.
function(farlod_library name)
  add_library(farlod_${name} STATIC)
  add_library(farlod::${name} ALIAS farlod_${name})
  target_link_libraries(farlod_${name} PUBLIC farlod::base)
  farlod_warnings(farlod_${name})
  farlod_for_shared_library(farlod_${name})
  cmake_language(EVAL CODE "cmake_language(DEFER DIRECTORY [[${PROJECT_SOURCE_DIR}]] CALL farlod_group_units farlod_${name})")
endfunction()

# What a unit of a unity build (CMAKE_UNITY_BUILD) holds: the files behind the door of one heavy library together, whose headers
# are then read once, and of the others sixteen a unit, in the order of their lists. Called when all folders have named their files.
function(farlod_group_units target)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  set(count 0)
  foreach(source ${sources})
    if(NOT source MATCHES "\\.cpp$")
      continue()
    endif()
    if(source MATCHES "_(cgal|cli11|nlohmann)\\.cpp$")
      set(group ${CMAKE_MATCH_1})
    else()
      math(EXPR group "${count} / 16")
      math(EXPR count "${count} + 1")
    endif()
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder})
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${group})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# What programs load when they need it, and not before: farlod_NAME.so in lib/farlod, beside the folder of the programs, in the
# build as where it is installed. It has its own copy of what it links, and shows nothing but its entry.
function(farlod_module name)
  set(target farlod_module_${name})
  add_library(${target} MODULE)
  farlod_warnings(${target})
  farlod_for_shared_library(${target})
  target_link_options(${target} PRIVATE -Wl,--exclude-libs,ALL)
  set_target_properties(${target} PROPERTIES
    PREFIX "" OUTPUT_NAME farlod_${name} LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/farlod)
  set_property(GLOBAL APPEND PROPERTY FARLOD_MODULES ${target})
  if(FARLOD_WITH_INSTALL)
    install(TARGETS ${target} LIBRARY DESTINATION lib/farlod COMPONENT programs)
  endif()
endfunction()
