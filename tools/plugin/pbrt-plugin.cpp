// The command that helps to write plug-ins.

#include "check.h"
#include "new.h"
#include "tools/command.h"

int main(int argc, char** argv) {
  CLI::App app("Helps to write plug-ins for pbrt.", "pbrt-plugin");
  app.set_version_flag("--version", "pbrt-plugin " PBRT_VERSION);
  app.require_subcommand(1);
  pbrt::NewPlugin plugin;
  const CLI::App* const writing = pbrt::addNew(app, plugin);
  pbrt::CheckOptions checking;
  pbrt::addCheck(app, checking);
  constexpr int bug = 5;  // 1 would say that the plug-in breaks a law
  const auto body = [&] { return *writing ? pbrt::writeNew(plugin) : pbrt::check(checking); };
  return pbrt::runCommand(app, pbrt::reversedWords(argc, argv), body, bug);
}
