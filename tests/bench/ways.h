#pragma once
// Ways to show the surface of a fluid to the rays of a camera: as rays meet it, as triangles of
// marching cubes, as points.

#include <fmt/format.h>

#include "core/base/parallel.h"
#include "core/scene/accel.h"
#include "shapes/metaballs/surfels/atom_field.h"
#include "shapes/metaballs/surfels/draw.h"
#include "tests/bench/cell_shape.h"
#include "tests/bench/marching_cubes.h"
#include "tests/bench/metaballs_view.h"
#include "tests/bench/seen.h"
#include "tools/particles/motion/motion.h"

namespace pbrt::bench {

using motion::Fluid;

// The rays of a pinhole camera that sees a box, in square blocks of pixels.
class View {
 public:
  static constexpr int kBlock = 32;  // pixels along each side

  // `size`: pixels along each side, a multiple of kBlock.
  View(const Bounds3& box, int size);

  int size() const { return size_; }
  std::size_t blocks() const { return rays_.size(); }
  // Row by row; directions are unit vectors.
  std::span<const Ray> rays(std::size_t block) const { return rays_[block]; }
  const surfels::Beam& beam(std::size_t block) const { return beams_[block]; }
  // The pixel of ray i of a block.
  Point2i pixel(std::size_t block, int i) const {
    const auto b = static_cast<int>(block), across = size_ / kBlock;
    return kBlock * Point2i(b % across, b / across) + Point2i(i % kBlock, i / kBlock);
  }

 private:
  int size_;
  std::vector<std::vector<Ray>> rays_;
  std::vector<surfels::Beam> beams_;
};

inline View::View(const Bounds3& box, int size) : size_(size) {
  const float radius = 0.5F * glm::length(box.diagonal());
  const Vec3 forward = glm::normalize(Vec3(-0.5F, -0.4F, -0.8F));
  const Vec3 right = glm::normalize(glm::cross(forward, Vec3(0, 1, 0)));
  const Vec3 up = glm::cross(right, forward);
  const Point3 eye = box.centre() - 3 * radius * forward;
  // The cone about a ball of 0.95 of its radius: fluids do not fill the corners.
  const float halfWidth = 0.95F / std::sqrt(9 - sqr(0.95F));
  rays_.resize(sqr(static_cast<std::size_t>(size / kBlock)));
  for (std::size_t block = 0; block < rays_.size(); ++block)
    for (int i = 0; i < sqr(kBlock); ++i) {
      const Point2 p = (Point2(pixel(block, i)) + 0.5F) / static_cast<float>(size) * 2.F - 1.F;
      const Vec3 d = forward + halfWidth * (p.x * right - p.y * up);
      rays_[block].push_back({eye, 0, glm::normalize(d)});
    }
  for (const auto& rays : rays_) beams_.emplace_back(rays, kBlock);
}

class Way {
 public:
  Way() = default;
  Way(const Way&) = delete;
  Way& operator=(const Way&) = delete;
  virtual ~Way() = default;
  virtual std::string name() const = 0;
  // Makes ready the next frame, `dt` after the last; `fluid` stays until the one after that.
  virtual void set(const Fluid& fluid, double dt) = 0;
  virtual void draw(const View& view, Picture& out) const = 0;
  virtual std::size_t primitives() const = 0;
  virtual std::span<const surfels::Surfel> surfels() const { return {}; }
};

// By the ray tree, in packets of 4 x 4 pixels.
class TracedWay : public Way {
 public:
  void draw(const View& view, Picture& out) const override;

 protected:
  virtual Seen seen(const Ray& ray, const Hit& hit) const = 0;
  // An empty tree for the next frame.
  Accel& renewTree() { return tree_.emplace(device_); }

