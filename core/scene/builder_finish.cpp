#include <fmt/format.h>

#include "core/api/light_choice.h"
#include "core/scene/moving_camera.h"
#include "core/scene/scene_builder.h"

namespace pbrt {

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
  const auto inPixels = film.integers("pixelbounds", "the part to render in pixels: x0 x1 y0 y1");
  if (!inPixels.empty() && inPixels.size() != 4)
    film.fail("pixelbounds", fmt::format("needs 4 numbers, not {}", inPixels.size()));
  if (!inPixels.empty() && !options_.cropWindow)
    bounds =
        intersect({{0, 0}, resolution}, {{inPixels[0], inPixels[2]}, {inPixels[1], inPixels[3]}});
  if (const auto& p = options_.pixelBounds)
    bounds = intersect({{0, 0}, resolution}, {{(*p)[0], (*p)[2]}, {(*p)[1], (*p)[3]}});
  if (bounds.empty())
    throw Error(film.where(), "the crop window (or the pixel bounds) holds no pixel");
  return bounds;
}

// The film's name in its generation decides only what is stored beside the picture.
AovSet SceneBuilder::filmAovs(const Directive& film) const {
  const std::vector<std::string> names = {"image", "rgb", "gbuffer", "spectral"};
  const std::string& name = film.words.at(0);
  if (name == "gbuffer") return kAlbedo | kNormal | kPosition | kDepth | kVariance;
  if (name == "spectral")
    factory_.report(
        Severity::warning, film.where,
        "film \"spectral\" is read as \"rgb\": light is carried as red, green and blue");
  else if (std::find(names.begin(), names.end(), name) == names.end())
    throw Error(film.wordsWhere.at(0),
                fmt::format("there is no film \"{}\" (it is one of {}){}", shown(name),
                            fmt::join(names, ", "), didYouMean(name, names)));
  return 0;
}

// When the camera's shutter opens and closes.
std::array<float, 2> SceneBuilder::shutter() const {
  std::array<float, 2> shutter = {0, 1};
  if (camera_)
    for (const Param& p : camera_->params)
      if (const auto* v = std::get_if<std::vector<float>>(&p.values); v && v->size() == 1) {
        if (p.name == "shutteropen") shutter[0] = v->front();
        if (p.name == "shutterclose") shutter[1] = v->front();
      }
  return shutter;
}

void SceneBuilder::setFrame() {
  if (!options_.time) return;
  const auto [open, close] = shutter();
  transforms_.setFrame(*options_.time, open, std::max(open, close));  // the camera refuses others
}

// pbrt-v4's sensor is exposed as long as the shutter is open, a second if nobody says more.
float SceneBuilder::exposureTime() const {
  if (factory_.dialect() != Dialect::v4 || !camera_) return 1;
  const auto [open, close] = shutter();
  return close > open ? close - open : 1;
}

Film::Settings SceneBuilder::filmSettings(Params& film) const {
  Film::Settings settings;
  settings.scale = film.positive("scale", 1, "factor for every pixel value") *
                   film.positive("iso", 100, "of pbrt-v4's sensor: pixel values go with it") / 100 *
                   exposureTime();
  settings.brightest =
      std::min(film.positive("maxsampleluminance", kInfinity,
                             "samples brighter than this are darkened to it"),
               film.positive("maxcomponentvalue", kInfinity, "pbrt-v4's name of the same"));
  for (const std::string& name :
       film.choices("aov", aovNames(), "what to store beside the picture"))
    settings.aovs |= *aovByName(name);
  settings.aovs |= options_.aovs;
  settings.origin = cameraFromWorld_.start.inverse().point(DPoint3(0));
  film.flag("premultiplyalpha", true, "of pbrt-v1; pictures here always are premultiplied");
  film.integer("writefrequency", -1, -1, std::numeric_limits<int>::max(),
               "of pbrt-v1; without effect");
  film.flag("display", false, "of pbrt-v2; without effect");
  film.flag("savefp16", true, "of pbrt-v4; without effect: pictures are stored in 32 bits");
  if (film.text("sensor", "cie1931", "of pbrt-v4") != "cie1931")
    film.warn("sensor", "is read as \"cie1931\"");
  if (film.nonNegative("whitebalance", 0, "of pbrt-v4, a temperature", "K") > 0)
    film.warn("whitebalance", "has no effect here");
  film.text("coordinatesystem", "camera", "of pbrt-v4's gbuffer; always that of the world");
  film.integer("nbuckets", 16, 1, 1 << 16, "of pbrt-v4's spectral film; without effect");
  film.positive("lambdamin", 360, "of pbrt-v4's spectral film; without effect", "nm");
  film.positive("lambdamax", 830, "of pbrt-v4's spectral film; without effect", "nm");
  return settings;
}

