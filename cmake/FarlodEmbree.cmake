# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0

include(FindPackageMessage)

# Links a target with Embree 4 where it is installed, else with Embree 3, and tells occlusion/queries_embree.hpp which it is.
function(farlod_link_embree target)
  find_package(embree 4 QUIET)
  if(NOT embree_FOUND)
    find_package(embree 3.13 REQUIRED)
  endif()
  find_package_message(embree "Found Embree ${embree_VERSION}" "${embree_DIR}")
  # For what is installed, which asks for the same
  set(FARLOD_EMBREE_MAJOR ${embree_VERSION_MAJOR} CACHE INTERNAL "The major version of Embree that is built with")
  target_link_libraries(${target} PRIVATE embree)
  target_compile_definitions(${target} PRIVATE FARLOD_EMBREE_MAJOR=${embree_VERSION_MAJOR})
endfunction()
