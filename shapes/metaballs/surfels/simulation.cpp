#include "shapes/metaballs/surfels/simulation.h"

#include <array>
#include <atomic>
#include <stdexcept>

#include "shapes/metaballs/surfels/chunks.h"
#include "shapes/metaballs/surfels/state.h"

namespace pbrt::surfels {
namespace {

// How the normal turns along the surface: the derivative of -g / |g| across it, that is -(I - n
// n^T) H (I - n n^T) / |g|. Zero where float cannot hold it.
void setBend(const ShapeAt& s, Surfel& surfel) {
  const DVec3 n(surfel.n);
  const glm::dmat3 across = glm::dmat3(1) - glm::outerProduct(n, n);
  const glm::dmat3 b = across * s.hessian * across / -glm::length(s.gradient);
  const double parts[6] = {b[0][0], b[1][1], b[2][2], b[1][0], b[2][0], b[2][1]};
  float sum = 0;
  for (int i = 0; i < 6; ++i) sum += sqr(surfel.bend[i] = static_cast<float>(parts[i]));
  if (!std::isfinite(sum)) std::fill(std::begin(surfel.bend), std::end(surfel.bend), 0.F);
}

// The lesser of the principal curvatures: of k1 + k2 and k1^2 + k2^2, the trace and the squared
// Frobenius norm of the bend.
float lesserCurvature(const Surfel& s) {
  const float* b = s.bend;
  const float sum = b[0] + b[1] + b[2];
  const float squares = sqr(b[0]) + sqr(b[1]) + sqr(b[2]) + 2 * (sqr(b[3]) + sqr(b[4]) + sqr(b[5]));
  return 0.5F * (sum - safeSqrt(2 * squares - sqr(sum)));
}

// The distance of surfels from their next, in reaches, if they lie as the cells of honeycomb. The
// ring of the nearest six alone gives sigma = 1 + 6 (1 - d)^3; many rings its integral over the
// plane, pi / 10 for each surfel per reach squared, of which there are 2 / (sqrt(3) d^2).
float spacing(float density) {
  const float ring = 1 - std::cbrt((density - 1) / 6), rings = std::sqrt(0.3627F / density);
  return std::max(ring, rings);
}

// Surfels within the reach of one. Fewer do not spread evenly, more only cost.
constexpr double kNeighbours = 14;

// Radius of a disc by the distance of its surfel from the next ones. The corners of an even
// honeycomb are 1 / sqrt(3) of it away; no cover is quite even. Where neighbours are on one side
// alone, they push toward a gap: by a tenth of the reach and more where half the plane is bare. The
// numbers were found on the dam that breaks: against 0.8 and 5, a third fewer of the picture's
// pixels are gaps, with a fifth more of area to draw; discs of the whole reach close few more.
float cover(const Repulsion& r) {
  const float push = std::sqrt(sqr(r.push[0]) + sqr(r.push[1]) + sqr(r.push[2]));
  return std::min(1.F, (0.85F + 7 * push) * spacing(r.density));
}

}  // namespace

Simulation::Simulation(const Settings& settings) : state_(std::make_unique<State>(settings)) {
  if (settings.count >> 31U != 0) throw std::invalid_argument("too many surfels");
}
Simulation::~Simulation() = default;
std::span<const Surfel> Simulation::surfels() const {
  return state_->surfels();
}
const Simulation::Report& Simulation::report() const {
  return state_->report();
}
void Simulation::step(const MovingField& field, double dt) {
  if (!(dt >= 0) || !std::isfinite(dt))
    throw std::invalid_argument("the time of a step must be finite and not below zero");
  state_->step(field, dt);
}

void Simulation::State::step(const MovingField& field, double dt) {
  report_ = {};
  report_.reach = reach_;
  ++steps_;
  carry(field, dt);
  setAnew(field);
  if (surfels_.empty()) return;
  sort();
  if (closeHoles(field)) sort();
  push(glm::length(DVec3(field.bounds().diagonal())));
  shape(field);
}

void Simulation::State::place(std::size_t i, const Landing& landing) {
  surfels_[i].p = landing.p;
  surfels_[i].n = Normal3(-glm::normalize(landing.gradient));
  motions_[i].flow = landing.flow;
  motions_[i].value = static_cast<float>(landing.value);
}

// Where the fluid and the neighbours carry a surfel. The law of motion, dp/dt = D - (F_x . D + F_t
// + phi F) F_x / |F_x|^2 (eq. 2), is what one step of Newton's method from p + D dt does to first
// order, with phi = 1 / dt; landing there sees to the higher orders, too. The push does not depend
// on dt: it is for the sake of evenness, however long a frame is.
//
// The velocity is that at the start of the way. By the mean of those at both ends (Heun's method)
// the surfel should have gone further by the lag, which it does one step later: so what turns does
// not slide off.
Landing Simulation::State::carried(const Bounds3& within, double dt, std::size_t i) const {
  const Motion& m = motions_[i];
  Landing l{surfels_[i].p + m.flow * dt + m.lag};
  if (!within.contains(Point3(l.p))) l.p = surfels_[i].p;
  l.p += report_.reach * DVec3(m.push[0], m.push[1], m.push[2]);
  return l;
}

void Simulation::State::carry(const MovingField& field, double dt) {
  const Bounds3 bounds = field.bounds();
  const double longest = 0.5 * field.grain();
  landings_.resize(surfels_.size()), lags_.resize(surfels_.size());
  std::atomic<std::size_t> jumps = 0;
  forChunks(surfels_.size(), [&](std::size_t begin, std::size_t end) {
    // Lands those again that have not `arrived`, from where `from` says.
    const auto again = [&](const auto& arrived, const auto& from) {
      std::array<Landing, kChunk> landings;
      std::array<std::size_t, kChunk> which;
      std::size_t n = 0;
      for (std::size_t i = begin; i < end; ++i)
        if (!arrived(i)) landings[n] = from(i), which[n++] = i;
      land(field, {landings.data(), n});
      for (std::size_t k = 0; k < n; ++k) landings_[which[k]] = landings[k];
    };
    const auto ownWay = [&](std::size_t i) { return carried(bounds, dt, i); };
    std::array<std::size_t, kChunk> partners;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t to = partners[i - begin] = partner(i);
      landings_[i] = to == i ? ownWay(i) : beside(to, ownWay(to));
    }
    land(field, {&landings_[begin], end - begin});
    std::size_t jumped = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const DVec3 lag = 0.5 * dt * (landings_[i].flow - motions_[i].flow);
      const bool counts =
          landings_[i].there && partners[i - begin] == i && glm::length(lag) < longest;
      lags_[i] = counts ? lag : DVec3(0);
    }
    // A jump to another sheet is none.
    again(
        [&](std::size_t i) {
          const std::size_t to = partners[i - begin];
          if (to == i) return true;
          const bool there =
              landings_[i].there && glm::dot(landings_[i].gradient, DVec3(surfels_[to].n)) < 0;
          jumped += there ? 1 : 0;
          return there;
        },
        ownWay);
    again([&](std::size_t i) { return landings_[i].there; },
          [&](std::size_t i) { return Landing{surfels_[i].p}; });
    jumps += jumped;
  });
  report_.moved += jumps;
  lost_.clear();
  for (std::size_t i = 0; i < surfels_.size(); ++i)
    if (landings_[i].there)
      place(i, landings_[i]), motions_[i].lag = lags_[i];
    else
      lost_.push_back(static_cast<std::uint32_t>(i));
}

