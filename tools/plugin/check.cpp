#include "check.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "apart.h"
#include "core/parse/parse.h"
#include "tools/command.h"
#include "tools/laws/laws.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using laws::Judge;
using laws::Law;

// A law's findings, also on their way from one process to another.
struct Verdict {
  std::size_t trials = 0, failures = 0;
  std::vector<std::string> findings;
  std::string skipped;
  int code = 0;  // not 0: an Error ended the work, with this exit code; its text is the finding
  bool mishap = false, late = false;  // it did not come to its end; not in time
  NLOHMANN_DEFINE_TYPE_INTRUSIVE(Verdict, trials, failures, findings, skipped, code, mishap, late)
};

struct Introduction {
  PluginKind kind{};
  std::string name, summary;
  NLOHMANN_DEFINE_TYPE_INTRUSIVE(Introduction, kind, name, summary)
};

std::string toText(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string textOf(const Error& error) {
  std::string text;
  for (const Diagnostic& d : error.diagnostics())
    text += fmt::format("{}{}", text.empty() ? "" : "\n", format(d));
  return text;
}

// The message alone of what textOf() gives.
std::string plain(const std::string& text) {
  return text.substr(text.find("error: ") + 7);
}

// Puts the question to the plug-in in a process of its own.
template <class Answer, class Ask>
Answer ask(const CheckOptions& o, Verdict& verdict, Ask question) {
  const Ending ending = runApart(
      [&] {
        Json reply;
        try {
          reply["answer"] = question(openPlugin(fs::absolute(o.file)));
        } catch (const Error& error) {
          reply["error"] = textOf(error);
          reply["code"] = static_cast<int>(error.failure());
        }
        return toText(reply);
      },
      o.timeout);
  if (!ending.mishap.empty()) {
    ++verdict.failures, ++verdict.trials;
    verdict.findings.push_back("it " + ending.mishap);
    verdict.mishap = true, verdict.late = ending.late;
    return {};
  }
  const Json reply = Json::parse(ending.text);
  if (!reply.contains("error")) return reply["answer"].get<Answer>();
  ++verdict.failures, ++verdict.trials;
  verdict.findings.push_back(reply["error"]);
  verdict.mishap = true, verdict.code = reply["code"];
  return {};
}

Verdict put(const CheckOptions& o, const ParamList& params, const Law& law) {
  Verdict mishap;
  const auto verdict = ask<Verdict>(o, mishap, [&](const PluginInfo& plugin) {
    Judge judge;
    law.check({&plugin, params, o.traits}, judge);
    return Verdict{judge.trials(), judge.failures(), judge.findings(), judge.skipped()};
  });
  // That of the first law is a message to the user.
  if (mishap.code && law.name != laws::kMade)
    mishap.findings[0] = "it threw an Error: " + plain(mishap.findings[0]);
  return mishap.failures ? mishap : verdict;
}

Introduction introduce(const CheckOptions& o) {
  Verdict mishap;
  auto introduction = ask<Introduction>(o, mishap, [](const PluginInfo& plugin) {
    return Introduction{plugin.kind, plugin.name, plugin.summary};
  });
  if (mishap.code)  // what it was about is in the message
    throw Error(plain(mishap.findings[0]), static_cast<Failure>(mishap.code));
  if (mishap.failures)
    throw Error(fmt::format("{}: opened, {}", o.file, mishap.findings[0]), Failure::plugin);
  return introduction;
}

// A scene finds it by its name, in a folder of its kind.
Verdict isFound(const CheckOptions& o, const Introduction& plugin) {
  Judge judge;
  const fs::path file = fs::absolute(o.file);
  const std::string folder = file.parent_path().filename().string();
  judge.expect(file.filename() == plugin.name + ".so",
               "it calls itself \"{0}\", so its file has to be {0}.so", plugin.name);
  for (std::uint32_t i = 0; i < kPluginKinds; ++i)
    if (folder == kindFolder(static_cast<PluginKind>(i)))
      judge.expect(folder == kindFolder(plugin.kind), "it is a {}, but lies in the folder {}",
                   kindName(plugin.kind), folder);
  return {judge.trials(), judge.failures(), judge.findings(), ""};
}

// The parameters, read as those of a statement. The parser keeps the text to which they point.
ParamList parameters(const CheckOptions& o, const Introduction& plugin,
                     std::unique_ptr<Parser>& keeper) {
  constexpr std::array<std::string_view, kPluginKinds> statements = {
      "Shape",       "Material",   "Texture \"it\" \"spectrum\"",
      "LightSource", "Camera",     "Sampler",
      "PixelFilter", "Integrator", "Volume"};
  std::vector<Directive> directives;
  keeper = std::make_unique<Parser>([&](Directive&& d) { directives.push_back(std::move(d)); });
  keeper->text("parameters",
               fmt::format("{} \"{}\" {}", statements.at(static_cast<std::size_t>(plugin.kind)),
                           plugin.name, o.parameters));
  if (directives.size() != 1)
    throw Error(directives.at(1).where, "there may be nothing here but parameters");
  return std::move(directives[0].params);
}

// The switch by which the user can tell that a plug-in is meant to be so; empty: there is none, or
// it was given.
std::string_view excuse(const CheckOptions& o, std::string_view law) {
  const laws::Traits& t = o.traits;
  if (law == "continuous" && !t.hasSteps) return "--has-steps";
  if (law.ends_with("well-spread") && !t.independentNumbers) return "--independent";
  if (law == "no-energy-is-made" && t.albedo == laws::Traits().albedo) return "--albedo NUMBER";
  if (law == "derivatives-foretell-the-neighbourhood" && t.facingWidth > 0 && !t.looksRound)
    return "--looks-round";
  constexpr std::string_view facing[] = {
      "points-lie-on-the-surface", "normals-do-not-turn-to-the-ray", "rays-leave-the-surface"};
  if (std::ranges::find(facing, law) != std::end(facing) && t.facingWidth == 0)
    return "--facing-width NUMBER";
  return "";
}

// `told`: the findings so far; a cause that breaks many laws is told once.
void print(const CheckOptions& o, const Law& law, const Verdict& v, std::size_t width,
           std::set<std::string>& told) {
  const char* word = v.failures ? "FAIL" : !v.skipped.empty() ? "skipped" : "ok";
  if (o.quiet && !v.failures) return;
  const bool again = v.findings.size() == 1 && !told.insert(v.findings[0]).second;
  const std::string why = again ? "as above" : v.skipped;
  fmt::print("{:<7}  {:<{}}  {}{}\n", word, law.name, width, law.promise,
             why.empty() ? "" : fmt::format(" ({})", why));
  if (v.failures > 1)
    fmt::print("{:9}{} of {} trials failed{}:\n", "", v.failures, v.trials,
               v.failures > v.findings.size() ? ", among them" : "");
  if (!again)
    for (const std::string& finding : v.findings) fmt::print("{:9}- {}\n", "", finding);
  const std::string_view meant = excuse(o, law.name);
  if (v.failures && !v.mishap && !meant.empty())
    fmt::print("{:9}if that is meant: {}\n", "", meant);
  std::fflush(stdout);
}

constexpr Law kFound{"is-found", "A scene finds it by its name, in a folder of its kind.", nullptr};

// Those to put it to, in their order.
std::vector<Law> chosenLaws(const CheckOptions& o, PluginKind kind) {
  std::vector<Law> all{kFound};
  for (const auto& part : {laws::commonLaws(), laws::lawsOf(kind)})
    all.insert(all.end(), part.begin(), part.end());
  std::vector<std::string> names;
  for (const Law& law : all) names.emplace_back(law.name);
  for (const std::string& name : o.laws)
    if (std::ranges::find(names, name) == names.end())
      throw Error(fmt::format("there is no law \"{}\" of {} (--list shows them){}", name,
                              kindFolder(kind), didYouMean(name, names)),
                  Failure::usage);
  if (!o.laws.empty())
    std::erase_if(
        all, [&](const Law& law) { return std::ranges::find(o.laws, law.name) == o.laws.end(); });
  return all;
}

}  // namespace

