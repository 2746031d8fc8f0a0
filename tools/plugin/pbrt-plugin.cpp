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
  // CLI11 would only say that one is required.
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' && std::ranges::find(names, argv[1]) == names.end()) {
    fmt::print(stderr, "error: there is no command \"{}\" (it is one of {}){}\n",
               pbrt::shown(argv[1]), fmt::join(names, ", "), pbrt::didYouMean(argv[1], names));
    return static_cast<int>(pbrt::Failure::usage);
  }
  constexpr int bug = 5;  // 1 would say that the plug-in breaks a law
  const auto body = [&] { return *writing ? pbrt::writeNew(plugin) : pbrt::check(checking); };
  return pbrt::runCommand(app, pbrt::reversedWords(argc, argv), body, bug);
}
