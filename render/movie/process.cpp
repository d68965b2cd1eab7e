#include "render/movie/process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "engine/base/error.h"

extern char** environ;

namespace erbs::render {

Process::Process(const std::vector<std::string>& command, const std::string& remedy) {
  signal(SIGPIPE, SIG_IGN);  // write() reports a program that died
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw Error("no pipe to " + command.front() + " can be made; close some programs");
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t how;
  posix_spawnattr_init(&how);
  posix_spawnattr_setflags(&how, POSIX_SPAWN_SETPGROUP);
  const int failed = posix_spawnp(&pid_, command.front().c_str(), &files, &how, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&how);
  close(ends[0]);
  input_ = ends[1];
  if (failed) {
    pid_ = -1;
    close(input_);
    throw Error(fmt::format("the program {} cannot be started ({}); {}", command.front(), std::strerror(failed), remedy));
  }
}

Process::~Process() {
  if (pid_ >= 0) finish();
}

bool Process::write(const void* bytes, std::size_t count) {
  const char* at = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t n = ::write(input_, at, count);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    count -= static_cast<std::size_t>(n);
  }
  return true;
}

int Process::finish() {
  if (pid_ < 0) return -1;
  close(input_);
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {}
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace erbs::render
