// How long a large scene takes from its text to the ray tree, beside a plain read of the same file,
// and how much memory that needs at most.

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <deque>
#include <filesystem>
#include <fstream>

#include "core/base/rng.h"
#include "core/parse/parse.h"
#include "core/plugin/loader.h"
#include "core/scene/builder.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;

// A net of n x n vertices, about 36 bytes for each of its triangles.
void mesh(std::ostream& out, int n, Rng& rng) {
  out << "Shape \"trianglemesh\" \"integer indices\" [\n";
  for (int i = 0; i + 1 < n; ++i)
    for (int j = 0; j + 1 < n; ++j) {
      const int a = i * n + j;
      out << fmt::format("{} {} {} {} {} {}\n", a, a + 1, a + n, a + 1, a + n + 1, a + n);
    }
  out << "] \"point P\" [\n";
  for (int i = 0; i < n * n; ++i)
    out << fmt::format("{:.6f} {:.6f} {:.6f}\n", double(i / n) / n, 0.02 * rng.uniform(),
                       double(i % n) / n);
  out << "]\n";
}

// 70,000 plants of four kinds: about 110 MB of text.
void landscape(std::ostream& out) {
  Rng rng(1);
  out << "WorldBegin\nLightSource \"distant\"\n";
  for (int kind = 0; kind < 4; ++kind) {
    out << fmt::format("ObjectBegin \"plant{}\"\n", kind);
    mesh(out, 600, rng);
    out << "ObjectEnd\n";
  }
  for (int i = 0; i < 70000; ++i)
    out << fmt::format(
        "AttributeBegin\nTransform [{:.6f} 0 {:.6f} 0 0 1 0 0 -{:.6f} 0 {:.6f} 0 {:.3f} 0 {:.3f} "
        "1]\n"
        "ObjectInstance \"plant{}\"\nAttributeEnd\n",
        rng.uniform(), rng.uniform(), rng.uniform(), 0.5 + rng.uniform(), 600 * rng.uniform(),
        600 * rng.uniform(), i % 4);
  out << "WorldEnd\n";
}

// The same four meshes, and nobody asks for them.
void unused(std::ostream& out) {
  Rng rng(1);
  out << "WorldBegin\nLightSource \"distant\"\nShape \"sphere\"\n";
  for (int kind = 0; kind < 4; ++kind) {
    out << fmt::format("ObjectBegin \"plant{}\"\n", kind);
    mesh(out, 600, rng);
    out << "ObjectEnd\n";
  }
  out << "WorldEnd\n";
}

// As exporters write: each shape in a block, with textures and a material of its own.
void materials(std::ostream& out) {
  out << "WorldBegin\nLightSource \"distant\"\n";
  for (int i = 0; i < 20000; ++i)
    out << fmt::format(
        "Texture \"t{}\" \"spectrum\" \"constant\" \"rgb value\" [ 0.{} 0.5 0.5 ]\n"
        "MakeNamedMaterial \"m{}\" \"string type\" \"matte\" \"texture Kd\" \"t{}\"\n",
        i, i, i, i);
  for (int i = 0; i < 20000; ++i)
    out << fmt::format(
        "AttributeBegin\nTranslate {} 0 {}\nNamedMaterial \"m{}\"\n"
        "Shape \"sphere\" \"float radius\" 0.3\nAttributeEnd\n",
        i % 200, i / 200, i);
  out << "WorldEnd\n";
}

using Write = void (*)(std::ostream&);

// A file that is written when it is first asked for, and goes away with the program. The memory
// that its text needs meanwhile is no scene's.
class Scenery {
 public:
  Scenery(const std::string& name, Write write)
      : path_(fs::temp_directory_path() / fmt::format("pbrt_{}_{}.pbrt", name, getpid())),
        write_(write) {}
  ~Scenery() { fs::remove(path_); }
  Scenery(const Scenery&) = delete;
  Scenery& operator=(const Scenery&) = delete;
  const fs::path& path() const {
    if (!fs::exists(path_)) {
      std::ofstream out(path_, std::ios::binary);
      write_(out);
    }
    return path_;
  }

 private:
  fs::path path_;
  Write write_;
};

void count(benchmark::State& state, const fs::path& path) {
  const auto bytes = static_cast<std::int64_t>(fs::file_size(path));
  state.SetBytesProcessed(state.iterations() * bytes);
  state.counters["text MB"] = static_cast<double>(bytes) / 1e6;
}

void read(benchmark::State& state, const Scenery& scenery) {
  const fs::path& path = scenery.path();
  for (auto _ : state) {
    std::ifstream in(path, std::ios::binary);
    std::string text(fs::file_size(path), '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    benchmark::DoNotOptimize(text.data());
  }
  count(state, path);
}

void build(benchmark::State& state, const Scenery& scenery) {
  const fs::path& path = scenery.path();
  std::size_t instances = 0;
  for (auto _ : state) {
    PluginLoader loader({PBRT_BUILD_DIR "/lib/pbrt"});
    SceneReader reader(loader, {});
    Parser parser([&](Directive&& d) { reader.read(std::move(d)); });
    parser.file(path);
    instances = reader.finish()->instances();
  }
  count(state, path);
  state.counters["instances"] = static_cast<double>(instances);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  state.counters["peak MB"] = static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;  // of all so far
}

void compare(const std::string& name, Write write) {
  static std::deque<Scenery> files;
  const Scenery* scenery = &files.emplace_back(name, write);
  const auto add = [&](const std::string& what, void (*run)(benchmark::State&, const Scenery&)) {
    benchmark::RegisterBenchmark((what + name).c_str(), [=](auto& state) { run(state, *scenery); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  add("build/", &build);  // first: the read holds the text as well
  add("read/", &read);
}

}  // namespace
}  // namespace pbrt

int main(int count, char** arguments) {
  benchmark::Initialize(&count, arguments);
  pbrt::compare("materials", pbrt::materials);
  pbrt::compare("unused", pbrt::unused);
  pbrt::compare("landscape", pbrt::landscape);
  benchmark::RunSpecifiedBenchmarks();
}
