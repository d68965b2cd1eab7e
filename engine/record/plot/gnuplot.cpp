#include "engine/record/plot/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "engine/base/error.h"
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

// Exit code of `gnuplot ./name` in `folder`, with standard output and error in files; 127 if there is no gnuplot. Option -d ignores
// settings of the user and of files in the folder.
int start_gnuplot(const std::string& folder, const std::string& name, const std::string& output, const std::string& errors) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  std::string program = "gnuplot", plain = "-d", file = "./" + name;
  char* arguments[] = {program.data(), plain.data(), file.data(), nullptr};
  pid_t child = 0;
  const int code = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (code != 0) return 127;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return 126;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 126;
}

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
  const int code = start_gnuplot(own.parent_path().string(), own.filename().string(), picture.path, errors.path);
  if (code == 127) throw Error("the picture needs the program gnuplot; install the package gnuplot-nox", {path});
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
