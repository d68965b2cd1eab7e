#include "engine/study/pool.h"

#include <algorithm>

#include "engine/base/system/affinity.h"

namespace erbs::study {

Pool::Pool(int at_once) : at_once_(std::size_t(at_once > 0 ? at_once : usable_processors())) {}

Pool::~Pool() {
  for (const auto& [pid, run] : running_) run.own_group ? stop_group({pid}) : stop_hard({pid});
  for (const auto& [pid, run] : running_) {
    Child child{pid};
    finish(child);
  }
}

void Pool::add(std::size_t id, const Job& job) {
  const Child child = start(job.command, job.how);
  running_[child.pid] = {id, Clock::now(), job.ask_after, job.kill_after, job.how.own_group};
}

void Pool::hurry() {
  for (auto& [pid, run] : running_) {
    const double wall = std::chrono::duration<double>(Clock::now() - run.begin).count();
    if (run.ask_after > 0 && wall > run.ask_after && !run.asked) run.asked = true, interrupt({pid});
    if (run.kill_after > 0 && wall > run.kill_after && !run.killed) {
      run.killed = true;
      run.own_group ? stop_group({pid}) : stop_hard({pid});
    }
  }
}

std::optional<Finished> Pool::wait(double seconds) {
  hurry();
  double most = seconds;
  std::vector<int> pids;
  for (const auto& [pid, run] : running_) {
    pids.push_back(pid);
    const double wall = std::chrono::duration<double>(Clock::now() - run.begin).count();
    if (run.ask_after > 0 && !run.asked) most = std::min(most, run.ask_after - wall);
    if (run.kill_after > 0 && !run.killed) most = std::min(most, run.kill_after - wall);
  }
  const Ended ended = wait_for_one(pids, std::max(most, 1e-3));
  const auto found = running_.find(ended.pid);
  if (found == running_.end()) return std::nullopt;
  const Running run = found->second;
  running_.erase(found);
  const double wall = std::chrono::duration<double>(Clock::now() - run.begin).count();
  return Finished{run.id, ended.code, wall, ended.cpu, ended.memory, run.asked || run.killed};
}

void Pool::interrupt_all() {
  if (interrupted_) return;
  interrupted_ = true;
  for (const auto& [pid, run] : running_) interrupt({pid});
}

}  // namespace erbs::study
