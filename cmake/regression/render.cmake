# Renders the scene of the settings into `picture`; sets `result` to pbrt's exit code, or to why
# there is none. What pbrt has to say goes to the terminal.
function(pbrt_render picture spp seed result)
  file(REMOVE "${picture}")
  # The picture's metadata names the scene: without the folder, it is the same on every machine.
  get_filename_component(directory "${scene}" DIRECTORY)
  get_filename_component(file "${scene}" NAME)
  if(plugin_path)
    set(plugins --plugin-path "${plugin_path}")
  endif()
  execute_process(
    COMMAND "${pbrt}" "${file}" --quiet --width ${width} --spp ${spp} --seed ${seed} --aov variance
            --outfile "${picture}" ${plugins} ${args}
    WORKING_DIRECTORY "${directory}" RESULT_VARIABLE code)
  set(${result} ${code} PARENT_SCOPE)
endfunction()
