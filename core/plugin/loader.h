#pragma once
// Opens plug-ins: the only place that calls dlopen.

#include <filesystem>
#include <map>

#include "core/plugin/culprit.h"
#include "core/plugin/plugin.h"

namespace pbrt {

struct LoadedPlugin {
  const PluginInfo* info = nullptr;
  std::filesystem::path file;
  double seconds = 0;  // to open
};

// Opens one file, whatever its kind and name; it is never closed. Throws Error, Failure::plugin,
// naming the file and the reason, if it cannot be used.
const PluginInfo& openPlugin(const std::filesystem::path& file);

// Looks for <folder>/<name>.so below each directory of the search path, opens it at first mention
// and never closes it. Not thread-safe.
class PluginLoader {
 public:
  explicit PluginLoader(std::vector<std::filesystem::path> path) : path_(std::move(path)) {}
  // `extra` (--plugin-path, colon-separated), PBRT_PLUGIN_PATH, then the folder pbrt beside the
  // core library (lib/pbrt).
  static std::vector<std::filesystem::path> searchPath(const std::string& extra);

  // Throws Error: Failure::scene if there is no such plug-in (with "did you mean"), Failure::plugin
  // if there is one that cannot be used; the message names the file and the reason.
  const PluginInfo& open(PluginKind kind, const std::string& name);

  // Whether there is a file for it; it may still be unusable.
  bool has(PluginKind kind, const std::string& name) const {
    return cache_.contains({kind, name}) || !find(kind, name).empty();
  }
  // Names that could be opened, sorted; nothing is opened.
  std::vector<std::string> available(PluginKind kind) const;
  // What was opened so far, in order.
  const std::vector<LoadedPlugin>& opened() const { return opened_; }
  // A hash of the files of the core library and of the plug-ins that were opened, in their order,
  // as they are now: the same only if every byte is. Throws Error, Failure::io, if one is gone.
  std::uint64_t programs() const;

 private:
  std::filesystem::path find(PluginKind kind, const std::string& name) const;

  std::vector<std::filesystem::path> path_;
  std::map<std::pair<PluginKind, std::string>, const PluginInfo*> cache_;
  std::vector<LoadedPlugin> opened_;
};

// Makes an object of the plug-in; what the plug-in throws gains the place of its statement.
template <class Interface>
std::unique_ptr<Interface> create(const PluginInfo& plugin, Params& params,
                                  const typename Interface::Setup& setup) {
  auto* make = plugin.create;
  if constexpr (std::is_same_v<Interface, Texture<Spectrum>>) make = plugin.createSpectrum;
  const Making making(params.where());
  try {
    return std::unique_ptr<Interface>(static_cast<Interface*>(make(params, &setup)));
  } catch (const Error& error) {
    throw error.at(params.where());
  }
}

}  // namespace pbrt
