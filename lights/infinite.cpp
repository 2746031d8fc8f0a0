// Light from all around, from infinitely far: one colour, or a picture of the surroundings
// (Blinn and Newell 1976; Debevec 1998).

#include "core/base/distribution.h"
#include "core/base/picture.h"
#include "core/base/sphere_map.h"
#include "core/plugin/light_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {
namespace {

// The radiance is interpolated between the pixels. A pixel's cell is chosen by the mean radiance in
// it, and the direction uniformly in solid angle within the cell: wherever there is light the
// density is above zero, and it is constant in each cell.
class Infinite final : public Light {
 public:
  Infinite(Params& p, const Setup& setup) : Infinite(p, setup, readLightPicture(p)) {}

  LightSample sample(const Point3& /*p*/, Point2 u) const override {
    LightSample s;
    const Distribution2D::Cell cell = cells_.sample(u);
    if (!(cell.chance > 0)) return s;
    const DVec2 st((cell.x + double{cell.within.x}) / picture_.width(),
                   rowPosition(cell.y, cell.within.y));
    const DVec3 w = toRender_ * sphereFromSquare(map_, st);
    const double stretch = glm::length(w);
    s.L = radiance(st);
    s.wi = w / stretch;
    s.finite = false;
    s.pdf = density(cell.chance, cell.y, stretch);
    return s;
  }
  bool isDelta() const override { return false; }
  bool isInfinite() const override { return true; }

  Spectrum escaped(const Vec3& w) const override {
    return radiance(squareFromSphere(map_, glm::normalize(toLight_ * DVec3(w))));
  }
  float pdfEscaped(const Vec3& w) const override {
    const DVec3 light = toLight_ * DVec3(w);
    const double length = glm::length(light);
    const DVec2 st = squareFromSphere(map_, light / length);
    const auto cell = [](double x, int n) { return std::clamp(static_cast<int>(x * n), 0, n - 1); };
    const int y = cell(st.y, picture_.height());
    return density(cells_.chance(cell(st.x, picture_.width()), y), y, 1 / length);
  }

  double power(double sceneRadius) const override {
    return std::numbers::pi * sqr(sceneRadius) * luminance(L_ * total_);
  }
  // The mean over all surfaces of the cosine, where it is above zero, is 1/4.
  LightBounds bounds() const override { return {{}, luminance(L_ * total_) / 4}; }

 private:
  Infinite(Params& p, const Setup& setup, const std::filesystem::path& file)
      : L_(p.emission("L", Spectrum(1), "radiance, of which the picture takes its share")),
        picture_(file.empty() ? Picture(Spectrum(1)) : Picture(file)),
        map_(readMap(p, picture_)),
        toRender_(setup.toRender.matrix()),
        toLight_(setup.toRender.inverseMatrix()),
        determinant_(std::abs(glm::determinant(toRender_))),
        cells_(picture_.width(), weights(picture_, map_)),
        total_(integral(picture_, map_)) {
    L_ *= readLightScale(p);
    L_ *= readTotal(p, "illuminance", p.has("illuminance") ? illuminance() : 1,
                    "of a surface that faces +z of the light's space, for L = 1; instead of the "
                    "picture's own",
                    "lx");
    samples_ = readLightSamples(p);
    if (!p.points("portal", "without effect yet: light is not guided through windows").empty())
      p.warn("portal",
             "has no effect yet: where light comes in elsewhere, too, it is there; where not, the "
             "picture is the same, but noisier");
  }

  // pbrt-v4 has square pictures in the equal-area map, the others have the latitude and longitude.
  static SphereMap readMap(Params& p, const Picture& picture) {
    const bool square = picture.width() == picture.height() && picture.width() > 1;
    constexpr std::string_view maps[] = {"latlong", "equalarea"};
    const std::string map =
        p.choice("mapping", maps, p.has("filename") && square ? "equalarea" : "latlong",
                 "how the sphere fills the picture: by the angles to +z (the top row) and about "
                 "it, or as pbrt-v4 has it (+z in the middle), which is the default of a square "
                 "one given by \"filename\"");
    if (map == "equalarea" && picture.width() != picture.height())
      p.fail("mapping", "cannot be \"equalarea\": the picture is not square");
    return map == "equalarea" ? SphereMap::equalarea : SphereMap::latlong;
  }

