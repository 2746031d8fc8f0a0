// Judges the pictures of the comparison against the exact surface.
//
// rival-judge depth SCENE.pbrt PICTURE.exr: our own depths (channel Z).
// rival-judge compare CLOUD STRIDE SHEET.png NAME DEPTH SHADE ...: pictures of the same view by any
//   number of programs; prints a line of CSV for each. SHEET shows the shaded ones side by side.
//
// A depth gives a point of space; its distance from the surface is |f| / |grad f| to first order,
// in support radii, over all pixels that show the body. On every STRIDE-th pixel each way the
// 128-bit oracle says what is to be seen: nothing, the surface in the light, or in the shadow.

#include <fmt/format.h>

#include <map>
#include <unordered_map>

#include "cloud.h"
#include "core/base/image.h"
#include "core/parse/parse.h"
#include "core/plugin/loader.h"
#include "core/scene/builder.h"
#include "tests/shapes/metaballs/clouds.h"
#include "tests/shapes/metaballs/oracle.h"

namespace pbrt::rivals {
namespace {

using metaballs::Field;

// Binary 16-bit PPM, as POV-Ray writes it; values from 0 to 1.
Image readPpm(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  const auto word = [&in] {
    std::string w;
    while (in >> w && w[0] == '#') std::getline(in, w);
    return w;
  };
  Image image;
  if (word() != "P6") throw Error(file + " is not a PPM file", Failure::io);
  image.resolution.x = std::stoi(word());
  image.resolution.y = std::stoi(word());
  if (word() != "65535") throw Error(file + " has not 16 bits", Failure::io);
  in.get();
  image.window = {Point2i(0), image.resolution};
  image.names = {"R", "G", "B"};
  image.channels.assign(3, {});
  for (int i = 0; i < image.resolution.x * image.resolution.y; ++i)
    for (auto& channel : image.channels) {
      const int high = in.get();
      channel.push_back(static_cast<float>(256 * high + in.get()) / 65535);
    }
  if (!in) throw Error(file + " ends too soon", Failure::io);
  return image;
}

// The depths of a picture; 0 where there is nothing. In a PPM red is the place between near and
// far, green the place within one of 64 equal slices of it.
std::vector<float> readDepths(const std::string& file, const Cloud& cloud) {
  if (!file.ends_with(".ppm")) {
    const Image image = readExr(file);
    const auto* z = image.channel("Z");
    return z ? *z : *image.channel("R");
  }
  const Image image = readPpm(file);
  const double slice = (cloud.far - cloud.near) / 64;
  std::vector<float> depths;
  for (std::size_t i = 0; i < image.channels[0].size(); ++i) {
    const double coarse = image.channels[0][i], fine = image.channels[1][i];
    const double z = cloud.near + slice * (std::round(64 * coarse - fine) + fine);
    depths.push_back(coarse == 0 && fine == 0 ? 0 : static_cast<float>(z));
  }
  return depths;
}

std::vector<float> readShade(const std::string& file) {
  const Image image = file.ends_with(".ppm") ? readPpm(file) : readExr(file);
  return *image.channel("R");
}

// The field about the eye, and which of its atoms are near: buckets as wide as a support.
class Exact {
 public:
  explicit Exact(const Cloud& cloud)
      : cloud_(cloud),
        kernel_(cloud.kernel == "blob" ? metaballs::Kernel::blob : metaballs::Kernel::wyvill),
        field_(kernel_, {}) {
    std::vector<metaballs::Atom> atoms;
    for (std::uint32_t i = 0; i < cloud.atoms.size(); ++i) {
      atoms.push_back(metaballs::test::atom(kernel_, Point3(cloud.centre(i)),
                                            static_cast<float>(cloud.radius),
                                            cloud.atoms[i][3] / cloud.threshold));
      buckets_[key(bucket(cloud.centre(i)))].push_back(i);
    }
    field_ = Field(kernel_, std::move(atoms));
  }

  // How far a point is from the surface, in support radii; 1 where the field cannot tell.
  double distance(const DPoint3& p) const {
    std::vector<std::uint32_t> near;
    const glm::i64vec3 middle = bucket(p);
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (const auto at = buckets_.find(key(middle + glm::i64vec3(x, y, z)));
              at != buckets_.end())
            near.insert(near.end(), at->second.begin(), at->second.end());
    const metaballs::FieldSample f = field_.sample(p, near);
    const double d = std::abs(f.value) / glm::length(f.gradient) / cloud_.radius;
    return d < 1 ? d : 1;
  }

  // The first crossing beyond tMin.
  std::optional<double> first(const ObjectRay& ray) const {
    std::vector<metaballs::Atom> near;
    const DVec3 d = glm::normalize(ray.d);
    for (const metaballs::Atom& atom : field_.atoms()) {
      const DVec3 v = DPoint3(atom.centre) - ray.o;
      if (lengthSquared(v - glm::dot(v, d) * d) < 1.001 * sqr(cloud_.radius)) near.push_back(atom);
    }
    const auto t = metaballs::test::Oracle(Field(kernel_, std::move(near)), ray).first();
    return t ? std::optional(static_cast<double>(*t)) : std::nullopt;
  }

 private:
  glm::i64vec3 bucket(const DPoint3& p) const { return glm::floor(p / cloud_.radius); }
  static std::uint64_t key(const glm::i64vec3& b) { return hash(b.x, b.y, b.z); }

