#include "lua/reports/profile_text.h"

#include <numeric>
#include <utility>

#include "engine/base/error.h"

namespace erbs::lua {

std::string profile_text(const analysis::RunOutcome& outcome) {
  const Metrics& m = outcome.metrics;
  const Metrics::Wall& wall = m.wall_s;
  const auto percent = [&](double s) { return wall.total > 0 ? 100 * s / wall.total : 0; };
  std::string out = fmt::format("time of this call, {} thread{}:\n", m.threads, m.threads > 1 ? "s" : "");
  const std::pair<const char*, double> rows[] = {{"setup", wall.setup},   {"joints", wall.joints},       {"contact", wall.contact},
                                                 {"search", wall.search}, {"integrate", wall.integrate}, {"ledger", wall.ledger},
                                                 {"record", wall.record}};
  for (const auto& [name, s] : rows) out += fmt::format("  {:<10} {:9.3f} s {:5.1f} %\n", name, s, percent(s));
  out += fmt::format("  {:<10} {:9.3f} s\n", "total", wall.total);
  const Profile& profile = outcome.profile;
  if (profile.noted() == 0) return out;
  out += fmt::format("steps of {:.3g} us on average; what kept them from being longer, share of steps:\n", 1e6 * profile.mean_dt());
  for (const std::string& line : outcome.limits) out += "  " + line + "\n";
  const auto& level = profile.evaluations();
  const long all = std::accumulate(level.begin(), level.end(), 0L);
  if (all == 0) return out;
  out += fmt::format("{:.3g} pairs of blocks evaluated in a step, on average\n", double(all) / double(profile.noted()));
  out += "pair evaluations by level, each twice the interval of the one before:\n ";
  for (std::size_t l = 0; l < level.size(); ++l)
    if (level[l] > 0) out += fmt::format(" {}: {:.1f} %", l, 100 * double(level[l]) / double(all));
  return out + "\n";
}

}  // namespace erbs::lua
