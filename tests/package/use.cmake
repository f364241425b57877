# Uses sightline as an outside project would: installs the headers of BUILD to a fresh place, builds a small program on them, runs it.
# cmake -D WAY=find_package|add_subdirectory -D SOURCE=... -D BUILD=... -D WORK=... -D GENERATOR=... -D COMPILER=... -P use.cmake

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nfailed (${status}):\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${WORK}")
set(prefix "${WORK}/prefix")
if(WAY STREQUAL "find_package")
  run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${prefix}" --component library)
  file(GLOB_RECURSE strays LIST_DIRECTORIES false "${prefix}/*")
  list(FILTER strays EXCLUDE REGEX "/include/sightline/.*[.]h$|/libsightline(_harness)?[.]a$|/cmake/sightline/sightline-[a-z-]*[.]cmake$")
  if(strays)
    message(FATAL_ERROR "installed, but neither header, library nor config: ${strays}")
  endif()
  set(headers_in "${prefix}/include/sightline")
  set(where "-DCMAKE_PREFIX_PATH=${prefix}")
else()
  set(where "-DSIGHTLINE_SOURCE=${SOURCE}")
endif()

# Two translation units that each include every header: what is not inline becomes a duplicate symbol. Once is enough, it takes long.
if(WAY STREQUAL "find_package")
  file(GLOB_RECURSE headers RELATIVE "${headers_in}" "${headers_in}/*.h")
else()
  set(headers kernel/number.h)
endif()
list(LENGTH headers count)
if(count EQUAL 0)
  message(FATAL_ERROR "no header in ${headers_in}")
endif()
list(TRANSFORM headers PREPEND "#include <sightline/")
list(TRANSFORM headers APPEND ">")
list(JOIN headers "\n" headers)
file(WRITE "${WORK}/headers.h" "#pragma once\n${headers}\n")

run("${CMAKE_COMMAND}" -G "${GENERATOR}" -S "${CMAKE_CURRENT_LIST_DIR}/outside" -B "${WORK}/build" -D WAY=${WAY} ${where}
    -D "HEADERS_DIR=${WORK}" -D "CMAKE_CXX_COMPILER=${COMPILER}" -D CMAKE_BUILD_TYPE=None
    -D CMAKE_UNITY_BUILD=ON)  # as others may have it; and it takes half the time
if(output MATCHES "Warning")
  message(FATAL_ERROR "configuring is not quiet:\n${output}")
endif()
run("${CMAKE_COMMAND}" --build "${WORK}/build" --parallel 2)
run("${WORK}/build/outside")
if(NOT output STREQUAL "1/10 1/10 1 4 4\n")
  message(FATAL_ERROR "expected '1/10 1/10 1 4 4', got '${output}'")
endif()
message(STATUS "${WAY}: ${count} headers")