CLI::App* addCheck(CLI::App& app, CheckOptions& o) {
  CLI::App* check = app.add_subcommand("check", "Put a plug-in to the laws of its kind");
  check->add_option("file", o.file, "The plug-in: torus.so")
      ->required()
      ->check([](const std::string& file) { return file.empty() ? "no name of a file" : ""; });
  check->add_option("parameters", o.parameters,
                    "What to make it with, as a scene gives it: '\"float radius\" 2'");
  check->add_option("--law", o.laws, "Only this law; may be given again")->allow_extra_args(false);
  check->add_flag("--list", o.list, "List the laws of its kind");
  check->add_option("--timeout", o.timeout, "Seconds for each law (default 60)")
      ->check(positiveNumber());
  check->add_flag("--quiet", o.quiet, "Tell of laws that fail alone");
  const char* const traits = "What the laws cannot know";
  check
      ->add_flag("--convex", o.traits.convex, "A shape that no ray meets again that leaves outward")
      ->group(traits);
  check
      ->add_option("--facing-width", o.traits.facingWidth,
                   "A shape that turns towards every ray, as a flat curve: its width")
      ->check(positiveNumber())
      ->group(traits);
  check
      ->add_flag("--looks-round", o.traits.looksRound,
                 "A shape with the normals of a tube about it")
      ->group(traits);
  check->add_flag("--has-steps", o.traits.hasSteps, "A filter whose weight jumps")->group(traits);
  check
      ->add_flag("--independent", o.traits.independentNumbers,
                 "A sampler whose points have nothing to do with one another, even in a pixel")
      ->group(traits);
  check
      ->add_option("--albedo", o.traits.albedo,
                   "A material that may scatter more light than comes: how many times (default 1)")
      ->check(positiveNumber())
      ->group(traits);
  check->footer(
      "Each law is tried in a process of its own.\n"
      "Exit codes: 0 it obeys all laws, 1 it does not, 2 usage, 3 its parameters are wrong, 5 it "
      "cannot be used.");
  return check;
}

