# What --html writes but for data: the files of apps/page, as constants of the program. Part of the top level's CMakeLists.txt, if SIGHTLINE_APPS.

set(page_scripts decode geometry camera renderer picking elements commands main)  # in this order
set(constants "")
function(add_page_constant name files)  # the files one after another; each is a literal of its own, as compilers limit their length
  set(all "")
  foreach(file IN LISTS files)
    file(READ "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${file}" text)
    string(APPEND all "R\"page(${text})page\"\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${file}")
  endforeach()
  set(constants "${constants}const std::string_view ${name} =\n${all};\n" PARENT_SCOPE)
endfunction()
add_page_constant(page_text page.html)
add_page_constant(page_style page.css)
list(TRANSFORM page_scripts APPEND ".js")
add_page_constant(page_script "${page_scripts}")
add_page_constant(turn_style turn.css)
add_page_constant(turn_script turn.js)
file(CONFIGURE OUTPUT page_sources.cpp @ONLY
     CONTENT "#include \"${CMAKE_CURRENT_LIST_DIR}/../support/page_sources.h\"\n\nnamespace sightline::app {\n\n@constants@\n}  // namespace sightline::app\n")
target_sources(sightline PRIVATE "${PROJECT_BINARY_DIR}/page_sources.cpp")
