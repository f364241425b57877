# Fuzz targets, for libFuzzer and without it: tests/fuzz/README.md. Part of the top level's CMakeLists.txt.

# The targets of tests/fuzz/targets.h without libFuzzer; built when asked for.
if(SIGHTLINE_TESTS)
  add_executable(fuzz_targets EXCLUDE_FROM_ALL tests/fuzz/program/main.cpp)
  target_link_libraries(fuzz_targets PRIVATE test_settings)
  set_source_files_properties(tests/fuzz/program/main.cpp PROPERTIES COMPILE_OPTIONS "$<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-O2>")  # oracles take half of the time
endif()

# Each of them is one executable fuzz_<name>.
if(SIGHTLINE_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "SIGHTLINE_FUZZ needs clang, which libFuzzer is part of (Debian: clang, libclang-rt-14-dev): configure a folder of its own with -DCMAKE_CXX_COMPILER=clang++")
  endif()
  add_custom_target(fuzzers)
  file(STRINGS tests/fuzz/targets.h names REGEX "{\"[a-z_]+\", [a-z_]+, {")
  list(TRANSFORM names REPLACE "^.*{\"([a-z_]+)\", .*$" "\\1")
  foreach(name IN LISTS names)
    add_executable(fuzz_${name} EXCLUDE_FROM_ALL tests/fuzz/libfuzzer/main.cpp)
    target_link_libraries(fuzz_${name} PRIVATE own_settings sightline_harness)
    target_compile_definitions(fuzz_${name} PRIVATE SIGHTLINE_FUZZ_TARGET=${name} SIGHTLINE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    target_compile_options(fuzz_${name} PRIVATE -O2 -g1 -fno-omit-frame-pointer -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all)
    target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer,address,undefined)
    add_dependencies(fuzzers fuzz_${name})
  endforeach()
endif()
