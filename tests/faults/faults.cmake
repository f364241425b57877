# The headers with planted faults, and what is built with them: tests/faults/README.md. Part of the top level's CMakeLists.txt, if SIGHTLINE_FAULTS.

# A copy of the headers in which each fault stands beside what it replaces; the environment variable SIGHTLINE_FAULT says which one is on.
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
file(GLOB_RECURSE originals RELATIVE "${PROJECT_SOURCE_DIR}" CONFIGURE_DEPENDS kernel/*.h algorithms/*.h io/*.h)
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
  file(CONFIGURE OUTPUT "${faulty_root}/sightline/${file}" CONTENT "${text}" @ONLY)
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

add_executable(sightline_faulty EXCLUDE_FROM_ALL tests/faults/program/main.cpp apps/fuzz.cpp apps/case_watch.cpp apps/fuzz_io.cpp apps/query.cpp apps/common.cpp)
target_link_libraries(sightline_faulty PRIVATE program_settings)
add_executable(fuzz_targets_faulty EXCLUDE_FROM_ALL tests/fuzz/program/main.cpp)
target_link_libraries(fuzz_targets_faulty PRIVATE test_settings)
foreach(target IN ITEMS sightline_faulty fuzz_targets_faulty)
  target_include_directories(${target} BEFORE PRIVATE "${faulty_root}")
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
endforeach()
add_custom_target(faulty DEPENDS sightline_faulty fuzz_targets_faulty)
