#include "lua/reports/profile_text.h"

#include <utility>

#include "engine/base/error.h"
#include "engine/base/text.h"

namespace erbs::lua {

std::string profile_text(const analysis::RunOutcome& outcome) {
  const Metrics& m = outcome.metrics;
  const Metrics::Wall& wall = m.wall_s;
  const auto percent = [&](double s) { return wall.total > 0 ? 100 * s / wall.total : 0; };
  std::string out = fmt::format("time of this call, {}:\n", counted(m.threads, "thread"));
  const std::pair<const char*, double> rows[] = {{"setup", wall.setup},   {"joints", wall.joints},       {"contact", wall.contact},
                                                 {"search", wall.search}, {"integrate", wall.integrate}, {"ledger", wall.ledger},
                                                 {"record", wall.record}};
  for (const auto& [name, s] : rows) out += fmt::format("  {:<10} {:9.3f} s {:5.1f} %\n", name, s, percent(s));
  out += fmt::format("  {:<10} {:9.3f} s\n", "total", wall.total);
  const Profile& profile = outcome.profile;
  if (profile.steps() == 0) return out;
  out += fmt::format("steps of {:.3g} us on average; what kept them from being longer, share of steps:\n", 1e6 * profile.mean_dt());
  for (const std::string& line : outcome.limits) out += "  " + line + "\n";
  const long all = profile.fast() + profile.slow();
  if (all > 0) out += fmt::format("{:.3g} pairs of blocks evaluated in a step, on average\n", double(all) / double(profile.steps()));
  if (profile.slow() > 0)
    out += fmt::format("contacts of loose blocks act every {:.3g} us on average; {:.1f} % of all evaluations are theirs\n",
                       1e6 * profile.mean_macro_dt(), 100 * double(profile.slow()) / double(all));
  return out;
}

}  // namespace erbs::lua
