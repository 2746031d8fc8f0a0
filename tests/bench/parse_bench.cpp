// How fast scene text becomes directives, beside a plain read of the same file.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <deque>
#include <filesystem>
#include <fstream>

#include "core/base/rng.h"
#include "core/parse/parse.h"

namespace pbrt {
namespace {

// A file under the temporary folder, gone at the end of the program.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& text)
      : path_(std::filesystem::temp_directory_path() / name) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// One mesh: a list of numbers of each kind.
std::string mesh() {
  Rng rng(1);
  std::string text = "Shape \"trianglemesh\" \"integer indices\" [";
  for (int i = 0; i < 1500000; ++i) text += fmt::format("{} ", rng.uniform(1000000));
  text += "]\n\"point P\" [";
  for (int i = 0; i < 1500000; ++i) text += fmt::format("{:.6f} ", 100 * rng.uniform() - 50);
  text += "]\n\"normal N\" [";
  for (int i = 0; i < 750000; ++i) text += fmt::format("{} ", rng.uniform());
  return text + "]\n";
}

// A landscape: one plant in many places.
std::string instances() {
  Rng rng(2);
  std::string text;
  for (int i = 0; i < 70000; ++i) {
    text += "AttributeBegin\n  Transform [";
    for (int k = 0; k < 16; ++k) text += fmt::format(" {}", rng.uniform());
    text += " ]\n  ObjectInstance \"plant\"\nAttributeEnd\n";
  }
  return text;
}

std::string transforms() {
  Rng rng(3);
  std::string text;
  for (int i = 0; i < 100000; ++i)
    text += fmt::format(
        "AttributeBegin\nTranslate {} {} {}\nShape \"sphere\" \"float radius\" [{}]\n"
        "AttributeEnd\n",
        rng.uniform(), rng.uniform(), rng.uniform(), rng.uniform());
  return text;
}

std::string smallShapes() {
  Rng rng(4);
  std::string text;
  for (int i = 0; i < 300000; ++i)
    text += fmt::format("Shape \"sphere\" \"float radius\" {:.4f} \"point P\" [ {} {} 0 ]\n",
                        rng.uniform(), rng.uniform(), rng.uniform());
  return text;
}

// As exporters of pbrt-v4 write: defaults, and a material for each shape.
std::string attributes() {
  Rng rng(5);
  std::string text = "Attribute \"material\" \"bool remaproughness\" [ false ]\n";
  for (int i = 0; i < 50000; ++i)
    text += fmt::format(
        "AttributeBegin\n  Attribute \"shape\" \"float alpha\" {}\n"
        "  Material \"coateddiffuse\"\n    \"rgb reflectance\" [ {} {} {} ]\n"
        "    \"texture displacement\" \"bumps-{}\"\n  NamedMaterial \"wood-{}\"\n"
        "  Shape \"plymesh\" \"string filename\" [ \"geometry/mesh_{:05}.ply\" ]\n"
        "AttributeEnd\n",
        rng.uniform(), rng.uniform(), rng.uniform(), rng.uniform(), i, i, i);
  return text;
}

void countBytes(benchmark::State& state, const std::filesystem::path& path) {
  state.SetBytesProcessed(state.iterations() *
                          static_cast<std::int64_t>(std::filesystem::file_size(path)));
}

void readOnly(benchmark::State& state, const std::filesystem::path& path) {
  for (auto _ : state) {
    std::ifstream in(path, std::ios::binary);
    std::string text(std::filesystem::file_size(path), '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    benchmark::DoNotOptimize(text.data());
  }
  countBytes(state, path);
}

void parse(benchmark::State& state, const std::filesystem::path& path) {
  for (auto _ : state) {
    Parser parser([](Directive&& directive) { benchmark::DoNotOptimize(directive.kind); });
    parser.file(path);
  }
  countBytes(state, path);
}

void compare(const std::string& name, std::string (*text)()) {
  static std::deque<TemporaryFile> files;
  const std::filesystem::path path =
      files.emplace_back("pbrt_bench_" + name + ".pbrt", text()).path();
  for (const auto& [what, run] : {std::pair{"read/", &readOnly}, std::pair{"parse/", &parse}})
    benchmark::RegisterBenchmark((what + name).c_str(), run, path)->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace pbrt

int main(int count, char** arguments) {
  benchmark::Initialize(&count, arguments);
  pbrt::compare("mesh", pbrt::mesh);
  pbrt::compare("instances", pbrt::instances);
  pbrt::compare("transforms", pbrt::transforms);
  pbrt::compare("small shapes", pbrt::smallShapes);
  pbrt::compare("attributes", pbrt::attributes);
  benchmark::RunSpecifiedBenchmarks();
}
