# The library with planted faults, and what is built with them: tests/faults/README.md. Part of the top level's CMakeLists.txt, if SIGHTLINE_FAULTS.
include(tests/faults/plant.cmake)
set(faulty_root "${PROJECT_BINARY_DIR}/faulty")
file(GLOB_RECURSE originals RELATIVE "${PROJECT_SOURCE_DIR}" CONFIGURE_DEPENDS
     kernel/*.h algorithms/*.h io/*.h harness/*.h sightline/*.h kernel/*.cpp algorithms/*.cpp io/*.cpp harness/*.cpp sightline/*.cpp)
plant_faults(tests/faults/faults.json "${faulty_root}" "${originals}")
if(planted_lost)
  message(FATAL_ERROR "tests/faults/faults.json: not found exactly once in its file is the text of ${planted_lost}; bring it up to date")
endif()
file(WRITE "${PROJECT_BINARY_DIR}/faults.txt" "${planted_hunts}")  # for tests/faults/hunt: a name, and what is to find it

include(tests/faults/programs.cmake)
add_programs_with_faults(faulty faulty_library "${faulty_root}" "${planted_sources}")
