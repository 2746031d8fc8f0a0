# How a plug-in is built, within this project and outside of it (docs/adding-a-plugin.md).
#
#   pbrt_add_plugin(<kind> <source.cpp> [<source.cpp>...])
#
# makes the target <kind>-<name>, where <name> is that of the first source without its suffix, and
# the shared object <kind>/<name>.so in PBRT_PLUGIN_OUTPUT_DIRECTORY, which pbrt finds by
# `--plugin-path`. By default that is the folder plugins of the build. `cmake --install` puts it
# where pbrt looks by itself when it is installed below the same prefix.
# Kinds: cameras filters integrators lights materials samplers shapes textures volumes.

include_guard(GLOBAL)
include(GNUInstallDirs)

set(PBRT_PLUGIN_KINDS shapes integrators samplers filters cameras lights materials textures volumes
    CACHE INTERNAL "Folders of plug-ins")

function(pbrt_add_plugin kind source)
  if(NOT kind IN_LIST PBRT_PLUGIN_KINDS)
    list(JOIN PBRT_PLUGIN_KINDS ", " kinds)
    message(FATAL_ERROR "pbrt_add_plugin(${kind} ${source}): the kinds are ${kinds}")
  endif()
  get_filename_component(name ${source} NAME_WE)
  if(NOT name MATCHES "^[A-Za-z0-9_-]+$")
    message(FATAL_ERROR "pbrt_add_plugin(${kind} ${source}): a scene can name a plug-in only by "
                        "letters, digits, _ and -")
  endif()
  if(NOT PBRT_PLUGIN_OUTPUT_DIRECTORY)
    set(PBRT_PLUGIN_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/plugins)
  endif()
  set(target ${kind}-${name})
  add_library(${target} MODULE ${source} ${ARGN})
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${name}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    # The expression keeps generators of several configurations from adding a folder of their own.
    LIBRARY_OUTPUT_DIRECTORY $<1:${PBRT_PLUGIN_OUTPUT_DIRECTORY}/${kind}>
    INSTALL_RPATH "$ORIGIN/../..")
  target_link_libraries(${target} PRIVATE pbrt::core)
  if(TARGET pbrt_options)  # within this project: its warnings and sanitizers
    target_link_libraries(${target} PRIVATE pbrt_options)
  endif()
  # What it lacks is an error when it is linked, not when a scene names it.
  if(NOT (PBRT_SANITIZE OR CMAKE_CXX_FLAGS MATCHES "-fsanitize"))
    target_link_options(${target} PRIVATE -Wl,--no-undefined)
  endif()
  install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/pbrt/${kind})
  set_property(GLOBAL APPEND PROPERTY PBRT_PLUGINS ${target})
endfunction()
