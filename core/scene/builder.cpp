#include "core/scene/builder.h"

#include <fmt/format.h>

#include "core/scene/graphics_state.h"
#include "core/scene/mesh.h"
#include "core/scene/placement.h"

namespace pbrt {

// Carries out the directives one after the other. What only later statements decide (camera, film,
// sampler, integrator) waits until the end; what nothing may use (textures, materials, objects)
// waits until something does.
class SceneBuilder {
 public:
  SceneBuilder(PluginLoader& loader, const BuildOptions& options, const DetectedDialect& dialect)
      : options_(options),
        factory_(loader, dialect.dialect, options.report),
        defaults_(dialectDefaults(dialect.dialect)),
        scene_(std::make_unique<Scene>(options.threads)) {
    attributes_.textures = std::make_shared<TextureScope>(factory_);
    attributes_.namedMaterials = std::make_shared<NamedMaterials>();
    attributes_.material =
        std::make_shared<MaterialDefinition>(defaults_.material, ParamList{}, Location{});
  }

  void handle(Directive&& d);
  std::unique_ptr<Scene> finish();

 private:
  // A shape with all that was current when it was named.
  struct PendingShape {
    Directive directive;
    Attributes attributes;
    Transform toGroup;
  };
  struct Object {
    std::vector<PendingShape> shapes;
    const Group* built = nullptr;  // since the first instance
  };
  struct Saved {
    Attributes attributes;
    Transform transform;
    Location where;
    bool wholeState;  // AttributeBegin rather than TransformBegin
  };

  bool handleOption(Directive& d);
  bool handleStack(const Directive& d);
  bool handleAttribute(Directive& d);
  bool handleWorld(Directive& d);
  void beginWorld(const Directive& d);
  void restore(const Directive& d, bool wholeState);
  void refuseUnsupported(const Directive& d) const;

  void addShape(const Directive& d, const Attributes& attributes, const Transform& toGroup,
                Group& group);
  void addAreaLight(const Directive& light, const Directive& shape, const Transform& toRender,
                    Geometry& g);
  void addInstance(const Directive& d);
  void addLight(const Directive& d);
  void makeCameraAndFilm();
  Bounds2i cropBounds(Params& film, Point2i resolution) const;
  const Directive& option(std::optional<Directive>& given, DirectiveKind kind,
                          const std::string& name) const;

  const BuildOptions& options_;
  Factory factory_;
  const DialectDefaults& defaults_;
  std::unique_ptr<Scene> scene_;

  TransformState transforms_;
  Attributes attributes_;
  std::vector<Saved> stack_;
  bool inWorld_ = false, worldSeen_ = false;
  std::map<std::string, Object> objects_;
  Object* openObject_ = nullptr;
  Location openObjectWhere_;

