# The library with mutants, and what is built with them: tests/faults/README.md. Part of the top level's CMakeLists.txt, if SIGHTLINE_MUTANTS
# names the folder in which tests/faults/mutate staged the sources.
include(tests/faults/programs.cmake)
file(GLOB_RECURSE mutant_sources CONFIGURE_DEPENDS "${SIGHTLINE_MUTANTS}/sightline/*.cpp")
add_programs_with_faults(mutants mutant_library "${SIGHTLINE_MUTANTS}" "${mutant_sources}")
target_precompile_headers(mutant_library PRIVATE ${standard_headers})

# The tests of some folders, for what no hunter finds.
foreach(folder IN LISTS SIGHTLINE_MUTANT_TESTS)
  file(GLOB of_folder CONFIGURE_DEPENDS tests/${folder}/*.cpp)
  add_executable(mutant_test_${folder} EXCLUDE_FROM_ALL ${of_folder})
  target_link_libraries(mutant_test_${folder} PRIVATE mutant_library GTest::gtest_main rapidcheck)
  target_compile_definitions(mutant_test_${folder} PRIVATE SIGHTLINE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" SIGHTLINE_SCENES_DIR="" SIGHTLINE_OUTSIDE_HEADERS="")
  target_compile_options(mutant_test_${folder} PRIVATE -O0)
  target_precompile_headers(mutant_test_${folder} PRIVATE ${standard_headers} <gtest/gtest.h> <rapidcheck.h> <nlohmann/json.hpp>)
  set_target_properties(mutant_test_${folder} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
  add_dependencies(mutants mutant_test_${folder})
endforeach()
