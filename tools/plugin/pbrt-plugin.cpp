// The command: helps to write plug-ins.

#include "core/plugin/loader.h"
#include "new.h"
#include "tools/command.h"
#include "tools/kind_by_name.h"

namespace pbrt {
namespace {

// Where this program is installed, if it was called by a path: by its bare name it is found in
// PATH, and CMake finds the rest from there.
std::filesystem::path prefixOf(const std::string& called) {
  if (called.find('/') == called.npos) return {};
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
}

int makeNew(const std::string& kind, NewPlugin plugin) {
  plugin.kind = kindByName(kind);
  const std::string folder = writeProject(plugin).lexically_normal().string();
  if (PluginLoader(PluginLoader::searchPath("")).has(plugin.kind, plugin.name))
    fmt::print(stderr,
               "warning: pbrt has a {} \"{}\": where --plugin-path leads to yours, yours "
               "goes before it\n",
               kindName(plugin.kind), plugin.name);
  fmt::print(
      "{0}: {1}.cpp, {1}.pbrt, CMakeLists.txt, README.md. To build and to test it:\n"
      "  cmake -S {0} -B {0}/build && cmake --build {0}/build && ctest --test-dir "
      "{0}/build\n",
      folder, plugin.name);
  return 0;
}

int run(int argc, char** argv) {
  CLI::App app("Helps to write plug-ins for pbrt", "pbrt-plugin");
  app.set_version_flag("--version", "pbrt-plugin " PBRT_VERSION);
  app.require_subcommand(1);

  std::string kind;
  NewPlugin plugin;
  plugin.prefix = prefixOf(argv[0]);
  CLI::App* make = app.add_subcommand(
      "new", "Write a small project of a new plug-in, which builds, renders and tests it");
  make->add_option("kind", kind,
                   "shape, integrator, material, light, texture, sampler, filter, "
                   "camera or volume")
      ->required();
  make->add_option("name", plugin.name, "As scenes will call it: letters, digits, _ and -")
      ->required();
  make->add_option("--into", plugin.into, "The folder in which its folder is made (default: here)");
  return runCommand(app, reversedWords(argc, argv), [&] { return makeNew(kind, plugin); });
}

}  // namespace
}  // namespace pbrt

int main(int argc, char** argv) {
  return pbrt::run(argc, argv);
}
