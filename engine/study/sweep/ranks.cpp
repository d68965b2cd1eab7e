#include "engine/study/sweep/ranks.h"

#include <algorithm>
#include <cstdlib>

namespace erbs::study {
namespace {

const char* variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : nullptr;
}

// Takes rank and size from two variables; false if they are absent or no numbers that fit.
bool take(Ranks& ranks, const char* rank, const char* size) {
  if (!variable(rank) || !variable(size)) return false;
  const int r = std::atoi(variable(rank)), n = std::atoi(variable(size));
  if (n < 1 || r < 0 || r >= n) return false;
  ranks.rank = r, ranks.size = n;
  return true;
}

}  // namespace

Ranks ranks_of_environment() {
  Ranks ranks;
  ranks.array_task = variable("SLURM_ARRAY_TASK_ID") != nullptr;
  // Slurm's variables count only within a step of srun: the script of a batch job sees them too, and is one process.
  ranks.launched = take(ranks, "OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE") || take(ranks, "PMI_RANK", "PMI_SIZE") ||
                   (variable("SLURM_STEP_ID") && take(ranks, "SLURM_PROCID", "SLURM_STEP_NUM_TASKS"));
  if (ranks.size == 1) return ranks;
  for (const char* name : {"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS", "SLURM_NTASKS_PER_NODE"})
    if (ranks.here == 1 && variable(name)) ranks.here = std::clamp(std::atoi(variable(name)), 1, ranks.size);
  for (const char* name : {"PMIX_NAMESPACE", "OMPI_MCA_ess_base_jobid", "PMI_JOBID"})
    if (ranks.launch.empty() && variable(name)) ranks.launch = std::string(name) + "=" + variable(name);
  if (ranks.launch.empty() && variable("SLURM_JOB_ID") && variable("SLURM_STEP_ID"))
    ranks.launch = std::string("slurm=") + variable("SLURM_JOB_ID") + "." + variable("SLURM_STEP_ID");
  return ranks;
}

}  // namespace erbs::study
