#include "lua/reports/book.h"
#include "engine/record/format/json.h"
#include "lua/reports/book_endings.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "engine/base/system/affinity.h"
#include "engine/base/text.h"
#include "engine/record/folder/manifest.h"
#include "engine/record/plot/gnuplot.h"
#include "lua/program/progress.h"

namespace erbs::lua {
namespace {

namespace fs = std::filesystem;

// v17_eccentric_compression -> 'v', 17.
std::pair<char, int> number_of(const std::string& name) {
  size_t end = 1;
  while (end < name.size() && std::isdigit(static_cast<unsigned char>(name[end])) != 0) ++end;
  return {name.empty() ? ' ' : name[0], end > 1 && end < 6 ? std::stoi(name.substr(1, end - 1)) : -1};
}

size_t family_index(const CaseResult& result) {
  const auto [letter, number] = number_of(result.name);
  if (letter == 'h' || result.scene.find("/hard/") != std::string::npos) return 4;
  if (letter != 'v' || number < 0) return 5;
  return number <= 27 || number > 46 ? 0 : number <= 36 ? 1 : number <= 45 ? 2 : 3;
}

std::string trimmed(const std::string& text) {
  const size_t from = text.find_first_not_of(" \t\r");
  if (from == std::string::npos) return "";
  return text.substr(from, text.find_last_not_of(" \t\r") - from + 1);
}

std::vector<std::string> lines_of(const std::string& path) {
  std::vector<std::string> lines;
  std::ifstream stream(path);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The reason of a tolerance as its scene gives it: the comment at the end of the expectation's line. Without one, it is the block
// of comment lines above the expectation; other expectations may stand between.
std::string cause_of(const Verdict& verdict, std::map<std::string, std::vector<std::string>>& files) {
  const size_t colon = verdict.place.rfind(':');
  if (colon == std::string::npos) return "";
  const std::string file = verdict.place.substr(0, colon);
  if (!files.contains(file)) files[file] = lines_of(file);
  const auto& lines = files[file];
  const auto number = static_cast<size_t>(std::max(0, std::atoi(verdict.place.c_str() + colon + 1)));
  if (number == 0 || number > lines.size()) return "";
  const std::string& own = lines[number - 1];
  if (const size_t tail = own.rfind("-- "); tail != std::string::npos && tail > 0) return trimmed(own.substr(tail + 3));
  size_t above = number - 1;  // index of the line of the expectation
  const auto comment = [&](size_t i) { return trimmed(lines[i]).starts_with("--"); };
  while (above > 0 && !comment(above - 1) && trimmed(lines[above - 1]).find("expect") != std::string::npos) --above;
  size_t first = above;
  while (first > 0 && comment(first - 1)) --first;
  if (first == 0) return "";  // the head of the scene
  std::string text;
  for (size_t i = first; i < above; ++i) {
    const std::string line = trimmed(lines[i]);
    text += (text.empty() ? "" : " ") +
            trimmed(line.substr(line.find_first_not_of('-') == std::string::npos ? line.size() : line.find_first_not_of('-')));
  }
  return text;
}

std::string sentences(const std::vector<std::string>& texts) {
  std::string all;
  for (const auto& text : texts) {
    all += (all.empty() ? "" : " ") + text;
    if (!text.ends_with('.')) all += '.';
  }
  return all;
}

void add_once(std::vector<std::string>& list, const std::string& text) {
  if (!text.empty() && std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
}

std::string table_of(const Family& family) {
  std::string text =
      "| case | quantity | expected | got | error | tolerance | share | verdict | cost |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const CaseResult* result : family.cases) {
    std::string name = result->name, cost = cost_text(*result);
    for (const Verdict& v : result->verdicts) {
      text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", code_cell(name), code_cell(v.key), cell(v.expected),
                          cell(v.got), cell(v.error), cell(v.tolerance), std::isfinite(v.used) ? fmt::format("{:.2g}", v.used) : "",
                          v.passed ? "ok" : "**failed**", cost);
      name = cost = "";
    }
    if (!result->trouble.empty())
      text += fmt::format("| {} | (run) | | {} | | | | **failed** | {} |\n", code_cell(name), cell(result->trouble), cost);
  }
  return text;
}

// Text of a scene as running text: without HTML tags.
std::string plain(const std::string& words) {
  std::string out;
  for (const char c : for_files(words)) out += c == '<' ? std::string("&lt;") : std::string(1, c);
  return out;
}

std::string sources_of(const Family& family, const std::string& book) {
  std::string text;
  std::map<std::string, std::vector<std::string>> files;
  for (const CaseResult* result : family.cases) {
    std::vector<std::string> sources, causes;
    for (const Verdict& v : result->verdicts) add_once(sources, v.source), add_once(causes, cause_of(v, files));
    text += fmt::format("- [{}]({}): {}", result->name, relative_link(book, result->scene), plain(sentences({result->title})));
    if (!sources.empty()) text += " *Source:* " + plain(sentences(sources));
    if (!causes.empty()) text += " *Tolerance:* " + plain(sentences(causes));
    text += "\n";
  }
  return text;
}

// The figures that the scenes draw of their studies.
std::string figures_of(const Family& family, const std::string& book, const fs::path& media) {
  std::string text;
  for (const CaseResult* result : family.cases)
    for (const LeftFigure& figure : result->figures) {
      const std::string file = (media / fmt::format("{}_{}.svg", result->name, figure.name)).string();
      run_gnuplot(figure.script, file);
      text += fmt::format("![{0}]({1})\n\n*{2}*: {0}.\n\n", plain(figure.title), relative_link(book, file), cell(result->name));
    }
  return text;
}

std::string overview(const std::vector<Family>& families) {
  std::string text =
      "| family | cases | expectations | passed | failed | worst share of a tolerance among those that pass | cost "
      "|\n|---|---|---|---|---|---|---|\n";
  for (const Family& f : families)
    text += fmt::format("| [{}](#{}) | {} | {} | {} | {} | {:.2g} ({}) | {:.1f} s, {:.2g} pt |\n", f.title, f.key, f.cases.size(),
                        f.expectations, f.expectations - f.failed, f.failed, f.worst, f.worst_at, f.cpu, f.updates);
  return text;
}

std::string failures(const std::vector<Family>& families) {
  std::string text;
  for (const Family& f : families)
    for (const CaseResult* result : f.cases) {
      for (const Verdict& v : result->verdicts)
        if (!v.passed) text += fmt::format("- **{}** {}: expected {} {}, got {}\n", result->name, v.key, v.expected, v.tolerance, v.got);
      if (!result->trouble.empty()) text += fmt::format("- **{}** {}\n", result->name, result->trouble);
    }
  return text.empty() ? "Nothing fails.\n" : text;
}

}  // namespace

std::vector<Family> families_of(const std::vector<CaseResult>& results) {
  std::vector<Family> all = {
      {"b1", "B1 exact", "Numbers that follow exactly from a formula.", {}, 0, 0, 0, "", 0, 0},
      {"b2", "B2 rocking", "Rigid rocking blocks, compared with the integrated equations of Housner's block.", {}, 0, 0, 0, "", 0, 0},
      {"b3", "B3 statics by dynamics", "Limit loads found by growing loads slowly, or by bisection.", {}, 0, 0, 0, "", 0, 0},
      {"b4", "B4 elastic dynamics", "Frequencies and modes of elastic structures.", {}, 0, 0, 0, "", 0, 0},
      {"hard",
       "Hard cases",
       "Situations in which such programs fail, each with an invariant that this one must keep.",
       {},
       0,
       0,
       0,
       "",
       0,
       0},
      {"more", "Further cases", "Loads, records, and comparisons of the program with itself.", {}, 0, 0, 0, "", 0, 0}};
  for (const CaseResult& result : results) {
    Family& f = all[family_index(result)];
    f.cases.push_back(&result);
    f.cpu += result.cpu;
    f.updates += result.updates;
    f.expectations += static_cast<int>(result.verdicts.size()) + !result.trouble.empty();
    f.failed += !result.trouble.empty();
    for (const Verdict& v : result.verdicts) {
      f.failed += !v.passed;
      if (v.used >= f.worst) f.worst = v.used, f.worst_at = result.name + " " + v.key;
    }
  }
  std::erase_if(all, [](const Family& f) { return f.cases.empty(); });
  return all;
}

std::string summary_line(const std::vector<Family>& families) {
  int cases = 0, expectations = 0, failed = 0;
  std::vector<std::string> worst;
  for (const Family& f : families) {
    cases += static_cast<int>(f.cases.size()), expectations += f.expectations, failed += f.failed;
    worst.push_back(f.failed > 0 ? fmt::format("{} {:.2g} ({} failed)", f.title, f.worst, f.failed)
                                 : fmt::format("{} {:.2g}", f.title, f.worst));
  }
  return fmt::format("{}, {}: {} passed, {} failed; worst error as a share of its tolerance: {}.", counted(cases, "case"),
                     counted(expectations, "expectation"), expectations - failed, failed, fmt::join(worst, ", "));
}

// A path as the target of a link: characters that would end the link are percent-encoded.
static std::string in_link(const std::string& path) {
  std::string out;
  for (const char c : path) {
    const bool valid =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/' || c == '.' || c == '_' || c == '-';
    out += valid ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

std::string relative_link(const std::string& from, const std::string& to) {
  return in_link(fs::weakly_canonical(to).lexically_relative(fs::weakly_canonical(from).parent_path()).generic_string());
}

std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '*' || c == '_') out += '\\';
    out += c;
  }
  return for_files(out);
}

