#include "tools/particles/motion/water.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>

#include "core/base/parallel.h"
#include "shapes/metaballs/lanes.h"

namespace pbrt::motion {
namespace {

using metaballs::Floats, metaballs::kLanes, metaballs::squareRoot;

constexpr float kSupport = 2;        // over the spacing
constexpr std::size_t kPiece = 128;  // particles in a piece of parallel work
constexpr float kCourant = 0.25F;    // how far a wave goes in a step, in spacings
constexpr float kViscosity = 4;      // per second
constexpr float kRelaxation = 0.5F;  // neighbours correct the same error at once
constexpr float kSoftness = 0.05F;   // of a constraint, where a particle has few neighbours

Floats load(const float* numbers) {
  Floats lanes;
  std::memcpy(&lanes, numbers, sizeof lanes);
  return lanes;
}

Floats gather(const std::vector<float>& numbers, const std::uint32_t* which) {
  Floats lanes;
  for (int i = 0; i < kLanes; ++i) lanes[i] = numbers[which[i]];
  return lanes;
}

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

void Water::Vectors::assign(std::size_t n, float value) {
  for (std::vector<float>* axis : {&x, &y, &z}) axis->assign(n, value);
}

void Water::Vectors::set(std::size_t i, const Vec3& v) {
  x[i] = v.x;
  y[i] = v.y;
  z[i] = v.z;
}

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
      density_(positions_.size()),
      pressure_(positions_.size() + 1),
      drag_(positions_.size()),
      pieces_((positions_.size() + kPiece - 1) / kPiece) {
  at_.assign(positions_.size() + kLanes, 1e6F * glm::length(tank_.diagonal()));
  speed_.assign(positions_.size() + kLanes, 0);
}

void Water::advance(double seconds) {
  const int steps = static_cast<int>(std::ceil(seconds / longestStep_));
  for (int i = 0; i < steps; ++i) step(static_cast<float>(seconds / steps));
}

std::vector<float> Water::densities() {
  sort(positions_);
  weigh();
  std::vector<float> densities(positions_.size());
  for (std::size_t i = 0; i < number_.size(); ++i) densities[number_[i]] = density_[i];
  return densities;
}

// Calls body(i, its piece) for every sorted particle.
template <class Body>
void Water::forEach(Body&& body) {
  parallelFor(pieces_.size(), [&](std::size_t k) {
    const std::size_t end = std::min((k + 1) * kPiece, number_.size());
    for (std::size_t i = k * kPiece; i < end; ++i) body(i, pieces_[k]);
  });
}

// Adds those within the support of particle i, itself too, and fills up the last eight with the one
// that is far away.
void Water::findNeighbours(std::size_t i, Piece& piece) const {
  using Bytes __attribute__((vector_size(kLanes))) = char;
  if (i % kPiece == 0) {
    piece.starts.assign(1, 0);
    piece.others.clear();
  }
  std::vector<std::uint32_t>& others = piece.others;
  const Point3 p = at_[i];
  const glm::ivec3 c = cell(p);
  const int x0 = std::max(c.x - 1, 0), x1 = std::min(c.x + 1, cells_.x - 1);
  for (int z = std::max(c.z - 1, 0); z <= std::min(c.z + 1, cells_.z - 1); ++z)
    for (int y = std::max(c.y - 1, 0); y <= std::min(c.y + 1, cells_.y - 1); ++y) {
      const int row = (z * cells_.y + y) * cells_.x;
      const std::uint32_t end = cellStart_[row + x1 + 1];
      for (std::uint32_t j = cellStart_[row + x0]; j < end; j += kLanes) {
        const Floats dx = p.x - load(&at_.x[j]), dy = p.y - load(&at_.y[j]),
                     dz = p.z - load(&at_.z[j]);
        const auto near = dx * dx + dy * dy + dz * dz < support_ * support_;
        // A byte a lane.
        auto lanes = std::bit_cast<std::uint64_t>(__builtin_convertvector(near, Bytes));
        lanes &= 0x0101010101010101;
        if (end - j < kLanes) lanes &= (std::uint64_t{1} << (8 * (end - j))) - 1;
        for (; lanes != 0; lanes &= lanes - 1)
          others.push_back(j + static_cast<std::uint32_t>(std::countr_zero(lanes)) / 8);
      }
    }
  while (others.size() % kLanes != 0) others.push_back(static_cast<std::uint32_t>(number_.size()));
  piece.starts.push_back(static_cast<std::uint32_t>(others.size()));
}

// Calls body(others, x, y, z, u) for the neighbours of particle i, eight at a time: u is 1 - r / h,
// or zero, and (x, y, z) is the unit vector from them to particle i. It is among them, with the
// vector 0 and u = 1.
template <class Body>
void Water::forNeighbours(std::size_t i, const Piece& piece, Body&& body) const {
  const Point3 p = at_[i];
  const float inverse = 1 / support_;
  for (std::uint32_t k = piece.starts[i % kPiece]; k < piece.starts[i % kPiece + 1]; k += kLanes) {
    const std::uint32_t* others = &piece.others[k];
    const Floats dx = p.x - gather(at_.x, others), dy = p.y - gather(at_.y, others),
                 dz = p.z - gather(at_.z, others);
    const Floats r = squareRoot(dx * dx + dy * dy + dz * dz);
    const Floats over = 1 / metaballs::max(r, Floats{} + 1e-30F);
    body(others, dx * over, dy * over, dz * over, metaballs::positivePart(1 - r * inverse));
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

// Beyond a wall space is folded back and very thin, so that particles which come into a corner do
// not come to one place, from where nothing could part them.
Point3 Water::inside(const Point3& p) const {
  const Point3 q = glm::clamp(p, tank_.lo, tank_.hi);
  return q + 0.01F * (q - p);
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
    at_.set(place, points[i]);
    speed_.set(place, velocities_[i]);
  }
}

// Densities, and how hard each particle has to push: equations 1, 8, 9 and 11 of the paper. There
// is no tension: a density below that at rest is none of a constraint's business.
void Water::weigh() {
  const float slope = 3 * kNorm / support_;
  forEach([&](std::size_t i, Piece& piece) {
    findNeighbours(i, piece);
    Floats density{}, squares{}, gx{}, gy{}, gz{}, vx{}, vy{}, vz{};
    forNeighbours(i, piece,
                  [&](const std::uint32_t* others, Floats x, Floats y, Floats z, Floats u) {
                    const Floats u2 = u * u, u3 = u * u2;
                    density += u3;
                    squares += u2 * u2;
                    gx += u2 * x;
                    gy += u2 * y;
                    gz += u2 * z;
                    vx += u3 * gather(speed_.x, others);
                    vy += u3 * gather(speed_.y, others);
                    vz += u3 * gather(speed_.z, others);
                  });
    const Floats sums = metaballs::sums(density, squares, gx, gy, gz, vx, vy, vz);
    const Wall outside = wall(at_[i]);
    const Vec3 gradient = outside.gradient - slope * Vec3(sums[2], sums[3], sums[4]);
    const float itself = 1;
    density_[i] = kNorm * sums[0] + outside.value;
    pressure_[i] =
        std::max(density_[i] - 1, 0.F) /
        (sqr(slope) * (sums[1] - itself) + lengthSquared(gradient) + kSoftness / sqr(spacing_));
    drag_[i] = kNorm * (Vec3(sums[5], sums[6], sums[7]) - sums[0] * speed_[i]);
  });
}

// Equation 12; and equation 17 (XSPH, of Schechter and Bridson 2012) put into positions, too. That
// is symmetric, so momentum stays, and less than it takes to be as fast as the neighbours, so
// energy falls.
void Water::push(float dt) {
  const float slope = 3 * kNorm / support_, most = 0.1F * spacing_;
  const float viscosity = std::min(kViscosity * dt, 0.5F);
  forEach([&](std::size_t i, const Piece& piece) {
    Floats sx{}, sy{}, sz{};
    forNeighbours(i, piece,
                  [&](const std::uint32_t* others, Floats x, Floats y, Floats z, Floats u) {
                    const Floats size = (pressure_[i] + gather(pressure_, others)) * u * u;
                    sx += size * x;
                    sy += size * y;
                    sz += size * z;
                  });
    const Floats sums = metaballs::sums(sx, sy, sz, sx, sy, sz, sx, sy);
    Vec3 shift = kRelaxation *
                 (slope * Vec3(sums[0], sums[1], sums[2]) - pressure_[i] * wall(at_[i]).gradient);
    shift *= std::min(1.F, most / glm::length(shift));
    const std::uint32_t number = number_[i];
    const Point3 p = inside(at_[i] + shift + dt * viscosity * drag_[i]);
    velocities_[number] = (p - positions_[number]) / dt;
    positions_[number] = p;
  });
}

void Water::step(float dt) {
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    Vec3& v = velocities_[i];
    v.y -= kGravity * dt;
    v *= std::min(1.F, fastest_ / glm::length(v));
    aims_[i] = inside(positions_[i] + dt * v);
  }
  sort(aims_);
  weigh();
  push(dt);
}

}  // namespace pbrt::motion
