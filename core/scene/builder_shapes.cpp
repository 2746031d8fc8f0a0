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
  auto light = factory_.make<Light>(d.words.at(0), d.params, d.where, {startOf(d), nullptr});
  scene_->ownLights_.push_back(std::move(light));
}

const Transform& SceneBuilder::startOf(const Directive& d) const {
  if (transforms_.current().moves())
    factory_.report(Severity::warning, d.where,
                    fmt::format("a {} does not move: it stays where it is at the start",
                                directiveName(d.kind)));
  return transforms_.current().start;
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

void SceneBuilder::addShape(const Directive& d, const Attributes& attributes,
                            const Transform& toGroup, Group& group) {
  auto g = std::make_unique<Geometry>();

  const PluginInfo& plugin = factory_.open(PluginKind::shape, d.words.at(0), d.where);
  Params params = factory_.params(plugin, d.where, {&d.params}, attributes.textures.get());
  g->shape = create<Shape>(plugin, params, {});
  g->cutout = cutout(params, factory_.dialect());
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
  const HitFilter* filter = g->cutout ? scene_.get() : nullptr;
  if (g->mesh) {
    transformMesh(*g->mesh, toGroup);
    g->toGroup = Transform();
    group.accel.add(*g->mesh, filter);
  } else {
    group.accel.add(*g->shape, g->toGroup, d.where, filter);
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
  if (g.cutout)
    factory_.report(Severity::warning, shape.where,
                    "the holes of this shape give light, too, to those who sample it");
  g.light = factory_.make<Light>(light.words.at(0), light.params, light.where,
                                 {toRender, g.sampler.get()});
  if (g.light->isDelta() || g.light->isInfinite())
    throw Error(light.where, fmt::format("a \"{}\" light is not the surface of a shape: it needs "
                                         "LightSource",
                                         light.words.at(0)));
}

void SceneBuilder::addInstance(const Directive& d) {
  if (openObject_) throw Error(d.where, "ObjectInstance inside an object");
  const auto found = objects_.find(d.words.at(0));
  if (found == objects_.end())
    throw Error(d.wordsWhere.at(0), fmt::format("there is no object \"{}\"{}", d.words[0],
                                                didYouMeanKey(d.words[0], objects_)));
  auto& [pending, shapes] = found->second;
  if (!shapes.resting) {
    shapes.resting = &addGroup();
    for (const PendingShape& shape : pending)
      addShape(shape.directive, shape.attributes, shape.toGroup, shapes);
    pending.clear();
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
