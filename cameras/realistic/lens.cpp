#include "cameras/realistic/lens.h"

namespace pbrt {

Lens::Lens(std::span<const LensRow> rows) {
  std::size_t stops = 0;
  double z = 0;
  for (std::size_t i = rows.size(); i-- > 0;) {
    const LensRow& row = rows[i];
    if (i + 1 < rows.size()) z += row.thickness;
    const double before = row.index, after = i > 0 ? rows[i - 1].index : 1;
    if (row.radius == 0 && before == after) {
      ++stops;
      stop_ = surfaces_.size();
    }
    surfaces_.push_back(
        {z, row.radius == 0 ? 0 : -1 / row.radius, before / after, 0.5 * row.diameter});
  }
  if (stops != 1)
    throw Error(stops == 0 ? "the lens has no stop: a row of radius 0 with air on both sides"
                           : "the lens has more than one stop: rows of radius 0 in one medium");
  stopRadius_ = surfaces_[stop_].rim;

  // Refraction at curvature k: u' = u n / n' - y k (1 - n / n'); then the way t: y' = y + t u'.
  Paraxial& m = paraxial_;
  z = 0;
  for (const Surface& s : surfaces_) {
    const double t = s.z - z, power = s.curvature * (1 - s.ratio);
    z = s.z;
    m.a += t * m.c;
    m.b += t * m.d;
    m.c = s.ratio * m.c - power * m.a;
    m.d = s.ratio * m.d - power * m.b;
  }
}

double Lens::rearSag() const {
  const Surface& rear = surfaces_.front();
  const double kr = rear.curvature * rear.rim;
  return kr * rear.rim / (1 + std::sqrt(std::max(0.0, 1 - kr * kr)));
}

// A film at x behind the last vertex is sharp where the ways x and s = S - x before and behind the
// lens make the height there independent of the slope here,
//   a x + b + s (c x + d) = 0,  that is  -c x^2 + (c S + a - d) x + (b + d S) = 0,
// where S is the distance less the length of the lens. Of the two positions that exchange object
// and image that with the film nearer to the lens is meant. It is written so that S may be huge.
std::optional<double> Lens::focused(double distance) const {
  const auto [a, b, c, d] = paraxial_;
  if (!(c < 0)) return {};
  const double S = distance - length();
  const double half = 0.5 * (d - a - c * S), constant = b + d * S;
  const double square = half * half + c * constant;
  if (!(half > 0 && square >= 0)) return {};
  return constant / (half + std::sqrt(square));
}

// By the classical formulas (Welford 1986, Aberrations of Optical Systems, section 4.2): from the
// point (x, y) of the vertex's tangent plane the sphere of curvature k is
//   F / (G + sqrt(G^2 - k F)),  F = k (x^2 + y^2),  G = d_z - k (x d_x + y d_y)
// away, which holds for planes, too. The root is the cosine of incidence.
bool Lens::refract(const Surface& s, LensRay& ray) {
  if (!(ray.d.z > 0)) return false;
  DPoint3 p = ray.o + (s.z - ray.o.z) / ray.d.z * ray.d;
  const double k = s.curvature;
  const double F = k * (p.x * p.x + p.y * p.y), G = ray.d.z - k * (p.x * ray.d.x + p.y * ray.d.y);
  const double cos2 = G * G - k * F;
  if (!(G > 0 && cos2 >= 0)) return false;
  const double cosine = std::sqrt(cos2);
  p += F / (G + cosine) * ray.d;
  const DVec3 n(-k * p.x, -k * p.y, 1 - k * (p.z - s.z));  // unit
  if (!(n.z > 0)) return false;                            // the half beyond the sphere's equator
  const double cos2After = 1 - s.ratio * s.ratio * (1 - cos2);
  if (!(cos2After >= 0)) return false;
  ray.o = p;
  ray.d = s.ratio * ray.d + (std::sqrt(cos2After) - s.ratio * cosine) * n;
  return true;
}

std::optional<glm::dvec2> Lens::trace(LensRay& ray) const {
  glm::dvec2 atStop(0);
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    if (!refract(surfaces_[i], ray)) return {};
    const glm::dvec2 p(ray.o);
    if (glm::dot(p, p) > sqr(i == stop_ ? stopRadius_ : surfaces_[i].rim)) return {};
    if (i == stop_) atStop = p / stopRadius_;
  }
  if (!(ray.d.z > 0)) return {};
  return atStop;
}

bool Lens::traceUnbounded(LensRay& ray) const {
  for (const Surface& s : surfaces_)
    if (!refract(s, ray)) return false;
  return ray.d.z > 0;
}

std::optional<double> Lens::stopHeight(LensRay ray) const {
  for (std::size_t i = 0; i <= stop_; ++i)
    if (!refract(surfaces_[i], ray)) return {};
  return ray.o.x;
}

}  // namespace pbrt
