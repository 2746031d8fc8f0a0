# Installs the build into a folder, which is then moved: nothing may still point to where it was.
file(REMOVE_RECURSE ${kit}/first ${kit}/prefix)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${build} --prefix ${kit}/first
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(RENAME ${kit}/first ${kit}/prefix)