void Simulation::State::sort() {
  const auto order = neighbours_.sort(surfels_, report_.reach);
  surfelsBefore_.swap(surfels_), motionsBefore_.swap(motions_);
  surfels_.resize(order.size()), motions_.resize(order.size());
  forChunks(order.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      surfels_[i] = surfelsBefore_[order[i]], motions_[i] = motionsBefore_[order[i]];
  });
}

void Simulation::State::push(double extent) {
  crowding_.clear();
  for (const Motion& m : motions_) crowding_.push_back(m.crowding);
  neighbours_.store(surfels_, crowding_);
  const auto cells = neighbours_.cells();
  repulsions_.resize(surfels_.size());
  struct Sums {
    double density = 0, squares = 0, area = 0, value = 0;
  };
  std::vector<Sums> sums(chunks(cells.size()));
  // The less there is to be made even, the longer counts are averaged.
  const float own = std::clamp(4 * evenness_, 0.1F, 0.5F);
  forChunks(cells.size(), [&](std::size_t begin, std::size_t end) {
    repel(neighbours_.view(), cells.subspan(begin, end - begin), repulsions_.data());
    Sums& sum = sums[begin / kChunk];
    for (std::size_t i = cells[begin].first; i < cells[end - 1].first + cells[end - 1].count; ++i) {
      const Repulsion& r = repulsions_[i];
      std::copy_n(r.push, 3, motions_[i].push);
      float& crowding = crowding_[i];
      const float count = r.neighbours + 1;
      crowding = crowding > 0 ? r.crowding + own * (count - r.crowding) : count;
      motions_[i].crowding = crowding;
      surfels_[i].density = r.density;
      surfels_[i].radius = static_cast<float>(report_.reach) * cover(r);
      sum.density += r.density, sum.squares += sqr(static_cast<double>(r.density));
      sum.area += 1 / (1.0 + r.neighbours);
      sum.value = std::max(sum.value, std::abs(static_cast<double>(motions_[i].value)));
    }
  });
  Sums all;
  for (const Sums& s : sums) {
    all.density += s.density, all.squares += s.squares, all.area += s.area;
    all.value = std::max(all.value, s.value);
  }
  const auto n = static_cast<double>(surfels_.size());
  const double mean = all.density / n;
  report_.evenness = std::sqrt(std::max(0.0, all.squares / n - mean * mean)) / mean;
  evenness_ = static_cast<float>(report_.evenness);
  report_.residual = all.value;
  // Each surfel stands for a part of the area, that within its reach shared with its neighbours:
  // the reach for which, with that area spread evenly, each has as many neighbours as are wanted.
  reach_ = report_.reach * std::sqrt((kNeighbours + 1) * all.area / n);
  if (reach_ > extent) reach_ = std::max(extent, 0.1 * report_.reach);
}

void Simulation::State::shape(const MovingField& field) {
  forChunks(surfels_.size(), [&](std::size_t begin, std::size_t end) {
    std::array<DPoint3, kChunk> places;
    std::array<ShapeAt, kChunk> shapes;
    for (std::size_t i = begin; i < end; ++i) places[i - begin] = surfels_[i].p;
    field.shape({places.data(), end - begin}, {shapes.data(), end - begin});
    for (std::size_t i = begin; i < end; ++i) {
      Surfel& s = surfels_[i];
      setBend(shapes[i - begin], s);
      // On what is convex all around, a drop, a disc is no wider than the drop.
      if (const float k = lesserCurvature(s); k * s.radius > 1) s.radius = 1 / k;
    }
  });
}

}  // namespace pbrt::surfels
