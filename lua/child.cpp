#include "lua/child.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "engine/base/error.h"

namespace erbs {
namespace {

int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

}  // namespace

std::string own_path() {
  std::error_code trouble;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", trouble);
  return trouble ? "erbs" : path.string();
}

std::string renderer_path() {
  const auto beside = std::filesystem::path(own_path()).parent_path() / "erbs-render";
  return std::filesystem::exists(beside) ? beside.string() : "erbs-render";
}

Child start(const std::vector<std::string>& command, const std::string& log) {
  std::vector<char*> words;
  for (const auto& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  int failure[2];  // closed by a successful exec, else brings errno
  if (pipe2(failure, O_CLOEXEC) != 0) throw Error(fmt::format("cannot start {}: {}", command.front(), std::strerror(errno)));
  const pid_t pid = fork();
  if (pid == 0) {
    if (!log.empty()) {
      const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
      if (file >= 0) {
        dup2(file, STDOUT_FILENO);
        dup2(file, STDERR_FILENO);
      }
    }
    execvp(words[0], words.data());
    const int number = errno;
    [[maybe_unused]] const auto written = write(failure[1], &number, sizeof number);
    _exit(127);
  }
  close(failure[1]);
  int number = pid < 0 ? errno : 0;
  if (pid > 0 && read(failure[0], &number, sizeof number) == sizeof number) waitpid(pid, nullptr, 0);
  close(failure[0]);
  if (number != 0) throw Error(fmt::format("cannot start {}: {}", command.front(), std::strerror(number)));
  return {pid};
}

Ended wait_for_any() {
  int status = 0;
  pid_t pid = 0;
  do pid = waitpid(-1, &status, 0);
  while (pid < 0 && errno == EINTR);
  return {pid, pid < 0 ? 0 : code_of(status)};
}

int wait_for(const Child& child) {
  int status = 0;
  while (waitpid(child.pid, &status, 0) < 0 && errno == EINTR) {}
  return code_of(status);
}

int run_renderer(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{renderer_path()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return wait_for(start(command));
}

}  // namespace erbs
