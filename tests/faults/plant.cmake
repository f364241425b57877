# What programs with faults are compiled with: a fault may leave a number out, which has the same value in every process then.
set(planted_options -ftrivial-auto-var-init=pattern)

# plant_faults(LIST ROOT FILES): copies FILES below ROOT, as they are included, in which each fault of the JSON file LIST stands beside what it
# replaces; the environment variable SIGHTLINE_FAULT says which one is on. Files that hold one are copied anyway. Sets planted_sources to the
# sources among the copies, planted_hunts to a line for each fault: its name, a tab, what is to find it; planted_lost to the names of faults whose
# text is not found exactly once.
function(plant_faults list root files)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${list}")
  file(READ "${list}" faults)
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
  list(APPEND files ${faulty_files})
  list(REMOVE_DUPLICATES files)
  set(sources "")
  set(lost "")
  foreach(file IN LISTS files)
    if(NOT EXISTS "${PROJECT_SOURCE_DIR}/${file}")
      message(FATAL_ERROR "${list}: no such file: ${file}")
    endif()
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
    file(READ "${file}" text)
    foreach(k IN LISTS faults_of_${file})
      string(FIND "${text}" "${text_${k}}" first)
      string(FIND "${text}" "${text_${k}}" second REVERSE)
      if(first EQUAL -1 OR NOT first EQUAL second)
        string(JSON name GET "${faults}" ${k} name)
        list(APPEND lost "${name}")
        continue()
      endif()
      string(REPLACE "${text_${k}}" "${faulty_text_${k}}" text "${text}")
    endforeach()
    if(file IN_LIST faulty_files)
      string(PREPEND text "#include <sightline/faults.h>\n")
    endif()
    string(REGEX REPLACE "^sightline/" "" place "${file}")  # the front door has no folder of its own in what is included
    file(CONFIGURE OUTPUT "${root}/sightline/${place}" CONTENT "${text}" @ONLY)
    if(file MATCHES "[.]cpp$")
      list(APPEND sources "${root}/sightline/${place}")
    endif()
  endforeach()
  file(CONFIGURE OUTPUT "${root}/sightline/faults.h" @ONLY CONTENT "#pragma once
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
  set(planted_sources "${sources}" PARENT_SCOPE)
  set(planted_hunts "${hunts}" PARENT_SCOPE)
  set(planted_lost "${lost}" PARENT_SCOPE)
endfunction()
