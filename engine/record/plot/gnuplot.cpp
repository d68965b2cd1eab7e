#include "engine/record/plot/gnuplot.h"

#include <unistd.h>

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
    throw Error(fmt::format("gnuplot ended with code {} and drew nothing: {}", code, shown(contents(errors.path), 400)), {path});
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
