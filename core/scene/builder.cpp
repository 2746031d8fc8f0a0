#include <fmt/format.h>

#include "core/scene/scene_builder.h"
#include "core/scene/translation.h"

namespace pbrt {

namespace {

// The plug-in that a statement makes, as the scene calls it.
std::optional<std::pair<PluginKind, std::string>> pluginOf(const Directive& d) {
  using enum DirectiveKind;
  switch (d.kind) {
    case DirectiveKind::Shape:
      return {{PluginKind::shape, d.words.at(0)}};
    case DirectiveKind::Material:
      return {{PluginKind::material, d.words.at(0)}};
    case MakeNamedMaterial:
    case MakeNamedMedium:
      if (std::string type = namedType(d); !type.empty())
        return {{d.kind == MakeNamedMedium ? PluginKind::volume : PluginKind::material,
                 std::move(type)}};
      return {};
    case Volume:
      return {{PluginKind::volume, d.words.at(0)}};
    case DirectiveKind::Texture:
      return {{PluginKind::texture, d.words.at(2)}};
    case LightSource:
    case AreaLightSource:
      return {{PluginKind::light, d.words.at(0)}};
    case DirectiveKind::Camera:
      return {{PluginKind::camera, d.words.at(0)}};
    case DirectiveKind::Sampler:
      return {{PluginKind::sampler, d.words.at(0)}};
    case PixelFilter:
      return {{PluginKind::filter, d.words.at(0)}};
    case DirectiveKind::Integrator:
    case SurfaceIntegrator:
    case VolumeIntegrator:
      return {{PluginKind::integrator, d.words.at(0)}};
    default:
      return {};
  }
}

// What is outside the gamut of Rec. 709 is moved to its border: no colour is negative.
void moveToRec709(Param& colours, ColorSpace space) {
  auto* values = std::get_if<std::vector<float>>(&colours.values);
  if (!values) return;
  const glm::dmat3 m = toRec709(space);
  for (std::size_t i = 0; i + 2 < values->size(); i += 3) {
    const DVec3 c = m * DVec3((*values)[i], (*values)[i + 1], (*values)[i + 2]);
    for (int k = 0; k < 3; ++k) (*values)[i + k] = static_cast<float>(std::max(0.0, c[k]));
  }
}

}  // namespace

void SceneBuilder::handle(Directive&& d) {
  if (worldSeen_ && !inWorld_) {
    if (!ended_)
      factory_.attempt([&] {
        throw Error(d.where, fmt::format("{} after WorldEnd: one scene makes one picture",
                                         directiveName(d.kind)));
      });
    ended_ = true;
    return;
  }
  try {
    factory_.attempt([&] {
      try {
        carryOut(std::move(d));
      } catch (const Error& error) {
        throw error.at(d.where);
      }
    });
  } catch (const std::bad_alloc&) {  // never passed over
    throw Error(d.where, "out of memory");
  }
}

void SceneBuilder::carryOut(Directive&& d) {
  if (options_.time && inWorld_ && d.kind == DirectiveKind::TransformTimes)
    throw Error(d.where, "in an animation TransformTimes belongs before WorldBegin");
  if (transforms_.apply(d, factory_.dialect())) return;
  toThisGeneration(d);
  if (handleStack(d) || handleOption(d) || handleAttribute(d) || handleMedia(d)) return;
  handleWorld(d);
}

// From here on parameters are called as they are here, and colours are Rec. 709.
void SceneBuilder::toThisGeneration(Directive& d) const {
  if (d.params.empty()) return;
  if (const auto plugin = pluginOf(d)) {
    translateParameters(factory_.dialect(), plugin->first, plugin->second, d.params);
    const auto map = std::ranges::find(d.params, "normalmap", &Param::name);
    if (plugin->first == PluginKind::material && map != d.params.end()) {
      factory_.report(Severity::warning, map->where, "normal maps are not there yet");
      d.params.erase(map);
    }
  }
  if (colorSpace_ != ColorSpace::srgb)
    for (Param& p : d.params)
      if (p.type == ParamType::rgb) moveToRec709(p, colorSpace_);
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
  constexpr std::size_t kDeepest = 1000000;
  if (stack_.size() >= kDeepest)
    throw Error(d.where, fmt::format("blocks are nested more than {} deep", kDeepest));
  stack_.push_back({attributes_, transforms_.save(), colorSpace_, d.where, d.kind});
}

void SceneBuilder::restore(const Directive& d, DirectiveKind begin) {
  if (stack_.empty())
    throw Error(d.where, fmt::format("{} without {}", directiveName(d.kind), directiveName(begin)));
  if (const DirectiveKind open = stack_.back().begin; open != begin)
    throw Error(d.where, fmt::format("{} without {}: what is open is {}", directiveName(d.kind),
                                     directiveName(begin), directiveName(open)));
  if (begin != DirectiveKind::TransformBegin) {
    Attributes& outer = stack_.back().attributes;
    if (factory_.dialect() == Dialect::v4)
      outer.scope = attributes_.scope;  // names are global there
    attributes_ = std::move(outer);
    colorSpace_ = stack_.back().colorSpace;
  }
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
    case Option:
    case Accelerator:  // the ray tree is Embree's
    case SearchPath:   // of pbrt-v1's own plug-ins
      break;
    case VolumeIntegrator:
      slot = &volumeIntegrator_;
      break;
    case Renderer:
      if (d.words.at(0) == "sampler") break;
      if (d.words[0] == "metropolis") {  // pbrt-v2's: the light of all paths, whatever is sampled
        factory_.report(Severity::warning, d.where,
                        "there is no renderer \"metropolis\" yet; \"path\" takes its place: "
                        "paths find the same light, at another cost");
        renderer_ = std::move(d);
        break;
      }
      throw Error(d.wordsWhere.at(0),
                  fmt::format("there is no renderer \"{}\", only \"sampler\"", shown(d.words[0])));
    default:
      return false;
  }
  if (inWorld_)
    throw Error(d.where, fmt::format("{} belongs before WorldBegin", directiveName(d.kind)));
  if (d.kind == Option) setOption(d);
  if (slot == &camera_) {
    cameraFromWorld_ = transforms_.save().transform;
    transforms_.name("camera", cameraFromWorld_.inverse());
    cameraMedia_ = attributes_.media;
    cameraMediaNamed_ = media_.size();
  }
  if (slot) *slot = std::move(d);
  if (slot == &camera_) setFrame();
  return true;
}

