// What the renderer adds to a camera ray: sampler, camera, film and the loop over tiles, beside
// bare Embree on the same rays. One thread. "of_single" and "of_packets" are the parts of bare
// Embree's rays per second, with single rays and with packets of 16, that the whole loop reaches.

#include <benchmark/benchmark.h>
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <fmt/format.h>

#include <chrono>

#include "tests/scenes.h"

namespace pbrt {
namespace {

constexpr int kSize = 512, kGrid = 200;

// A bumpy sheet of 80,000 triangles.
struct Sheet {
  std::vector<float> points;
  std::vector<int> indices;

  Sheet() {
    for (int j = 0; j <= kGrid; ++j)
      for (int i = 0; i <= kGrid; ++i) {
        const float x = 4.F * i / kGrid - 2, y = 4.F * j / kGrid - 2;
        points.insert(points.end(), {x, y, 0.2F * std::sin(7 * x) * std::cos(5 * y)});
      }
    for (int j = 0; j < kGrid; ++j)
      for (int i = 0; i < kGrid; ++i) {
        const int a = j * (kGrid + 1) + i, b = a + kGrid + 1;
        indices.insert(indices.end(), {a, a + 1, b, a + 1, b + 1, b});
      }
  }
};

std::unique_ptr<Scene> buildSheet(const Sheet& sheet) {
  const std::string options = fmt::format(
      "LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 40\n"
      "Film \"image\" \"integer xresolution\" {0} \"integer yresolution\" {0}\n"
      "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 1 Integrator \"whitted\" WorldBegin\n",
      kSize);
  return test::buildText(
      fmt::format("{}Shape \"trianglemesh\" \"point P\" [{}] \"integer indices\" [{}] WorldEnd",
                  options, fmt::join(sheet.points, " "), fmt::join(sheet.indices, " ")));
}

// Asks for nothing but the hit.
class Depth final : public SamplingIntegrator {
 public:
  Spectrum Li(const World&, const RayDifferential&, const Hit& hit, Sampler&,
              Scratch&) const override {
    return Spectrum(hit.found() ? hit.t : 0);
  }
};

// Bare Embree over the same triangles, with the same flags.
class Bare {
 public:
  explicit Bare(Sheet& sheet) : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    sheet.points.reserve(sheet.points.size() + 3);
    RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sheet.points.data(),
                               0, 12, sheet.points.size() / 3);
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sheet.indices.data(),
                               0, 12, sheet.indices.size() / 3);
    rtcCommitGeometry(g);
    rtcAttachGeometry(scene_, g);
    rtcReleaseGeometry(g);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_);
  }
  ~Bare() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  float single(const std::vector<Ray>& rays) const {
    float sum = 0;
    for (const Ray& r : rays) {
      RTCRayHit e;
      e.ray = {r.o.x, r.o.y, r.o.z, 0, r.d.x, r.d.y, r.d.z, 0, r.tMax, ~0U, 0, 0};
      e.hit.geomID = e.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
      rtcIntersect1(scene_, &e, nullptr);
#else
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcIntersect1(scene_, &context, &e);
#endif
      if (e.hit.geomID != RTC_INVALID_GEOMETRY_ID) sum += e.ray.tfar;
    }
    return sum;
  }

  float packets(const std::vector<Ray>& rays) const {
    float sum = 0;
    alignas(64) std::array<int, 16> valid;
    valid.fill(-1);
    for (std::size_t first = 0; first + 16 <= rays.size(); first += 16) {
      alignas(64) RTCRayHit16 e;
      for (int i = 0; i < 16; ++i) {
        const Ray& r = rays[first + static_cast<std::size_t>(i)];
        e.ray.org_x[i] = r.o.x, e.ray.org_y[i] = r.o.y, e.ray.org_z[i] = r.o.z;
        e.ray.dir_x[i] = r.d.x, e.ray.dir_y[i] = r.d.y, e.ray.dir_z[i] = r.d.z;
        e.ray.tnear[i] = 0, e.ray.tfar[i] = r.tMax, e.ray.time[i] = 0, e.ray.mask[i] = ~0U;
        e.ray.id[i] = e.ray.flags[i] = 0;
        e.hit.geomID[i] = e.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      }
#if RTC_VERSION_MAJOR >= 4
      RTCIntersectArguments arguments;
      rtcInitIntersectArguments(&arguments);
      arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
      rtcIntersect16(valid.data(), scene_, &e, &arguments);
#else
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
      rtcIntersect16(valid.data(), scene_, &context, &e);
#endif
      for (int i = 0; i < 16; ++i)
        if (e.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) sum += e.ray.tfar[i];
    }
    return sum;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

// The camera's rays, 4 x 4 pixels after 4 x 4 pixels, as the loop over tiles takes them.
std::vector<Ray> cameraRays(const Scene& scene) {
  std::vector<Ray> rays;
  const auto sampler = scene.sampler().clone();
  for (int y = 0; y < kSize; y += 4)
    for (int x = 0; x < kSize; x += 4)
      for (int i = 0; i < 16; ++i) {
        const Point2i pixel(x + i % 4, y + i / 4);
        sampler->start(pixel, 0);
        rays.push_back(
            scene.camera().generate({Point2(pixel) + sampler->pixel2D(), {}, 0}, false).ray);
      }
  return rays;
}

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void cameraRaysBesideBareEmbree(benchmark::State& state) {
  Sheet sheet;
  const auto scene = buildSheet(sheet);
  const Bare bare(sheet);
  const std::vector<Ray> rays = cameraRays(*scene);
  const Depth depth;
  double whole = 0, single = 0, packets = 0;
  for (auto _ : state) {
    RenderControl control;
    control.threads = 1;
    const double t0 = seconds();
    depth.render(*scene, scene->sampler(), scene->film(), control);
    const double t1 = seconds();
    benchmark::DoNotOptimize(bare.single(rays));
    const double t2 = seconds();
    benchmark::DoNotOptimize(bare.packets(rays));
    const double t3 = seconds();
    whole += t1 - t0, single += t2 - t1, packets += t3 - t2;
  }
  const double count = static_cast<double>(rays.size()) * static_cast<double>(state.iterations());
  state.counters["rays/s"] = count / whole;
  state.counters["single_rays/s"] = count / single;
  state.counters["packet_rays/s"] = count / packets;
  state.counters["of_single"] = single / whole;
  state.counters["of_packets"] = packets / whole;
}
BENCHMARK(cameraRaysBesideBareEmbree)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pbrt
