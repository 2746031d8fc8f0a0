# Regression renders: scenes rendered small and held to golden pictures as ctest tests. See
# docs/regression-renders.md.
#
#   pbrt_add_regression_render(<name> SCENE <file.pbrt> GOLDEN <file.exr>
#     [SPP <n>]               samples per pixel of the test; default 64, from 16
#     [GOLDEN_SPP <n>]        those of the golden picture; default 1024
#     [WIDTH <pixels>]        default 64; the height follows
#     [PLUGIN_PATH <folder>]  where the plug-ins are that pbrt does not bring along
#     [DEPENDS <target>...]   what the target `golden` builds first, such as these plug-ins
#     [ARGS <option>...])     further options of pbrt, which runs in the folder of the scene
#
# adds the test regression/<name>, labelled `regression`: it renders the scene with another seed
# than that of the golden picture and fails if noise does not explain the difference, or if there is
# no golden picture. Its pictures stay in regression/<name> of the build folder.
#
# The target `golden` renders all golden pictures again, lists what became of each, and replaces
# those that are new or changed by more than noise. Environment variables:
#   PBRT_GOLDEN       the names of those to render, separated by spaces; default all
#   PBRT_GOLDEN_ALL   not empty: replace the unchanged ones as well
#
# Relative paths begin at the current source folder. The programs are those of PBRT_EXECUTABLE and
# PBRT_DIFF_EXECUTABLE, else the targets pbrt and pbrt-diff (or pbrt::...), else those installed with this file,
# else those found in PATH.

include_guard(GLOBAL)

# Sets `result` to where the program is, which may be a generator expression.
function(_pbrt_program result variable program)
  foreach(target ${program} pbrt::${program})
    if(NOT ${variable} AND TARGET ${target})
      set(${result} $<TARGET_FILE:${target}> PARENT_SCOPE)
      return()
    endif()
  endforeach()
  find_program(${variable} ${program} HINTS ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../../../bin
               DOC "The program ${program}" REQUIRED)
  set(${result} ${${variable}} PARENT_SCOPE)
endfunction()

function(pbrt_add_regression_render name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SCENE;GOLDEN;SPP;GOLDEN_SPP;WIDTH;PLUGIN_PATH"
                        "ARGS;DEPENDS")
  if(arg_UNPARSED_ARGUMENTS OR arg_KEYWORDS_MISSING_VALUES)
    message(FATAL_ERROR "pbrt_add_regression_render(${name}): what is "
                        "${arg_UNPARSED_ARGUMENTS}${arg_KEYWORDS_MISSING_VALUES}?")
  endif()
  if(NOT name MATCHES "^[A-Za-z0-9_.+-]+$" OR NOT arg_SCENE OR NOT arg_GOLDEN)
    message(FATAL_ERROR "pbrt_add_regression_render(${name}): needs a name fit for a folder, SCENE "
                        "and GOLDEN")
  endif()
  foreach(default SPP=64 GOLDEN_SPP=1024 WIDTH=64)
    string(REGEX MATCH "(.*)=(.*)" default ${default})
    if(NOT DEFINED arg_${CMAKE_MATCH_1})
      set(arg_${CMAKE_MATCH_1} ${CMAKE_MATCH_2})
    endif()
    if(NOT arg_${CMAKE_MATCH_1} MATCHES "^[1-9][0-9]*$")
      message(FATAL_ERROR "pbrt_add_regression_render(${name}): ${CMAKE_MATCH_1} must be a number "
                          "from 1, not ${arg_${CMAKE_MATCH_1}}")
    endif()
  endforeach()
  foreach(path SCENE GOLDEN PLUGIN_PATH)
    if(arg_${path})
      get_filename_component(arg_${path} ${arg_${path}} ABSOLUTE)
    endif()
  endforeach()
  _pbrt_program(pbrt PBRT_EXECUTABLE pbrt)
  _pbrt_program(pbrt_diff PBRT_DIFF_EXECUTABLE pbrt-diff)

  # What the scripts need to know.
  set(folder ${CMAKE_BINARY_DIR}/regression/${name})
  set(settings ${folder}/settings-$<CONFIG>.cmake)
  file(GENERATE OUTPUT ${settings} CONTENT "set(name [==[${name}]==])
set(scene [==[${arg_SCENE}]==])
set(golden [==[${arg_GOLDEN}]==])
set(spp ${arg_SPP})
set(golden_spp ${arg_GOLDEN_SPP})
set(width ${arg_WIDTH})
set(plugin_path [==[${arg_PLUGIN_PATH}]==])
set(args [==[${arg_ARGS}]==])
set(pbrt [==[${pbrt}]==])
set(pbrt_diff [==[${pbrt_diff}]==])
set(build [==[${CMAKE_BINARY_DIR}]==])
set(folder [==[${folder}]==])
")
  set(scripts ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/regression)
  add_test(NAME regression/${name}
           COMMAND ${CMAKE_COMMAND} -Dsettings=${settings} -P ${scripts}/test.cmake)
  set_tests_properties(regression/${name} PROPERTIES LABELS regression)

  if(NOT TARGET golden)
    set(renders ${CMAKE_BINARY_DIR}/regression/renders-$<CONFIG>.txt)
    file(GENERATE OUTPUT ${renders}
         CONTENT "$<JOIN:$<GENEX_EVAL:$<TARGET_PROPERTY:golden,PBRT_RENDERS>>,\n>\n")
    add_custom_target(golden COMMAND ${CMAKE_COMMAND} -Drenders=${renders} -P ${scripts}/golden.cmake
                      COMMENT "Rendering golden pictures" USES_TERMINAL VERBATIM)
  endif()
  set_property(TARGET golden APPEND PROPERTY PBRT_RENDERS ${settings})
  foreach(target pbrt pbrt-diff plugins)
    if(TARGET ${target})
      add_dependencies(golden ${target})
    endif()
  endforeach()
  if(arg_DEPENDS)
    add_dependencies(golden ${arg_DEPENDS})
  endif()
endfunction()
