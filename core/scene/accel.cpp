#include "core/scene/accel.h"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <utility>

#include "core/base/parallel.h"
#include "core/plugin/culprit.h"
#include "core/scene/accel_query.h"
#include "core/scene/placement.h"

namespace pbrt {

namespace {

thread_local std::uint64_t rayCount __attribute__((tls_model("initial-exec"))) = 0;

RTCDevice device(void* d) {
  return static_cast<RTCDevice>(d);
}
RTCScene scene(void* s) {
  return static_cast<RTCScene>(s);
}

void check(RTCDevice d, std::string_view doing) {
  const RTCError error = rtcGetDeviceError(d);
  if (error == RTC_ERROR_NONE) return;
  throw Error(error == RTC_ERROR_OUT_OF_MEMORY
                  ? fmt::format("not enough memory for {}", doing)
                  : fmt::format("Embree failed (error {}) at {}", static_cast<int>(error), doing));
}

// How far from the origin a ray may be so that it can still be traced within an instance.
float reachOf(const Transform& toScene) {
  const Transform toInstance = toScene.inverse();
  const double shift = glm::length(DVec3(toInstance.matrix()[3]));
  const double reach = (Accel::kReach - shift) / std::max(1.0, stretch(toInstance));
  return reach > 0 ? static_cast<float>(reach) : 0;  // 0, too, if the map is singular
}

// Embree leaves out, without a word, what reaches farther.
bool isWithin(const Bounds3& b, float reach) {
  const Bounds3 all{Point3(-reach), Point3(reach)};
  return b.empty() || (all.contains(b.lo) && all.contains(b.hi));
}

Error tooFar(const Location& where, float reach, std::string_view what) {
  return {where, fmt::format("{} farther than {:.0e} from the camera, too far for the ray tracer",
                             what, reach)};
}

}  // namespace

struct Accel::UserGeometry {
  UserGeometry(const Shape& s, const Transform& t, const Location& l, const HitFilter* f)
      : shape(&s), toObject(t.inverse()), toScene(t), where(l), filter(f) {}

  const Shape* shape;
  Transform toObject;
  Transform toScene;
  Location where;
  const HitFilter* filter;
  std::atomic<bool> reachesTooFar = false;  // as Embree's threads see when they build
  std::atomic<bool> threw = false;
  std::exception_ptr thrown;  // the first

  // The ray of lane i as the shape sees it.
  ObjectRay ray(RTCRayN* rays, unsigned n, unsigned i) const {
    return toObject.ray(
        {{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
         RTCRayN_tnear(rays, n, i),
         {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)},
         RTCRayN_tfar(rays, n, i)});
  }

  static void bounds(const RTCBoundsFunctionArguments* a) {
    auto& g = *static_cast<UserGeometry*>(a->geometryUserPtr);
    Bounds3 b;
    try {
      b = g.toScene.bounds(g.shape->bounds(a->primID));
    } catch (...) {
      if (!g.threw.exchange(true)) g.thrown = asError(g.where);
    }
    if (!isWithin(b, kReach)) g.reachesTooFar.store(true, std::memory_order_relaxed);
    a->bounds_o->lower_x = b.lo.x, a->bounds_o->lower_y = b.lo.y, a->bounds_o->lower_z = b.lo.z;
    a->bounds_o->upper_x = b.hi.x, a->bounds_o->upper_y = b.hi.y, a->bounds_o->upper_z = b.hi.z;
  }

  // The nearest crossing of lane i that the filter keeps.
  template <class Arguments>
  std::optional<ShapeHit> nearest(const Arguments* a, RTCRayN* rays, unsigned i,
                                  bool shadow) const {
    ObjectRay r = ray(rays, a->N, i);
    while (const auto hit = shape->intersect(r, a->primID)) {
      if (!filter) return hit;
      const Ray& whole =
          static_cast<const QueryContext*>(a->context)->source[RTCRayN_id(rays, a->N, i)];
      if (filter->keeps(whole,
                        {hit->t, hit->u, hit->v, hit->primitive, a->geomID, a->context->instID[0]},
                        shadow))
        return hit;
      r.tMin = std::nextafter(hit->t, kInfinity);  // t was rounded: the crossing is not beyond
    }
    return {};
  }

