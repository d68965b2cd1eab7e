#include "engine/record/plot/gnuplot.h"

#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "engine/base/error.h"
#include "engine/base/system/process.h"
#include "engine/base/text.h"

namespace erbs {
namespace {

namespace fs = std::filesystem;

// Removes its file on every way out.
struct TemporaryFile {
  std::string path;
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

std::string contents(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// How a shell numbers them: beyond 128 stands a signal.
std::string end_of_process(int code) { return code > 128 ? fmt::format("by signal {}", code - 128) : fmt::format("with code {}", code); }

// What it said; where it could not even say that, the likely cause.
std::string words_of_failure(const std::string& said, int code) {
  if (!said.empty()) return ": " + shown(said, 400);
  return code == 128 + SIGXFSZ ? "; is a limit on the size of files (ulimit -f) reached?" : " and said nothing; is the disk full?";
}

}  // namespace

void run_gnuplot(const std::string& script, const std::string& path) {
  const std::string stem = fmt::format("{}.{}", path, getpid());
  const TemporaryFile program{stem + ".gnuplot"}, picture{stem + ".part"}, errors{stem + ".err"};
  std::ofstream out(program.path);
  out << script;
  out.close();
  if (!out) throw Error("the picture cannot be written here; check the folder and its permissions", {path});
  const fs::path own = fs::absolute(program.path);
  // Option -d ignores settings of the user and of files in the folder.
  Child gnuplot = start({"gnuplot", "-d", "./" + own.filename().string()}, {.output = fs::absolute(picture.path).string(),
                                                                            .errors = fs::absolute(errors.path).string(),
                                                                            .folder = own.parent_path().string(),
                                                                            .remedy = "pictures need the package gnuplot-nox"});
  const int code = finish(gnuplot);
  std::error_code trouble;
  if (code == 0 && contents(errors.path).empty() && (fs::file_size(picture.path, trouble) == 0 || trouble))
    throw Error("gnuplot drew nothing and said nothing; is the disk full?", {path});
  if (code != 0 || fs::file_size(picture.path, trouble) == 0 || trouble)
    throw Error(fmt::format("gnuplot ended {} and drew nothing{}", end_of_process(code), words_of_failure(contents(errors.path), code)),
                {path});
  fs::rename(picture.path, path, trouble);
  if (trouble) throw Error(fmt::format("the picture cannot be put here ({}); check the folder", trouble.message()), {path});
}

std::string gnuplot_quoted(std::string_view text) {
  std::string quoted = "'";
  for (const char c : for_files(text)) {
    if (c == '\'') quoted += '\'';
    else if (c == '>' && quoted.ends_with("]]")) quoted += ' ';  // would end a CDATA section of the SVG
    quoted += c;
  }
  return quoted + "'";
}

}  // namespace erbs