int check(const CheckOptions& o) {
  const Introduction plugin = introduce(o);
  const std::vector<Law> chosen = chosenLaws(o, plugin.kind);
  std::size_t width = 0;
  for (const Law& law : chosen) width = std::max(width, law.name.size());
  if (o.list) {
    for (const Law& law : chosen) fmt::print("{:<{}}  {}\n", law.name, width, law.promise);
    return 0;
  }
  std::unique_ptr<Parser> keeper;
  const ParamList params = parameters(o, plugin, keeper);
  if (!o.quiet)
    fmt::print("{}: {} \"{}\", {}\n\n", o.file, kindName(plugin.kind), plugin.name, plugin.summary);
  std::size_t failed = 0, skipped = 0, tried = 0;
  std::set<std::string> told;
  for (const Law& law : chosen) {
    const Verdict v = law.check ? put(o, params, law) : isFound(o, plugin);
    if (law.name == laws::kMade && v.code) {
      fmt::print(stderr, "{}\n", v.findings[0]);
      return v.code;
    }
    print(o, law, v, width, told);
    ++tried;
    failed += v.failures ? 1 : 0;
    skipped += v.skipped.empty() || v.failures ? 0 : 1;
    // What hangs would mostly hang again, for as long.
    if (v.late || (law.name == laws::kMade && v.failures)) break;
  }
  fmt::print("{}{} laws: {} ok, {} failed, {} skipped", o.quiet ? "" : "\n", tried,
             tried - failed - skipped, failed, skipped);
  if (tried < chosen.size()) fmt::print(", {} not tried", chosen.size() - tried);
  fmt::print("\n");
  return failed ? 1 : 0;
}

}  // namespace pbrt
