#pragma once
// Rays as Embree takes them, and the calls that trace them: for accel.cpp alone.

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <exception>

#include "core/api/world.h"
#include "core/scene/accel.h"

namespace pbrt {

// The rays of a query as they are outside of all instances: Embree's callbacks see only those
// within.
struct RaySource {
  const Ray* rays = nullptr;             // one after the other, or
  const Ray* const* pointers = nullptr;  // by pointers

  const Ray& operator[](unsigned id) const { return pointers ? *pointers[id] : rays[id]; }
};

#if RTC_VERSION_MAJOR >= 4
using EmbreeContext = RTCRayQueryContext;
#else
using EmbreeContext = RTCIntersectContext;
#endif

// What callbacks get back. No exception may pass through Embree: the first of a query is kept here.
struct QueryContext : EmbreeContext {
  RaySource source;
  std::exception_ptr thrown = nullptr;

  // Work of a callback; false if it threw.
  template <class Work>
  bool attempt(const Work& work) noexcept {
    try {
      work();
      return true;
    } catch (...) {
      if (!thrown) thrown = std::current_exception();
      return false;
    }
  }
};

// Embree's own hits of triangles, which it asks about one by one.
template <bool shadow>
void filterHits(const RTCFilterFunctionNArguments* a) {
  const auto& filter = *static_cast<const HitFilter*>(a->geometryUserPtr);
  auto& context = *static_cast<QueryContext*>(a->context);
  const auto& rays = context.source;
  for (unsigned i = 0; i < a->N; ++i) {
    if (!a->valid[i]) continue;
    const Hit hit{RTCRayN_tfar(a->ray, a->N, i),   RTCHitN_u(a->hit, a->N, i),
                  RTCHitN_v(a->hit, a->N, i),      RTCHitN_primID(a->hit, a->N, i),
                  RTCHitN_geomID(a->hit, a->N, i), RTCHitN_instID(a->hit, a->N, i, 0)};
    bool kept = false;
    context.attempt([&] { kept = filter.keeps(rays[RTCRayN_id(a->ray, a->N, i)], hit, shadow); });
    if (!kept) a->valid[i] = 0;
  }
}

// One call into Embree, which throws what its callbacks have thrown. Version 4 took the context out
// of the calls and put optional arguments in.
class Query {
 public:
  // `source` gives the rays of the lanes by their identifiers.
#if RTC_VERSION_MAJOR >= 4
  explicit Query(const RaySource& source, bool coherent = false) : context_{{}, source} {
    rtcInitIntersectArguments(&intersect_);
    rtcInitOccludedArguments(&occluded_);
    rtcInitRayQueryContext(&context_);
    intersect_.context = occluded_.context = &context_;
    if (coherent) intersect_.flags = occluded_.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  }
  void intersect(RTCScene s, RTCRayHit& e) {
    rtcIntersect1(s, &e, &intersect_);
    rethrow();
  }
  void intersect(const int* valid, RTCScene s, RTCRayHit16& e) {
    rtcIntersect16(valid, s, &e, &intersect_);
    rethrow();
  }
  void occluded(RTCScene s, RTCRay& e) {
    rtcOccluded1(s, &e, &occluded_);
    rethrow();
  }
  void occluded(const int* valid, RTCScene s, RTCRay8& e) {
    rtcOccluded8(valid, s, &e, &occluded_);
    rethrow();
  }
  void occluded(const int* valid, RTCScene s, RTCRay16& e) {
    rtcOccluded16(valid, s, &e, &occluded_);
    rethrow();
  }

 private:
  RTCIntersectArguments intersect_;
  RTCOccludedArguments occluded_;
#else
  explicit Query(const RaySource& source, bool coherent = false) : context_{{}, source} {
    rtcInitIntersectContext(&context_);
    if (coherent) context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
  void intersect(RTCScene s, RTCRayHit& e) {
    rtcIntersect1(s, &context_, &e);
    rethrow();
  }
  void intersect(const int* valid, RTCScene s, RTCRayHit16& e) {
    rtcIntersect16(valid, s, &context_, &e);
    rethrow();
  }
  void occluded(RTCScene s, RTCRay& e) {
    rtcOccluded1(s, &context_, &e);
    rethrow();
  }
  void occluded(const int* valid, RTCScene s, RTCRay8& e) {
    rtcOccluded8(valid, s, &context_, &e);
    rethrow();
  }
  void occluded(const int* valid, RTCScene s, RTCRay16& e) {
    rtcOccluded16(valid, s, &context_, &e);
    rethrow();
  }

 private:
#endif
  void rethrow() const {
    if (context_.thrown) [[unlikely]]
      std::rethrow_exception(context_.thrown);
  }

  QueryContext context_;
};

// Embree may abort at rays that reach farther (or are no numbers); they meet nothing.
inline const Ray& traceable(const Ray& r, float reach) {
  static constexpr Ray nothing{{}, 1, {0, 0, 1}, 0};  // an empty range of t
  const Vec3 far = glm::abs(r.o) + glm::abs(r.d);
  return far.x < reach && far.y < reach && far.z < reach ? r : nothing;
}

inline RTCRay toEmbree(const Ray& ray, float reach, float time) {
  const Ray& r = traceable(ray, reach);
  RTCRay e;
  e.org_x = r.o.x, e.org_y = r.o.y, e.org_z = r.o.z;
  e.dir_x = r.d.x, e.dir_y = r.d.y, e.dir_z = r.d.z;
  e.tnear = r.tMin, e.tfar = r.tMax;
  e.time = time, e.mask = ~0U, e.id = 0, e.flags = 0;
  return e;
}

template <class Packet>
void setLane(Packet& e, int i, const Ray& ray, float reach, float time) {
  const Ray& r = traceable(ray, reach);
  e.org_x[i] = r.o.x, e.org_y[i] = r.o.y, e.org_z[i] = r.o.z;
  e.dir_x[i] = r.d.x, e.dir_y[i] = r.d.y, e.dir_z[i] = r.d.z;
  e.tnear[i] = r.tMin, e.tfar[i] = r.tMax;
  e.time[i] = time, e.mask[i] = ~0U, e.id[i] = static_cast<unsigned>(i), e.flags[i] = 0;
}

}  // namespace pbrt
