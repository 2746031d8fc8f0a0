#pragma once
// Renders a scene into pictures.

#include "core/plugin/loader.h"
#include "options.h"

namespace pbrt {

// Exit code of a render that a signal has ended before its goal (EX_TEMPFAIL of sysexits.h).
constexpr int kInterrupted = 75;

// Reads the scene, renders it until its goal is reached, and writes pictures and films. Returns the
// exit code.
int render(const Options& o, PluginLoader& loader);

}  // namespace pbrt