 private:
  AccelDevice device_{0};
  std::optional<Accel> tree_;
};

inline void TracedWay::draw(const View& view, Picture& out) const {
  parallelFor(view.blocks(), [&](std::size_t block) {
    constexpr int side = 4, across = View::kBlock / side;
    const std::span<const Ray> rays = view.rays(block);
    for (int tile = 0; tile < sqr(across); ++tile) {
      const int corner = tile / across * side * View::kBlock + tile % across * side;
      std::array<const Ray*, sqr(side)> pointers;
      std::array<Hit, sqr(side)> hits;
      const auto index = [&](int k) { return corner + k / side * View::kBlock + k % side; };
      for (int k = 0; k < sqr(side); ++k) pointers[k] = &rays[index(k)];
      tree_->intersect(pointers, hits);
      for (int k = 0; k < sqr(side); ++k) {
        const Point2i p = view.pixel(block, index(k));
        out.at(p.x, p.y) = hits[k].found() ? seen(*pointers[k], hits[k]) : Seen();
      }
    }
  });
}

class RayTraced final : public TracedWay {
 public:
  std::string name() const override { return "ray traced"; }
  void set(const Fluid& fluid, double) override {
    field_.emplace(fluid.kernel, fluid.atoms);
    Accel& tree = renewTree();
    shape_.emplace(*field_);
    tree.add(*shape_, Transform());
    tree.build();
  }
  std::size_t primitives() const override { return shape_->primitives(); }
  const metaballs::Field& field() const { return *field_; }

 private:
  // The hit rounds t to a float.
  Seen seen(const Ray& ray, const Hit& hit) const override {
    const ObjectRay r = metaballs::bench::inDouble(ray);
    const auto t = shape_->crossing(r, hit.primitive);
    const metaballs::Cells& cells = shape_->cells();
    const auto list = cells.atoms(cells.cells()[hit.primitive]);
    return {*t, -glm::normalize(field_->sample(r.at(*t), list).gradient)};
  }

  std::optional<metaballs::Field> field_;
  std::optional<metaballs::bench::CellShape> shape_;
};

// Marching cubes with voxels of h / divisions.
class Triangles final : public TracedWay {
 public:
  Triangles(double h, int divisions) : h_(h), divisions_(divisions) {}
  std::string name() const override { return fmt::format("triangles, h/{}", divisions_); }
  void set(const Fluid& fluid, double) override {
    Accel& tree = renewTree();
    const metaballs::Field field(fluid.kernel, fluid.atoms);
    mesh_ = metaballs::bench::Mesher(field, h_ / divisions_).mesh();
    tree.add(mesh_);
    tree.build();
  }
  std::size_t primitives() const override { return mesh_.triangles(); }

 private:
  Seen seen(const Ray&, const Hit& hit) const override {
    const auto normal = [&](int k) {
      return DVec3(mesh_.normals[mesh_.indices[3 * hit.primitive + k]]);
    };
    const double u = hit.u, v = hit.v;
    return {hit.t, glm::normalize((1 - u - v) * normal(0) + u * normal(1) + v * normal(2))};
  }

  double h_;
  int divisions_;
  TriangleMesh mesh_;
};

// Discs at surfels that settle in the first frame, then follow the fluid from frame to frame; or,
// if `anew` is above zero, that start anew in every frame and take so many steps.
class Points final : public Way {
 public:
  explicit Points(std::size_t count, int anew = 0) : settings_{count}, anew_(anew) {
    simulation_.emplace(settings_);
  }
  std::string name() const override {
    const auto count = fmt::format("{} points", settings_.count);
    return anew_ == 0 ? count : fmt::format("{}, anew, {} step(s)", count, anew_);
  }
  void set(const Fluid& fluid, double dt) override {
    if (anew_ > 0) {
      field_ = surfels::AtomField();
      simulation_.emplace(settings_);
    }
    field_.set(fluid.kernel, fluid.atoms, fluid.velocities);
    const int steps = anew_ > 0 ? anew_ : simulation_->surfels().empty() ? kSettling : 1;
    for (int i = 0; i < steps; ++i) simulation_->step(field_, steps == 1 ? dt : 0);
    discs_.set(simulation_->surfels(), DPoint3(0));
  }
  void draw(const View& view, Picture& out) const override;
  std::size_t primitives() const override { return surfels().size(); }
  std::span<const surfels::Surfel> surfels() const override { return simulation_->surfels(); }

 private:
  static constexpr int kSettling = 20;  // steps

  surfels::Simulation::Settings settings_;
  int anew_;
  surfels::AtomField field_;
  std::optional<surfels::Simulation> simulation_;
  surfels::Discs discs_;
};

inline void Points::draw(const View& view, Picture& out) const {
  parallelFor(view.blocks(), [&](std::size_t block) {
    std::array<surfels::Fragment, sqr(View::kBlock)> fragments;
    discs_.draw(view.beam(block), fragments);
    for (int i = 0; i < sqr(View::kBlock); ++i) {
      const Point2i p = view.pixel(block, i);
      out.at(p.x, p.y) = {fragments[i].t, DVec3(fragments[i].n)};
    }
  });
}

}  // namespace pbrt::bench