  std::optional<Directive> camera_, sampler_, filter_, film_, integrator_;
  Transform cameraFromWorld_;  // as of the Camera statement
};

void SceneBuilder::handle(Directive&& d) {
  if (worldSeen_ && !inWorld_)
    throw Error(d.where, fmt::format("{} after WorldEnd: one scene makes one picture",
                                     directiveName(d.kind)));
  try {
    if (transforms_.apply(d, factory_.dialect(), options_.report)) return;
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
      stack_.push_back({attributes_, transforms_.current(), d.where, d.kind == AttributeBegin});
      return true;
    case AttributeEnd:
      restore(d, true);
      return true;
    case TransformEnd:
      restore(d, false);
      return true;
    default:
      return false;
  }
}

void SceneBuilder::restore(const Directive& d, bool wholeState) {
  if (stack_.empty() || stack_.back().wholeState != wholeState)
    throw Error(d.where, fmt::format("{} without a {}", directiveName(d.kind),
                                     wholeState ? "AttributeBegin" : "TransformBegin"));
  if (wholeState) attributes_ = std::move(stack_.back().attributes);
  transforms_.setCurrent(stack_.back().transform);
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
  inWorld_ = worldSeen_ = true;
  // Everything is built in a space whose origin is the camera, where floats are densest.
  const DPoint3 eye = cameraFromWorld_.inverse().point(DPoint3(0));
  const Transform renderFromWorld = Transform::translate(-eye);
  transforms_.name("camera", renderFromWorld * cameraFromWorld_.inverse());
  transforms_.name("world", renderFromWorld);
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
      (*named)[d.words.at(0)] =
          std::make_shared<MaterialDefinition>(plugin, std::move(d.params), d.where);
      attributes_.namedMaterials = std::move(named);
      return true;
    }
    case NamedMaterial: {
      const auto found = attributes_.namedMaterials->find(d.words.at(0));
      if (found == attributes_.namedMaterials->end()) {
        std::vector<std::string> names;
        for (const auto& entry : *attributes_.namedMaterials) names.push_back(entry.first);
        throw Error(d.wordsWhere.at(0), fmt::format("there is no named material \"{}\"{}",
                                                    d.words[0], didYouMean(d.words[0], names)));
      }
      attributes_.material = found->second;
      return true;
    }
    case DirectiveKind::Texture: {
      const std::string& type = d.words.at(1);
      const bool isSpectrum = type == "color" || type == "spectrum" || type == "rgb";
      if (!isSpectrum && type != "float")
        throw Error(
            d.wordsWhere.at(1),
            fmt::format("a texture is \"float\", \"color\" or \"spectrum\", not \"{}\"", type));
      attributes_.textures = std::make_shared<TextureScope>(
          attributes_.textures, d.words.at(0), isSpectrum,
          TextureScope::Definition{d.words.at(2), std::move(d.params), d.where,
                                   transforms_.current(), attributes_.textures});
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
      const pbrt::Transform toGroup = openObject_
                                          ? transforms_.base().inverse() * transforms_.current()
                                          : transforms_.current();
      if (openObject_)
        openObject_->shapes.push_back({std::move(d), attributes_, toGroup});
      else
        addShape(d, attributes_, toGroup, scene_->root_);
      return true;
    }
    case ObjectBegin:
      if (openObject_) throw Error(d.where, "ObjectBegin inside an object");
      openObject_ = &(objects_[d.words.at(0)] = {});
      openObjectWhere_ = d.where;
      stack_.push_back({attributes_, transforms_.current(), d.where, true});
      return true;
    case ObjectEnd:
      if (!openObject_) throw Error(d.where, "ObjectEnd without an ObjectBegin");
      restore(d, true);
      openObject_ = nullptr;
      return true;
    case ObjectInstance:
      addInstance(d);
      return true;
    default:
      return false;
  }
}

void SceneBuilder::addLight(const Directive& d) {
  auto light =
      factory_.make<Light>(d.words.at(0), d.params, d.where, {transforms_.current(), nullptr});
  scene_->ownLights_.push_back(std::move(light));
}

void SceneBuilder::addShape(const Directive& d, const Attributes& attributes,
                            const Transform& toGroup, Group& group) {
  auto g = std::make_unique<Geometry>();

  const auto opened = factory_.open(PluginKind::shape, d.words.at(0), d.where);
  Params params = factory_.params(opened, d.where, {&d.params});
  g->shape = create<Shape>(*opened.plugin, params, {});
  // What the shape does not know may be meant for its material.
  if (const auto unread = params.unread(); unread.empty()) {
    g->material = attributes.material->shared(factory_, attributes.textures);
  } else {
    ParamList overrides;
    for (const Param* param : unread) overrides.push_back(*param);
    g->material = attributes.material->overridden(factory_, *attributes.textures, overrides);
    std::vector<Diagnostic> errors;
    for (const Param& param : overrides) errors.push_back(params.unknown(param));
    if (!errors.empty()) throw Error(std::move(errors));
  }
  scene_->filters_ = scene_->filters_ || g->material->filters();

  g->reverse = attributes.reverse;
  g->flip = attributes.reverse != toGroup.swapsHandedness();
  g->toGroup = toGroup;
  g->mesh = g->shape->triangles();
  if (g->mesh) {
    transformMesh(*g->mesh, toGroup);
    g->toGroup = Transform();
    group.accel.add(*g->mesh);
  } else {
    group.accel.add(*g->shape, g->toGroup);
  }
  ++scene_->shapes_;
  if (attributes.areaLight) {
    if (&group == &scene_->root_)
      addAreaLight(*attributes.areaLight, d, toGroup, *g);
    else
      factory_.report(Severity::warning, d.where,
                      "a shape of an object for instancing gives no light");
  }
  group.geometries.push_back(std::move(g));
}

