# The Python module: python/module is compiled to _sightline, and lies in the build folder's python/sightline beside what python/sightline holds.
# PYTHONPATH=BUILD/python imports it; `pip install .` builds it by python/build_backend.py.

set(SIGHTLINE_PYTHON OFF CACHE STRING "Build the Python module: ON, OFF, or AUTO: where pybind11 and Python's headers are")
set(SIGHTLINE_PYTHON_EXECUTABLE "" CACHE FILEPATH "The Python to build the module for; empty: the first that has numpy, of the path's python3 and /usr/bin/python3")
if(NOT SIGHTLINE_PYTHON)
  return()
endif()

# ---- Which Python, and what is there

set(python "${SIGHTLINE_PYTHON_EXECUTABLE}")
foreach(candidate IN ITEMS python3 /usr/bin/python3)
  if(NOT python)
    execute_process(COMMAND ${candidate} -c "import numpy, sys; print(sys.executable)" OUTPUT_VARIABLE python ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  endif()
endforeach()
set(missing "")
if(python)
  execute_process(COMMAND "${python}" -c "import sysconfig; print(sysconfig.get_path('include'), sysconfig.get_config_var('EXT_SUFFIX'), sep=';')"
                  OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  list(GET found 0 python_include)
  list(GET found 1 python_suffix)
  if(NOT EXISTS "${python_include}/Python.h")
    list(APPEND missing "Python.h (Debian: python3-dev)")
  endif()
else()
  list(APPEND missing "a python3 with numpy (Debian: python3-numpy)")
endif()
find_path(SIGHTLINE_PYBIND11_INCLUDE_DIR pybind11/pybind11.h)
mark_as_advanced(SIGHTLINE_PYBIND11_INCLUDE_DIR)
if(NOT SIGHTLINE_PYBIND11_INCLUDE_DIR)
  list(APPEND missing "pybind11 (Debian: pybind11-dev)")
endif()
list(JOIN missing ", " missing)
if(missing AND NOT SIGHTLINE_PYTHON STREQUAL "AUTO")
  message(FATAL_ERROR "SIGHTLINE_PYTHON needs ${missing}")
elseif(missing)
  message(STATUS "the Python module is left out: it needs ${missing}")
  if(SIGHTLINE_TESTS)
    add_test(NAME python.module COMMAND "${CMAKE_COMMAND}" -E echo "skipped: the Python module needs ${missing}")
    set_tests_properties(python.module PROPERTIES SKIP_REGULAR_EXPRESSION "skipped:")
  endif()
  return()
endif()

# ---- The module

file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_LIST_DIR}/module/*.cpp")
add_library(sightline_python MODULE ${sources})
target_link_libraries(sightline_python PRIVATE own_settings sightline_harness)
target_include_directories(sightline_python SYSTEM PRIVATE "${python_include}" "${SIGHTLINE_PYBIND11_INCLUDE_DIR}")
# What takes its time is in the libraries.
target_compile_options(sightline_python PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-O1> ${rough})
set_source_files_properties("${CMAKE_CURRENT_LIST_DIR}/module/module.cpp" PROPERTIES COMPILE_DEFINITIONS SIGHTLINE_VERSION="${PROJECT_VERSION}")
set_source_files_properties("${CMAKE_CURRENT_LIST_DIR}/module/harness.cpp" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)  # its questions are judge's
set_target_properties(sightline_python PROPERTIES OUTPUT_NAME _sightline PREFIX "" SUFFIX "${python_suffix}" DEBUG_POSTFIX ""
  CXX_VISIBILITY_PRESET hidden LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/python/sightline")
if(SIGHTLINE_PCH)
  target_precompile_headers(sightline_python PRIVATE <pybind11/numpy.h> <pybind11/pybind11.h> <gmpxx.h> <functional> <memory> <string> <vector>)
endif()
file(GLOB package CONFIGURE_DEPENDS "${CMAKE_CURRENT_LIST_DIR}/sightline/*.py" "${CMAKE_CURRENT_LIST_DIR}/sightline/*.pyi" "${CMAKE_CURRENT_LIST_DIR}/sightline/py.typed")
file(MAKE_DIRECTORY "${PROJECT_BINARY_DIR}/python/sightline")
foreach(file IN LISTS package)
  cmake_path(GET file FILENAME name)
  file(CREATE_LINK "${file}" "${PROJECT_BINARY_DIR}/python/sightline/${name}" SYMBOLIC)
endforeach()

# ---- Its tests, by pytest

if(SIGHTLINE_TESTS)
  add_dependencies(tests sightline_python)
  execute_process(COMMAND "${python}" -c "import numpy, pytest" RESULT_VARIABLE without ERROR_QUIET)
  if(without)
    add_test(NAME python.module COMMAND "${CMAKE_COMMAND}" -E echo "skipped: ${python} has no numpy or no pytest (Debian: python3-numpy python3-pytest)")
    set_tests_properties(python.module PROPERTIES SKIP_REGULAR_EXPRESSION "skipped:")
  else()
    add_test(NAME python.module COMMAND "${python}" -m pytest -q -p no:cacheprovider -rs "${CMAKE_CURRENT_LIST_DIR}/tests"
             WORKING_DIRECTORY "${PROJECT_BINARY_DIR}/python")
    set_tests_properties(python.module PROPERTIES TIMEOUT 600 COST 40 ENVIRONMENT
      "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1;SIGHTLINE_BUILD_DIR=${PROJECT_BINARY_DIR};MPLBACKEND=Agg")
  endif()
endif()
