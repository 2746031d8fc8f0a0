#include "core/plugin/loader.h"

#include <cxxabi.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <memory>

#include "core/base/file.h"
#include "core/base/hash.h"

namespace pbrt {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, kPluginKinds> kNames = {
    "shape", "material", "texture", "light", "camera", "sampler", "filter", "integrator", "volume"};
constexpr std::array<std::string_view, kPluginKinds> kFolders = {
    "shapes",   "materials", "textures",    "lights", "cameras",
    "samplers", "filters",   "integrators", "volumes"};

void addPaths(std::vector<fs::path>& path, std::string_view list) {
  while (!list.empty()) {
    const std::size_t colon = std::min(list.find(':'), list.size());
    if (colon > 0) path.emplace_back(list.substr(0, colon));
    list.remove_prefix(std::min(colon + 1, list.size()));
  }
}

// A name from a scene file is a name, never a path.
bool isName(std::string_view name) {
  return !name.empty() && name.size() < 100 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
}

// What the dynamic linker complains of, without the file's own name before it, and with the name of
// the function that it misses, if any, as a person writes it.
std::string linkerError(const fs::path& file) {
  std::string text = dlerror();
  if (const std::string own = file.string() + ": "; text.starts_with(own))
    text.erase(0, own.size());
  if (const std::size_t at = text.rfind("_Z"); at != text.npos) {
    const std::size_t end = std::min(text.find_first_of(" ,)", at), text.size());
    const std::unique_ptr<char, decltype(&std::free)> name(
        abi::__cxa_demangle(text.substr(at, end - at).c_str(), nullptr, nullptr, nullptr),
        &std::free);
    if (name) text.replace(at, end - at, name.get());
  }
  return text;
}

// The file of this library, wherever it is installed; empty if that cannot be told.
fs::path ownFile() {
  Dl_info self{};
  if (dladdr(reinterpret_cast<const void*>(&kindName), &self) == 0) return {};
  return fs::absolute(self.dli_fname);
}

}  // namespace

std::string_view kindName(PluginKind kind) {
  return kNames.at(static_cast<std::size_t>(kind));
}
std::string_view kindFolder(PluginKind kind) {
  return kFolders.at(static_cast<std::size_t>(kind));
}

const PluginInfo& openPlugin(const fs::path& file) {
  const auto refuse = [&](const std::string& reason) {
    throw Error(fmt::format("{}: {}", file.string(), reason), Failure::plugin);
  };
  if (const std::string reason = refusal(file); !reason.empty()) refuse(reason);
  // All symbols now: a missing one must not end a render halfway. Never closed: objects live on.
  // A name without a folder would be looked for among the libraries of the system.
  const fs::path whole = fs::absolute(file);
  void* handle = dlopen(whole.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) refuse("it cannot be opened: " + linkerError(whole));
  const auto entry = reinterpret_cast<PluginEntry>(dlsym(handle, kPluginSymbol));
  if (!entry) refuse(fmt::format("it is no pbrt plug-in: it has no function {}", kPluginSymbol));
  const PluginInfo* info = entry();
  if (!info) refuse("its entry function returns nothing");
  // The file may hold the stamp of something else.
  if (const std::string reason = refusal(info->stamp); !reason.empty()) refuse(reason);
  registerPlugin(*info, whole);
  return *info;
}

std::vector<fs::path> PluginLoader::searchPath(const std::string& extra) {
  std::vector<fs::path> path;
  addPaths(path, extra);
  if (const char* environment = std::getenv("PBRT_PLUGIN_PATH")) addPaths(path, environment);
  if (const fs::path own = ownFile(); !own.empty()) path.push_back(own.parent_path() / "pbrt");
  return path;
}

// Its file; empty if there is none.
fs::path PluginLoader::find(PluginKind kind, const std::string& name) const {
  if (!isName(name)) return {};
  for (const fs::path& directory : path_) {
    const fs::path candidate = directory / kindFolder(kind) / (name + ".so");
    if (std::error_code unreadable; fs::exists(candidate, unreadable))
      return fs::absolute(candidate);
  }
  return {};
}

const PluginInfo& PluginLoader::open(PluginKind kind, const std::string& name) {
  const auto key = std::pair(kind, name);
  if (const auto known = cache_.find(key); known != cache_.end()) return *known->second;

  const fs::path file = find(kind, name);
  if (file.empty()) {
    const std::vector<std::string> names = available(kind);
    if (names.empty())
      throw Error(fmt::format("there are no {} in {}", kindFolder(kind),
                              fmt::join(
                                  [this] {
                                    std::vector<std::string> paths;
                                    for (const fs::path& p : path_) paths.push_back(p.string());
                                    return paths;
                                  }(),
                                  ", ")),
                  Failure::plugin);
    throw Error(fmt::format("there is no {} \"{}\"{}", kindName(kind), shown(name),
                            didYouMean(name, names)));
  }

  const auto start = std::chrono::steady_clock::now();
  const PluginInfo* info = &openPlugin(file);
  std::string reason;
  if (info->kind != kind)
    reason = fmt::format("it is a {}, not a {}", kindName(info->kind), kindName(kind));
  else if (info->name != name)
    reason = fmt::format("it calls itself \"{}\"", info->name);
  if (!reason.empty()) throw Error(fmt::format("{}: {}", file.string(), reason), Failure::plugin);

  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  opened_.push_back({info, file, seconds.count()});
  cache_.emplace(key, info);
  return *info;
}

std::uint64_t PluginLoader::programs() const {
  std::uint64_t hash = hashBytes(readFile(ownFile()));
  for (const LoadedPlugin& plugin : opened_) hash = hashBytes(readFile(plugin.file), hash);
  return hash;
}

std::vector<std::string> PluginLoader::available(PluginKind kind) const {
  std::vector<std::string> names;
  for (const fs::path& directory : path_) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(directory / kindFolder(kind), none))
      if (entry.path().extension() == ".so") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace pbrt