// Those of pbrt-v4 that change the picture are read; the others are for its own insides.
void SceneBuilder::setOption(const Directive& d) {
  ParamList list = d.params;  // v4 does not mind case, - and _ in their names
  for (Param& option : list) {
    std::erase_if(option.name, [](char c) { return c == '-' || c == '_'; });
    std::ranges::transform(option.name, option.name.begin(),
                           [](unsigned char c) { return std::tolower(c); });
  }
  Params p("Option", d.where, {&list}, nullptr, options_.report);
  constexpr int kMost = std::numeric_limits<int>::max();
  const int seed = p.integer("seed", 0, 0, kMost, "of all random numbers");
  if (p.has("seed")) seed_ = static_cast<std::uint64_t>(seed);
  for (const char* name : {"disablepixeljitter", "disabletexturefiltering", "forcediffuse"})
    if (p.flag(name, false, "")) p.warn(name, "has no effect here");
  for (const char* name : {"disablewavelengthjitter", "pixelstats", "wavefront"})
    p.flag(name, false, "");
  for (const char* name : {"rendercoordsys", "msereferenceimage", "msereferenceout"})
    p.text(name, "", "");
  p.number("displacementedgescale", 1, "");
  p.refuseUnread();
}

void SceneBuilder::beginWorld(const Directive& d) {
  if (inWorld_) throw Error(d.where, "WorldBegin inside the world");
  if (!stack_.empty())
    throw Error(d.where, fmt::format("WorldBegin inside {}", directiveName(stack_.back().begin)));
  inWorld_ = worldSeen_ = true;
  transforms_.name("camera", cameraFromWorld_.inverse());
  factory_.attempt([&] {
    try {
      cameraFromWorld_ = transforms_.inFrame(cameraFromWorld_.inverse()).inverse();
    } catch (const Error& error) {
      throw error.at(camera_->where);
    }
  });
  // Everything is built in a space whose origin is the camera, where floats are densest.
  const DPoint3 eye = cameraFromWorld_.start.inverse().point(DPoint3(0));
  const Transform renderFromWorld = Transform::translate(-eye);
  transforms_.name("world", Transform());
  transforms_.setBase(renderFromWorld);
  makeIntegrator();
}

void SceneBuilder::handleWorld(Directive& d) {
  using enum DirectiveKind;
  if (d.kind == WorldBegin) return beginWorld(d);
  if (!inWorld_)
    throw Error(d.where, fmt::format("{} belongs after WorldBegin", directiveName(d.kind)));
  switch (d.kind) {
    case WorldEnd:
      inWorld_ = false;
      return;
    case AreaLightSource:
      attributes_.areaLightDefaults = defaultsFor(AttributeTarget::light, d.words.at(0));
      attributes_.areaLight = std::make_shared<const Directive>(std::move(d));
      return;
    case LightSource:
      return addLight(d);
    case DirectiveKind::Shape: {
      attributes_.mediaNamed = media_.size();
      // An object's shapes live in a space of their own, which each instance places anew.
      if (openObject_)
        openObject_->pending.push_back(
            {std::move(d), attributes_, transforms_.base().inverse() * transforms_.current()});
      else
        addShape(d, attributes_, transforms_.current(), shapes_);
      return;
    }
    case ObjectBegin:
      if (openObject_) throw Error(d.where, "ObjectBegin inside an object");
      openObject_ = &(objects_[d.words.at(0)] = {});
      save(d);
      return;
    case ObjectEnd:
      restore(d, ObjectBegin);
      openObject_ = nullptr;
      return;
    case ObjectInstance:
      return addInstance(d);
    default:
      return;
  }
}

}  // namespace pbrt
