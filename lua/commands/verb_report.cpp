// erbs report DIR: a run as one web page, DIR/report.html.
#include <filesystem>

#include "engine/record/report/report.h"
#include "lua/page/page.h"
#include "lua/program/options.h"
#include "lua/program/say.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

std::string page_path(const ReportCommand& command) {
  const bool chosen = !command.output.directory.empty();
  const std::string path = chosen ? command.output.directory : (fs::path(command.words.front()) / "report.html").string();
  if (const std::string ending = fs::path(path).extension().string(); ending != ".html" && ending != ".htm")
    throw Error("the name of a page ends with .html; change it", {path, 0});
  if (fs::is_directory(path)) throw Error("it is a folder; choose another name with -o FILE", {path, 0});
  if (fs::exists(path) && !command.output.force) throw Error("it exists already; --force writes it anew, -o FILE another", {path, 0});
  const fs::path folder = fs::absolute(path).parent_path();
  if (chosen && !fs::is_directory(folder))
    throw Error("its folder does not exist; make it, or choose another name with -o FILE", {path, 0});
  return path;
}

}  // namespace

int verb_report(const ReportCommand& command) {
  if (command.words.size() != 1)
    throw Error(fmt::format("report takes one run folder, not {}; e.g. erbs report runs/first", command.words.size()));
  const ReportPage& page = report_page();
  if (page.script.empty())
    throw Error("erbs was built without the packages of its web page; run sh .ci/setup in its source folder, and build it again");
  const std::string& dir = command.words.front();
  const std::string path = page_path(command);
  const ReportedRun run = read_reported_run(dir);
  std::error_code failed;
  const fs::path way = fs::relative(fs::canonical(dir), fs::weakly_canonical(fs::absolute(path)).parent_path(), failed);
  const std::string html = report_html(run, page, failed || way.empty() ? "." : way.generic_string());
  write_whole(path, html);
  if (!command.output.quiet)
    say("page {} ({} block{}, {} frame{}, {:.3g} MB)\n", shown(path, 400), run.run.scene.blocks.size(),
        run.run.scene.blocks.size() == 1 ? "" : "s", run.run.frames.size(), run.run.frames.size() == 1 ? "" : "s",
        1e-6 * static_cast<double>(html.size()));
  return exit_ok;
}

}  // namespace erbs::lua
