#pragma once
// `pbrt-plugin new`: writes the project of a new plug-in: a source to go on with, a scene that
// shows it, and its tests.

#include <CLI/CLI.hpp>
#include <filesystem>

namespace pbrt {

struct NewPlugin {
  std::string kind;                  // "shape" or "shapes"
  std::string name;                  // of the plug-in, its file and the folder of the project
  std::filesystem::path into = ".";  // where that folder is made
  std::filesystem::path prefix;      // where CMake finds pbrt last of all; empty: only by itself
};

// Adds the subcommand, whose words land in `plugin`.
CLI::App* addNew(CLI::App& app, NewPlugin& plugin);

// Writes the folder into / name, whole or not at all, and returns its path. Throws Error:
// Failure::usage for a kind that there is not, a name that no scene can say or that is taken there,
// Failure::io if it cannot be written.
std::filesystem::path writeProject(const NewPlugin& plugin);

// The same for the installation that this program is part of; then tells how to go on. Returns 0.
int writeNew(NewPlugin plugin);

}  // namespace pbrt
