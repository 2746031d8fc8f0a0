// How fast scene text becomes directives, beside a plain read of the same file.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

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

// One mesh: a list of numbers of each kind, about 32 MB in all.
const std::filesystem::path& mesh() {
  static const TemporaryFile file("pbrt_bench_mesh.pbrt", [] {
    Rng rng(1);
    std::string text = "Shape \"trianglemesh\" \"integer indices\" [";
    for (int i = 0; i < 1500000; ++i) text += fmt::format("{} ", rng.uniform(1000000));
    text += "]\n\"point P\" [";
    for (int i = 0; i < 1500000; ++i) text += fmt::format("{:.6f} ", 100 * rng.uniform() - 50);
    text += "]\n\"normal N\" [";
    for (int i = 0; i < 750000; ++i) text += fmt::format("{} ", rng.uniform());
    return text + "]\n";
  }());
  return file.path();
}

// Many small statements, about 10 MB.
const std::filesystem::path& statements() {
  static const TemporaryFile file("pbrt_bench_statements.pbrt", [] {
    Rng rng(2);
    std::string text;
    for (int i = 0; i < 100000; ++i)
      text += fmt::format(
          "AttributeBegin\nTranslate {} {} {}\nShape \"sphere\" \"float radius\" [{}]\n"
          "AttributeEnd\n",
          rng.uniform(), rng.uniform(), rng.uniform(), rng.uniform());
    return text;
  }());
  return file.path();
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

void readMesh(benchmark::State& state) {
  readOnly(state, mesh());
}
void parseMesh(benchmark::State& state) {
  parse(state, mesh());
}
void readStatements(benchmark::State& state) {
  readOnly(state, statements());
}
void parseStatements(benchmark::State& state) {
  parse(state, statements());
}

BENCHMARK(readMesh)->Unit(benchmark::kMillisecond);
BENCHMARK(parseMesh)->Unit(benchmark::kMillisecond);
BENCHMARK(readStatements)->Unit(benchmark::kMillisecond);
BENCHMARK(parseStatements)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pbrt
