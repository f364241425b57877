# cmake -D PROGRAM=... -D SAYS=bash|zsh|fish|man -D OUT=... -P say.cmake: what the program says of itself, into a file.
get_filename_component(folder "${OUT}" DIRECTORY)
file(MAKE_DIRECTORY "${folder}")
execute_process(COMMAND "${PROGRAM}" completion ${SAYS} OUTPUT_FILE "${OUT}" RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  file(REMOVE "${OUT}")
  message(FATAL_ERROR "${PROGRAM} completion ${SAYS} ended with ${status}")
endif()
