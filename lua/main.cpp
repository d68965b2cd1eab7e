// The program erbs: reads the command line, calls the verb, turns an error into an exit code.
#include <malloc.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "engine/base/spelling.h"
#include "engine/base/system/interrupt.h"
#include "engine/base/system/isa.h"
#include "engine/base/system/streams.h"
#include "engine/base/text.h"
#include "engine/record/folder/manifest.h"
#include "lua/commands/help.h"
#include "lua/program/command_line.h"
#include "lua/program/overrides.h"
#include "lua/program/say.h"

namespace erbs::lua {
namespace {

void check_verb(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> verbs;
  for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
  if (argc < 2) throw Error(fmt::format("erbs takes a verb: {}; see erbs help", fmt::join(verbs, ", ")));
  const std::string word = argv[1];
  if (!word.starts_with("-") && std::find(verbs.begin(), verbs.end(), word) == verbs.end())
    throw Error(fmt::format("there is no verb {}{}; see erbs help", shown(word, 60), did_you_mean(word, verbs)));
}

// Refuses what CLI11 would blame on the scene, or take: an unknown option, and a value for an option that takes none (--force=1e400).
void check_options(const CLI::App& app, int argc, char** argv) {
  const CLI::App* verb = nullptr;
  for (const CLI::App* known : app.get_subcommands({}))
    if (argc > 1 && known->get_name() == argv[1]) verb = known;
  if (verb == nullptr || verb->get_prefix_command()) return;
  for (int i = 2; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--") return;
    const bool is_long = word.starts_with("--");
    if (!is_long && (word.size() < 2 || word[0] != '-' || std::isalpha(static_cast<unsigned char>(word[1])) == 0)) continue;
    const std::string name(is_long ? word.substr(0, word.find('=')) : word.substr(0, 2));
    const CLI::Option* option = verb->get_option_no_throw(name);
    if (option == nullptr) {
      std::vector<std::string> names;
      for (const CLI::Option* known : verb->get_options([](const CLI::Option* one) { return !one->get_group().empty(); }))  // not hidden
        for (const std::string& one : known->get_lnames()) names.push_back("--" + one);
      throw Error(fmt::format("erbs {} has no option {}{}; see erbs help {}", verb->get_name(), shown(name, 60), did_you_mean(name, names),
                              verb->get_name()));
    }
    const bool takes_value = option->get_items_expected_max() > 0;
    if (is_long && name.size() < word.size() && !takes_value) throw Error(fmt::format("{} takes no value; write {}", name, name));
    if (takes_value && name.size() == word.size()) ++i;  // its value, whatever it begins with
  }
}

int call(const CLI::App& app, const CommandLine& line) {
  const CLI::App& verb = *app.get_subcommands().front();
  const std::string name = verb.get_name();
  const AccuracyCommand& accuracy = line.accuracy;
  if ((line.run.output.force && line.run.resume) || (accuracy.output.force && accuracy.batch.resume) ||
      (line.sweep.output.force && line.sweep.resume) || (line.calibrate.output.force && line.calibrate.resume) ||
      (line.effects.output.force && line.effects.batch.resume))
    throw Error("--force and --resume exclude each other; keep one");
  if (name == "run") return verb_run(line.run);
  if (name == "check") return verb_check(line.check);
  if (name == "export") return verb_export(line.exported);
  if (name == "plot") return verb_plot(line.plot);
  if (name == "report") return verb_report(line.report);
  if (name == "compare") return verb_compare(line.compare);
  if (name == "record") return verb_record(line.record);
  if (name == "accuracy") return accuracy.map ? verb_map(accuracy) : verb_accuracy(accuracy);
  if (name == "test") return verb_test(line.test);
  if (name == "sweep") return verb_sweep(line.sweep);
  if (name == "calibrate") return verb_calibrate(line.calibrate);
  if (name == "bench") return verb_bench(line.bench);
  if (name == "limit") return verb_limit(line.limit);
  if (name == "capacity") return verb_capacity(line.capacity);
  if (name == "effects") return verb_effects(line.effects);
  if (name == "version") return verb_version();
  std::vector<std::string> words = line.words;
  for (const auto& word : verb.remaining()) words.push_back(word);
  if (name == "render") return verb_render(words);
  if (!words.empty() && words.front() == "render") return verb_render({"--help"});
  // CLI11 prints the help of every other verb
  if (!words.empty())
    for (const CLI::App* other : app.get_subcommands({}))
      if (other->get_name() == words.front()) {
        say("{}", other->help("erbs"));
        if (is_function(words.front())) say("In a scene:\n\n{}", function_help(words.front()));
        return exit_ok;
      }
  // not app.help(), which would print the help of the verb help
  return verb_help(words, app.get_formatter()->make_help(&app, "erbs", CLI::AppFormatMode::Normal));
}

int answer(CLI::App& app, CommandLine& line, int argc, char** argv) {
  const auto wrong = [](const std::string& what, int code = exit_usage) {
    tell(stderr, what);
    return code;
  };
  try {
    check_verb(app, argc, argv);
    check_options(app, argc, argv);
    app.parse(argc, argv);
    chosen_isa();  // refuses an unknown ERBS_ISA
    return call(app, line);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    const std::string_view first = argv[1];                  // check_verb() knows it, unless it is an option
    return wrong(
        fmt::format("{}; see erbs help{}{}", error.what(), first.starts_with("-") ? "" : " ", first.starts_with("-") ? "" : first));
  } catch (const Interrupted& error) { return wrong(error.what(), exit_interrupted); } catch (const NumbersError& error) {
    return wrong(error.what(), exit_numbers);
  } catch (const std::filesystem::filesystem_error& error) {
    return wrong(fmt::format("{}: {}; check the path", error.path1().string(), error.code().message()));
  } catch (const std::system_error& error) {
    if (std::ferror(stdout) != 0) return exit_ok;  // finish_streams() reports it
    return wrong(fmt::format("the system refuses: {}; is a limit of memory, threads or files (ulimit) reached?", error.what()));
  } catch (const std::bad_alloc&) {
    return wrong("there is not enough memory; build a smaller model, or raise the limit (ulimit -v)");
  } catch (const std::logic_error& error) { return wrong(error.what(), exit_numbers); } catch (const std::exception& error) {
    return wrong(error.what());
  }
}

}  // namespace

int run_program(int argc, char** argv) {
  prepare_streams();
  prctl(PR_SET_NAME, "erbs");          // for ps and top: what a study starts is found by way of /proc/self/exe
  mallopt(M_MMAP_THRESHOLD, 1 << 20);  // large arrays return to the system when freed, so that the heap does not fragment
  CommandLine line;
  CLI::App app("ERBS: collapse of masonry by rigid blocks and mortar springs", "erbs");
  app.require_subcommand(1);
  app.set_version_flag("--version", "erbs " + program_version(), "the version and the commit it was built from");
  add_verbs(app, line);
  if (std::find(argv, argv + argc, std::string_view("--log-json")) != argv + argc) tell_as_json();  // mistakes in the options too
  return finish_streams(answer(app, line, argc, argv), exit_usage);
}

}  // namespace erbs::lua

int main(int argc, char** argv) { return erbs::lua::run_program(argc, argv); }
