# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0

# The two libraries as strangers link them, and how their CMake projects and pkg-config find them. In the build everything else
# links the rooms themselves.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(FARLOD_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/farlod)

# farlod_public_library(NAME OBJECTS_OF room... LINK library...): lib/libfarlod_NAME with the objects of these rooms
function(farlod_public_library name)
  cmake_parse_arguments(L "" "" "OBJECTS_OF;LINK" ${ARGN})
  set(target farlod_${name})
  add_library(${target})
  add_library(farlod::${name} ALIAS ${target})
  foreach(room ${L_OBJECTS_OF})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:farlod_${room}>)
  endforeach()
  target_link_libraries(${target} PUBLIC farlod_api PRIVATE ${L_LINK})
  # Before 1.0, each second number may break what was built against the one before
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} LINKER_LANGUAGE CXX VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} INSTALL_RPATH "$ORIGIN")
  if(NOT FARLOD_WITH_INSTALL)
    return()
  endif()
  install(TARGETS ${target} EXPORT farlod_${name} COMPONENT development
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT farlod_${name} NAMESPACE farlod:: FILE farlod_${name}.cmake DESTINATION ${FARLOD_CMAKE_DIR} COMPONENT development)
endfunction()

# A file of pkg-config, whose prefix is where it lies: an installed tree may be moved. A static library needs at once what a shared
# one has linked already.
function(farlod_pkg_config name)
  if(NOT FARLOD_WITH_INSTALL)
    return()
  endif()
  cmake_parse_arguments(P "" "DESCRIPTION" "REQUIRES;PACKAGES;LIBRARIES" ${ARGN})
  set(FARLOD_PC_NAME ${name})
  set(FARLOD_PC_DESCRIPTION "${P_DESCRIPTION}")
  if(BUILD_SHARED_LIBS)
    set(P_PACKAGES)
    set(P_LIBRARIES)
  endif()
  string(JOIN ", " FARLOD_PC_REQUIRES ${P_REQUIRES} ${P_PACKAGES})
  string(JOIN " " FARLOD_PC_LIBRARIES ${P_LIBRARIES})
  file(RELATIVE_PATH FARLOD_PC_PREFIX_FROM_HERE /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/farlod.pc.in ${PROJECT_BINARY_DIR}/farlod-${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/farlod-${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endfunction()

# How CMake projects find what the functions above install. After them.
function(farlod_cmake_package)
  if(NOT FARLOD_WITH_INSTALL)
    return()
  endif()
  set_target_properties(farlod_api PROPERTIES EXPORT_NAME api)
  install(TARGETS farlod_api EXPORT farlod_api FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
  install(EXPORT farlod_api NAMESPACE farlod:: FILE farlod_api.cmake DESTINATION ${FARLOD_CMAKE_DIR} COMPONENT development)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/farlodConfig.cmake.in ${PROJECT_BINARY_DIR}/farlodConfig.cmake
    INSTALL_DESTINATION ${FARLOD_CMAKE_DIR})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/farlodConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/farlodConfig.cmake ${PROJECT_BINARY_DIR}/farlodConfigVersion.cmake
    DESTINATION ${FARLOD_CMAKE_DIR} COMPONENT development)
endfunction()
