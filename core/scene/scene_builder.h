#pragma once
// The builder behind buildScene(), in three parts: statements (builder.cpp), shapes and lights
// (builder_shapes.cpp), and what waits until the end (builder_finish.cpp).

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
        factory_(loader, dialect.dialect, options.report),
        defaults_(dialectDefaults(dialect.dialect)),
        scene_(std::make_unique<Scene>(options.threads)) {
    attributes_.textures = std::make_shared<TextureScope>(factory_);
    attributes_.namedMaterials = std::make_shared<NamedMaterials>();
    attributes_.material =
        std::make_shared<MaterialDefinition>(defaults_.material, ParamList{}, Location{});
    shapes_.resting = &scene_->root_;
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
  struct Saved {
    Attributes attributes;
    TransformState::Current transform;
    Location where;
    DirectiveKind begin;  // AttributeBegin, TransformBegin or ObjectBegin
  };

  bool handleOption(Directive& d);
  bool handleStack(const Directive& d);
  bool handleAttribute(Directive& d);
  bool handleWorld(Directive& d);
  void beginWorld(const Directive& d);
  void save(const Directive& d);
  void restore(const Directive& d, DirectiveKind begin);
  void refuseUnsupported(const Directive& d) const;

  void addShape(const Directive& d, const Attributes& attributes, TransformPair place,
                Shapes& shapes);
  void addShape(const Directive& d, const Attributes& attributes, const Transform& toGroup,
                Group& group);
  Group& addGroup();
  void addAreaLight(const Directive& light, const Directive& shape, const Transform& toRender,
                    Geometry& g);
  void addInstance(const Directive& d);
  void addInstance(const Group& group, const AnimatedTransform& outer,
                   const AnimatedTransform& inner);
  const Transform& startOf(const Directive& d) const;
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
  Shapes shapes_;  // of the scene itself

  std::optional<Directive> camera_, sampler_, filter_, film_, integrator_;
  TransformPair cameraFromWorld_;  // as of the Camera statement
};

}  // namespace pbrt