void SceneBuilder::addAreaLight(const Directive& light, const Directive& shape,
                                const Transform& toRender, Geometry& g) {
  if (g.mesh)
    g.sampler = meshSampler(*g.mesh, g.flip);
  else if (const AreaSampler* sampler = g.shape->areaSampler())
    g.sampler = placedSampler(*sampler, g.toGroup, g.reverse);
  if (!g.sampler) {
    factory_.report(Severity::warning, shape.where,
                    fmt::format("this {} cannot be an area light (it has no area, or no way to "
                                "sample it yet); it stays dark",
                                shape.words.at(0)));
    return;
  }
  g.light = factory_.make<Light>(light.words.at(0), light.params, light.where,
                                 {toRender, g.sampler.get()});
}

void SceneBuilder::addInstance(const Directive& d) {
  if (openObject_) throw Error(d.where, "ObjectInstance inside an object");
  const auto found = objects_.find(d.words.at(0));
  if (found == objects_.end()) {
    std::vector<std::string> names;
    for (const auto& entry : objects_) names.push_back(entry.first);
    throw Error(d.wordsWhere.at(0), fmt::format("there is no object \"{}\"{}", d.words[0],
                                                didYouMean(d.words[0], names)));
  }
  Object& object = found->second;
  if (!object.built) {
    auto group = std::make_unique<Group>(scene_->device_);
    for (const PendingShape& shape : object.shapes)
      addShape(shape.directive, shape.attributes, shape.toGroup, *group);
    object.shapes.clear();
    group->accel.build();
    object.built = group.get();
    scene_->objects_.push_back(std::move(group));
  }
  if (object.built->geometries.empty()) return;
  scene_->instances_.push_back({object.built, transforms_.current()});
}

const Directive& SceneBuilder::option(std::optional<Directive>& given, DirectiveKind kind,
                                      const std::string& name) const {
  if (!given) {
    given.emplace();
    given->kind = kind;
    given->words = {name};
  }
  return *given;
}

Bounds2i SceneBuilder::cropBounds(Params& film, Point2i resolution) const {
  const std::vector<float> window =
      film.numbers("cropwindow", "the part to render: x0 x1 y0 y1, each from 0 to 1");
  std::array<float, 4> crop = {0, 1, 0, 1};
  if (!window.empty()) {
    if (window.size() != 4)
      film.fail("cropwindow", fmt::format("needs 4 numbers, not {}", window.size()));
    std::copy(window.begin(), window.end(), crop.begin());
  }
  if (options_.cropWindow) crop = *options_.cropWindow;
  for (float& x : crop) x = std::clamp(x, 0.F, 1.F);
  const Vec2 size(resolution);
  Bounds2i bounds{{std::ceil(size.x * std::min(crop[0], crop[1])),
                   std::ceil(size.y * std::min(crop[2], crop[3]))},
                  {std::ceil(size.x * std::max(crop[0], crop[1])),
                   std::ceil(size.y * std::max(crop[2], crop[3]))}};
  if (const auto& p = options_.pixelBounds)
    bounds = intersect({{0, 0}, resolution}, {{(*p)[0], (*p)[2]}, {(*p)[1], (*p)[3]}});
  if (bounds.empty())
    throw Error(film.where(), "the crop window (or the pixel bounds) holds no pixel");
  return bounds;
}

