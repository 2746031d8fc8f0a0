#include <fmt/format.h>

#include "core/scene/scene_builder.h"
#include "core/scene/translation.h"

namespace pbrt {

bool SceneBuilder::handleAttribute(Directive& d) {
  using enum DirectiveKind;
  switch (d.kind) {
    case ReverseOrientation:
      attributes_.reverse = !attributes_.reverse;
      return true;
    case DirectiveKind::ColorSpace:
      colorSpace_ = colorSpaceOf(d);
      return true;
    case DirectiveKind::Attribute:
      setDefaults(d);
      return true;
    case DirectiveKind::Material:
      attributes_.material = std::make_shared<MaterialDefinition>(
          d.words.at(0), std::move(d.params), defaultsFor(AttributeTarget::material, d.words[0]),
          d.where);
      return true;
    case MakeNamedMaterial:
      nameMaterial(d);
      return true;
    case NamedMaterial:
      try {
        attributes_.material = resources_.material(attributes_.scope, d.words.at(0));
      } catch (const Error& error) {
        throw error.at(d.wordsWhere.at(0));
      }
      return true;
    case DirectiveKind::Texture:
      defineTexture(d);
      return true;
    default:
      return false;
  }
}

ColorSpace SceneBuilder::colorSpaceOf(const Directive& d) {
  if (const auto space = findColorSpace(d.words.at(0))) return *space;
  const std::vector<std::string> names = colorSpaceNames();
  throw Error(d.wordsWhere.at(0),
              fmt::format("there is no color space \"{}\" (it is one of {}){}", shown(d.words[0]),
                          fmt::join(names, ", "), didYouMean(d.words[0], names)));
}

// Attribute "target": from here on, defaults for all statements of a kind.
void SceneBuilder::setDefaults(Directive& d) {
  const auto* target = std::find(kAttributeTargets.begin(), kAttributeTargets.end(), d.words.at(0));
  if (target == kAttributeTargets.end()) {
    const std::vector<std::string> names(kAttributeTargets.begin(), kAttributeTargets.end());
    throw Error(
        d.wordsWhere.at(0),
        fmt::format("Attribute sets defaults of \"{}\", not of \"{}\"{}",
                    fmt::join(names, "\", \""), shown(d.words[0]), didYouMean(d.words[0], names)));
  }
  auto& defaults = attributes_.defaults[target - kAttributeTargets.begin()];
  ParamList list = defaults ? *defaults : ParamList();
  for (Param& p : d.params) {
    std::erase_if(list, [&](const Param& before) { return before.name == p.name; });
    if (list.size() == kMostParameters)
      throw Error(p.where, fmt::format("there are defaults of {} parameters already", list.size()));
    list.push_back(std::move(p));
  }
  defaults = std::make_shared<const ParamList>(std::move(list));
}

// The defaults for a statement that makes the plug-in `name`, called as they are here. Null: none.
std::shared_ptr<const ParamList> SceneBuilder::defaultsFor(AttributeTarget target,
                                                           const std::string& name) const {
  const auto& defaults = attributes_.defaultsOf(target);
  if (!defaults) return defaults;
  constexpr std::array kKinds = {PluginKind::shape, PluginKind::light, PluginKind::material,
                                 PluginKind::volume, PluginKind::texture};
  ParamList list = *defaults;
  translateParameters(factory_.dialect(), kKinds[static_cast<std::size_t>(target)], name, list);
  return std::make_shared<const ParamList>(std::move(list));
}

// Takes the plug-in that MakeNamedMaterial or MakeNamedMedium names out of its parameters.
std::string SceneBuilder::takeType(Directive& d) {
  const auto type = std::find_if(d.params.begin(), d.params.end(), [](const Param& p) {
    return p.name == "type" && p.type == ParamType::string;
  });
  if (type == d.params.end())
    throw Error(d.where,
                fmt::format("{} needs a parameter \"string type\"", directiveName(d.kind)));
  const auto& words = std::get<std::vector<std::string>>(type->values);
  if (words.size() != 1) throw Error(type->where, "\"type\" needs 1 string");
  std::string plugin = words[0];
  d.params.erase(type);
  return plugin;
}

void SceneBuilder::nameMaterial(Directive& d) {
  const std::string plugin = takeType(d);
  resources_.define(attributes_.scope, d.words.at(0),
                    std::make_shared<MaterialDefinition>(
                        plugin, std::move(d.params), defaultsFor(AttributeTarget::material, plugin),
                        d.where, attributes_.scope));
}

void SceneBuilder::defineTexture(Directive& d) {
  if (!inWorld_) throw Error(d.where, "Texture belongs after WorldBegin");
  const std::string& type = d.words.at(1);
  const auto define = [&]<class T>(std::type_identity<T>) {
    resources_.define(attributes_.scope, d.words[0],
                      TextureDefinition<T>{d.words.at(2),
                                           std::move(d.params),
                                           defaultsFor(AttributeTarget::texture, d.words[2]),
                                           d.where,
                                           {startOf(d), transforms_.base()},
                                           attributes_.scope,
                                           nullptr});
  };
  if (type == "float")
    define(std::type_identity<float>());
  else if (type == "color" || type == "spectrum" || type == "rgb")
    define(std::type_identity<Spectrum>());
  else
    throw Error(d.wordsWhere.at(1),
                fmt::format("a texture is \"float\", \"color\" or \"spectrum\", not \"{}\"", type));
}

}  // namespace pbrt
