#include "stage.h"

#include "core/scene/builder.h"

namespace pbrt::laws {
namespace {

struct StageText {
  std::string name, world;
  bool named = false;  // whether it has named media
};

constexpr const char* kOptions =
    "LookAt 0 1.2 -4 0 0.7 0 0 1 0 Camera \"perspective\" \"float fov\" 50\n"
    "Film \"image\" \"integer xresolution\" {} \"integer yresolution\" {}\n"
    "PixelFilter \"box\" Sampler \"random\" Integrator \"{}\"\nWorldBegin\n{}\nWorldEnd\n";

std::vector<StageText> stageTexts() {
  const std::string floor =
      "AttributeBegin Texture \"tiles\" \"color\" \"checkerboard\" \"float uscale\" 8 "
      "\"float vscale\" 8 Material \"matte\" \"texture Kd\" \"tiles\" Rotate -90 1 0 0 "
      "Shape \"disk\" \"float radius\" 3 AttributeEnd\n";
  const std::string ball =
      "AttributeBegin Material \"matte\" \"rgb Kd\" [0.7 0.5 0.3] Translate 0 0.7 0 "
      "Shape \"sphere\" \"float radius\" 0.7 AttributeEnd\n";
  const std::string lamp = "LightSource \"point\" \"rgb I\" [12 11 10] \"point from\" [2 4 -2]\n";
  const std::string mirrorInGlass =
      "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [9 9 8] Translate 0 3 0 "
      "Rotate 90 1 0 0 Shape \"disk\" \"float radius\" 0.6 AttributeEnd\n"
      "Translate 0 0.7 0 Material \"glass\" Shape \"sphere\" \"float radius\" 0.7\n"
      "Material \"mirror\" Shape \"sphere\" \"float radius\" 0.4";
  const std::string sky = "LightSource \"infinite\" \"rgb L\" [0.5 0.7 1]";
  const std::string fog =
      "Volume \"homogeneous\" \"rgb sigma_a\" [0.05 0.1 0.2] \"rgb sigma_s\" [0.3 0.2 0.1] "
      "\"rgb Le\" [0.02 0.03 0] \"point p0\" [-2 -1 -2] \"point p1\" [2 2 2]";
  const std::string milk =
      "MakeNamedMedium \"milk\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [0.1 0.2 0.4] "
      "\"rgb sigma_s\" [3 3 2]\n"
      "MakeNamedMedium \"smoke\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [1 1 1] "
      "\"rgb sigma_s\" [1 1 1]\n"
      "AttributeBegin MediumInterface \"milk\" \"\" Material \"glass\" Translate 0 0.7 0 "
      "Shape \"sphere\" \"float radius\" 0.7 AttributeEnd\n"
      "AttributeBegin MediumInterface \"smoke\" \"\" Material \"none\" Translate 0.6 1 -1.6 "
      "Shape \"sphere\" \"float radius\" 0.9 AttributeEnd";
  const std::string drops =
      "Material \"plastic\" Shape \"metaballs\" \"point3 P\" [-0.3 0.7 0 0.4 0.8 0.3] "
      "\"float radius\" [1.2 0.9]\n";
  return {{"a ball under a point light", floor + ball + lamp},
          {"metaballs under a point light", floor + drops + lamp},
          {"a mirror within glass under an area light", floor + mirrorInGlass},
          {"a ball in a sky", floor + ball + sky},
          {"a ball in fog", floor + ball + lamp + fog},
          {"nothing at all", ""},
          {"a ball without light", floor + ball},
          {"a glass of milk behind smoke", floor + lamp + milk, true}};
}

PluginLoader& plugins() {
  static PluginLoader loader(PluginLoader::searchPath(""));
  return loader;
}

// Samples count in their own pixel alone.
class OnePixel final : public Filter {
 public:
  OnePixel() : Filter(Vec2(0.5F)) {}
  float evaluate(Vec2 /*p*/) const override { return 1; }
};

}  // namespace

Stage::Stage(const Subject& subject, std::string name, std::unique_ptr<Parser> text,
             std::unique_ptr<Scene> scene, std::unique_ptr<Integrator> surface)
    : World(*scene),
      subject_(subject),
      name_(std::move(name)),
      text_(std::move(text)),
      scene_(std::move(scene)),
      surface_(std::move(surface)),
      integrator_(makeIntegrator()) {
  if (const VolumeIntegrator* own = integrator_->volume()) volume_ = own;
}

std::unique_ptr<Integrator> Stage::makeIntegrator() const {
  return subject_.make<Integrator>({surface_->sampling()});
}

Film Stage::film(const Bounds2i& crop) const {
  Film::Settings settings;
  if (const SamplingIntegrator* sampling = integrator_->sampling())
    settings.block = sampling->blockWidth();
  return {kResolution, crop, OnePixel(), settings};
}

std::uint64_t Stage::render(const Integrator& integrator, const Options& options,
                            Film& film) const {
  RenderControl control;
  control.firstSample = options.first;
  control.endSample = options.end > 0 ? options.end : options.samples;
  control.samplesPerPixel = options.samples;
  control.threads = options.threads;
  integrator.render(*this, *sampler(options.seed, options.samples), film, control);
  return control.faults.count();
}

std::vector<std::unique_ptr<Stage>> stages(const Subject& subject) {
  const Subject direct{&plugins().open(PluginKind::integrator, "directlighting")};
  std::vector<std::unique_ptr<Stage>> all;
  for (const StageText& text : stageTexts()) {
    auto surface = direct.make<Integrator>();
    const bool media = subject.make<Integrator>({surface->sampling()})->tracesMedia();
    if (text.named && !media) continue;
    const Point2i size = Stage::kResolution;
    std::vector<Directive> directives;
    auto parser =
        std::make_unique<Parser>([&](Directive&& d) { directives.push_back(std::move(d)); });
    parser->text("scene of a law", fmt::format(kOptions, size.x, size.y,
                                               media ? "volpath" : "directlighting", text.world));
    auto scene = buildScene(std::move(directives), plugins(), {});
    all.push_back(std::unique_ptr<Stage>(
        new Stage(subject, text.name, std::move(parser), std::move(scene), std::move(surface))));
  }
  return all;
}

}  // namespace pbrt::laws
