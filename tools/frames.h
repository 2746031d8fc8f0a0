#pragma once
// The frames of an animation, one after the other.

#include <functional>

#include "core/plugin/loader.h"
#include "options.h"

namespace pbrt {

// The numbers that "7", "1-240", "1-240:10" (every tenth) or several of them with commas between
// name, in this order, each once. Throws Error, Failure::usage.
std::vector<int> readFrames(const std::string& text);

// Throws Error, Failure::usage, if frames would have no names of their own, or cannot be had.
void checkFrames(const Options& o);

// What is done for a scene; returns the exit code.
using Command = std::function<int(const Options&, PluginLoader&)>;

// Carries the command out for each of o.frames. A frame that fails is told, and the others go on,
// unless they would fail alike or the user has interrupted this one. Returns the exit code of the
// first failure, or that of the interruption.
int forFrames(const Options& o, const Command& command);

}  // namespace pbrt
