#include <fmt/format.h>

#include "core/scene/mesh.h"
#include "core/scene/placement.h"
#include "core/scene/scene_builder.h"

namespace pbrt {

namespace {

// The holes of a shape, which any shape may have; none if it is whole.
std::optional<Cutout> cutout(Params& shape, Dialect dialect) {
  Cutout c;
  c.alpha = shape.floatTexture("alpha", 1, "0 where the shape has a hole");
  c.shadowAlpha = shape.floatTexture("shadowalpha", 1, "0 where only shadow rays pass");
  c.partial = dialect > Dialect::v3;
  for (const Textured<float>* t : {&c.alpha, &c.shadowAlpha})
    if (t->texture() || (*t)({}) < 1) return c;
  return {};
}

}  // namespace

void SceneBuilder::addLight(const Directive& d) {
  const std::string& name = d.words.at(0);
  scene_->ownLights_.push_back(
      factory_.make<Light>(name, d.params, d.where, {startOf(d), nullptr, {}}, nullptr,
                           defaultsFor(AttributeTarget::light, name).get()));
}

Transform SceneBuilder::startOf(const Directive& d) const {
  const TransformPair place = transforms_.current();
  if (place.moves())
    factory_.report(Severity::warning, d.where,
                    fmt::format("a {} does not move: it stays where it is at the start",
                                directiveName(d.kind)));
  return place.start;
}

Group& SceneBuilder::addGroup() {
  scene_->objects_.push_back(std::make_unique<Group>(scene_->device_));
  return *scene_->objects_.back();
}

void SceneBuilder::addShape(const Directive& d, const Attributes& attributes, TransformPair place,
                            Shapes& shapes) {
  if (place.moves() && attributes.areaLight && &shapes == &shapes_) {
    factory_.report(Severity::warning, d.where,
                    "a shape that gives light does not move: it stays where it is at the start");
    place = place.start;
  }
  if (!place.moves()) return addShape(d, attributes, place.start, *shapes.resting);
  std::vector<MovingGroup>& moving = shapes.moving;
  if (moving.empty() || !(moving.back().toOuter.ends() == place))
    moving.push_back({&addGroup(), AnimatedTransform(place), d.where});
  addShape(d, attributes, Transform(), *moving.back().group);
}

// Whether the shape gives light. Without a material it cannot in pbrt-v4; in v3 it does so, and
// lets light pass, for integrators that see such shapes at all.
bool SceneBuilder::shines(const Directive& shape, const Attributes& attributes) {
  if (!attributes.areaLight) return false;
  if (!attributes.material->isInterface()) return true;
  if (factory_.dialect() < Dialect::v4 && scene_->integrator_->tracesMedia()) return true;
  factory_.report(Severity::warning, shape.where,
                  factory_.dialect() == Dialect::v4
                      ? "a shape without a material gives no light"
                      : "this integrator sees no shape without a material: it gives no light "
                        "(\"volpath\" sees it)");
  return false;
}

void SceneBuilder::addShape(const Directive& d, const Attributes& attributes,
                            const Transform& toGroup, Group& group) {
  const MediumInterface* media = mediaOf(attributes);
  const bool lit = shines(d, attributes);
  if (attributes.material->isInterface() && !lit && !media) return;
  auto g = std::make_unique<Geometry>();

  const std::string& name = d.words.at(0);
  const PluginInfo& plugin = factory_.open(PluginKind::shape, name, d.where);
  std::vector<const ParamList*> lists = {&d.params};
  if (const auto& defaults = attributes.defaultsOf(AttributeTarget::shape))
    lists.push_back(defaults.get());
  Library textures(resources_, attributes.scope);
  Params params = factory_.params(plugin, name, d.where, std::move(lists), &textures);
  g->shape = Factory::make<Shape>(plugin, params, {});
  factory_.attempt([&] { g->cutout = cutout(params, factory_.dialect()); });
  g->material = materialFor(params, attributes);
  g->media = media;
  scene_->filters_ = scene_->filters_ || (g->material && g->material->filters());

  g->reverse = attributes.reverse;
  g->flip = attributes.reverse != toGroup.swapsHandedness();
  g->toGroup = toGroup;
  g->mesh = g->shape->triangles();
  if (g->mesh) {
    transformMesh(*g->mesh, toGroup);
    g->toGroup = Transform();
  }
  if (lit) {
    if (&group == &scene_->root_)
      factory_.attempt([&] { addAreaLight(attributes, d, toGroup, *g); });
    else
      factory_.report(Severity::warning, d.where,
                      "a shape of an object for instancing gives no light");
  }
  // Last, as the tree and the list count alike: what is in one has to be in the other.
  const HitFilter* filter = g->cutout || !g->material ? scene_.get() : nullptr;
  if (g->mesh)
    group.accel.add(*g->mesh, filter);
  else
    group.accel.add(*g->shape, g->toGroup, d.where, filter);
  group.geometries.push_back(std::move(g));
  ++scene_->shapes_;
}

// The material of a shape; null if it has none. What the shape does not know may be meant for it.
std::shared_ptr<const Material> SceneBuilder::materialFor(const Params& shape,
                                                          const Attributes& attributes) {
  if (attributes.material->isInterface()) {
    factory_.attempt([&] { shape.refuseUnread(); });
    return nullptr;
  }
  ParamList overrides;
  for (const Param* param : shape.unread()) overrides.push_back(*param);
  if (overrides.empty()) return attributes.material->shared(resources_, attributes.scope);
  auto material = attributes.material->overridden(resources_, attributes.scope, overrides);
  std::vector<Diagnostic> errors;
  for (const Param& param : overrides) errors.push_back(shape.unknown(param));
  if (!errors.empty()) factory_.attempt([&] { throw Error(std::move(errors)); });
  return material;
}

void SceneBuilder::addAreaLight(const Attributes& attributes, const Directive& shape,
                                const Transform& toRender, Geometry& g) {
  if (g.mesh)
    g.sampler = meshSampler(*g.mesh, g.flip, g.reverse);
  else if (const AreaSampler* sampler = g.shape->areaSampler())
    g.sampler = placedSampler(*sampler, g.toGroup, g.reverse);
  if (!g.sampler) {
    factory_.report(Severity::warning, shape.where,
                    fmt::format("this {} cannot be an area light (it has no area, or no way to "
                                "sample it yet); it stays dark",
                                shape.words.at(0)));
    return;
  }
  Bounds3 box;
  if (g.mesh)
    for (const Point3& p : g.mesh->positions) box.add(p);
  else
    for (std::uint32_t i = 0; i < g.shape->primitives(); ++i)
      box.add(g.toGroup.bounds(g.shape->bounds(i)));
  if (g.cutout)
    factory_.report(Severity::warning, shape.where,
                    "the holes of this shape give light, too, to those who sample it");
  const Directive& light = *attributes.areaLight;
  auto made = factory_.make<Light>(light.words.at(0), light.params, light.where,
                                   {toRender, g.sampler.get(), box}, nullptr,
                                   attributes.areaLightDefaults.get());
  if (made->isDelta() || made->isInfinite())
    throw Error(light.where, fmt::format("a \"{}\" light is not the surface of a shape: it needs "
                                         "LightSource",
                                         light.words.at(0)));
  g.light = std::move(made);
}

void SceneBuilder::addInstance(const Directive& d) {
  if (openObject_) throw Error(d.where, "ObjectInstance inside an object");
  const auto found = objects_.find(d.words.at(0));
  if (found == objects_.end())
    throw Error(d.wordsWhere.at(0), fmt::format("there is no object \"{}\"{}", shown(d.words[0]),
                                                didYouMeanKey(d.words[0], objects_)));
  Object& object = found->second;
  Shapes& shapes = object.shapes;
  if (!shapes.resting) {
    shapes.resting = &addGroup();
    for (const PendingShape& shape : object.pending)
      factory_.attempt([&] {
        try {
          addShape(shape.directive, shape.attributes, shape.toGroup, shapes);
        } catch (const Error& error) {
          throw error.at(shape.directive.where);
        }
      });
    object.pending.clear();
    shapes.resting->accel.build();
    for (const MovingGroup& moving : shapes.moving) moving.group->accel.build();
  }
  const AnimatedTransform toRender(transforms_.current());
  addInstance(*shapes.resting, toRender, {});
  for (const MovingGroup& moving : shapes.moving)
    addInstance(*moving.group, toRender, moving.toOuter);
}

// The ray tree has one level of instances: what moves within an object is an instance of its own,
// under both transforms.
void SceneBuilder::addInstance(const Group& group, const AnimatedTransform& outer,
                               const AnimatedTransform& inner) {
  if (group.geometries.empty()) return;
  Instance instance{&group, outer.ends().start * inner.ends().start, {}};
  if (outer.moves() || inner.moves()) instance.motion.emplace(outer, inner, group.accel.bounds());
  scene_->moves_ = scene_->moves_ || instance.motion;
  scene_->instances_.push_back(std::move(instance));
}

}  // namespace pbrt
