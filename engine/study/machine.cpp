#include "engine/study/machine.h"

#include <linux/perf_event.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <vector>

#include "engine/joints/kernels.h"

namespace erbs::study {

double processor_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return double(used.ru_utime.tv_sec) + 1e-6 * double(used.ru_utime.tv_usec);
}

double wall_seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double machine_memory() { return double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGE_SIZE)); }

// STREAM triad (McCalpin 1995): 24 bytes per element. The read of a cache line before its write is not counted.
double triad(std::size_t bytes) {
  const std::size_t n = std::max<std::size_t>(bytes / 24, 64);
  std::vector<double> a(n, 0.0), b(n, 1.0), c(n, 2.0);
  const long rounds = std::max(1L, long(4e8 / (24 * double(n))));
  std::vector<double> rates;
  for (int sample = 0; sample < 5; ++sample) {
    const double began = processor_seconds();
    for (long r = 0; r < rounds; ++r) {
      const double s = 1e-3 * double(r);
      double* const pa = a.data();
      const double *const pb = b.data(), *const pc = c.data();
      for (std::size_t i = 0; i < n; ++i) pa[i] = pb[i] + s * pc[i];
      std::swap(a, b);
    }
    rates.push_back(24 * double(n) * double(rounds) / std::max(1e-9, processor_seconds() - began));
  }
  std::sort(rates.begin(), rates.end());
  return rates[2] + 1e-30 * a[n / 2];
}

double flop_peak() {
  std::vector<double> rates;
  for (int sample = 0; sample < 5; ++sample) {
    const double began = processor_seconds();
    const double flop = step_kernels().work_registers(4000000);
    rates.push_back(flop / std::max(1e-9, processor_seconds() - began));
  }
  std::sort(rates.begin(), rates.end());
  return rates[2];
}

InstructionCounter::InstructionCounter() {
  perf_event_attr what{};
  what.type = PERF_TYPE_HARDWARE;
  what.size = sizeof what;
  what.config = PERF_COUNT_HW_INSTRUCTIONS;
  what.exclude_kernel = what.exclude_hv = 1;
  file_ = static_cast<int>(syscall(SYS_perf_event_open, &what, 0, -1, -1, 0));
}

InstructionCounter::~InstructionCounter() {
  if (file_ >= 0) close(file_);
}

double InstructionCounter::read() const {
  std::uint64_t count = 0;
  if (file_ < 0 || ::read(file_, &count, sizeof count) != sizeof count) return 0;
  return double(count);
}

}  // namespace erbs::study
