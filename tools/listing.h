#pragma once
// What pbrt says about its plug-ins.

#include <string>

#include "core/plugin/loader.h"

namespace pbrt {

// All plug-ins that can be opened, by kind, with a sentence each, and the names of other
// generations that stand for them (--list-plugins).
std::string listPlugins(PluginLoader& loader);

// One plug-in with its parameters (--describe KIND NAME). Throws Error.
std::string describePlugin(PluginLoader& loader, const std::string& kind, const std::string& name);

// The same for all plug-ins, in Markdown: docs/plugins.md, beside docs/shelf with a picture of each
// (--describe all).
std::string describeAll(PluginLoader& loader);

}  // namespace pbrt
