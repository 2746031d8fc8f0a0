#pragma once
// Objects of any kind, made only to see what comes of it.

#include <vector>

#include "core/plugin/loader.h"

namespace pbrt::laws {

// Makes what a scene would make of these parameters, and lets it go. Throws Error; what the reader
// has that nobody read is left for the caller to tell.
void make(const PluginInfo& plugin, Params& reader);

// The parameters that the plug-in declares when nothing is given. An object may come of it or not.
std::vector<Declaration> declarationsOf(const PluginInfo& plugin);

}  // namespace pbrt::laws
