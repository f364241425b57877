# What looks for faults, on a copy of the library that holds some: NAME_library, sightline_NAME and fuzz_targets_NAME of sources below root.
# Found here too: the program and the tests, which find them otherwise, may be left out.
include(tests/faults/plant.cmake)
find_package(CLI11 CONFIG REQUIRED)
find_package(fmt CONFIG REQUIRED)
find_package(GTest CONFIG REQUIRED)
find_package(rapidcheck CONFIG REQUIRED)

function(add_programs_with_faults name library root sources)
  add_library(${library} STATIC EXCLUDE_FROM_ALL ${sources})
  target_include_directories(${library} PUBLIC "${root}")
  target_compile_features(${library} PUBLIC cxx_std_20)
  target_compile_options(${library} PUBLIC $<TARGET_PROPERTY:sightline_library,INTERFACE_COMPILE_OPTIONS>)
  target_compile_options(${library} PRIVATE ${planted_options})
  target_link_libraries(${library} PUBLIC sightline::dependencies)

  add_executable(sightline_${name} EXCLUDE_FROM_ALL tests/faults/program/main.cpp
                 apps/fuzz/fuzz.cpp apps/fuzz/case_watch.cpp apps/fuzz/io.cpp apps/support/query.cpp apps/support/common.cpp
                 apps/support/files.cpp apps/support/options.cpp apps/support/shard.cpp)
  target_link_libraries(sightline_${name} PRIVATE CLI11::CLI11 fmt::fmt)
  add_executable(fuzz_targets_${name} EXCLUDE_FROM_ALL tests/fuzz/program/main.cpp)
  target_link_libraries(fuzz_targets_${name} PRIVATE GTest::gtest rapidcheck)
  target_compile_definitions(fuzz_targets_${name} PRIVATE SIGHTLINE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  foreach(target IN ITEMS sightline_${name} fuzz_targets_${name})
    target_link_libraries(${target} PRIVATE ${library})
    set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
  endforeach()
  foreach(target IN ITEMS ${library} sightline_${name} fuzz_targets_${name})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
  add_custom_target(${name} DEPENDS sightline_${name} fuzz_targets_${name})
endfunction()
