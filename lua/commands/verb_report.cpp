// erbs report DIR: a run, or a study, as one web page, DIR/report.html.
#include <filesystem>

#include "engine/base/text.h"
#include "engine/record/folder/run_folder.h"
#include "engine/record/report/report.h"
#include "engine/record/report/study_page.h"
#include "lua/page/page.h"
#include "lua/program/output_path.h"
#include "lua/program/say.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

std::string page_path(const ReportCommand& command, const std::string& ordinary) {
  return output_path(command.output, ordinary, "a page", {".html", ".htm"});
}

int report_study(const ReportCommand& command, const std::string& path) {
  const ReportedStudy study = read_reported_study(command.words.front(), path);
  const std::string html = study_html(study, study_page(), study_style());
  write_whole(path, html);
  std::size_t rows = 0;
  for (const StudyTable& table : study.tables) rows += table.table.rows();
  if (!command.output.quiet)
    say("page {} ({}, {}, {:.3g} MB)\n", shown(path, 400), study.kind, counted(rows, "row"), 1e-6 * static_cast<double>(html.size()));
  return exit_ok;
}

}  // namespace

int verb_report(const ReportCommand& command) {
  if (command.words.size() != 1)
    throw Error(fmt::format("report takes one folder of a run or a study, not {}; e.g. erbs report runs/first", command.words.size()));
  const std::string& dir = command.words.front();
  const bool of_study = is_study_folder(dir);
  if (of_study && !is_run_folder(dir)) return report_study(command, page_path(command, study_page_path(dir)));
  const ReportPage& page = report_page();
  if (page.script.empty())
    throw Error("erbs was built without the packages of its web page; run sh .ci/setup in its source folder, and build it again");
  const std::string path = page_path(command, (fs::path(dir) / "report.html").string());
  // The studies of a scene have a page beside their tables; the page of its run names it.
  if (of_study) report_study(command, study_page_path(dir));
  const ReportedRun run = read_reported_run(dir);
  std::error_code failed;
  const fs::path way = fs::relative(fs::canonical(dir), fs::weakly_canonical(fs::absolute(path)).parent_path(), failed);
  const std::string html = report_html(run, page, failed || way.empty() ? "." : way.generic_string());
  write_whole(path, html);
  if (!command.output.quiet)
    say("page {} ({}, {}, {:.3g} MB)\n", shown(path, 400), counted(run.run.scene.blocks.size(), "block"),
        counted(run.run.frames.size(), "frame"), 1e-6 * static_cast<double>(html.size()));
  return exit_ok;
}

}  // namespace erbs::lua
