// Loop's subdivision surface: a smooth surface from a coarse mesh of triangles.
//
// Loop 1987, "Smooth Subdivision Surfaces Based on Triangles"; boundaries and limit masks as in
// Hoppe et al. 1994, "Piecewise Smooth Surface Reconstruction"; weights of Warren 1995.

#include <fmt/format.h>

#include <tuple>

#include "core/plugin/plugin.h"

namespace pbrt {

namespace {

constexpr std::uint32_t kNone = ~0U;

// Half-edge 3 f + k runs from corner k of triangle f to the next; `vertex` holds where it starts.
struct HalfEdges {
  std::vector<std::uint32_t> vertex;
  std::vector<std::uint32_t> twin;  // the same edge from the other side; kNone on a boundary
  std::vector<std::uint32_t> out;   // of each vertex: one that starts there, the boundary if any

  static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::uint32_t previous(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  std::uint32_t end(std::uint32_t h) const { return vertex[next(h)]; }
  bool boundary(std::uint32_t v) const { return twin[out[v]] == kNone; }

  // Calls visit(w) for the neighbours of v, counter-clockwise seen from outside. At a boundary
  // the first and the last lie on it.
  template <class Visit>
  void around(std::uint32_t v, Visit visit) const {
    std::uint32_t h = out[v];
    visit(end(h));
    while (h != kNone) {
      const std::uint32_t before = previous(h);
      h = twin[before];
      if (h == out[v]) return;
      visit(vertex[before]);
    }
  }
};

// Joins the half-edges of triangles. Complains of what has no inside and outside, or no ring.
HalfEdges connect(const Params& p, std::vector<std::uint32_t> vertex, std::size_t vertices) {
  HalfEdges mesh{std::move(vertex), {}, {}};
  const auto count = static_cast<std::uint32_t>(mesh.vertex.size());
  mesh.twin.assign(count, kNone);
  mesh.out.assign(vertices, kNone);

  struct Edge {
    std::uint32_t a, b, h;
    bool operator<(const Edge& e) const { return std::tie(a, b, h) < std::tie(e.a, e.b, e.h); }
  };
  std::vector<Edge> edges(count);
  for (std::uint32_t h = 0; h < count; ++h) {
    const auto [a, b] = std::minmax({mesh.vertex[h], mesh.end(h)});
    if (a == b) p.fail("indices", fmt::format("triangle {} has vertex {} twice", h / 3, a));
    edges[h] = {a, b, h};
  }
  std::sort(edges.begin(), edges.end());
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    const Edge &e = edges[i], &f = edges[i + 1];
    if (e.a != f.a || e.b != f.b) continue;
    if (mesh.twin[e.h] != kNone)
      p.fail("indices",
             fmt::format("more than two triangles share the edge from vertex {} to {}", e.a, e.b));
    if (mesh.vertex[e.h] == mesh.vertex[f.h])
      p.fail("indices", fmt::format("triangles {} and {} face opposite sides: both run from "
                                    "vertex {} to {}",
                                    e.h / 3, f.h / 3, mesh.vertex[e.h], mesh.end(e.h)));
    mesh.twin[e.h] = f.h;
    mesh.twin[f.h] = e.h;
  }

  std::vector<std::uint32_t> corners(vertices);
  for (std::uint32_t h = 0; h < count; ++h) {
    const std::uint32_t v = mesh.vertex[h];
    ++corners[v];
    if (mesh.out[v] == kNone || mesh.twin[h] == kNone) mesh.out[v] = h;
  }
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (mesh.out[v] == kNone) continue;
    std::uint32_t reached = 0;
    mesh.around(v, [&](std::uint32_t) { ++reached; });
    if (reached != corners[v] + (mesh.boundary(v) ? 1 : 0))
      p.fail("indices", fmt::format("parts of the surface touch in vertex {} alone", v));
  }
  return mesh;
}

// Weight of each neighbour of an inner vertex with n of them.
float beta(int n) {
  return n == 3 ? 3.F / 16 : 3 / (8 * static_cast<float>(n));
}

// Weight of each neighbour for the limit of an inner vertex: the left eigenvector of the
// subdivision matrix for the eigenvalue one.
float limitWeight(int n) {
  return 1 / (static_cast<float>(n) + 3 / (8 * beta(n)));
}

// A vertex and the edges from it to its neighbours, counter-clockwise.
class OneRing {
 public:
  void gather(const HalfEdges& mesh, const std::vector<Point3>& points, std::uint32_t v) {
    centre_ = points[v];
    boundary_ = mesh.boundary(v);
    spokes_.clear();
    mesh.around(v, [&](std::uint32_t w) { spokes_.push_back(points[w] - centre_); });
  }

