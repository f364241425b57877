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

add_library(faulty_library STATIC EXCLUDE_FROM_ALL ${faulty_sources})
target_include_directories(faulty_library PUBLIC "${faulty_root}")
target_compile_features(faulty_library PUBLIC cxx_std_20)
target_compile_options(faulty_library PUBLIC $<TARGET_PROPERTY:sightline_library,INTERFACE_COMPILE_OPTIONS>)
target_link_libraries(faulty_library PUBLIC sightline::dependencies)

# Found here too: the program and the tests, which find them otherwise, may be left out.
find_package(CLI11 CONFIG REQUIRED)
find_package(fmt CONFIG REQUIRED)
find_package(GTest CONFIG REQUIRED)
find_package(rapidcheck CONFIG REQUIRED)

add_executable(sightline_faulty EXCLUDE_FROM_ALL tests/faults/program/main.cpp
               apps/fuzz/fuzz.cpp apps/fuzz/case_watch.cpp apps/fuzz/io.cpp apps/support/query.cpp apps/support/common.cpp
               apps/support/files.cpp apps/support/options.cpp)
target_link_libraries(sightline_faulty PRIVATE CLI11::CLI11 fmt::fmt)
add_executable(fuzz_targets_faulty EXCLUDE_FROM_ALL tests/fuzz/program/main.cpp)
target_link_libraries(fuzz_targets_faulty PRIVATE GTest::gtest rapidcheck)
target_compile_definitions(fuzz_targets_faulty PRIVATE SIGHTLINE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
foreach(target IN ITEMS sightline_faulty fuzz_targets_faulty)
  target_link_libraries(${target} PRIVATE faulty_library)
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
endforeach()
foreach(target IN ITEMS faulty_library sightline_faulty fuzz_targets_faulty)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endforeach()
add_custom_target(faulty DEPENDS sightline_faulty fuzz_targets_faulty)
