// The process among those that one command of MPI or Slurm has started, by the environment that these set. The program needs neither: the
// processes share their work through a folder.
#pragma once
#include <string>

namespace erbs::study {

struct Ranks {
  int rank = 0, size = 1;
  int here = 1;             // ranks on this machine, which share its memory
  std::string launch;       // the same for all ranks of one launch, another one for each launch; "": not known
  bool launched = false;    // by MPI or srun, be it alone
  bool array_task = false;  // of a job array
};
Ranks ranks_of_environment();  // OpenMPI, MPICH and others with PMI, srun

}  // namespace erbs::study
