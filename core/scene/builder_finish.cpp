#include <fmt/format.h>

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
  if (options_.width)
    resolution = {*options_.width,
                  std::clamp(static_cast<int>(std::lround(static_cast<double>(resolution.y) *
                                                          *options_.width / resolution.x)),
                             1, kMost)};
  const Bounds2i crop = cropBounds(film, resolution);
  scene_->outputFile_ = film.text("filename", "pbrt.exr", "where the picture goes");
  Film::Settings settings;
  settings.scale = film.positive("scale", 1, "factor for every pixel value");
  settings.brightest = film.positive("maxsampleluminance", kInfinity,
                                     "samples brighter than this are darkened to it");
  for (const std::string& name :
       film.choices("aov", aovNames(), "what to store beside the picture"))
    settings.aovs |= *aovByName(name);
  settings.aovs |= options_.aovs;
  settings.origin = cameraFromWorld_.start.inverse().point(DPoint3(0));
  film.flag("premultiplyalpha", true, "of pbrt-v1; pictures here always are premultiplied");
  film.integer("writefrequency", -1, -1, std::numeric_limits<int>::max(),
               "of pbrt-v1; without effect");
  film.positive("diagonal", 35, "of the sensor, for cameras with a lens system", "mm");
  film.refuseUnread();

  const Directive& filter = option(filter_, DirectiveKind::PixelFilter, defaults_.filter);
  scene_->filter_ = factory_.make<Filter>(filter.words.at(0), filter.params, filter.where);
  scene_->film_ = std::make_unique<Film>(resolution, crop, *scene_->filter_, settings);

  const Directive& sampler = option(sampler_, DirectiveKind::Sampler, defaults_.sampler);
  scene_->makeSampler_ = [factory = factory_, sampler, resolution](
                             std::uint64_t seed, std::optional<int> samplesPerPixel) mutable {
    return factory.make<Sampler>(sampler.words.at(0), sampler.params, sampler.where,
                                 {seed, samplesPerPixel, resolution});
  };
  scene_->sampler_ = scene_->makeSampler_(options_.seed, options_.samplesPerPixel);
  if (options_.quick && !options_.samplesPerPixel)
    scene_->sampler_ =
        scene_->makeSampler(options_.seed, std::max(1, scene_->sampler_->samplesPerPixel() / 4));

  const Directive& camera = option(camera_, DirectiveKind::Camera, defaults_.camera);
  const TransformPair renderFromCamera = transforms_.base() * cameraFromWorld_.inverse();
  scene_->ownCamera_ = factory_.make<Camera>(camera.words.at(0), camera.params, camera.where,
                                             {renderFromCamera.start, resolution});
  if (renderFromCamera.moves()) try {
      scene_->moves_ = true;
      scene_->ownCamera_ = std::make_unique<MovingCamera>(
          std::move(scene_->ownCamera_), AnimatedTransform(renderFromCamera), transforms_.times());
    } catch (const Error& error) {
      throw error.at(camera.where);
    }
  scene_->camera_ = scene_->ownCamera_.get();
  scene_->attributes_["worldToCamera"] = cameraFromWorld_.start.matrix();
  if (const auto screen = scene_->camera_->screenFromCamera())
    scene_->attributes_["worldToNDC"] = *screen * cameraFromWorld_.start.matrix();

  if (integrator_)
    translateParameters(factory_.dialect(), PluginKind::integrator, integrator_->words.at(0),
                        integrator_->params);
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
  for (const Saved& saved : stack_)
    note(saved.where, fmt::format("{} is never closed", directiveName(saved.begin)));
  if (!camera_) note({}, "the scene has no Camera: it is seen from 0 0 0 along +z");

  makeCameraAndFilm();

  Scene& scene = *scene_;
  for (const MovingGroup& moving : shapes_.moving) try {
      moving.group->accel.build();
      addInstance(*moving.group, {}, moving.toOuter);
    } catch (const Error& error) {
      throw error.at(moving.where);
    }
  for (const Instance& instance : scene.instances_)
    if (instance.motion)
      scene.root_.accel.add(instance.group->accel, *instance.motion);
    else
      scene.root_.accel.add(instance.group->accel, instance.toRender);
  scene.root_.accel.build(transforms_.times());
  scene.bounds_ = scene.root_.accel.bounds();
  const auto addLight = [&](Light& light) {
    light.prepare(scene.bounds_);
    scene.lights_.push_back(&light);
    if (light.isInfinite()) scene.infiniteLights_.push_back(&light);
  };
  for (const auto& light : scene.ownLights_) addLight(*light);
  for (const auto& g : scene.root_.geometries)
    if (g->light) addLight(*g->light);

  if (scene.bounds_.empty()) note({}, "the scene has no shapes: the picture is empty");
  if (scene.lights_.empty()) note({}, "the scene has no lights: the picture is black");
  return std::move(scene_);
}

}  // namespace pbrt
