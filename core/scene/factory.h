#pragma once
// Objects of plug-ins, made as a scene asks for them.

#include <map>
#include <memory>

#include "core/plugin/loader.h"
#include "core/scene/dialect.h"

namespace pbrt {

// `; did you mean "..."?` over the keys of a map, or nothing.
template <class Map>
std::string didYouMeanKey(std::string_view name, const Map& map) {
  std::vector<std::string> names;
  for (const auto& entry : map) names.push_back(entry.first);
  return didYouMean(name, names);
}

// Makes objects of plug-ins for a scene: finds them by the names its dialect knows, gives them its
// defaults, and refuses parameters that they do not read. If `permissive`, errors are reported, and
// what can go on goes on.
class Factory {
 public:
  // `folder`: see BuildOptions.
  Factory(PluginLoader& loader, Dialect dialect, Reporter report, bool permissive,
          std::filesystem::path folder)
      : loader_(loader),
        dialect_(dialect),
        report_(std::move(report)),
        permissive_(permissive),
        folder_(std::move(folder)) {}

  // `more` are parameters of lower rank that the plug-in need not read, e.g. of Attribute.
  template <class Interface>
  std::unique_ptr<Interface> make(const std::string& name, const ParamList& params,
                                  const Location& where,
                                  const typename Interface::Setup& setup = {},
                                  TextureLibrary* textures = nullptr,
                                  const ParamList* more = nullptr) {
    const PluginInfo& plugin = open(kindOf<Interface>, name, where);
    std::vector<const ParamList*> lists = {&params};
    if (more) lists.push_back(more);
    Params reader = this->params(plugin, name, where, std::move(lists), textures);
    auto object = make<Interface>(plugin, reader, setup);
    attempt([&] { reader.refuseUnread(); });
    return object;
  }

  // Whatever the plug-in throws becomes an Error of its own.
  template <class Interface>
  static std::unique_ptr<Interface> make(const PluginInfo& plugin, Params& reader,
                                         const typename Interface::Setup& setup) {
    try {
      return create<Interface>(plugin, reader, setup);
    } catch (...) {
      std::rethrow_exception(asError(reader.where(), &plugin));
    }
  }

  // Runs `body`. If it throws an Error that the scene is to blame for, and the scene may have
  // errors, reports that and returns false.
  template <class Body>
  bool attempt(const Body& body) const {
    try {
      body();
      return true;
    } catch (const Error& error) {
      if (!permissive_ || !passOver(error)) throw;
      return false;
    }
  }

  // The plug-in that a scene means by a name. Throws Error.
  const PluginInfo& open(PluginKind kind, const std::string& name, const Location& where);
  Params params(const PluginInfo& plugin, const std::string& name, const Location& where,
                std::vector<const ParamList*> lists, TextureLibrary* textures = nullptr) const;

  PluginLoader& loader() { return loader_; }
  Dialect dialect() const { return dialect_; }
  void report(Severity severity, const Location& where, std::string message) const {
    if (report_) report_(diagnose(severity, where, std::move(message)));
  }

 private:
  bool passOver(const Error& error) const;

  PluginLoader& loader_;
  Dialect dialect_;
  Reporter report_;
  bool permissive_;
  std::filesystem::path folder_;
  std::map<std::pair<PluginKind, std::string>, bool> translated_;  // warned about already
};

}  // namespace pbrt