std::string code_cell(const std::string& name) {
  std::string out = for_files(name);
  std::replace(out.begin(), out.end(), '|', '/');
  std::replace(out.begin(), out.end(), '`', '\'');
  return out.empty() ? "" : "`" + out + "`";
}

bool replace_marked(const std::string& file, const std::string& mark, const std::string& text) {
  std::string all = whole_text(file);
  const std::string open = "<!-- " + mark + " -->", close = "<!-- /" + mark + " -->";
  const size_t from = all.find(open), to = all.find(close);
  if (from == std::string::npos || to == std::string::npos || to < from) return false;
  all.replace(from + open.size(), to - from - open.size(), "\n" + text + "\n");
  write_text_atomically(file, all);
  return true;
}

void write_book(const std::vector<CaseResult>& results, const TestCommand& command, double wall) {
  const std::string& book = command.book;
  const fs::path folder = fs::absolute(book).parent_path();
  const fs::path media = fs::is_directory(folder.parent_path() / "media") ? folder.parent_path() / "media" : folder;
  const std::vector<Family> families = families_of(results);
  const std::string summary = summary_line(families);
  std::string text = fmt::format("# Verification book\n\n{}", how_to_write_a_case);
  text +=
      fmt::format("Written by `erbs test {}{} --book {}`, never edited by hand: {}, {}, {} on {} processors, with erbs {}.\n\n",
                  fmt::join(command.words, " "), command.quick ? " --quick" : "", fs::proximate(book).generic_string(), duration_text(wall),
                  machine_isa(), command.batch.jobs > 0 ? fmt::format("{} runs at a time", command.batch.jobs) : "one run per processor",
                  usable_processors(), program_version());
  text += "**" + summary + "**\n\n" + overview(families) + "\n";
  text += "The share is the error over its tolerance; 1 is the limit. Cost: processor seconds and evaluations of contact points.\n";
  if (fs::exists(folder / "grid.md"))
    text += "The hard cases at other steps and numbers of contact points, with noise in the initial state: [the grid](grid.md).\n";
  text += "\n## What fails\n" + failures(families) + "\n" + endings_table;
  for (const Family& f : families) {
    const std::string figure = (media / ("book_" + f.key + ".svg")).string();
    draw_family(f, figure);
    text += fmt::format("\n<a name=\"{}\"></a>\n## {}\n{}\n\n![{}]({})\n\n{}\n{}### Sources and reasons of the tolerances\n{}", f.key,
                        f.title, f.about, "error over tolerance by case", relative_link(book, figure), table_of(f),
                        figures_of(f, book, media), sources_of(f, book));
  }
  write_text_atomically(book, text);
  const std::string readme = (folder.parent_path() / "README.md").string();
  if (fs::exists(readme))
    replace_marked(readme, "verification", fmt::format("[The verification book]({}): {}", relative_link(readme, book), summary));
}

}  // namespace erbs::lua
