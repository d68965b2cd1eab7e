#include "engine/analysis/resume.h"

#include <filesystem>

#include "engine/base/hash.h"

namespace erbs::analysis {

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

std::shared_ptr<const FolderLock> reserve_folder(const std::string& directory, Existing existing,
                                                 const std::vector<std::string>& override_arguments) {
  check_run_folder(directory, existing);
  std::shared_ptr<const FolderLock> lock;
  if (std::filesystem::is_directory(directory)) lock = std::make_shared<FolderLock>(directory);
  if (existing == Existing::resume) check_overrides(directory, override_arguments);
  return lock;
}

CheckpointKey checkpoint_key(const Scene& scene, const std::string& script, double dt, const std::vector<std::string>& override_arguments) {
  return {scene_hash(scene, script), dt, fnv1a(fmt::format("{}", fmt::join(override_arguments, "\n")))};
}

std::vector<std::size_t> sizes_of(const State& s) {
  return {s.pose.u.size(),
          s.pose.q.size(),
          s.motion.v.size(),
          s.motion.spin_momentum.size(),
          s.motion.w.size(),
          s.cache.ref_u.size(),
          s.cache.ref_q.size(),
          s.topology.island.size(),
          s.topology.loose.size(),
          s.topology.grounded.size(),
          s.topology.joined.size(),
          s.joints.stage.size(),
          s.joints.slot.size(),
          s.joints.memory.size(),
          s.joints.history.size(),
          s.joints.crushed.size(),
          s.joints.viscous.size(),
          s.cache.wrench.size(),
          s.cache.increment.size(),
          s.cache.owner_sum.size(),
          s.cache.neighbour_force.size()};
}

void check_sizes(const std::string& directory, const std::vector<std::size_t>& built, const State& read) {
  if (sizes_of(read) != built)
    throw Error("is of another model: its blocks, joints or contact points are not as many as this scene has; start anew with --force",
                {directory + "/checkpoint.bin", 0});
}

}  // namespace erbs::analysis
