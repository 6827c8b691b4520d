# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0

# Links a target with Expat. Expat 2.9 gives new names to the functions that tell places, and warns of the old ones: with an older
# Expat, the new names mean the old ones.
function(farlod_link_expat target)
  find_package(EXPAT 2.5 REQUIRED)
  target_link_libraries(${target} PRIVATE EXPAT::EXPAT)
  if(EXPAT_VERSION_STRING VERSION_LESS 2.9)
    foreach(place ByteIndex ByteCount LineNumber ColumnNumber)
      target_compile_definitions(${target} PRIVATE XML_GetCurrent${place}64=XML_GetCurrent${place})
    endforeach()
  endif()
endfunction()