void SceneBuilder::makeCameraAndFilm() {
  const Directive& filmStatement = option(film_, DirectiveKind::Film, "image");
  if (filmStatement.words.at(0) != "image")
    throw Error(filmStatement.wordsWhere.at(0),
                fmt::format("there is no film \"{}\", only \"image\"", filmStatement.words[0]));
  Params film("film/image", filmStatement.where, {&filmStatement.params}, nullptr, options_.report);
  constexpr int kMost = 1 << 16;
  Point2i resolution(
      film.integer("xresolution", defaults_.resolution.x, 1, kMost, "width in pixels"),
      film.integer("yresolution", defaults_.resolution.y, 1, kMost, "height in pixels"));
  if (options_.quick) resolution = glm::max(resolution / 4, 1);
  const Bounds2i crop = cropBounds(film, resolution);
  scene_->outputFile_ = film.text("filename", "pbrt.exr", "where the picture goes");
  const float scale = film.positive("scale", 1, "factor for every pixel value");
  const float brightest = film.positive("maxsampleluminance", kInfinity,
                                        "samples brighter than this are darkened to it");
  film.flag("premultiplyalpha", true, "of pbrt-v1; pictures here always are premultiplied");
  film.integer("writefrequency", -1, -1, std::numeric_limits<int>::max(),
               "of pbrt-v1; without effect");
  film.positive("diagonal", 35, "of the sensor, for cameras with a lens system", "mm");
  film.refuseUnread();

  const Directive& filter = option(filter_, DirectiveKind::PixelFilter, defaults_.filter);
  scene_->filter_ = factory_.make<Filter>(filter.words.at(0), filter.params, filter.where);
  scene_->film_ = std::make_unique<Film>(resolution, crop, *scene_->filter_, scale, brightest);

  const Directive& sampler = option(sampler_, DirectiveKind::Sampler, defaults_.sampler);
  Sampler::Setup samplerSetup{options_.seed, options_.samplesPerPixel, resolution};
  scene_->sampler_ =
      factory_.make<Sampler>(sampler.words.at(0), sampler.params, sampler.where, samplerSetup);
  if (options_.quick && !options_.samplesPerPixel) {
    samplerSetup.samplesPerPixel = std::max(1, scene_->sampler_->samplesPerPixel() / 4);
    scene_->sampler_ =
        factory_.make<Sampler>(sampler.words.at(0), sampler.params, sampler.where, samplerSetup);
  }

  const Directive& camera = option(camera_, DirectiveKind::Camera, defaults_.camera);
  const DPoint3 eye = cameraFromWorld_.inverse().point(DPoint3(0));
  const Transform renderFromCamera = Transform::translate(-eye) * cameraFromWorld_.inverse();
  scene_->ownCamera_ = factory_.make<Camera>(camera.words.at(0), camera.params, camera.where,
                                             {renderFromCamera, resolution});
  scene_->camera_ = scene_->ownCamera_.get();
  scene_->attributes_["worldToCamera"] = cameraFromWorld_.matrix();
  if (const auto screen = scene_->camera_->screenFromCamera())
    scene_->attributes_["worldToNDC"] = *screen * cameraFromWorld_.matrix();

  const Directive& integrator =
      option(integrator_, DirectiveKind::Integrator, defaults_.integrator);
  scene_->integrator_ =
      factory_.make<Integrator>(integrator.words.at(0), integrator.params, integrator.where);
}

std::unique_ptr<Scene> SceneBuilder::finish() {
  if (!worldSeen_) throw Error("there is no WorldBegin: the scene describes no picture");
  const auto note = [&](const Location& where, const std::string& message) {
    factory_.report(Severity::warning, where, message);
  };
  if (inWorld_) note({}, "the file ends without WorldEnd; the scene is taken to be complete");
  if (openObject_) note(openObjectWhere_, "ObjectBegin is never closed");
  for (const Saved& saved : stack_)
    if (!openObject_ || saved.where.begin != openObjectWhere_.begin)
      note(saved.where,
           saved.wholeState ? "AttributeBegin is never closed" : "TransformBegin is never closed");
  if (!camera_) note({}, "the scene has no Camera: it is seen from 0 0 0 along +z");

  makeCameraAndFilm();

  Scene& scene = *scene_;
  for (const Instance& instance : scene.instances_)
    scene.root_.accel.add(instance.group->accel, instance.toRender);
  scene.root_.accel.build();
  scene.bounds_ = scene.root_.accel.bounds();
  for (const auto& light : scene.ownLights_) scene.lights_.push_back(light.get());
  for (const auto& g : scene.root_.geometries)
    if (g->light) scene.lights_.push_back(g->light.get());
  for (const auto& light : scene.ownLights_) light->prepare(scene.bounds_);
  for (const auto& g : scene.root_.geometries)
    if (g->light) g->light->prepare(scene.bounds_);
  for (const Light* light : scene.lights_)
    if (light->isInfinite()) scene.infiniteLights_.push_back(light);

  if (scene.bounds_.empty()) note({}, "the scene has no shapes: the picture is empty");
  if (scene.lights_.empty()) note({}, "the scene has no lights: the picture is black");
  return std::move(scene_);
}

std::unique_ptr<Scene> buildScene(std::vector<Directive> directives, PluginLoader& loader,
                                  const BuildOptions& options) {
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
