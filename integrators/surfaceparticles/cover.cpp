#include "integrators/surfaceparticles/cover.h"

#include <tuple>

#include "core/base/parallel.h"
#include "core/base/sphere_map.h"
#include "integrators/surfaceparticles/likeness.h"
#include "shapes/metaballs/surfels/simulation.h"

namespace pbrt::surfels {
namespace {

constexpr double kMost = 1 << 24;   // surfels of a scene
constexpr std::size_t kLeast = 32;  // of a surface
constexpr std::size_t kCells = 1 << 17;
constexpr std::size_t kShare = 256;
constexpr int kPasses = 64;  // surfaces that a ray passes by

auto place(std::uint32_t instance, std::uint32_t geometry) {
  return std::tuple(instance, geometry);
}

// A unit vector in the two numbers of a hit.
void setNormal(Hit& hit, const Normal3& n) {
  const Point2 st(squareFromSphere(SphereMap::equalarea, DVec3(n)));
  hit.u = st.x, hit.v = st.y;
}
Normal3 normalOf(const Hit& hit) {
  return Normal3(sphereFromSquare(SphereMap::equalarea, DVec2(hit.u, hit.v)));
}

// A ray that goes on behind what it met there.
void passBy(Ray& ray, float t) {
  ray.tMin = std::nextafter(t + 1e-6F * std::abs(t), kInfinity);
}

}  // namespace

Cover::Cover(const World& world, Point2i resolution, const Settings& settings) : world_(world) {
  ImplicitSurfaces all = world.implicitSurfaces();
  alone_ = all.alone;
  std::ranges::sort(all.surfaces, {},
                    [](const ImplicitSurface& s) { return place(s.instance, s.geometry); });
  std::vector<Likeness> likenesses;
  for (const ImplicitSurface& surface : all.surfaces) {
    skins_.push_back({surface, surface.toRender.inverse()});
    likenesses.emplace_back(surface);
  }
  // Those that are alike share the field of the first, and those of them that get equally many
  // surfels share these. Many fields share the boxes by which they are known.
  const Groups forms(likenesses);
  const std::size_t cells = std::clamp<std::size_t>(kCells / (forms.firsts.size() + 1), 64, 4096);
  std::vector<std::optional<StillField>> fields(forms.firsts.size());
  parallelFor(fields.size(), [&](std::size_t k) {
    const ImplicitSurface& surface = skins_[forms.firsts[k]].surface;
    fields[k].emplace(*surface.field, surface.toRender, cells);
  });
  std::vector<double> scales, areas;
  double area = 0;
  for (std::size_t i = 0; i < skins_.size(); ++i) {
    const Skin& first = skins_[forms.firsts[forms.of[i]]];
    scales.push_back(scaleBetween(first.surface.toRender, skins_[i].surface.toRender));
    areas.push_back(sqr(scales[i]) * fields[forms.of[i]]->area());
    area += areas[i];
  }
  if (!(area > 0)) return;
  const auto perArea = static_cast<double>(count(area, resolution, settings)) / area;
  std::vector<std::pair<std::size_t, std::size_t>> sizes;  // form, number of surfels
  for (std::size_t i = 0; i < skins_.size(); ++i) {
    const auto n = static_cast<std::size_t>(perArea * areas[i] + 0.5);
    sizes.emplace_back(forms.of[i], areas[i] > 0 ? std::max(n, kLeast) : 0);
  }
  const Groups sheets(sizes);
  std::vector<std::vector<Surfel>> surfels(sheets.firsts.size());
  parallelFor(surfels.size(), [&](std::size_t k) {
    const auto [form, n] = sizes[sheets.firsts[k]];
    if (n == 0) return;
    const StillField& field = *fields[form];
    Simulation simulation({n, k});
    for (int step = 0; step < settings.steps; ++step) simulation.step(field, 0);
    for (const Surfel& surfel : simulation.surfels())
      if (field.holds(surfel.p)) surfels[k].push_back(surfel);
  });
  for (std::uint32_t i = 0; i < skins_.size(); ++i) {
    const Skin& first = skins_[forms.firsts[forms.of[i]]];
    const Transform map = skins_[i].surface.toRender * first.toField;
    std::vector<Surfel> own;
    for (const Surfel& surfel : surfels[sheets.of[i]])
      own.push_back(placed(surfel, map, scales[i]));
    cover(i, own);
  }
}

// By quality: neighbours are to be 3 / quality pixels apart.
std::size_t Cover::count(double area, Point2i resolution, const Settings& settings) const {
  if (!(settings.quality > 0)) return static_cast<std::size_t>(settings.particles);
  const double n = area * pixelsPerArea(resolution) * sqr<double>(settings.quality / 3);
  return static_cast<std::size_t>(std::clamp(n, 1.0, kMost));
}

// Over how many pixels a unit of area is spread that faces the camera: the mean over those parts of
// the picture that show an implicit surface.
double Cover::pixelsPerArea(Point2i resolution) const {
  constexpr int across = 64;
  double sum = 0;
  int seen = 0;
  for (int y = 0; y < across; ++y)
    for (int x = 0; x < across; ++x) {
      CameraSample sample;
      sample.film = (Point2(x, y) + 0.5F) / float{across} * Point2(resolution);
      sample.lens = Point2(0.5F);
      const CameraRay camera = world_.camera().generate(sample, true);
      if (!(camera.weight > 0)) continue;
      const Hit hit = world_.intersect(camera.ray);
      if (!hit.found() || !isImplicit(hit)) continue;
      const RayDifferential& ray = camera.ray;
      const Point3 p = ray.at(hit.t);
      const Vec3 dx = ray.rxOrigin + hit.t * ray.rxDirection - p,
                 dy = ray.ryOrigin + hit.t * ray.ryDirection - p;
      const double pixel = std::abs(glm::dot(glm::cross(dx, dy), glm::normalize(ray.d)));
      if (!(pixel > 0)) continue;
      sum += 1 / pixel;
      ++seen;
    }
  return seen > 0 ? sum / seen : 0;
}

// A surfel that finds no surface below, as in a hole of an alpha texture, is left out.
void Cover::cover(std::uint32_t number, std::span<const Surfel> surfels) {
  Skin& skin = skins_[number];
  const std::size_t first = bases_.size();
  skin.firstBase = static_cast<std::uint32_t>(first);
  bases_.resize(first + surfels.size());
  const std::span<Base> bases = std::span(bases_).subspan(first);
  parallelFor((surfels.size() + kShare - 1) / kShare, [&](std::size_t k) {
    for (std::size_t i = k * kShare; i < std::min((k + 1) * kShare, surfels.size()); ++i) {
      if (const auto at = below(surfels[i], skin))
        bases[i] = {at->p, at->dpdu, at->dpdv, at->dndu, at->dndv, at->uv, at->primitive, number};
    }
  });
  std::vector<Surfel> there;
  for (std::size_t i = 0; i < surfels.size(); ++i)
    if (bases[i].skin == number) bases[there.size()] = bases[i], there.push_back(surfels[i]);
  bases_.resize(first + there.size());
  if (there.empty()) return;
  skin.anywhere = *below(there.front(), skin);
  skin.reversed = glm::dot(skin.anywhere.n, there.front().n) < 0;
  skin.discs.set(there, DPoint3(0));
}

// The surface that is nearest to the surfel along its normal.
std::optional<SurfaceInteraction> Cover::below(const Surfel& surfel, const Skin& skin) const {
  const float height = surfel.radius;
  RayDifferential ray;
  ray.d = -surfel.n;
  ray.o = Point3(surfel.p) + height * surfel.n;
  ray.tMax = 2 * height;
  ray.time = std::numeric_limits<float>::lowest();
  Hit nearest;
  for (int i = 0; i < kPasses; ++i) {
    const Hit hit = world_.intersect(ray);
    if (!hit.found()) break;
    if (skin.surface.isOf(hit) && std::abs(hit.t - height) < std::abs(nearest.t - height))
      nearest = hit;
    passBy(ray, hit.t);
  }
  ray.tMin = 0;
  if (!nearest.found()) return {};
  return world_.surface(ray, nearest);
}

bool Cover::isImplicit(const Hit& hit) const {
  const auto found = std::ranges::lower_bound(
      skins_, place(hit.instance, hit.geometry), {},
      [](const Skin& s) { return place(s.surface.instance, s.surface.geometry); });
  return found != skins_.end() && found->surface.isOf(hit);
}

Hit Cover::passImplicit(Ray ray, Hit hit) const {
  for (int i = 0; i < kPasses && hit.found() && isImplicit(hit); ++i) {
    passBy(ray, hit.t);
    hit = world_.intersect(ray);
  }
  return hit.found() && isImplicit(hit) ? Hit() : hit;
}

// One that moves is met by rays that have moved the other way, each by what its time asks for. They
// keep their parameters.
void Cover::draw(const Skin& skin, std::span<const Ray> rays, int width, const Beam& beam,
                 std::span<Fragment> out) {
  if (!skin.moves()) return skin.discs.draw(beam, out);
  thread_local std::vector<Ray> carried;
  thread_local Beam carriedBeam;
  carried.assign(rays.begin(), rays.end());
  for (Ray& ray : carried) {
    const Transform back = skin.moved(ray.time).inverse();
    ray.o = Point3(back.point(DPoint3(ray.o)));
    ray.d = Vec3(back.vector(DVec3(ray.d)));
  }
  carriedBeam.set(carried, width);
  skin.discs.draw(carriedBeam, out);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (out[i].t < kInfinity)
      out[i].n = Normal3(glm::normalize(skin.moved(rays[i].time).normal(DVec3(out[i].n))));
}

void Cover::look(std::span<const Ray* const> rays, int width, std::span<Hit> hits) const {
  // Kept for the next block, so that no memory is asked for.
  thread_local std::vector<Ray> copies;
  thread_local std::vector<Fragment> fragments;
  thread_local Beam beam;
  copies.clear();
  for (const Ray* ray : rays) copies.push_back(*ray);
  std::ranges::fill(hits, Hit());
  fragments.resize(rays.size());
  beam.set(copies, width);
  for (const Skin& skin : skins_) {
    draw(skin, copies, width, beam, fragments);
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (const Fragment& f = fragments[i]; f.t < hits[i].t) {
        hits[i] = {
            f.t, 0, 0, skin.firstBase + f.surfel, skin.surface.geometry, skin.surface.instance};
        setNormal(hits[i], f.n);
      }
  }
  if (alone_) return;
  for (std::size_t first = 0; first < rays.size(); first += World::kBatch) {
    const std::size_t n = std::min<std::size_t>(World::kBatch, rays.size() - first);
    std::array<const Ray*, World::kBatch> some{};
    std::array<Hit, World::kBatch> others;
    for (std::size_t i = 0; i < n; ++i) {
      Ray& ray = copies[first + i];
      ray.tMax = std::min(ray.tMax, hits[first + i].t);
      some[i] = &ray;
    }
    world_.intersect({some.data(), n}, {others.data(), n});
    for (std::size_t i = 0; i < n; ++i)
      if (const Hit hit = passImplicit(*some[i], others[i]); hit.found()) hits[first + i] = hit;
  }
}

SurfaceInteraction Cover::surface(const RayDifferential& ray, const Hit& hit) const {
  if (!isImplicit(hit)) return world_.surface(ray, hit);
  const Base& base = bases_[hit.primitive];
  const Skin& skin = skins_[base.skin];
  SurfaceInteraction s = skin.anywhere;
  s.p = ray.at(hit.t);
  s.n = s.ns = skin.reversed ? -normalOf(hit) : normalOf(hit);
  s.wo = -glm::normalize(ray.d);
  s.error =
      8 * std::numeric_limits<float>::epsilon() * (glm::length(ray.o) + hit.t * glm::length(ray.d));
  s.time = ray.time;
  const Transform moved = skin.moved(ray.time), back = moved.inverse();
  const DPoint3 p = back.point(DPoint3(s.p));
  s.objectP = skin.toField.point(p);
  s.primitive = base.primitive;
  // From the point below the surfel the parameters go on linearly along its tangent plane:
  // p = dpdu du + dpdv dv by least squares.
  const Vec3 d(p - DPoint3(base.p));
  const float uu = lengthSquared(base.dpdu), uv = glm::dot(base.dpdu, base.dpdv),
              vv = lengthSquared(base.dpdv), a = glm::dot(base.dpdu, d), b = glm::dot(base.dpdv, d),
              determinant = uu * vv - uv * uv;
  s.uv = base.uv;
  if (determinant > 0) s.uv += Point2(vv * a - uv * b, uu * b - uv * a) / determinant;
  const auto tangent = [&](const Vec3& before) {
    const Vec3 v(moved.vector(DVec3(before)));
    return v - glm::dot(v, s.n) * s.n;
  };
  s.dpdu = s.tangent = tangent(base.dpdu);
  s.dpdv = tangent(base.dpdv);
  s.dndu = Normal3(moved.normal(DVec3(base.dndu)));
  s.dndv = Normal3(moved.normal(DVec3(base.dndv)));
  if (ray.hasDifferentials) setFootprint(s, ray);
  return s;
}

// Steps of f / |gradient| along the normal, a little too long, until the field is below zero.
float Cover::depth(const Hit& hit, const SurfaceInteraction& at) const {
  if (!isImplicit(hit)) return 0;
  const Skin& skin = skins_[bases_[hit.primitive].skin];
  const Transform toRender = skin.toRender(at.time);
  const DVec3 up = toRender.inverse().vector(DVec3(skin.reversed ? -at.n : at.n));
  double depth = 0;
  for (int i = 0; i < 8; ++i) {
    const FieldPoint f = skin.surface.field->at(at.objectP + depth * up);
    const double step = 1.1 * f.value / glm::length(toRender.normal(f.gradient));
    if (!(step > 0 && std::isfinite(step))) break;
    depth += step;
  }
  return static_cast<float>(depth);
}

}  // namespace pbrt::surfels
