#include "core/scene/builder.h"

#include <fmt/format.h>

#include "core/base/parallel.h"
#include "core/scene/scene_builder.h"

namespace pbrt {

void SceneBuilder::handle(Directive&& d) {
  if (worldSeen_ && !inWorld_)
    throw Error(d.where, fmt::format("{} after WorldEnd: one scene makes one picture",
                                     directiveName(d.kind)));
  try {
    if (transforms_.apply(d, factory_.dialect())) return;
    refuseUnsupported(d);
    if (handleStack(d) || handleOption(d) || handleAttribute(d) || handleWorld(d)) return;
  } catch (const Error& error) {
    throw error.at(d.where);
  }
}

void SceneBuilder::refuseUnsupported(const Directive& d) const {
  using enum DirectiveKind;
  const bool medium = d.kind == MakeNamedMedium || d.kind == Volume ||
                      (d.kind == MediumInterface &&
                       std::any_of(d.words.begin(), d.words.end(),
                                   [](const std::string& word) { return !word.empty(); }));
  if (medium)
    throw Error(d.where,
                fmt::format("{}: participating media are not there yet", directiveName(d.kind)));
  if (d.kind == Renderer && d.words.at(0) != "sampler")
    throw Error(d.wordsWhere.at(0),
                fmt::format("there is no renderer \"{}\", only \"sampler\"", d.words[0]));
}

bool SceneBuilder::handleStack(const Directive& d) {
  using enum DirectiveKind;
  switch (d.kind) {
    case AttributeBegin:
    case TransformBegin:
      save(d);
      return true;
    case AttributeEnd:
      restore(d, AttributeBegin);
      return true;
    case TransformEnd:
      restore(d, TransformBegin);
      return true;
    default:
      return false;
  }
}

void SceneBuilder::save(const Directive& d) {
  stack_.push_back({attributes_, transforms_.save(), d.where, d.kind});
}

void SceneBuilder::restore(const Directive& d, DirectiveKind begin) {
  if (stack_.empty())
    throw Error(d.where, fmt::format("{} without {}", directiveName(d.kind), directiveName(begin)));
  if (const DirectiveKind open = stack_.back().begin; open != begin)
    throw Error(d.where, fmt::format("{} without {}: what is open is {}", directiveName(d.kind),
                                     directiveName(begin), directiveName(open)));
  if (begin != DirectiveKind::TransformBegin) attributes_ = std::move(stack_.back().attributes);
  transforms_.restore(stack_.back().transform);
  stack_.pop_back();
}

bool SceneBuilder::handleOption(Directive& d) {
  using enum DirectiveKind;
  std::optional<Directive>* slot = nullptr;
  switch (d.kind) {
    case DirectiveKind::Camera:
      slot = &camera_;
      break;
    case DirectiveKind::Sampler:
      slot = &sampler_;
      break;
    case PixelFilter:
      slot = &filter_;
      break;
    case DirectiveKind::Film:
      slot = &film_;
      break;
    case DirectiveKind::Integrator:
    case SurfaceIntegrator:
      slot = &integrator_;
      break;
    case Accelerator:       // the ray tree is Embree's
    case VolumeIntegrator:  // without a volume it does nothing
    case Renderer:
    case SearchPath:  // of pbrt-v1's own plug-ins
      break;
    default:
      return false;
  }
  if (inWorld_)
    throw Error(d.where, fmt::format("{} belongs before WorldBegin", directiveName(d.kind)));
  if (slot == &camera_) {
    cameraFromWorld_ = transforms_.current();
    transforms_.name("camera", cameraFromWorld_.inverse());
  }
  if (slot) *slot = std::move(d);
  return true;
}

void SceneBuilder::beginWorld(const Directive& d) {
  if (inWorld_) throw Error(d.where, "WorldBegin inside the world");
  if (!stack_.empty())
    throw Error(d.where, fmt::format("WorldBegin inside {}", directiveName(stack_.back().begin)));
  inWorld_ = worldSeen_ = true;
  // Everything is built in a space whose origin is the camera, where floats are densest.
  const DPoint3 eye = cameraFromWorld_.start.inverse().point(DPoint3(0));
  const Transform renderFromWorld = Transform::translate(-eye);
  transforms_.name("camera", cameraFromWorld_.inverse());
  transforms_.name("world", Transform());
  transforms_.setBase(renderFromWorld);
}

bool SceneBuilder::handleAttribute(Directive& d) {
  using enum DirectiveKind;
  switch (d.kind) {
    case ReverseOrientation:
      attributes_.reverse = !attributes_.reverse;
      return true;
    case DirectiveKind::Material:
      attributes_.material =
          std::make_shared<MaterialDefinition>(d.words.at(0), std::move(d.params), d.where);
      return true;
    case MakeNamedMaterial: {
      const auto type = std::find_if(d.params.begin(), d.params.end(), [](const Param& p) {
        return p.name == "type" && p.type == ParamType::string;
      });
      if (type == d.params.end())
        throw Error(d.where, "MakeNamedMaterial needs a parameter \"string type\"");
      const auto& words = std::get<std::vector<std::string>>(type->values);
      if (words.size() != 1) throw Error(type->where, "\"type\" needs 1 string");
      const std::string plugin = words[0];
      d.params.erase(type);
      auto named = std::make_shared<NamedMaterials>(*attributes_.namedMaterials);
      (*named)[d.words.at(0)] = std::make_shared<MaterialDefinition>(plugin, std::move(d.params),
                                                                     d.where, attributes_.textures);
      attributes_.namedMaterials = std::move(named);
      return true;
    }
    case NamedMaterial: {
      const auto found = attributes_.namedMaterials->find(d.words.at(0));
      if (found == attributes_.namedMaterials->end())
        throw Error(d.wordsWhere.at(0),
                    fmt::format("there is no named material \"{}\"{}", d.words[0],
                                didYouMeanKey(d.words[0], *attributes_.namedMaterials)));
      attributes_.material = found->second;
      return true;
    }
    case DirectiveKind::Texture: {
      if (!inWorld_) throw Error(d.where, "Texture belongs after WorldBegin");
      const std::string& type = d.words.at(1);
      const bool isSpectrum = type == "color" || type == "spectrum" || type == "rgb";
      if (!isSpectrum && type != "float")
        throw Error(
            d.wordsWhere.at(1),
            fmt::format("a texture is \"float\", \"color\" or \"spectrum\", not \"{}\"", type));
      attributes_.textures =
          std::make_shared<TextureScope>(attributes_.textures, d.words.at(0), isSpectrum,
                                         TextureScope::Definition{d.words.at(2),
                                                                  std::move(d.params),
                                                                  d.where,
                                                                  {startOf(d), transforms_.base()},
                                                                  attributes_.textures});
      return true;
    }
    default:
      return false;
  }
}

bool SceneBuilder::handleWorld(Directive& d) {
  using enum DirectiveKind;
  if (d.kind == WorldBegin) {
    beginWorld(d);
    return true;
  }
  if (d.kind == MediumInterface) return true;  // from nothing to nothing; see refuseUnsupported
  if (!inWorld_)
    throw Error(d.where, fmt::format("{} belongs after WorldBegin", directiveName(d.kind)));
  switch (d.kind) {
    case WorldEnd:
      inWorld_ = false;
      return true;
    case AreaLightSource:
      attributes_.areaLight = std::make_shared<const Directive>(std::move(d));
      return true;
    case LightSource:
      addLight(d);
      return true;
    case DirectiveKind::Shape: {
      // An object's shapes live in a space of their own, which each instance places anew.
      if (openObject_)
        openObject_->pending.push_back(
            {std::move(d), attributes_, transforms_.base().inverse() * transforms_.current()});
      else
        addShape(d, attributes_, transforms_.current(), shapes_);
      return true;
    }
    case ObjectBegin:
      if (openObject_) throw Error(d.where, "ObjectBegin inside an object");
      openObject_ = &(objects_[d.words.at(0)] = {});
      save(d);
      return true;
    case ObjectEnd:
      restore(d, ObjectBegin);
      openObject_ = nullptr;
      return true;
    case ObjectInstance:
      addInstance(d);
      return true;
    default:
      return false;
  }
}

std::unique_ptr<Scene> buildScene(std::vector<Directive> directives, PluginLoader& loader,
                                  const BuildOptions& options) {
  const ThreadLimit limit(options.threads);
  DetectedDialect dialect = detectDialect(directives);
  if (options.dialect) dialect = {*options.dialect, {}, "--dialect says so"};
  SceneBuilder builder(loader, options, dialect);
  for (Directive& d : directives) {
    builder.handle(std::move(d));
    d = Directive();  // frees the parameters that nobody kept
  }
  return builder.finish();
}

}  // namespace pbrt
