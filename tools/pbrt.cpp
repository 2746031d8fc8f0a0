// The command: reads scenes, renders, writes pictures.

#include <fmt/format.h>

#include "command.h"
#include "core/parse/format.h"
#include "core/plugin/culprit.h"
#include "crash.h"
#include "frames.h"
#include "listing.h"
#include "options.h"
#include "reading.h"
#include "rendering.h"

namespace pbrt {
namespace {

int formatScene(const Options& o, PluginLoader& /*loader*/) {
  Formatter formatter;
  std::string text;
  Parser parser([&](Directive&& d) { text += formatter.print(d); }, includes(o), o.frame);
  parse(parser, o.files);
  fmt::print("{}", text);
  return judge(o);
}

int check(const Options& o, PluginLoader& loader) {
  SceneReader reader(loader, o.build);
  Parser parser([&](Directive&& d) { reader.read(std::move(d)); }, includes(o), o.frame);
  parse(parser, o.files);
  const auto scene = reader.finish();
  const DetectedDialect& dialect = reader.dialect();
  if (!o.quiet)
    fmt::print("{}: pbrt-{} ({}); {} shapes, {} lights, {} instances, {} plug-ins\n",
               fmt::join(o.files, " "), dialectName(dialect.dialect), dialect.reason,
               scene->shapes(), scene->lights().size(), scene->instances(), loader.opened().size());
  return judge(o);
}

int run(const Options& o) {
  const auto carryOut = o.check ? check : o.format ? formatScene : render;
  PluginLoader loader(PluginLoader::searchPath(o.pluginPath));
  if (o.listPlugins)
    fmt::print("{}", listPlugins(loader));
  else if (!o.describe.empty())
    fmt::print("{}", o.describe[0] == "all" ? describeAll(loader)
                                            : describePlugin(loader, o.describe[0], o.describe[1]));
  else if (!o.frames.empty())
    return forFrames(o, carryOut);
  else
    return carryOut(o, loader);
  return 0;
}

}  // namespace
}  // namespace pbrt

int main(int argc, char** argv) {
  pbrt::Options options;
  CLI::App app("pbrt renders scenes described in the pbrt format.", "pbrt");
  pbrt::defineOptions(app, options);
  return pbrt::runCommand(app, pbrt::words(argc, argv), [&] {
    try {
      pbrt::finishOptions(options);
      pbrt::tellOfCrashes();
      return pbrt::run(options);
    } catch (...) {
      fmt::print("{}", pbrt::failureLine(options.progress, pbrt::whatWasThrown()));
      std::rethrow_exception(pbrt::asError());
    }
  });
}
