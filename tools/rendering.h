#pragma once
// Renders a scene into pictures.

#include "core/plugin/loader.h"
#include "options.h"

namespace pbrt {

// Reads the scene, renders it until its goal is reached, and writes the pictures. Returns the exit
// code.
int render(const Options& o, PluginLoader& loader);

}  // namespace pbrt
