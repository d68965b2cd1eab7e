#include "engine/base/spelling.h"

#include <algorithm>
#include <cctype>

#include "engine/base/error.h"

namespace erbs {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

// Edit distance: letters inserted, dropped, replaced, or two neighbours swapped (Damerau 1964, optimal alignment). Each edit costs 2, a
// change of case 1.
int distance(std::string_view a, std::string_view b) {
  const size_t n = a.size(), m = b.size();
  std::vector<std::vector<int>> d(n + 1, std::vector<int>(m + 1));
  for (size_t i = 0; i <= n; ++i) d[i][0] = 2 * static_cast<int>(i);
  for (size_t j = 0; j <= m; ++j) d[0][j] = 2 * static_cast<int>(j);
  for (size_t i = 1; i <= n; ++i)
    for (size_t j = 1; j <= m; ++j) {
      const int replace = a[i - 1] == b[j - 1] ? 0 : lower(a[i - 1]) == lower(b[j - 1]) ? 1 : 2;
      d[i][j] = std::min({d[i - 1][j] + 2, d[i][j - 1] + 2, d[i - 1][j - 1] + replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 2);
    }
  return d[n][m];
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  if (word.size() > 64) return {};
  std::string best;
  // a third of the letters may be wrong, at least one
  int limit = 2 * std::max(1, static_cast<int>(word.size()) / 3);
  for (const auto& candidate : known) {
    if (candidate.size() > 64) continue;
    const int d = distance(word, candidate);
    if (d <= limit) {
      best = candidate;
      limit = d - 1;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::string near = nearest(word, known);
  if (!near.empty()) return fmt::format("; did you mean \"{}\"?", near);
  std::vector<std::string> named = known;
  std::erase(named, "");  // such as the group of blocks that name none
  if (named.empty()) return "; none is known";
  constexpr size_t most = 40;
  const size_t more = named.size() - std::min(named.size(), most);
  named.resize(named.size() - more);
  return fmt::format("; known: {}{}", fmt::join(named, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

}  // namespace erbs
