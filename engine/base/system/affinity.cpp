#include "engine/base/system/affinity.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <thread>

namespace erbs {

namespace {

// CPU quota in processors; 0 if none is set. `file` holds quota and period in us, such as "150000 100000".
// The older interface (cgroup v1) keeps the period in a file of its own.
double quota_in(const std::string& file, const std::string& period_file = "") {
  std::ifstream in(file);
  double quota = 0, period = 0;
  if (!(in >> quota)) return 0;  // "max"
  if (period_file.empty()) in >> period;
  else std::ifstream(period_file) >> period;
  return quota > 0 && period > 0 ? quota / period : 0;
}

// Smallest CPU quota over the control group of this process and its ancestors, in processors; 0 if none is set.
double least_quota() {
  double least = 0;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // v1 4:cpu,cpuacct:/a/b, v2 0::/a/b
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const bool unified = controllers == ",,", old = controllers.find(",cpu,") != std::string::npos;
    if (!unified && !old) continue;
    for (std::string path = line.substr(second + 1);; path.erase(path.find_last_of('/'))) {
      const std::string folder = (unified ? "/sys/fs/cgroup" : "/sys/fs/cgroup/cpu") + (path == "/" ? "" : path);
      const double quota = unified ? quota_in(folder + "/cpu.max") : quota_in(folder + "/cpu.cfs_quota_us", folder + "/cpu.cfs_period_us");
      if (quota > 0) least = least > 0 ? std::min(least, quota) : quota;
      if (path.find('/') == std::string::npos) break;
    }
  }
  return least;
}

}  // namespace

int usable_processors() {
  cpu_set_t allowed;
  const int machine =
      ::sched_getaffinity(0, sizeof(allowed), &allowed) == 0 ? CPU_COUNT(&allowed) : int(std::thread::hardware_concurrency());
  const double quota = least_quota();
  const int granted = quota > 0 ? std::max(1, int(quota + 0.5)) : machine;
  return std::max(1, std::min(machine, granted));
}

int this_core() { return ::sched_getcpu(); }

void leave_core(int core) {
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof(allowed), &allowed) != 0 || core < 0 || core >= CPU_SETSIZE) return;
  cpu_set_t others = allowed;
  CPU_CLR(core, &others);
  if (CPU_COUNT(&others) == 0 || ::sched_setaffinity(0, sizeof(others), &others) != 0) return;
  ::sched_setaffinity(0, sizeof(allowed), &allowed);
}

OwnCore::OwnCore(int i, int threads) {
  if (threads < 2 || ::sched_getaffinity(0, sizeof(before_), &before_) != 0 || CPU_COUNT(&before_) != threads) return;
  int core = 0;
  for (int left = i; !CPU_ISSET(core, &before_) || left-- > 0;) ++core;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(core, &one);
  bound_ = ::sched_setaffinity(0, sizeof(one), &one) == 0;
}

OwnCore::~OwnCore() {
  if (bound_) ::sched_setaffinity(0, sizeof(before_), &before_);
}

}  // namespace erbs