  // The vertex moved towards its neighbours: towards those on the boundary if it lies there.
  Point3 smooth(float boundaryWeight, float (*innerWeight)(int)) const {
    if (boundary_) return centre_ + boundaryWeight * (spokes_.front() + spokes_.back());
    Vec3 sum(0);
    for (const Vec3& spoke : spokes_) sum += spoke;
    return centre_ + innerWeight(static_cast<int>(spokes_.size())) * sum;
  }

  // The normal of the limit surface, or zero. Tangents are the left eigenvectors of the
  // subdivision matrix for its second eigenvalue (Hoppe et al. 1994, section 3 and appendix).
  Normal3 limitNormal() {
    const Vec3 n = boundary_ ? boundaryNormal() : innerNormal();
    const float length = glm::length(n);
    return length > 0 ? n / length : n;
  }

 private:
  Vec3 innerNormal() {
    const std::size_t n = spokes_.size();
    if (circle_.size() != n) {  // nearly every vertex has six neighbours
      circle_.resize(n);
      for (std::size_t i = 0; i < n; ++i) {
        const float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(n);
        circle_[i] = {std::cos(angle), std::sin(angle)};
      }
    }
    Vec3 s(0), t(0);
    for (std::size_t i = 0; i < n; ++i) {
      s += circle_[i].x * spokes_[i];
      t += circle_[i].y * spokes_[i];
    }
    return glm::cross(s, t);
  }

  Vec3 boundaryNormal() const {
    const std::size_t n = spokes_.size();
    const Vec3 along = spokes_.front() - spokes_.back();
    if (n == 2) return glm::cross(along, spokes_[0] + spokes_[1]);
    if (n == 3) return glm::cross(along, spokes_[1]);
    if (n == 4) return glm::cross(along, 2.F * (spokes_[1] + spokes_[2]) - spokes_[0] - spokes_[3]);
    const float theta = kPi / static_cast<float>(n - 1);
    Vec3 inward = -std::sin(theta) * (spokes_.front() + spokes_.back());
    for (std::size_t i = 1; i + 1 < n; ++i)
      inward += (2 - 2 * std::cos(theta)) * std::sin(static_cast<float>(i) * theta) * spokes_[i];
    return glm::cross(along, inward);
  }

