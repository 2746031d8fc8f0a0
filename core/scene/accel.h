#pragma once
// The ray tree. accel.cpp, with accel_query.h, is the only file that knows Embree (3 or 4).

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/api/shape.h"
#include "core/api/world.h"
#include "core/base/error.h"
#include "core/scene/motion.h"

namespace pbrt {

// The Embree device; one for all trees of a scene, which it must outlive.
class AccelDevice {
 public:
  // threads: for building; 0 is all.
  explicit AccelDevice(int threads);
  ~AccelDevice();
  AccelDevice(const AccelDevice&) = delete;
  AccelDevice& operator=(const AccelDevice&) = delete;

 private:
  friend class Accel;
  void* device_;
};

// Surfaces with holes: is asked about every hit on the way, from many threads at once.
class HitFilter {
 public:
  virtual ~HitFilter() = default;
  // Whether the surface is there for this ray of the world; `shadow`: it only asks for occlusion.
  virtual bool keeps(const Ray& ray, const Hit& hit, bool shadow) const = 0;
};

// One tree: geometries get the identifiers 0, 1, 2, ... in the order in which they are added.
// All that is added must outlive the tree and stay where it is. Throws Error if Embree fails, for
// lack of memory above all.
class Accel {
 public:
  // Farther out than this nothing is traced; Embree's own limit is 1.8e18.
  static constexpr float kReach = 1e18F;

  explicit Accel(const AccelDevice& device);
  ~Accel();
  Accel(const Accel&) = delete;
  Accel& operator=(const Accel&) = delete;

  // Traced natively, from the mesh's own arrays. Reserves room for one vertex more, which Embree
  // may read.
  void add(TriangleMesh& mesh, const HitFilter* filter = nullptr);
  // `where` is what build() complains about if the shape reaches too far.
  void add(const Shape& shape, const Transform& toScene, const Location& where = {},
           const HitFilter* filter = nullptr);
  void add(const Accel& instance, const Transform& toScene);
  void add(const Accel& instance, const Motion& motion);
  // `times`: when motions start and end, as the rays' time has it.
  void build(const MotionTimes& times = {});
  double buildSeconds() const { return buildSeconds_; }

  Bounds3 bounds() const;  // empty if there is nothing

  Hit intersect(const Ray& ray) const;
  bool occluded(const Ray& ray) const;
  void intersect(std::span<const Ray* const> rays, std::span<Hit> hits) const;
  std::uint32_t occluded(std::span<const Ray> rays) const;

  // How far all motions have come at the time of a ray; 0 if nothing moves.
  float fraction(const Ray& ray) const { return moves_ ? times_.fraction(ray.time) : 0; }

  // How many rays this thread traced since it asked last.
  static std::uint64_t takeRayCount();

 private:
  struct UserGeometry;

  void addInstance(const Accel& instance, std::span<const Motion::Key> keys);
  template <class Packet>
  std::uint32_t occludedPacket(std::span<const Ray> rays) const;

  void* device_;
  void* scene_;
  std::uint32_t count_ = 0;
  float reach_ = kReach;  // rays farther out meet nothing; instances that shrink bring it nearer
  // Whether packets may be marked as coherent, which is faster. Embree 3 then never returns for
  // some packets that look all ways through instances.
  bool coherent_ = true;
  bool moves_ = false;  // whether any instance does
  double buildSeconds_ = 0;
  MotionTimes times_;
  std::vector<std::unique_ptr<UserGeometry>> users_;
};

}  // namespace pbrt
