#include "tests/fuzz/scene_target.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/parse/format.h"
#include "core/parse/parse.h"
#include "core/scene/builder.h"
#include "core/scene/render.h"
#include "tests/core/parse/meaning.h"

namespace pbrt::fuzz {
namespace {

void require(bool holds, const std::string& law) {
  if (!holds) throw BrokenLaw(law);
}

// The parts of an input, and its file as long as it lives.
class Input {
 public:
  explicit Input(const std::string& bytes) : text_(bytes) {
    constexpr std::string_view kMark = "\n#file.";
    const std::size_t mark = bytes.find(kMark);
    if (mark == bytes.npos) return;
    const std::size_t suffix = mark + kMark.size();
    const std::size_t end = bytes.find_first_not_of("abcdefghijklmnopqrstuvwxyz", suffix);
    if (end == bytes.npos || bytes[end] != '\n' || end - suffix > 10) return;
    file_ = bytes.substr(mark + 2, end - mark - 2);
    text_.resize(mark + 1);
    std::ofstream(file_, std::ios::binary) << std::string_view(bytes).substr(end + 1);
  }
  ~Input() {
    std::error_code ignored;
    if (!file_.empty()) std::filesystem::remove(file_, ignored);
  }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  const std::string& text() const { return text_; }
  std::optional<Dialect> dialect() const {
    if (!text_.starts_with("# ") || text_.find('\n') != 4) return {};
    return dialectByName(std::string_view(text_).substr(2, 2));
  }

 private:
  std::string text_;
  std::filesystem::path file_;
};

// What takes any time or memory because the scene asks for it by a number is no find.
void makeCheap(Directive& d) {
  constexpr std::array kCounts{"maxdepth", "nsamples", "samples", "octaves", "levels", "nlevels"};
  for (Param& p : d.params) {
    auto* ints = std::get_if<std::vector<int>>(&p.values);
    if (ints && std::ranges::find(kCounts, p.name) != kCounts.end())
      for (int& value : *ints) value = std::min(value, 4);
    auto* floats = std::get_if<std::vector<float>>(&p.values);
    if (floats && d.kind == DirectiveKind::PixelFilter)
      for (float& width : *floats) width = std::min(width, 4.F);
  }
}

void checkMessages(const std::vector<Diagnostic>& diagnostics) {
  for (const Diagnostic& d : diagnostics) {
    require(!d.message.empty(), "a diagnostic says something");
    require(d.quoteColumn <= d.quote.size(), "the caret is in the quoted line");
    format(d);
  }
}

struct Printed {
  std::string text;
  std::vector<test::Meaning> scene;
  Dialect dialect = Dialect::v1;
};

Printed print(const std::string& text) {
  Printed out;
  Formatter formatter;
  DialectDetector detector;
  Parser parser([&](Directive&& d) {
    out.text += formatter.print(d);
    detector.look(d);
    out.scene.emplace_back(d);
  });
  parser.text("fuzz", text);
  out.dialect = detector.result().dialect;
  return out;
}

void checkFormat(const std::string& text) {
  const Printed first = print(text);
  const Printed second = print(first.text);
  require(first.scene == second.scene, "a printed scene is the same scene");
  require(first.text == second.text, "what is printed is printed as it is");
  require(first.dialect == second.dialect, "a printed scene is of the same generation");
}

void renderPixels(Scene& scene) {
  RenderControl control;
  control.threads = 1;
  scene.integrator().render(scene, scene.sampler(), scene.film(), control);
  for (const std::vector<float>& channel : scene.film().image().channels)
    require(std::ranges::none_of(channel, [](float x) { return std::isnan(x); }),
            "pixels are numbers");
}

void render(PluginLoader& loader, const Input& input, bool permissive) {
  std::vector<Diagnostic> told;
  BuildOptions options;
  options.dialect = input.dialect();
  options.threads = 1;
  options.samplesPerPixel = 1;
  options.pixelBounds = {0, 4, 0, 4};
  options.permissive = permissive;
  options.report = [&](const Diagnostic& d) { told.push_back(d); };
  SceneReader reader(loader, options);
  Parser parser(
      [&](Directive&& d) {
        makeCheap(d);
        reader.read(std::move(d));
      },
      permissive ? options.report : Reporter());
  parser.text("fuzz", input.text());
  const auto scene = reader.finish();
  renderPixels(*scene);
  checkMessages(told);
  const bool errors = std::ranges::count(told, Severity::error, &Diagnostic::severity) > 0;
  require(errors == permissive, permissive ? "what is refused is reported when it is passed over"
                                           : "a scene with errors is refused");
}

// Runs what may refuse its input. Returns whether it did not.
template <class Body>
bool accepts(const Body& body) {
  try {
    body();
    return true;
  } catch (const Error& error) {
    checkMessages(error.diagnostics());
    require(error.failure() == Failure::scene || error.failure() == Failure::io,
            std::string("the scene is to blame, not the program: ") + error.what());
    return false;
  }
}

}  // namespace

SceneTarget::SceneTarget() : loader_(PluginLoader::searchPath("")) {
  for (std::uint32_t i = 0; i < kPluginKinds; ++i)
    for (const std::string& name : loader_.available(static_cast<PluginKind>(i)))
      loader_.open(static_cast<PluginKind>(i), name);
}

bool SceneTarget::run(const std::string& bytes) {
  const Input input(bytes);
  accepts([&] { checkFormat(input.text()); });
  const bool good = accepts([&] { render(loader_, input, false); });
  if (!good) accepts([&] { render(loader_, input, true); });
  return good;
}

}  // namespace pbrt::fuzz
