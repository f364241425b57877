# The library with planted faults, and what is built with them: tests/faults/README.md. Part of the top level's CMakeLists.txt, if SIGHTLINE_FAULTS.

# A copy of the library in which each fault stands beside what it replaces; the environment variable SIGHTLINE_FAULT says which one is on.
set(faulty_root "${PROJECT_BINARY_DIR}/faulty")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS tests/faults/faults.json)
file(READ tests/faults/faults.json faults)
string(JSON last LENGTH "${faults}")
math(EXPR last "${last} - 1")
set(faulty_files "")
set(switches "")
set(hunts "")
foreach(k RANGE ${last})
  foreach(key IN ITEMS name file before expression after faulty hunt)
    string(JSON ${key} ERROR_VARIABLE none GET "${faults}" ${k} ${key})
    if(none)
      set(${key} "")
    endif()
  endforeach()
  list(APPEND faulty_files "${file}")
  list(APPEND faults_of_${file} ${k})
  set(text_${k} "${before}${expression}${after}")
  set(faulty_text_${k} "${before}(::sightline_fault::${name} ? (${faulty}) : (${expression}))${after}")
  string(APPEND switches "inline const bool ${name} = is_on(\"${name}\");\n")
  string(REGEX REPLACE "[][\"\n]" "" hunt "${hunt}")
  string(REGEX REPLACE ", +" "," hunt "${hunt}")
  string(STRIP "${hunt}" hunt)
  string(APPEND hunts "${name}\t${hunt}\n")
endforeach()
file(GLOB_RECURSE originals RELATIVE "${PROJECT_SOURCE_DIR}" CONFIGURE_DEPENDS
     kernel/*.h algorithms/*.h io/*.h harness/*.h sightline/*.h kernel/*.cpp algorithms/*.cpp io/*.cpp harness/*.cpp sightline/*.cpp)
set(faulty_sources "")
foreach(file IN LISTS originals)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  file(READ "${file}" text)
  foreach(k IN LISTS faults_of_${file})
    string(FIND "${text}" "${text_${k}}" first)
    string(FIND "${text}" "${text_${k}}" second REVERSE)
    if(first EQUAL -1 OR NOT first EQUAL second)
      string(JSON name GET "${faults}" ${k} name)
      message(FATAL_ERROR "tests/faults/faults.json: the text of fault ${name} is not found exactly once in ${file}; bring it up to date")
    endif()
    string(REPLACE "${text_${k}}" "${faulty_text_${k}}" text "${text}")
  endforeach()
  if(file IN_LIST faulty_files)
    string(PREPEND text "#include <sightline/faults.h>\n")
    list(REMOVE_ITEM faulty_files "${file}")
  endif()
  string(REGEX REPLACE "^sightline/" "" place "${file}")  # the front door has no folder of its own in what is included
  file(CONFIGURE OUTPUT "${faulty_root}/sightline/${place}" CONTENT "${text}" @ONLY)
  if(file MATCHES "[.]cpp$")
    list(APPEND faulty_sources "${faulty_root}/sightline/${place}")
  endif()
endforeach()
if(faulty_files)
  message(FATAL_ERROR "tests/faults/faults.json: no such file: ${faulty_files}")
endif()
file(CONFIGURE OUTPUT "${faulty_root}/sightline/faults.h" @ONLY CONTENT "#pragma once
#include <cstdlib>
#include <string_view>

namespace sightline_fault {

inline bool is_on(std::string_view name) {
const char* const one = std::getenv(\"SIGHTLINE_FAULT\");
return one != nullptr && name == one;
}
${switches}
}
")
file(WRITE "${PROJECT_BINARY_DIR}/faults.txt" "${hunts}")  # for tests/faults/hunt: a name, and what is to find it

include(tests/faults/programs.cmake)
add_programs_with_faults(faulty faulty_library "${faulty_root}" "${faulty_sources}")
