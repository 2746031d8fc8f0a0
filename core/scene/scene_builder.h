#pragma once
// The builder behind SceneReader (scene_reader.cpp), in parts: statements (builder.cpp), what
// shapes are made of (builder_attributes.cpp), shapes and lights (builder_shapes.cpp), media
// (builder_media.cpp), and what waits until the end (builder_finish.cpp).

#include "core/base/colorspace.h"
#include "core/base/parallel.h"
#include "core/scene/attributes.h"
#include "core/scene/builder.h"
#include "core/scene/graphics_state.h"

namespace pbrt {

// Carries out the directives one after the other. What only later statements decide (camera, film,
// sampler, integrator) waits until the end; what nothing may use (textures, materials, objects)
// waits until something does.
class SceneBuilder {
 public:
  SceneBuilder(PluginLoader& loader, const BuildOptions& options, const DetectedDialect& dialect)
      : options_(options),
        limit_(options.threads),
        factory_(loader, dialect.dialect, options.report, options.permissive, options.folder),
        resources_(factory_),
        defaults_(dialectDefaults(dialect.dialect)),
        scene_(std::make_unique<Scene>(options.threads)) {
    attributes_.material =
        std::make_shared<MaterialDefinition>(defaults_.material, ParamList{}, nullptr, Location{});
    shapes_.resting = &scene_->root_;
    setFrame();
  }

  void handle(Directive&& d);
  std::unique_ptr<Scene> finish();

 private:
  // A shape with all that was current when it was named.
  struct PendingShape {
    Directive directive;
    Attributes attributes;
    TransformPair toGroup;
  };
  // Shapes that move as one, in a space of their own.
  struct MovingGroup {
    Group* group;
    AnimatedTransform toOuter;  // to the space of the scene or of the object
    Location where;             // the first shape
  };
  // Shapes that share a space: the scene's or an object's.
  struct Shapes {
    Group* resting = nullptr;
    std::vector<MovingGroup> moving;
  };
  struct Object {
    std::vector<PendingShape> pending;
    Shapes shapes;  // since the first instance
  };
  // A MakeNamedMedium statement; built when something is found to be in it.
  struct MediumDefinition {
    std::string type;
    ParamList params;
    std::shared_ptr<const ParamList> attributes;
    Location where;
    Transform place;
    bool placed = false;  // in render space; else in world space, which is not known in it yet
    const Medium* built = nullptr;
  };
  struct Saved {
    Attributes attributes;
    TransformState::Current transform;
    ColorSpace colorSpace;
    Location where;
    DirectiveKind begin;  // AttributeBegin, TransformBegin or ObjectBegin
  };

  void carryOut(Directive&& d);
  void toThisGeneration(Directive& d) const;
  bool handleOption(Directive& d);
  bool handleStack(const Directive& d);
  bool handleAttribute(Directive& d);
  void handleWorld(Directive& d);
  void beginWorld(const Directive& d);
  void save(const Directive& d);
  void restore(const Directive& d, DirectiveKind begin);
  bool handleMedia(Directive& d);
  void addRegion(const Directive& d);
  const MediumInterface* mediaOf(const Attributes& attributes);
  const Medium* medium(const Directive& names, std::size_t word, std::size_t named);
  void finishMedia();
  static std::string takeType(Directive& d);
  static ColorSpace colorSpaceOf(const Directive& d);
  void setDefaults(Directive& d);
  std::shared_ptr<const ParamList> defaultsFor(AttributeTarget target,
                                               const std::string& name) const;
  void setOption(const Directive& d);
  void nameMaterial(Directive& d);
  void defineTexture(Directive& d);

  void addShape(const Directive& d, const Attributes& attributes, TransformPair place,
                Shapes& shapes);
  void addShape(const Directive& d, const Attributes& attributes, const Transform& toGroup,
                Group& group);
  bool shines(const Directive& shape, const Attributes& attributes);
  Group& addGroup();
  std::shared_ptr<const Material> materialFor(const Params& shape, const Attributes& attributes);
  void addAreaLight(const Attributes& attributes, const Directive& shape, const Transform& toRender,
                    Geometry& g);
  void addInstance(const Directive& d);
  void addInstance(const Group& group, const AnimatedTransform& outer,
                   const AnimatedTransform& inner);
  Transform startOf(const Directive& d) const;
  void addLight(const Directive& d);
  void makeIntegrator();
  void movePixelBounds();
  void makeFilm();
  void readFilm();
  void makeSampler(Point2i resolution);
  void makeCamera(Point2i resolution);
  AovSet filmAovs(const Directive& film) const;
  std::array<float, 2> shutter() const;
  void setFrame();
  float exposureTime() const;
  Film::Settings filmSettings(Params& film) const;
  Bounds2i cropBounds(Params& film, Point2i resolution) const;
  const Directive& option(std::optional<Directive>& given, DirectiveKind kind,
                          const std::string& name) const;
  // The object of an option statement, or what the generation uses without one; in a permissive
  // scene also if the statement is wrong, or `check` throws.
  template <class Interface>
  std::unique_ptr<Interface> makeOption(std::optional<Directive>& given, DirectiveKind kind,
                                        const std::string& fallback,
                                        const typename Interface::Setup& setup = {},
                                        const std::function<void(const Interface&)>& check = {}) {
    std::unique_ptr<Interface> object;
    const auto make = [&] {
      const Directive& d = option(given, kind, fallback);
      object = factory_.make<Interface>(d.words.at(0), d.params, d.where, setup);
      if (check) check(*object);
    };
    if (!factory_.attempt(make)) {
      given.reset();
      make();
    }
    return object;
  }

  const BuildOptions& options_;
  ThreadLimit limit_;
  Factory factory_;
  Resources resources_;
  const DialectDefaults& defaults_;
  std::unique_ptr<Scene> scene_;

  TransformState transforms_;
  Attributes attributes_;
  std::vector<Saved> stack_;
  bool inWorld_ = false, worldSeen_ = false;
  bool ended_ = false;  // something came after WorldEnd
  std::map<std::string, Object> objects_;
  Object* openObject_ = nullptr;
  Shapes shapes_;  // of the scene itself

  std::optional<Directive> renderer_;  // one that integrates light itself
  std::optional<Directive> camera_, sampler_, filter_, film_, integrator_, volumeIntegrator_;
  std::optional<std::uint64_t> seed_;  // of Option "integer seed"
  ColorSpace colorSpace_ = ColorSpace::srgb;
  TransformPair cameraFromWorld_;  // as of the Camera statement
  float filmDiagonal_ = 35;        // mm
  std::shared_ptr<const Directive> cameraMedia_;
  std::size_t cameraMediaNamed_ = 0;  // MakeNamedMedium statements before it

  // By their names, which may be given again, and how many came before.
  std::map<std::pair<std::string, std::size_t>, MediumDefinition> media_;
  // Of shapes, by the names of both sides and how many media had been named, with the first
  // statement that has them.
  std::map<std::tuple<std::string, std::string, std::size_t>,
           std::pair<MediumInterface*, std::shared_ptr<const Directive>>>
      interfaces_;
  std::shared_ptr<const Directive> firstMedia_;  // the first MediumInterface with a name
};

}  // namespace pbrt
