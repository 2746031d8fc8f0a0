# The test of a regression render: cmake -Dsettings=FILE -P test.cmake
cmake_minimum_required(VERSION 3.25)
include("${settings}")
include("${CMAKE_CURRENT_LIST_DIR}/render.cmake")

set(picture "${folder}/test.exr")
set(reference "${folder}/test-golden.exr")
set(error "${folder}/test-error.png")
file(REMOVE "${picture}" "${reference}" "${error}")
set(remake "PBRT_GOLDEN=${name} cmake --build ${build} --target golden")
if(NOT EXISTS "${golden}")
  message(FATAL_ERROR "${name}: there is no golden picture ${golden}\nTo make it:\n  ${remake}\n"
                      "Look at it, and put it under version control.")
endif()

# Golden pictures have seed 0 (golden.cmake): the noise of the two is independent.
pbrt_render("${picture}" ${spp} 1 code)
if(NOT code STREQUAL "0")
  message(FATAL_ERROR "${name}: pbrt failed (${code}) on ${scene}")
endif()
execute_process(COMMAND "${pbrt_diff}" --statistical "${golden}" "${picture}" RESULT_VARIABLE code)
if(code STREQUAL "0")
  return()
elseif(NOT code STREQUAL "1")
  message(FATAL_ERROR "${name}: pbrt-diff failed (${code}) on ${golden} and ${picture}")
endif()

# All that one wants to look at, in one place.
file(COPY_FILE "${golden}" "${reference}")
execute_process(COMMAND "${pbrt_diff}" --quiet --image "${error}" "${golden}" "${picture}"
                OUTPUT_QUIET ERROR_QUIET)
set(pictures "  ${picture}\n  ${reference}\n")
if(EXISTS "${error}")
  string(APPEND pictures "  ${error} (FLIP of the two)\n")
endif()
message(FATAL_ERROR "${name}: not as in the golden picture ${golden}\n${pictures}"
                    "If the new picture is right:\n  ${remake}")