// pbrt-v3's integrators may name the part to render, too: it becomes the film's.
void SceneBuilder::movePixelBounds() {
  if (!integrator_) return;
  ParamList& from = integrator_->params;
  const auto bounds = std::ranges::find(from, "pixelbounds", &Param::name);
  if (bounds == from.end()) return;
  option(film_, DirectiveKind::Film, "image");
  film_->params.push_back(std::move(*bounds));
  from.erase(bounds);
}

// Known before the world, as it decides what is built of media.
void SceneBuilder::makeIntegrator() {
  movePixelBounds();
  if (renderer_)
    integrator_ =
        Directive{DirectiveKind::Integrator, renderer_->where, {"path"}, {renderer_->where}};
  scene_->integrator_ =
      makeOption<Integrator>(integrator_, DirectiveKind::Integrator, defaults_.integrator);
}

void SceneBuilder::makeFilm() {
  scene_->filter_ = makeOption<Filter>(filter_, DirectiveKind::PixelFilter, defaults_.filter);
  if (!factory_.attempt([&] { readFilm(); })) {
    film_.reset();
    readFilm();
  }
}

void SceneBuilder::readFilm() {
  const Directive& statement = option(film_, DirectiveKind::Film, "image");
  Params film("film/" + statement.words.at(0), statement.where, {&statement.params}, nullptr,
              options_.report);
  constexpr int kMost = 1 << 16;
  Point2i resolution(
      film.integer("xresolution", defaults_.resolution.x, 1, kMost, "width in pixels"),
      film.integer("yresolution", defaults_.resolution.y, 1, kMost, "height in pixels"));
  if (options_.quick) resolution = glm::max(resolution / 4, 1);
  if (options_.width)
    resolution = {*options_.width,
                  std::clamp(static_cast<int>(std::lround(static_cast<double>(resolution.y) *
                                                          *options_.width / resolution.x)),
                             1, kMost)};
  const Bounds2i crop = cropBounds(film, resolution);
  scene_->outputFile_ = film.text("filename", "pbrt.exr", "where the picture goes");
  filmDiagonal_ =
      film.positive("diagonal", 35, "of the sensor, for cameras with a lens system", "mm");
  Film::Settings settings = filmSettings(film);
  factory_.attempt([&] { settings.aovs |= filmAovs(statement); });
  factory_.attempt([&] { film.refuseUnread(); });
  if (const SamplingIntegrator* sampling = scene_->integrator_->sampling())
    settings.block = sampling->blockWidth();
  scene_->film_ = std::make_unique<Film>(resolution, crop, *scene_->filter_, settings);
}

void SceneBuilder::makeSampler(Point2i resolution) {
  scene_->seed_ = options_.seed.value_or(seed_.value_or(0));
  const auto make = [&] {
    const Directive& sampler = option(sampler_, DirectiveKind::Sampler, defaults_.sampler);
    scene_->makeSampler_ = [factory = factory_, sampler, resolution](
                               std::uint64_t seed, std::optional<int> samplesPerPixel) mutable {
      return factory.make<Sampler>(sampler.words.at(0), sampler.params, sampler.where,
                                   {seed, samplesPerPixel, resolution});
    };
    scene_->sampler_ = scene_->makeSampler_(scene_->seed_, options_.samplesPerPixel);
  };
  if (!factory_.attempt(make)) {
    sampler_.reset();
    make();
  }
  if (options_.quick && !options_.samplesPerPixel)
    scene_->sampler_ =
        scene_->makeSampler(scene_->seed_, std::max(1, scene_->sampler_->samplesPerPixel() / 4));
}

