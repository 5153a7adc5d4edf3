# Installs the program, the headers and the Python package of the build tree BUILD into the folder PREFIX.
file(REMOVE_RECURSE ${PREFIX})
foreach(component robosim robosim-dev python3-robosim)
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --component ${component} --prefix ${PREFIX}
                  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()
