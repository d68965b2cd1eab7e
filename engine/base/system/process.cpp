#include "engine/base/system/process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "engine/base/error.h"
#include "engine/base/system/interrupt.h"

namespace erbs {
namespace {

int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

double seconds_of(const rusage& used) {
  return double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1e-6 * double(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

}  // namespace

std::string own_path() {
  std::error_code trouble;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", trouble);
  return trouble ? "erbs" : path.string();
}

Child start(const std::vector<std::string>& command, const std::string& log) {
  std::vector<char*> words;
  for (const auto& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  int failure[2];  // a successful exec closes this pipe, a failed one writes errno
  if (pipe2(failure, O_CLOEXEC) != 0) throw Error(fmt::format("cannot start {}: {}", command.front(), std::strerror(errno)));
  const pid_t parent = getpid(), pid = fork();
  if (pid == 0) {
    // The child ends with this thread, however that ends. It gets back the default handling of a closed pipe and of a file's size limit.
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(128 + SIGTERM);
    std::signal(SIGPIPE, SIG_DFL);
    std::signal(SIGXFSZ, SIG_DFL);
    if (!log.empty()) {
      const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
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
  rusage used{};
  const pid_t pid = wait4(-1, &status, 0, &used);
  if (pid < 0) return {};
  return {pid, code_of(status), seconds_of(used)};
}

Ended wait_for_any(double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  for (;;) {
    int status = 0;
    rusage used{};
    const pid_t pid = wait4(-1, &status, WNOHANG, &used);
    if (pid > 0) return {pid, code_of(status), seconds_of(used)};
    if (std::chrono::steady_clock::now() >= end) return {};
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

int wait_for(const Child& child) {
  int status = 0;
  bool told = false;
  auto pause = std::chrono::milliseconds(1);
  for (pid_t ended = 0; (ended = waitpid(child.pid, &status, WNOHANG)) == 0 || (ended < 0 && errno == EINTR);) {
    if (is_interrupted() && !told) told = kill(child.pid, SIGTERM) == 0;
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::milliseconds(20));
  }
  return code_of(status);
}

void interrupt(const Child& child) {
  if (child.pid > 0) kill(child.pid, SIGINT);
}

void stop_hard(const Child& child) {
  if (child.pid > 0) kill(child.pid, SIGKILL);
}

std::string last_words(const std::string& log, int code, const std::string& file) {
  if (code > 128 && code != 130) return fmt::format("ended by signal {}", code - 128);
  const std::string name = std::filesystem::path(file).filename().string() + ":";
  std::string first, last, line;
  std::ifstream stream(log);
  while (std::getline(stream, line)) {
    if (line.empty() || line.starts_with("warning:") || line.find("results in ") != std::string::npos) continue;
    if (first.empty() && line.find(name) != std::string::npos) first = line;
    last = line;
  }
  return fmt::format("exit code {}: {}", code, first.empty() ? last : first);
}

}  // namespace erbs