  static Wrap wrapOf(SphereMap map) {
    return map == SphereMap::latlong ? Wrap::latlong : Wrap::octahedral;
  }
  Spectrum radiance(DVec2 st) const { return L_ * picture_.at(Point2(st), wrapOf(map_)); }

  // sin^2(theta / 2) = (1 - cos(theta)) / 2 at the upper edge of a row: the share of the sphere
  // above it, exact near both poles.
  static double shareAbove(const Picture& picture, int y) {
    return sqr(std::sin(0.5 * std::numbers::pi * y / picture.height()));
  }
  // The share of the sphere that a cell has, times the number of columns.
  static double shareOfRow(const Picture& picture, SphereMap map, int y) {
    return map == SphereMap::equalarea ? 1.0 / picture.height()
                                       : shareAbove(picture, y + 1) - shareAbove(picture, y);
  }
  // t at the share v of the solid angle of a row.
  double rowPosition(int y, float v) const {
    if (map_ == SphereMap::equalarea) return (y + double{v}) / picture_.height();
    const double above = shareAbove(picture_, y), below = shareAbove(picture_, y + 1);
    return 2 / std::numbers::pi * std::asin(std::sqrt(std::min(1.0, above + v * (below - above))));
  }

  // The luminance of each cell times its solid angle. Over a cell the interpolated radiance has the
  // mean of the pixel and its neighbours with weights 3/4 and 1/8 along each side.
  static std::vector<double> weights(const Picture& picture, SphereMap map) {
    const int w = picture.width(), h = picture.height();
    std::vector<double> result;
    result.reserve(static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
    constexpr std::array<float, 3> share = {0.125F, 0.75F, 0.125F};
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        double sum = 0;
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i) {
            int column = x + i, row = y + j;
            wrapPixel(wrapOf(map), w, h, column, row);
            sum += double{share[i + 1] * share[j + 1]} * luminance(picture.pixel(column, row));
          }
        result.push_back(sum * shareOfRow(picture, map, y));
      }
    return result;
  }

  // Of the picture over the sphere.
  static Spectrum integral(const Picture& picture, SphereMap map) {
    DVec3 sum(0);
    for (int y = 0; y < picture.height(); ++y) {
      DVec3 row(0);
      for (int x = 0; x < picture.width(); ++x) row += DVec3(picture.pixel(x, y));
      sum += row * shareOfRow(picture, map, y);
    }
    return Spectrum(sum * (4 * std::numbers::pi / picture.width()));
  }

  // From the sphere about a cell to render space: a map that is no rotation changes solid angles by
  // its determinant over the cube of how it stretches the direction.
  float density(double chance, int y, double stretch) const {
    const double angle = 4 * std::numbers::pi * shareOfRow(picture_, map_, y) / picture_.width();
    return static_cast<float>(chance / angle * stretch * stretch * stretch / determinant_);
  }

  // What a surface that faces +z receives of the picture, for L = 1.
  float illuminance() const {
    if (picture_.width() * picture_.height() == 1) return kPi * luminance(picture_.pixel(0, 0));
    double sum = 0;
    for (int y = 0; y < picture_.height(); ++y)
      for (int x = 0; x < picture_.width(); ++x) {
        const DVec2 middle((x + 0.5) / picture_.width(), rowPosition(y, 0.5F));
        sum += std::max(0.0, sphereFromSquare(map_, middle).z) * cells_.chance(x, y);
      }
    // The weights, whose total the chances lack, hold the share of the sphere times the columns.
    return static_cast<float>(sum * cells_.total() * 4 * std::numbers::pi / picture_.width());
  }

  Spectrum L_;
  Picture picture_;
  SphereMap map_;
  glm::dmat3 toRender_, toLight_;
  double determinant_;
  Distribution2D cells_;
  Spectrum total_;  // the picture's integral over the sphere
};

}  // namespace
}  // namespace pbrt

PBRT_PLUGIN(Light, pbrt::Infinite, "infinite", "light from all around, such as the sky's")
