#include "engine/base/system/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <thread>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/system/interrupt.h"

namespace erbs {
namespace {

int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

double seconds_of(const rusage& used) {
  return double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1e-6 * double(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

struct Pipe {
  int from = -1, to = -1;
  bool open() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return false;
    from = ends[0], to = ends[1];
    return true;
  }
  static void close_end(int& end) {
    if (end >= 0) close(end);
    end = -1;
  }
  static int release(int& end) { return std::exchange(end, -1); }
  ~Pipe() { close_end(from), close_end(to); }
};

// fork(); the child gets `signal` when the thread that started it ends, however that ends.
pid_t fork_bound(int signal) {
  const pid_t parent = getpid(), pid = fork();
  if (pid == 0) {
    prctl(PR_SET_PDEATHSIG, signal);
    if (getppid() != parent) _exit(128 + signal);
  }
  return pid;
}

void redirect(const std::string& path, std::initializer_list<int> streams) {
  const int file = path.empty() ? -1 : open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  for (const int stream : streams)
    if (file >= 0) dup2(file, stream);
}

// In the child: becomes the program. Returns only if that fails. The program gets back the default handling of a closed pipe and of a
// file's size limit.
void become(const char* program, const std::vector<char*>& words, const Launch& how, int input, int output) {
  std::signal(SIGPIPE, SIG_DFL);
  std::signal(SIGXFSZ, SIG_DFL);
  if (how.own_group) setpgid(0, 0);
#ifndef ERBS_SANITIZED  // a sanitizer reserves far more than any run
  if (how.memory > 0) {
    // The limit of data, not of addresses: libraries and stacks that are only reserved do not count.
    rlimit most{};
    getrlimit(RLIMIT_DATA, &most);
    most.rlim_cur = most.rlim_max = std::min(most.rlim_max, static_cast<rlim_t>(how.memory));  // a run of a run gets no more than that one
    setrlimit(RLIMIT_DATA, &most);
  }
#endif
  if (how.fed) dup2(input, STDIN_FILENO);
  if (how.output == how.errors) {
    redirect(how.output, {STDOUT_FILENO, STDERR_FILENO});
  } else {
    redirect(how.output, {STDOUT_FILENO});
    redirect(how.errors, {STDERR_FILENO});
  }
  if (how.heard) dup2(output, STDOUT_FILENO);
  if (!how.folder.empty() && chdir(how.folder.c_str()) != 0) return;
  execvp(program, words.data());
}

}  // namespace

std::string own_path() {
  std::error_code trouble;
  std::string path = std::filesystem::read_symlink("/proc/self/exe", trouble).string();
  const std::string gone = " (deleted)";
  if (path.ends_with(gone)) path.resize(path.size() - gone.size());
  return trouble ? "erbs" : path;
}

std::string own_folder() {
  std::error_code trouble;
  return std::filesystem::read_symlink("/proc/self/exe", trouble).parent_path().string();
}

bool can_start(const std::string& name) {
  if (name.find('/') != std::string::npos) return access(name.c_str(), X_OK) == 0;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/bin:/usr/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/" + name).c_str(), X_OK) == 0) return true;
  return false;
}

Child start(const std::vector<std::string>& command, const Launch& how) {
  std::vector<char*> words;
  for (const auto& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  // The link leads to this very program, whatever lies at its path by now: a study goes on with what has begun it.
  const char* const program = command.front() == own_path() ? "/proc/self/exe" : words[0];
  const auto refuse = [&](int number) {
    throw Error(fmt::format("the program {} cannot be started: {}{}{}", command.front(), std::strerror(number),
                            how.remedy.empty() ? "" : "; ", how.remedy));
  };
  if (how.fed) std::signal(SIGPIPE, SIG_IGN);  // send() reports a program that died
  Pipe failure, input, output;                 // a successful exec closes the first one, a failed one writes errno into it
  if (!failure.open() || (how.fed && !input.open()) || (how.heard && !output.open())) refuse(errno);
  const pid_t pid = fork_bound(how.bound_hard ? SIGKILL : SIGTERM);
  if (pid == 0) {
    become(program, words, how, input.from, output.to);
    const int number = errno;
    send(failure.to, &number, sizeof number);
    _exit(127);
  }
  int number = pid < 0 ? errno : 0;
  failure.close_end(failure.to);
  if (pid > 0 && receive(failure.from, &number, sizeof number)) waitpid(pid, nullptr, 0);
  if (number != 0) refuse(number);
  return {pid, input.release(input.to), output.release(output.from)};
}

Child start(const std::vector<std::string>& command, const std::string& log) { return start(command, Launch{log, log}); }

Child start_copy(const std::function<void(int, int)>& body) {
  std::signal(SIGPIPE, SIG_IGN);  // send() reports a process that died
  Pipe orders, answers;
  const pid_t pid = orders.open() && answers.open() ? fork_bound(SIGKILL) : -1;
  if (pid < 0) throw Error("no more processes can be started; ask for fewer --threads");
  if (pid == 0) {
    orders.close_end(orders.to), answers.close_end(answers.from);
    body(orders.from, answers.to);
    _exit(0);
  }
  return {pid, orders.release(orders.to), answers.release(answers.from)};
}

bool send(int pipe, const void* bytes, std::size_t count) {
  for (const char* at = static_cast<const char*>(bytes); count > 0;) {
    const ssize_t n = write(pipe, at, count);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n, count -= static_cast<std::size_t>(n);
  }
  return true;
}

bool receive(int pipe, void* bytes, std::size_t count) {
  for (char* at = static_cast<char*>(bytes); count > 0;) {
    const ssize_t n = read(pipe, at, count);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n, count -= static_cast<std::size_t>(n);
  }
  return true;
}

Ended wait_for_one(const std::vector<int>& pids, double seconds) {
  const auto ended = [&]() -> Ended {
    for (const int pid : pids) {
      int status = 0;
      rusage used{};
      if (wait4(pid, &status, WNOHANG, &used) == pid)
        return {pid, code_of(status), seconds_of(used), 1024.0 * static_cast<double>(used.ru_maxrss)};
    }
    return {};
  };
  if (const Ended now = ended(); now.pid > 0 || seconds <= 0) return now;
  // A descriptor of a process becomes readable when it ends: no time is lost between its end and the next run.
  std::vector<pollfd> watched;
  for (const int pid : pids) watched.push_back({static_cast<int>(syscall(SYS_pidfd_open, pid, 0)), POLLIN, 0});
  const bool able = std::all_of(watched.begin(), watched.end(), [](const pollfd& one) { return one.fd >= 0; });
  if (able) {
    poll(watched.data(), watched.size(), static_cast<int>(1000 * seconds));
  } else {  // a kernel before 5.3
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    for (Ended now; std::chrono::steady_clock::now() < end; std::this_thread::sleep_for(std::chrono::milliseconds(1)))
      if (now = ended(); now.pid > 0) {
        for (pollfd& one : watched) Pipe::close_end(one.fd);
        return now;
      }
  }
  for (pollfd& one : watched) Pipe::close_end(one.fd);
  return ended();
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

void end_input(Child& child) { Pipe::close_end(child.to); }

int finish(Child& child) {
  Pipe::close_end(child.to), Pipe::close_end(child.from);
  int status = 0;
  while (waitpid(child.pid, &status, 0) < 0 && errno == EINTR) {}
  child.pid = -1;
  return code_of(status);
}

void interrupt(const Child& child) {
  if (child.pid > 0) kill(child.pid, SIGINT);
}

void stop_hard(const Child& child) {
  if (child.pid > 0) kill(child.pid, SIGKILL);
}

void stop_group(const Child& child) {
  if (child.pid > 0) kill(-child.pid, SIGKILL);
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
