# What an installation has besides headers, libraries and the program; and Debian's package, by CPack.
# Included by CMakeLists.txt, behind the program.

# 1. What the program says of itself, written by it once it is built.
set(said "${PROJECT_BINARY_DIR}/said")
set(says bash zsh fish man)
set(bash_as share/bash-completion/completions/sightline)
set(zsh_as share/zsh/vendor-completions/_sightline)
set(fish_as share/fish/vendor_completions.d/sightline.fish)
set(man_as share/man/man1/sightline.1)
set(outputs "")
foreach(shell IN LISTS says)
  add_custom_command(OUTPUT "${said}/${${shell}_as}"
    COMMAND "${CMAKE_COMMAND}" -D "PROGRAM=$<TARGET_FILE:sightline>" -D SAYS=${shell} -D "OUT=${said}/${${shell}_as}" -P "${CMAKE_CURRENT_LIST_DIR}/say.cmake"
    DEPENDS sightline "${CMAKE_CURRENT_LIST_DIR}/say.cmake" VERBATIM)
  list(APPEND outputs "${said}/${${shell}_as}")
endforeach()
add_custom_target(sightline_says ALL DEPENDS ${outputs})
install(DIRECTORY "${said}/share" DESTINATION . COMPONENT program)
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff DESTINATION share/doc/sightline COMPONENT program)
install(FILES LICENSE DESTINATION share/doc/sightline RENAME copyright COMPONENT program)

# 2. The pages, in the folders of the headers that they are about.
foreach(room IN ITEMS kernel algorithms io harness sightline proofs)
  install(DIRECTORY ${room} DESTINATION share/doc/sightline COMPONENT program
          FILES_MATCHING PATTERN "*.md" PATTERN "*.svg" PATTERN "*.png")
endforeach()

# 3. The package.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME sightline)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_CONTACT "The authors of Sightline")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "exact 3D visibility that can be checked")
set(CPACK_PACKAGE_DESCRIPTION
    "Who can see what in polygonal scenes, from a point, a polygon, a solid or everywhere, in exact arithmetic, with certificates that a small checker accepts: a program, a C++20 library, and a judge for other programs.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program library)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS
    "libcgal-dev, libboost-dev, libtbb-dev, libgmp-dev, libmpfr-dev, libopenmesh-dev, nlohmann-json3-dev")  # who compiles against the library
find_program(SIGHTLINE_SHLIBDEPS dpkg-shlibdeps)
mark_as_advanced(SIGHTLINE_SHLIBDEPS)
if(SIGHTLINE_SHLIBDEPS)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}")
else()
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "libc6, libstdc++6, libgmp10, libgmpxx4ldbl, libmpfr6, libtbb12, libfmt9, libpng16-16, libopenmesh1")
endif()
include(CPack)
