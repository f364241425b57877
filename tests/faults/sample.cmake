# The mutants of sample.json, and the test faults.sample that wants each found: tests/faults/README.md. Part of the top level's CMakeLists.txt.
# The sources that they stand in are compiled once more, as tests are, and linked before the library with what the program and the tests of fuzz
# targets were compiled to already. (A static library of unity units would bring each symbol twice.)
if(NOT SIGHTLINE_TESTS OR NOT SIGHTLINE_APPS OR SIGHTLINE_SANITIZE OR (CMAKE_UNITY_BUILD AND NOT BUILD_SHARED_LIBS))
  return()
endif()
# By clang what calls them in the same unit calls the library's own. (-fsemantic-interposition makes the library ten times as slow.)
set_source_files_properties(algorithms/priority/rounded_plane.cpp io/off.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
include(tests/faults/plant.cmake)
set(sample_list tests/faults/sample.json CACHE FILEPATH "The mutants of the test faults.sample")
mark_as_advanced(sample_list)
plant_faults("${sample_list}" "${PROJECT_BINARY_DIR}/sample" "")

add_library(sample_library OBJECT EXCLUDE_FROM_ALL ${planted_sources})
target_include_directories(sample_library BEFORE PRIVATE "${PROJECT_BINARY_DIR}/sample")
target_link_libraries(sample_library PRIVATE test_settings)
target_compile_options(sample_library PRIVATE -w ${planted_options})  # a mutant may well be a condition that is always true
set_target_properties(sample_library PROPERTIES UNITY_BUILD_BATCH_SIZE 16)
add_executable(sample_program EXCLUDE_FROM_ALL $<TARGET_OBJECTS:sightline>)
target_link_libraries(sample_program PRIVATE program_settings sample_library)
add_executable(sample_targets EXCLUDE_FROM_ALL $<TARGET_OBJECTS:test_fuzz>)
target_link_libraries(sample_targets PRIVATE test_settings sample_library)
foreach(target IN ITEMS sample_program sample_targets)
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
endforeach()
if(SIGHTLINE_PCH)  # of its own, as a compiler may want the same options for it
  target_precompile_headers(sample_library PRIVATE ${standard_headers})
endif()
if(BUILD_SHARED_LIBS)  # as ./check builds; else the test says that it is skipped until the target sample is built
  add_custom_target(sample ALL DEPENDS sample_program sample_targets)
else()
  add_custom_target(sample DEPENDS sample_program sample_targets)
endif()
add_test(NAME faults.sample COMMAND "${CMAKE_COMMAND}" -D "LIST=${sample_list}" -D "LOST=${planted_lost}" -D "BUILD=${PROJECT_BINARY_DIR}"
         -P tests/faults/sample_test.cmake WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")
set_tests_properties(faults.sample PROPERTIES TIMEOUT 1200 COST 35 SKIP_REGULAR_EXPRESSION "^faults.sample: skipped")
