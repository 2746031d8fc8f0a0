#include "tools/particles/motion/water.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/base/parallel.h"

namespace pbrt::motion {
namespace {

constexpr float kSupport = 2;        // over the spacing
constexpr std::size_t kPiece = 128;  // particles
constexpr int kIterations = 2;       // of the constraints, a step
constexpr float kCourant = 0.2F;     // how far a wave goes in a step, in spacings
constexpr float kViscosity = 4;      // per second
constexpr float kRelaxation = 0.8F;  // neighbours correct the same error at once
constexpr float kSoftness = 0.05F;   // of a constraint, where a particle has few neighbours

// The kernel is (1 - r / h)^3, of Desbrun and Gascuel 1996 (spiky in Mueller et al. 2003), over its
// sum for a particle in a cubic lattice.
float latticeSum() {
  float sum = 0;
  for (int i = 0; i < 125; ++i) {
    const Vec3 p(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2);
    const float u = 1 - glm::length(p) / kSupport;
    sum += u > 0 ? u * u * u : 0;
  }
  return sum;
}
const float kNorm = 1 / latticeSum();
// What the kernel has over all space, at one particle a cube of the spacing:
// 4 pi h^3 times the integral of x^2 (1 - x)^3.
const float kWhole = kNorm * 4 * std::numbers::pi_v<float> * kSupport * kSupport * kSupport / 60;

}  // namespace

Water::Water(std::vector<Point3> positions, const Bounds3& tank, float spacing, float depth)
    : positions_(std::move(positions)),
      velocities_(positions_.size()),
      tank_(tank),
      spacing_(spacing),
      support_(kSupport * spacing),
      longestStep_(kCourant * spacing / std::sqrt(kGravity * depth)),
      fastest_(2 * std::sqrt(2 * kGravity * depth)),
      cells_(glm::ivec3(glm::floor(tank.diagonal() / support_)) + 1),
      aims_(positions_.size()),
      number_(positions_.size()),
      at_(positions_.size()),
      moved_(positions_.size()),
      speed_(positions_.size()),
      density_(positions_.size()),
      pressure_(positions_.size()),
      pieces_((positions_.size() + kPiece - 1) / kPiece) {}

void Water::advance(double seconds) {
  const int steps = static_cast<int>(std::ceil(seconds / longestStep_));
  for (int i = 0; i < steps; ++i) step(static_cast<float>(seconds / steps));
}

std::vector<float> Water::densities() {
  sort(positions_);
  findNeighbours();
  weigh();
  std::vector<float> densities(positions_.size());
  for (std::size_t i = 0; i < number_.size(); ++i) densities[number_[i]] = density_[i];
  return densities;
}

// Calls body(piece, i) for every sorted particle.
template <class Body>
void Water::forEach(Body&& body) {
  parallelFor(pieces_.size(), [&](std::size_t k) {
    const std::size_t end = std::min((k + 1) * kPiece, number_.size());
    for (std::size_t i = k * kPiece; i < end; ++i) body(pieces_[k], i);
  });
}

// Calls body(j, d, u) for the particles j within the support of particle i: d is the unit vector
// from j to i, u is 1 - r / h.
template <class Body>
void Water::forNeighbours(const Piece& piece, std::size_t i, Body&& body) const {
  const Point3 p = at_[i];
  for (std::uint32_t k = piece.starts[i % kPiece]; k < piece.starts[i % kPiece + 1]; ++k) {
    const std::uint32_t j = piece.others[k];
    const Vec3 d = p - at_[j];
    const float r2 = lengthSquared(d);
    if (r2 >= support_ * support_) continue;
    const float r = std::sqrt(r2);
    // Two in one place part along y.
    const Vec3 direction = r > 0 ? d / r : Vec3(0, i < j ? -1 : 1, 0);
    body(j, direction, 1 - r / support_);
  }
}

// What water beyond the walls would add to the density, and its gradient. Over the half space that
// begins at a distance z = h (1 - u) the integral of the kernel, over that of all space, is
// u^5 (3 / 2 - u): that of rings, then of planes. (The idea is that of T. Harada et al. 2007,
// "Smoothed Particle Hydrodynamics in Complex Shapes".)
Water::Wall Water::wall(const Point3& p) const {
  Wall wall;
  for (int k = 0; k < 3; ++k)
    for (const float side : {-1.F, 1.F}) {
      const float distance = side < 0 ? p[k] - tank_.lo[k] : tank_.hi[k] - p[k];
      const float u = std::min(1 - distance / support_, 1.F);
      if (u <= 0) continue;
      const float u4 = u * u * u * u;
      wall.value += kWhole * u4 * u * (1.5F - u);
      wall.gradient[k] += side * kWhole * u4 * (7.5F - 6 * u) / support_;
    }
  return wall;
}

Point3 Water::inside(const Point3& p) const {
  return glm::clamp(p, tank_.lo, tank_.hi);
}

glm::ivec3 Water::cell(const Point3& p) const {
  return glm::min(glm::ivec3((p - tank_.lo) / support_), cells_ - 1);
}

// By cells whose edge is the support; x runs fastest.
void Water::sort(std::span<const Point3> points) {
  const auto index = [&](const Point3& p) {
    const glm::ivec3 c = cell(p);
    return static_cast<std::size_t>((c.z * cells_.y + c.y) * cells_.x + c.x);
  };
  cellStart_.assign(static_cast<std::size_t>(cells_.x * cells_.y * cells_.z) + 1, 0);
  for (const Point3& p : points) ++cellStart_[index(p)];
  std::partial_sum(cellStart_.begin(), cellStart_.end(), cellStart_.begin());
  // Backwards from the ends of the cells, which so become their starts.
  for (std::size_t i = points.size(); i-- > 0;) {
    const std::uint32_t place = --cellStart_[index(points[i])];
    number_[place] = static_cast<std::uint32_t>(i);
    at_[place] = points[i];
  }
}

// Those that may come within the support during a step's corrections, too.
void Water::findNeighbours() {
  const float reach2 = sqr(1.1F * support_);
  forEach([&](Piece& piece, std::size_t i) {
    if (i % kPiece == 0) {
      piece.starts.assign(1, 0);
      piece.others.clear();
    }
    const Point3 p = at_[i];
    const glm::ivec3 c = cell(p);
    const int x0 = std::max(c.x - 1, 0), x1 = std::min(c.x + 1, cells_.x - 1);
    for (int z = std::max(c.z - 1, 0); z <= std::min(c.z + 1, cells_.z - 1); ++z)
      for (int y = std::max(c.y - 1, 0); y <= std::min(c.y + 1, cells_.y - 1); ++y) {
        const int row = (z * cells_.y + y) * cells_.x;
        for (std::uint32_t j = cellStart_[row + x0]; j < cellStart_[row + x1 + 1]; ++j)
          if (j != i && lengthSquared(at_[j] - p) < reach2) piece.others.push_back(j);
      }
    piece.starts.push_back(static_cast<std::uint32_t>(piece.others.size()));
  });
}

// Densities, and how hard each particle has to push: equations 1, 8, 9 and 11 of the paper. There
// is no tension: a density below that at rest is none of a constraint's business.
void Water::weigh() {
  forEach([&](const Piece& piece, std::size_t i) {
    const Wall outside = wall(at_[i]);
    float density = kNorm + outside.value, squares = 0;
    Vec3 gradient = outside.gradient;
    const float slope = 3 * kNorm / support_;
    forNeighbours(piece, i, [&](std::uint32_t, const Vec3& d, float u) {
      density += kNorm * u * u * u;
      const Vec3 g = -slope * u * u * d;
      gradient += g;
      squares += lengthSquared(g);
    });
    density_[i] = density;
    pressure_[i] = std::max(density - 1, 0.F) /
                   (squares + lengthSquared(gradient) + kSoftness / sqr(spacing_));
  });
}

// Equation 12.
void Water::push() {
  forEach([&](const Piece& piece, std::size_t i) {
    Vec3 shift = -pressure_[i] * wall(at_[i]).gradient;
    const float slope = 3 * kNorm / support_;
    forNeighbours(piece, i, [&](std::uint32_t j, const Vec3& d, float u) {
      shift += (pressure_[i] + pressure_[j]) * slope * u * u * d;
    });
    const float most = 0.1F * spacing_;
    moved_[i] = inside(at_[i] + kRelaxation * shift * std::min(1.F, most / glm::length(shift)));
  });
  std::swap(at_, moved_);
}

// Schechter and Bridson 2012 (XSPH): neighbours come to move alike. It is symmetric, so momentum
// stays, and below one, so energy falls.
void Water::smoothVelocities(float dt) {
  const float share = std::min(kViscosity * dt, 0.5F);
  forEach([&](const Piece& piece, std::size_t i) {
    Vec3 change(0);
    forNeighbours(piece, i, [&](std::uint32_t j, const Vec3&, float u) {
      change += kNorm * u * u * u * (speed_[j] - speed_[i]);
    });
    velocities_[number_[i]] = speed_[i] + share * change;
  });
}

void Water::step(float dt) {
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    Vec3 v = velocities_[i] - Vec3(0, kGravity * dt, 0);
    v *= std::min(1.F, fastest_ / glm::length(v));
    aims_[i] = inside(positions_[i] + dt * v);
  }
  sort(aims_);
  findNeighbours();
  for (int i = 0; i < kIterations; ++i) {
    weigh();
    push();
  }
  for (std::size_t i = 0; i < number_.size(); ++i) {
    Point3& p = positions_[number_[i]];
    speed_[i] = (at_[i] - p) / dt;
    p = at_[i];
  }
  smoothVelocities(dt);
}

}  // namespace pbrt::motion
