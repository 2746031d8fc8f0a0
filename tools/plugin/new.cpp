#include "new.h"

#include <fmt/format.h>

#include <cctype>
#include <cstdlib>

#include "core/base/error.h"
#include "core/base/replacement.h"
#include "core/plugin/loader.h"
#include "templates.h"
#include "tools/kind_by_name.h"

namespace pbrt {

namespace fs = std::filesystem;

namespace {

bool isLetterOrDigit(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 && static_cast<unsigned char>(c) < 128;
}

// What a scene can name, a shell does not take for an option, and file systems hold.
void checkName(std::string_view name) {
  const auto allowed = [](char c) { return isLetterOrDigit(c) || c == '_' || c == '-'; };
  if (name.empty() || name.size() >= 100 || name.front() == '-' ||
      !std::ranges::all_of(name, allowed))
    throw Error(fmt::format("\"{}\" cannot be the name of a plug-in: up to 99 letters, digits, _ "
                            "and - can, with no - in front",
                            shown(name)),
                Failure::usage);
}

// The text of a template; there is always one.
std::string_view textOf(const std::string& name) {
  return std::ranges::find(templates(), std::string_view(name), &Template::name)->text;
}

bool hasWord(std::string_view text, std::string_view word) {
  const auto inWord = [&](std::size_t i) {
    return i < text.size() && (isLetterOrDigit(text[i]) || text[i] == '_');
  };
  for (auto at = text.find(word); at != text.npos; at = text.find(word, at + 1))
    if (!(at > 0 && inWord(at - 1)) && !inWord(at + word.size())) return true;
  return false;
}

// my-torus_2 gives MyTorus2: no keyword begins with a capital, and no macro of ours has small
// letters behind it. Where that is no identifier, or one that the source uses for something else,
// the kind is added.
std::string className(std::string_view name, std::string_view kind, std::string_view source) {
  const bool shouts = std::ranges::none_of(name, [](char c) { return c >= 'a' && c <= 'z'; });
  std::string result;
  bool begins = true;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (isLetterOrDigit(c))
      result += static_cast<char>(begins   ? std::toupper(letter)
                                  : shouts ? std::tolower(letter)
                                           : letter);
    begins = !isLetterOrDigit(c);
  }
  std::string capital(kind);
  capital.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(capital.front())));
  if (result.empty() || (result.front() >= '0' && result.front() <= '9')) result = capital + result;
  while (hasWord(source, result)) result += capital;
  return result;
}

using Places = std::vector<std::pair<std::string, std::string>>;

std::string filled(std::string_view source, const Places& places) {
  std::string text(source);
  for (const auto& [place, value] : places)
    for (auto at = text.find(place); at != text.npos; at = text.find(place, at + value.size()))
      text.replace(at, place.size(), value);
  return text;
}

// A folder of its own beside where something is made, which goes away with what is left in it.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const fs::path& beside) {
    std::string pattern = (beside / ".pbrt-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
      throw Error(fmt::format("cannot write into {}: {}", beside.string(),
                              std::generic_category().message(errno)),
                  Failure::io);
    path_ = pattern;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

fs::path writeProject(const NewPlugin& plugin) {
  const PluginKind asked = kindByName(plugin.kind);
  const std::string kind(kindName(asked)), folder(kindFolder(asked));
  checkName(plugin.name);
  const fs::path target = plugin.into / plugin.name;
  std::error_code error;
  if (fs::exists(fs::symlink_status(target, error)))
    throw Error(fmt::format("{} is there already", target.string()), Failure::usage);

  const std::string_view source = textOf(kind + ".cpp");
  const Places places = {
      {"@NAME@", plugin.name},
      {"@CLASS@", className(plugin.name, kind, source)},
      {"@KIND@", kind},
      {"@FOLDER@", folder},
      {"@HEADER@", asked == PluginKind::volume ? "medium" : kind},
      {"@PATHS@",
       plugin.prefix.empty() ? "" : fmt::format(" PATHS [[{}]]", plugin.prefix.string())},
  };
  const TemporaryFolder temporary(plugin.into);
  const fs::path made = temporary.path() / plugin.name;
  fs::create_directory(made, error);
  const auto write = [&](const std::string& file, const std::string& templ) {
    writeFile(made / file, filled(textOf(templ), places));
  };
  write("CMakeLists.txt", "CMakeLists.txt");
  write(plugin.name + ".cpp", kind + ".cpp");
  write(plugin.name + ".pbrt", kind + ".pbrt");
  write("README.md", "README.md");
  write(".gitignore", "gitignore");
  fs::rename(made, target, error);
  if (error)
    throw Error(fmt::format("cannot make {}: {}", target.string(), error.message()), Failure::io);
  return target;
}

CLI::App* addNew(CLI::App& app, NewPlugin& plugin) {
  CLI::App* make = app.add_subcommand(
      "new", "Write a small project of a new plug-in, which builds, renders and tests it");
  make->add_option("kind", plugin.kind,
                   "shape, integrator, material, light, texture, sampler, filter, camera or volume")
      ->required();
  make->add_option("name", plugin.name, "As scenes will call it: letters, digits, _ and -")
      ->required();
  make->add_option("--into", plugin.into, "Where its folder is made (default: here)");
  return make;
}

int writeNew(NewPlugin plugin) {
  // Not installed where its own package is not, as in a build.
  const fs::path prefix = fs::read_symlink("/proc/self/exe").parent_path().parent_path();
  const bool installed = fs::exists(prefix / PBRT_LIBDIR "/cmake/pbrt/pbrtTargets.cmake");
  if (installed) plugin.prefix = prefix;
  const std::string folder = writeProject(plugin).lexically_normal().string();
  const PluginKind kind = kindByName(plugin.kind);
  if (PluginLoader(PluginLoader::searchPath("")).has(kind, plugin.name))
    fmt::print(stderr,
               "warning: pbrt itself has a {} \"{}\": yours goes before it, where --plugin-path "
               "leads to yours\n",
               kindName(kind), plugin.name);
  if (!installed)
    fmt::print(stderr,
               "warning: {0} holds no CMake package of pbrt, which the project needs: install pbrt "
               "first (cmake --install BUILD --prefix PREFIX, or the package pbrt-dev), and add "
               "-DCMAKE_PREFIX_PATH=PREFIX to the first cmake below\n",
               prefix.string());
  fmt::print(
      "{0}: {1}.cpp, {1}.pbrt, CMakeLists.txt, README.md. To build and to test it:\n"
      "  cmake -S {0} -B {0}/build && cmake --build {0}/build && ctest --test-dir {0}/build\n",
      folder, plugin.name);
  return 0;
}

}  // namespace pbrt