  Point3 centre_{};
  bool boundary_ = false;
  std::vector<Vec3> spokes_;
  std::vector<Vec2> circle_;  // as many points of the unit circle
};

// One step: each triangle becomes four. Child k < 3 of triangle f is (corner k, middle of edge k,
// middle of the edge before); child 3 is (middle 0, middle 1, middle 2).
void subdivide(HalfEdges& mesh, std::vector<Point3>& points, OneRing& ring) {
  const auto count = static_cast<std::uint32_t>(mesh.vertex.size());
  const auto old = static_cast<std::uint32_t>(points.size());

  std::vector<Point3> finer(old);
  HalfEdges fine;
  fine.out.assign(old, kNone);
  for (std::uint32_t v = 0; v < old; ++v) {
    finer[v] = points[v];
    if (mesh.out[v] == kNone) continue;
    ring.gather(mesh, points, v);
    finer[v] = ring.smooth(1.F / 8, beta);
    fine.out[v] = 12 * (mesh.out[v] / 3) + 3 * (mesh.out[v] % 3);
  }

  std::vector<std::uint32_t> middle(count);
  for (std::uint32_t h = 0; h < count; ++h) {
    const std::uint32_t g = mesh.twin[h];
    if (g < h) {
      middle[h] = middle[g];
      continue;
    }
    middle[h] = static_cast<std::uint32_t>(finer.size());
    const Point3 ends = points[mesh.vertex[h]] + points[mesh.end(h)];
    finer.push_back(g == kNone ? 0.5F * ends
                               : 0.375F * ends + 0.125F * (points[mesh.vertex[mesh.previous(h)]] +
                                                           points[mesh.vertex[mesh.previous(g)]]));
    // From the middle to where h ends: a boundary if h is one.
    fine.out.push_back(12 * (h / 3) + 3 * (HalfEdges::next(h) % 3) + 2);
  }

  fine.vertex.resize(4 * std::size_t{count});
  fine.twin.resize(4 * std::size_t{count});
  for (std::uint32_t h = 0; h < count; ++h) {
    const std::uint32_t base = 12 * (h / 3), k = h % 3;
    const std::uint32_t child = base + 3 * k, inner = base + 9;
    const std::uint32_t before = mesh.previous(h);
    fine.vertex[child] = mesh.vertex[h];
    fine.vertex[child + 1] = middle[h];
    fine.vertex[child + 2] = middle[before];
    fine.vertex[inner + k] = middle[h];

    fine.twin[child + 1] = inner + before % 3;
    fine.twin[inner + before % 3] = child + 1;
    // The halves of an edge lie in the children at its ends.
    const std::uint32_t g = mesh.twin[h], gBefore = mesh.twin[before];
    fine.twin[child] = g == kNone ? kNone : 12 * (g / 3) + 3 * (mesh.next(g) % 3) + 2;
    fine.twin[child + 2] = gBefore == kNone ? kNone : 12 * (gBefore / 3) + 3 * (gBefore % 3);
  }
  mesh = std::move(fine);
  points = std::move(finer);
}

}  // namespace

class LoopSubdiv final : public MeshShape {
 public:
  explicit LoopSubdiv(Params& p) {
    const int nlevels = p.integer("nlevels", 3, 0, kMaxLevels, "steps of subdivision");
    const int levels = p.integer("levels", nlevels, 0, kMaxLevels, "another name for nlevels");
    // Real scenes name other schemes, and no pbrt ever had one.
    const std::string scheme = p.text("scheme", "loop", "rule of subdivision; only loop is known");
    if (scheme != "loop") p.warn("scheme", fmt::format("is \"{}\"; Loop's rule is used", scheme));
    std::vector<Point3> points = p.points("P", "vertices of the coarse mesh");
    p.require("P");
    HalfEdges mesh = connect(p, readIndices(p, points.size(), levels), points.size());

    OneRing ring;
    for (int i = 0; i < levels; ++i) subdivide(mesh, points, ring);

    mesh_.positions = points;
    mesh_.normals.resize(points.size());
    for (std::uint32_t v = 0; v < points.size(); ++v) {
      if (mesh.out[v] == kNone) continue;
      ring.gather(mesh, points, v);
      // On boundaries pbrt's weight; that of the very limit is 1/6.
      mesh_.positions[v] = ring.smooth(1.F / 5, limitWeight);
      mesh_.normals[v] = ring.limitNormal();
    }
    mesh_.indices = std::move(mesh.vertex);
  }

 private:
  static constexpr int kMaxLevels = 12;
  static constexpr std::size_t kMaxTriangles = std::size_t{1} << 26;

  static std::vector<std::uint32_t> readIndices(Params& p, std::size_t vertices, int levels) {
    const std::vector<int> given = p.integers("indices", "three vertices a triangle, from 0");
    p.require("indices");
    if (given.size() % 3 != 0)
      p.fail("indices", fmt::format("has {} numbers, not three a triangle", given.size()));
    if (given.size() / 3 > kMaxTriangles >> (2 * levels))
      p.fail("indices",
             fmt::format("{} triangles are too many for {} levels", given.size() / 3, levels));
    for (std::size_t i = 0; i < given.size(); ++i)
      if (given[i] < 0 || static_cast<std::size_t>(given[i]) >= vertices)
        p.fail("indices", fmt::format("number {} is {}, but there are {} vertices, from 0", i,
                                      given[i], vertices));
    return {given.begin(), given.end()};
  }
};

}  // namespace pbrt

PBRT_PLUGIN(Shape, pbrt::LoopSubdiv, "loopsubdiv",
            "a smooth surface, made by rounding off a coarse mesh of triangles")
