# What the program loads where mpirun started several of it: algorithms/levels/README.md. Part of the top level's CMakeLists.txt, if SIGHTLINE_APPS.

# MPI's C interface alone, found without its compilers' languages: no C in this project, and C++ bindings are gone from MPI.
set(SIGHTLINE_MPI AUTO CACHE STRING "Let `mpirun sightline pvs` share its work among processes: ON, OFF, or AUTO, if MPI is found")
set_property(CACHE SIGHTLINE_MPI PROPERTY STRINGS AUTO ON OFF)
set(modules lib/sightline)  # where it is installed
if(SIGHTLINE_INSTALL)
  set(modules "${CMAKE_INSTALL_LIBDIR}/sightline")
endif()
set_source_files_properties(apps/support/ranks.cpp PROPERTIES COMPILE_DEFINITIONS SIGHTLINE_MODULES="../${modules}")
if(NOT SIGHTLINE_MPI)
  return()
endif()
set(MPI_CXX_SKIP_MPICXX ON)
find_package(MPI QUIET COMPONENTS CXX)
if(NOT MPI_CXX_FOUND)
  if(SIGHTLINE_MPI STREQUAL "AUTO")
    message(STATUS "mpirun sightline pvs is left out: it needs MPI (Debian: libopenmpi-dev)")
    return()
  endif()
  message(FATAL_ERROR "SIGHTLINE_MPI=ON needs MPI (Debian: libopenmpi-dev)")
endif()

add_library(sightline_mpi MODULE apps/mpi/messages.cpp)
set_target_properties(sightline_mpi PROPERTIES PREFIX "" CXX_EXTENSIONS OFF LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
target_compile_features(sightline_mpi PRIVATE cxx_std_20)
target_link_libraries(sightline_mpi PRIVATE own_settings MPI::MPI_CXX)
add_dependencies(sightline sightline_mpi)
if(SIGHTLINE_INSTALL)  # Debian's package is without it: nobody needs MPI who does not call mpirun
  install(TARGETS sightline_mpi LIBRARY DESTINATION "${modules}" COMPONENT mpi)
endif()
