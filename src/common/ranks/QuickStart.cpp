// SPDX-License-Identifier: BSD-3-Clause
#include "common/ranks/QuickStart.hpp"

#include <cstdlib>
#include <utility>

namespace tooljoint::parallel {

QuickStart::QuickStart() {
  // Variables that mpirun, PMIx and PMI launchers, and Slurm set for the processes they start.
  for (const char* launched :
       {"OMPI_COMM_WORLD_SIZE", "PMIX_NAMESPACE", "PMI_SIZE", "SLURM_PROCID"})
    if (std::getenv(launched)) return;
  for (const auto& [name, value] :
       {std::pair{"OMPI_MCA_ess_singleton_isolated", "1"}, {"OMPI_MCA_pml", "ob1"}})
    if (!std::getenv(name) && setenv(name, value, 0) == 0) set_.push_back(name);
}

QuickStart::~QuickStart() {
  for (const char* name : set_) unsetenv(name);
}

}  // namespace tooljoint::parallel
