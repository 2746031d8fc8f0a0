#include "core/scene/factory.h"

#include <fmt/format.h>

#include "core/scene/translation.h"

namespace pbrt {

namespace {

// "v1 v2 v3" as "pbrt-v1, v2 and v3".
std::string generations(std::string_view of) {
  std::string text = "pbrt-";
  while (!of.empty()) {
    const std::size_t blank = std::min(of.find(' '), of.size());
    text += of.substr(0, blank);
    of.remove_prefix(std::min(blank + 1, of.size()));
    if (!of.empty()) text += of.find(' ') == of.npos ? " and " : ", ";
  }
  return text;
}

}  // namespace

const PluginInfo& Factory::open(PluginKind kind, const std::string& name, const Location& where) {
  try {
    // A plug-in of that very name goes before what may stand for it.
    const Translation* t = findTranslation(kind, name);
    if (t && !loader_.has(kind, name)) {
      if (t->target.empty())
        throw Error(fmt::format("\"{}\" is {} {} of {} that is not here yet", name,
                                kind == PluginKind::integrator ? "an" : "a", kindName(kind),
                                generations(t->of)));
      bool& warned = translated_[{kind, name}];
      if (!t->differs.empty() && !warned)
        report(Severity::warning, where,
               fmt::format("there is no {} \"{}\" yet; \"{}\" takes its place: {}", kindName(kind),
                           name, t->target, t->differs));
      warned = true;
      return loader_.open(kind, std::string(t->target));
    }
    if (!loader_.has(kind, name)) {
      std::vector<std::string> names = loader_.available(kind);
      for (const Translation& other : translations())
        if (other.kind == kind) names.emplace_back(other.name);
      if (!closest(name, names).empty())
        throw Error(fmt::format("there is no {} \"{}\"{}", kindName(kind), shown(name),
                                didYouMean(name, names)));
    }
    return loader_.open(kind, name);
  } catch (const Error& error) {
    throw error.at(where);
  }
}

Params Factory::params(const PluginInfo& plugin, const std::string& name, const Location& where,
                       std::vector<const ParamList*> lists, TextureLibrary* textures) const {
  const ParamList* defaults = &parameterDefaults(dialect_, plugin.kind, name);
  if (defaults->empty()) defaults = &parameterDefaults(dialect_, plugin.kind, plugin.name);
  Params p(fmt::format("{}/{}", kindFolder(plugin.kind), plugin.name), where, std::move(lists),
           textures, report_, defaults);
  p.alsoSearch(folder_);
  if (dialect_ == Dialect::v4) p.bringLightsToLuminanceOne();
  p.alsoKnown(renamedParameters(plugin.kind, name));
  return p;
}

bool Factory::passOver(const Error& error) const {
  if (error.failure() != Failure::scene && error.failure() != Failure::io) return false;
  if (report_)
    for (const Diagnostic& d : error.diagnostics()) report_(d);
  return true;
}

}  // namespace pbrt