  const Cloud& cloud_;
  metaballs::Kernel kernel_;
  Field field_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> buckets_;
};

struct Truth {
  double depth = 0;  // 0: nothing
  bool lit = false;
};

Truth see(const Cloud& cloud, const Exact& exact, int x, int y) {
  const DVec3 d = cloud.direction(x, y);
  const auto t = exact.first({cloud.eye, d});
  if (!t) return {};
  const DPoint3 p = cloud.eye + *t * d;
  // Starts within the rounding of p. What leaves into the body meets its far side.
  const DVec3 w = cloud.light - p;
  const double start = 1e-8 * cloud.radius / glm::length(w);
  return {*t, !exact.first({p, w, start, 1})};
}

// What one program shows, and how far it is from the truth.
struct Judgement {
  std::string name;
  std::vector<float> depth;
  std::vector<float> shade;
  int hits = 0;                 // of all pixels
  double sum = 0, largest = 0;  // distances from the surface
  int lost = 0, invented = 0;   // of the sampled pixels: the body is not seen; it should not be
  int other = 0;                // another place of the surface than the first, by more than h / 10
  int dark = 0, bright = 0;     // wrongly in the shadow, in the light

  bool lit(std::size_t i) const { return shade[i] > 0; }

  void measure(const Cloud& cloud, const Exact& exact) {
    for (int y = 0, i = 0; y < cloud.pixels; ++y)
      for (int x = 0; x < cloud.pixels; ++x, ++i) {
        if (!(depth[i] > 0)) continue;
        const double d = exact.distance(cloud.eye + double{depth[i]} * cloud.direction(x, y));
        ++hits;
        sum += d;
        largest = std::max(largest, d);
      }
  }
  void judge(std::size_t pixel, const Truth& truth, double radius) {
    const double z = depth[pixel];
    if (!truth.depth)
      invented += z > 0;
    else if (!(z > 0))
      ++lost;
    else if (std::abs(z - truth.depth) > 0.1 * radius)
      ++other;
    else if (lit(pixel) != truth.lit)
      ++(truth.lit ? dark : bright);
  }
};

// All shaded pictures in a row, each with its brightest pixel but few at 1.
void writeSheet(const std::string& file, const std::vector<Judgement>& all, int pixels) {
  Image sheet;
  sheet.resolution = {pixels * static_cast<int>(all.size()), pixels};
  sheet.window = {Point2i(0), sheet.resolution};
  sheet.names = {"R", "G", "B"};
  std::vector<float> row(static_cast<std::size_t>(sheet.resolution.x * pixels));
  for (std::size_t k = 0; k < all.size(); ++k) {
    std::vector<float> from = all[k].shade;
    for (float& x : from) x = x > 0 ? x : 0;  // what is not a number too
    std::vector<float> sorted = from;
    const auto high = sorted.begin() + static_cast<std::ptrdiff_t>(0.99 * sorted.size());
    std::ranges::nth_element(sorted, high);
    const float scale = *high > 0 ? 0.9F / *high : 1;
    for (std::size_t i = 0; i < from.size(); ++i)
      row[(i / pixels * all.size() + k) * pixels + i % pixels] = scale * from[i];
  }
  sheet.channels = {row, row, row};
  writeImage(file, sheet);
}

void compare(const std::vector<std::string>& words) {
  const Cloud cloud = readCloud(words[0]);
  const int stride = std::stoi(words[1]);
  const Exact exact(cloud);
  std::vector<Judgement> all;
  for (std::size_t i = 3; i + 2 < words.size(); i += 3) {
    all.push_back({words[i], readDepths(words[i + 1], cloud), readShade(words[i + 2])});
    all.back().measure(cloud, exact);
  }
  int judged = 0;
  for (int y = stride / 2; y < cloud.pixels; y += stride)
    for (int x = stride / 2; x < cloud.pixels; x += stride) {
      const Truth truth = see(cloud, exact, x, y);
      ++judged;
      for (Judgement& j : all) j.judge(y * cloud.pixels + x, truth, cloud.radius);
    }
  fmt::print("program,body,mean error / h,largest,judged,lost,invented,other,dark,bright\n");
  for (const Judgement& j : all)
    fmt::print("{},{},{:.3g},{:.3g},{},{},{},{},{},{}\n", j.name, j.hits,
               j.hits ? j.sum / j.hits : 0, j.largest, judged, j.lost, j.invented, j.other, j.dark,
               j.bright);
  writeSheet(words[2], all, cloud.pixels);
}

void depth(const std::string& file, const std::string& picture) {
  std::vector<Directive> directives;
  Parser parser([&](Directive&& d) { directives.push_back(std::move(d)); });
  parser.file(file);
  PluginLoader loader(PluginLoader::searchPath(""));
  const auto scene = buildScene(std::move(directives), loader, {});
  Image image = scene->film().image();
  image.names = {"Z"};
  image.channels.assign(1, {});
  // Render space is world space about the eye, and the camera looks along z.
  for (int y = 0; y < image.resolution.y; ++y)
    for (int x = 0; x < image.resolution.x; ++x) {
      const CameraSample middle{{x + 0.5F, y + 0.5F}};
      const RayDifferential ray = scene->camera().generate(middle, false).ray;
      const Hit hit = scene->intersect(ray);
      image.channels[0].push_back(hit.found() ? scene->surface(ray, hit).p.z : 0);
    }
  writeImage(picture, image);
}

}  // namespace
}  // namespace pbrt::rivals

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    if (words.size() == 3 && words[0] == "depth")
      pbrt::rivals::depth(words[1], words[2]);
    else if (words.size() > 6 && words[0] == "compare")
      pbrt::rivals::compare({words.begin() + 1, words.end()});
    else
      throw pbrt::Error("rival-judge depth SCENE PICTURE, or compare CLOUD STRIDE SHEET NAME ...");
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