  static void intersect(const RTCIntersectFunctionNArguments* a) {
    const auto& g = *static_cast<const UserGeometry*>(a->geometryUserPtr);
    auto& context = *static_cast<QueryContext*>(a->context);
    RTCRayN* rays = RTCRayHitN_RayN(a->rayhit, a->N);
    RTCHitN* hits = RTCRayHitN_HitN(a->rayhit, a->N);
    for (unsigned i = 0; i < a->N; ++i) {
      if (!a->valid[i]) continue;
      std::optional<ShapeHit> hit;
      if (!context.attempt([&] { hit = g.nearest(a, rays, i, false); })) return;
      if (!hit) continue;
      RTCRayN_tfar(rays, a->N, i) = hit->t;
      RTCHitN_u(hits, a->N, i) = hit->u;
      RTCHitN_v(hits, a->N, i) = hit->v;
      RTCHitN_primID(hits, a->N, i) = hit->primitive;
      RTCHitN_geomID(hits, a->N, i) = a->geomID;
      RTCHitN_instID(hits, a->N, i, 0) = a->context->instID[0];
    }
  }

  static void occluded(const RTCOccludedFunctionNArguments* a) {
    const auto& g = *static_cast<const UserGeometry*>(a->geometryUserPtr);
    auto& context = *static_cast<QueryContext*>(a->context);
    RTCRayN* rays = a->ray;
    context.attempt([&] {
      for (unsigned i = 0; i < a->N; ++i)
        if (a->valid[i] && (g.filter ? g.nearest(a, rays, i, true).has_value()
                                     : g.shape->occluded(g.ray(rays, a->N, i), a->primID)))
          RTCRayN_tfar(rays, a->N, i) = -kInfinity;
    });
  }
};

// Asked for as many threads as there are cores, or more, Embree would hold the whole process to the
// cores.
AccelDevice::AccelDevice(int threads)
    : device_(rtcNewDevice(threads > 0 && threads < defaultThreads()
                               ? fmt::format("threads={}", threads).c_str()
                               : nullptr)) {
  if (!device_) check(nullptr, "starting the ray tracer");
}

AccelDevice::~AccelDevice() {
  rtcReleaseDevice(device(device_));
}

Accel::Accel(const AccelDevice& d) : device_(d.device_), scene_(rtcNewScene(device(d.device_))) {
  // Without this flag rays may slip between neighbouring triangles.
  rtcSetSceneFlags(scene(scene_), RTC_SCENE_FLAG_ROBUST);
  check(device(device_), "a ray tree");
}

Accel::~Accel() {
  rtcReleaseScene(scene(scene_));
}

void Accel::add(TriangleMesh& mesh, const HitFilter* filter) {
  Bounds3 bounds;
  for (const Point3& p : mesh.positions) bounds.add(p);
  if (!isWithin(bounds, kReach)) throw tooFar({}, kReach, "the shape reaches");
  mesh.positions.reserve(mesh.positions.size() + 1);
  RTCGeometry g = rtcNewGeometry(device(device_), RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(),
                             0, sizeof(Point3), mesh.positions.size());
  rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0,
                             3 * sizeof(std::uint32_t), mesh.triangles());
  if (filter) {
    rtcSetGeometryUserData(g, const_cast<HitFilter*>(filter));  // NOLINT: comes back as const
    rtcSetGeometryIntersectFilterFunction(g, &filterHits<false>);
    rtcSetGeometryOccludedFilterFunction(g, &filterHits<true>);
  }
  rtcCommitGeometry(g);
  rtcAttachGeometryByID(scene(scene_), g, count_++);
  rtcReleaseGeometry(g);
  check(device(device_), "a triangle mesh");
}

