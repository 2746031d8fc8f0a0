#pragma once
// The project of a new plug-in: its source to go on with, a scene that shows it, and its tests.

#include <filesystem>

#include "core/plugin/kind.h"

namespace pbrt {

struct NewPlugin {
  PluginKind kind{};
  std::string name;
  std::filesystem::path into = ".";  // where its folder is made
  std::filesystem::path prefix;      // where CMake finds pbrt last of all; empty: only by itself
};

// Writes the folder into / name, whole or not at all, and returns its path. Throws Error:
// Failure::usage for a name that no scene can say or that is taken there, Failure::io.
std::filesystem::path writeProject(const NewPlugin& plugin);

}  // namespace pbrt