void SceneBuilder::makeCamera(Point2i resolution) {
  const TransformPair renderFromCamera = transforms_.base() * cameraFromWorld_.inverse();
  scene_->ownCamera_ = makeOption<Camera>(camera_, DirectiveKind::Camera, defaults_.camera,
                                          {renderFromCamera.start, resolution, filmDiagonal_});
  if (renderFromCamera.moves())
    factory_.attempt([&] {
      try {
        const AnimatedTransform toRender(renderFromCamera);
        scene_->ownCamera_ = std::make_unique<MovingCamera>(std::move(scene_->ownCamera_), toRender,
                                                            transforms_.times());
        scene_->moves_ = true;
      } catch (const Error& error) {
        throw error.at(camera_ ? camera_->where : Location());
      }
    });
  scene_->camera_ = scene_->ownCamera_.get();
  if (options_.time) scene_->attributes_["sceneTime"] = *options_.time;
  scene_->attributes_["worldToCamera"] = cameraFromWorld_.start.matrix();
  if (const auto screen = scene_->camera_->screenFromCamera())
    scene_->attributes_["worldToNDC"] = *screen * cameraFromWorld_.start.matrix();
}

std::unique_ptr<Scene> SceneBuilder::finish() {
  if (!worldSeen_) throw Error("there is no WorldBegin: the scene describes no picture");
  const auto note = [&](const Location& where, const std::string& message) {
    factory_.report(Severity::warning, where, message);
  };
  if (inWorld_ && factory_.dialect() != Dialect::v4)
    note({}, "the file ends without WorldEnd; the scene is taken to be complete");
  for (const Saved& saved : stack_)
    note(saved.where, fmt::format("{} is never closed", directiveName(saved.begin)));
  if (!camera_) note({}, "the scene has no Camera: it is seen from 0 0 0 along +z");

  makeFilm();
  const Point2i resolution = scene_->film_->resolution();
  makeSampler(resolution);
  makeCamera(resolution);

  Scene& scene = *scene_;
  for (const MovingGroup& moving : shapes_.moving)
    factory_.attempt([&] {
      try {
        moving.group->accel.build();
        addInstance(*moving.group, {}, moving.toOuter);
      } catch (const Error& error) {
        throw error.at(moving.where);
      }
    });
  for (const Instance& instance : scene.instances_)
    if (instance.motion)
      scene.root_.accel.add(instance.group->accel, *instance.motion);
    else
      scene.root_.accel.add(instance.group->accel, instance.toRender);
  scene.root_.accel.build(transforms_.times());
  scene.bounds_ = scene.root_.accel.bounds();
  const auto addLight = [&](Light& light) {
    light.number = static_cast<std::uint32_t>(scene.lights_.size());
    scene.lights_.push_back(&light);
    if (light.isInfinite()) scene.infiniteLights_.push_back(&light);
  };
  for (const auto& light : scene.ownLights_) addLight(*light);
  for (const auto& g : scene.root_.geometries)
    if (g->light) addLight(*g->light);

  const auto prepares = [&](LightStrategy s) {
    return scene.lights_.size() > 1 && scene.integrator_->mayChooseBy(s);
  };
  if (prepares(LightStrategy::power)) {
    const double radius = scene.bounds_.empty() ? 1 : 0.5 * glm::length(scene.bounds_.diagonal());
    std::vector<double> powers;
    for (const Light* light : scene.lights_) powers.push_back(light->power(radius));
    scene.lightPowers_ = {static_cast<int>(powers.size()), std::move(powers)};
  }
  if (prepares(LightStrategy::spatial)) scene.lightTree_ = LightTree(scene.lights_);

  finishMedia();
  if (scene.bounds_.empty() && scene.media_.empty())
    note({}, "the scene has no shapes: the picture is empty");
  if (scene.lights_.empty() && scene.media_.empty() && scene.integrator_->usesLights())
    note({}, "the scene has no lights: the picture is black");
  return std::move(scene_);
}

}  // namespace pbrt