void Accel::add(const Shape& shape, const Transform& toScene, const Location& where,
                const HitFilter* filter) {
  users_.push_back(std::make_unique<UserGeometry>(shape, toScene, where, filter));
  RTCGeometry g = rtcNewGeometry(device(device_), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(g, shape.primitives());
  rtcSetGeometryUserData(g, users_.back().get());
  rtcSetGeometryBoundsFunction(g, &UserGeometry::bounds, nullptr);
  rtcSetGeometryIntersectFunction(g, &UserGeometry::intersect);
  rtcSetGeometryOccludedFunction(g, &UserGeometry::occluded);
  rtcCommitGeometry(g);
  rtcAttachGeometryByID(scene(scene_), g, count_++);
  rtcReleaseGeometry(g);
  check(device(device_), "a shape");
}

void Accel::add(const Accel& instance, const Transform& toScene) {
  const Motion::Key key(toScene.matrix());
  addInstance(instance, {&key, 1});
}

void Accel::add(const Accel& instance, const Motion& motion) {
  moves_ = true;
  addInstance(instance, motion.keys());
}

void Accel::addInstance(const Accel& instance, std::span<const Motion::Key> keys) {
  coherent_ = false;
  RTCGeometry g = rtcNewGeometry(device(device_), RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(g, scene(instance.scene_));
  rtcSetGeometryTimeStepCount(g, static_cast<unsigned>(keys.size()));
  for (unsigned i = 0; i < keys.size(); ++i) {
    reach_ = std::min({reach_, instance.reach_, reachOf(Transform(glm::dmat4(keys[i])))});
    rtcSetGeometryTransform(g, i, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &keys[i][0].x);
  }
  rtcCommitGeometry(g);
  rtcAttachGeometryByID(scene(scene_), g, count_++);
  rtcReleaseGeometry(g);
  check(device(device_), "an object instance");
}

void Accel::build(const MotionTimes& times) {
  times_ = times;
  const auto start = std::chrono::steady_clock::now();
  rtcCommitScene(scene(scene_));
  buildSeconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  check(device(device_), "building the ray tree");
  for (const auto& user : users_)
    if (user->thrown) std::rethrow_exception(user->thrown);
  for (const auto& user : users_)
    if (user->reachesTooFar) throw tooFar(user->where, kReach, "the shape reaches");
  if (!isWithin(bounds(), reach_))
    throw tooFar({}, reach_, "with an object instance that small, the scene must not reach");
}

Bounds3 Accel::bounds() const {
  RTCBounds b;
  rtcGetSceneBounds(scene(scene_), &b);
  return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

Hit Accel::intersect(const Ray& ray) const {
  ++rayCount;
  RTCRayHit e;
  e.ray = toEmbree(ray, reach_, fraction(ray));
  e.hit.geomID = e.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  Query({&ray}).intersect(scene(scene_), e);
  if (e.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {e.ray.tfar, e.hit.u, e.hit.v, e.hit.primID, e.hit.geomID, e.hit.instID[0]};
}

bool Accel::occluded(const Ray& ray) const {
  ++rayCount;
  RTCRay e = toEmbree(ray, reach_, fraction(ray));
  Query({&ray}).occluded(scene(scene_), e);
  return e.tfar < 0;
}

void Accel::intersect(std::span<const Ray* const> rays, std::span<Hit> hits) const {
  const int n = static_cast<int>(rays.size());
  rayCount += rays.size();
  alignas(64) std::array<int, World::kBatch> valid{};
  alignas(64) RTCRayHit16 e;
  for (int i = 0; i < World::kBatch; ++i) {
    valid[i] = i < n ? -1 : 0;
    if (i < n) setLane(e.ray, i, *rays[i], reach_, fraction(*rays[i]));
    e.hit.geomID[i] = e.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  Query({nullptr, rays.data()}, coherent_).intersect(valid.data(), scene(scene_), e);
  for (int i = 0; i < n; ++i)
    hits[i] = e.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                  ? Hit{}
                  : Hit{e.ray.tfar[i],   e.hit.u[i],      e.hit.v[i],
                        e.hit.primID[i], e.hit.geomID[i], e.hit.instID[0][i]};
}

template <class Packet>
std::uint32_t Accel::occludedPacket(std::span<const Ray> rays) const {
  rayCount += rays.size();
  alignas(64) Packet e;
  alignas(64) std::array<int, std::extent_v<decltype(e.org_x)>> valid{};
  const int n = static_cast<int>(rays.size());
  for (int i = 0; i < n; ++i) {
    valid[i] = -1;
    setLane(e, i, rays[i], reach_, fraction(rays[i]));
  }
  Query({rays.data()}, coherent_).occluded(valid.data(), scene(scene_), e);
  std::uint32_t mask = 0;
  for (int i = 0; i < n; ++i) mask |= static_cast<std::uint32_t>(e.tfar[i] < 0) << i;
  return mask;
}

std::uint32_t Accel::occluded(std::span<const Ray> rays) const {
  if (rays.size() > 8) return occludedPacket<RTCRay16>(rays);
  if (rays.size() > 2) return occludedPacket<RTCRay8>(rays);
  std::uint32_t mask = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
    mask |= static_cast<std::uint32_t>(occluded(rays[i])) << i;
  return mask;
}

std::uint64_t Accel::takeRayCount() {
  return std::exchange(rayCount, 0);
}

}  // namespace pbrt
