#include "engine/analysis/resume.h"

#include "engine/record/folder/run_folder.h"

namespace erbs {

void check_overrides(const std::string& directory, const std::vector<std::string>& override_arguments) {
  std::vector<std::string> before;
  try {
    before = read_manifest(directory).override_arguments;
  } catch (const std::exception&) { return; }  // damaged; the checkpoint holds them too
  if (before == override_arguments) return;
  const auto words = [](const std::vector<std::string>& list) { return list.empty() ? "none" : fmt::format("{}", fmt::join(list, " ")); };
  throw Error(
      fmt::format("the run in \"{}\" was started with other options: {}; now they are: {}. Resume with those of the run, or start anew "
                  "with --force",
                  directory, words(before), words(override_arguments)));
}

std::vector<std::size_t> sizes_of(const State& s) {
  return {s.u.size(),
          s.q.size(),
          s.v.size(),
          s.spin_momentum.size(),
          s.w.size(),
          s.ref_u.size(),
          s.ref_q.size(),
          s.island.size(),
          s.loose.size(),
          s.grounded.size(),
          s.joined.size(),
          s.stage.size(),
          s.slot.size(),
          s.memory.size(),
          s.history.size(),
          s.crushed.size(),
          s.viscous.size(),
          s.wrench.size(),
          s.increment.size(),
          s.owner_sum.size(),
          s.neighbour_force.size()};
}

void check_sizes(const std::string& directory, const std::vector<std::size_t>& built, const State& read) {
  if (sizes_of(read) != built)
    throw Error("is of another model: its blocks, joints or contact points are not as many as this scene has; start anew with --force",
                {directory + "/checkpoint.bin", 0});
}

}  // namespace erbs
