#include "engine/model/kept_lanes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "engine/model/block_field.h"
#include "engine/model/model.h"

namespace erbs {
namespace {

constexpr int record = 6 * lanes;  // doubles
std::size_t z(int i) { return std::size_t(i); }

// A joint of one of eight blocks, and the record it reads.
struct End {
  int joint, record;
};
using Hand = std::array<std::vector<End>, lanes>;
using Round = std::array<int, lanes>;  // joint of each lane; -1: none

struct Wanted {
  int record;
  unsigned lanes;  // lanes with an unscheduled joint that reads the record, as bits
};

// The records that unscheduled joints read: the few that serve most lanes, in that order.
std::vector<Wanted> wanted(const Hand& hand) {
  std::vector<Wanted> out;
  for (int l = 0; l < lanes; ++l)
    for (const End& e : hand[z(l)]) out.push_back({e.record, 1U << l});
  std::sort(out.begin(), out.end(), [](const Wanted& a, const Wanted& b) { return a.record < b.record; });
  std::size_t n = 0;
  for (const Wanted& w : out) {
    if (n > 0 && out[n - 1].record == w.record) out[n - 1].lanes |= w.lanes;
    else out[n++] = w;
  }
  out.resize(n);
  std::stable_sort(out.begin(), out.end(),
                   [](const Wanted& a, const Wanted& b) { return std::popcount(a.lanes) > std::popcount(b.lanes); });
  constexpr std::size_t few = 16;
  if (n > few) out.resize(few);
  return out;
}

// The two records that serve most lanes. A lane that must be served now and would read a third record counts against the choice.
std::pair<int, int> best_two(const std::vector<Wanted>& all, unsigned must) {
  int best = -1000;
  std::pair<int, int> out{-1, -1};
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i; j < all.size(); ++j) {
      const unsigned served = all[i].lanes | all[j].lanes;
      const int worth = 2 * std::popcount(served) - 4 * std::popcount(must & ~served);
      if (worth > best) best = worth, out = {all[i].record, all[j].record};
    }
  return out;
}

// Schedules the joints of a group: as many rounds as the busiest lane has joints, each with the two records that serve it best. A lane with
// as many joints left as rounds is used in every round, with a third record if necessary.
std::vector<Round> deal(Hand hand) {
  std::size_t most = 0;
  for (const auto& ends : hand) most = std::max(most, ends.size());
  std::vector<Round> out;
  for (std::size_t rounds = most; rounds > 0; --rounds) {
    unsigned must = 0;
    for (int l = 0; l < lanes; ++l) must |= hand[z(l)].size() == rounds ? 1U << l : 0;
    const auto [one, two] = best_two(wanted(hand), must);
    Round& round = out.emplace_back();
    for (int l = 0; l < lanes; ++l) {
      auto& ends = hand[z(l)];
      auto found = std::find_if(ends.begin(), ends.end(), [&, a = one, b = two](const End& e) { return e.record == a || e.record == b; });
      if (found == ends.end() && ends.size() == rounds) found = ends.begin();
      round[z(l)] = -1;
      if (found == ends.end()) continue;
      round[z(l)] = found->joint;
      ends.erase(found);
    }
  }
  return out;
}

// Gather table from the sources of eight lanes. `at`: record * lanes + lane of each source, `none` for an unused lane.
Crossing crossing(const int at[lanes], int none) {
  Crossing out{};
  int of[lanes] = {}, lanes_of[lanes] = {};
  for (int l = 0; l < lanes; ++l) {
    if (at[l] == none) continue;
    const int r = at[l] / lanes, i = int(std::find(of, of + out.records, r) - of);
    if (i == out.records) of[out.records++] = r;
    ++lanes_of[i];
  }
  for (int i = 0; i < out.records; ++i)  // records of many lanes first
    for (int k = i; k > 0 && lanes_of[k] > lanes_of[k - 1]; --k) std::swap(of[k], of[k - 1]), std::swap(lanes_of[k], lanes_of[k - 1]);
  for (int l = lanes - 1; l >= 0; --l) {
    const int i = at[l] == none ? lanes : int(std::find(of, of + out.records, at[l] / lanes) - of);
    out.at[l] = at[l] / lanes * record + at[l] % lanes + (i == 1 ? lanes : 0);
    if (i < lanes) out.first[i] = std::uint8_t(l), out.who[i] = std::uint8_t(out.who[i] | 1 << l);
  }
  if (out.records == 1) out.first[1] = out.first[0];
  out.who[0] = std::uint8_t(out.who[0] | out.who[1]);
  return out;
}

void deal_kept(const Model& m, KeptLanes& out) {
  std::vector<Hand> hands(block_groups(m.nblock));
  const auto other = [&](int j) { return m.joint[z(j)].kept_by_b ? m.joint[z(j)].a : m.joint[z(j)].b; };
  for (int j = 0; j < m.njoint; ++j) hands[z(m.keeper(j) / lanes)][z(m.keeper(j) % lanes)].push_back({j, other(j) / lanes});
  out.lane.resize(z(m.njoint));
  out.first_batch.assign(1, 0);
  for (Hand& hand : hands) {
    for (const Round& round : deal(std::move(hand))) {
      int at[lanes];
      for (int l = 0; l < lanes; ++l) {
        const int j = round[z(l)];
        at[l] = j < 0 ? m.nblock : other(j);
        if (j >= 0) out.lane[z(j)] = int(out.joint.size());
        out.joint.push_back(j);
      }
      out.other.push_back(crossing(at, m.nblock));
    }
    out.first_batch.push_back(int(out.other.size()));
  }
}

void deal_taken(const Model& m, KeptLanes& out) {
  std::vector<Hand> hands(block_groups(m.nblock));
  std::vector<std::vector<int>> ends(z(m.nblock));
  for (int j = 0; j < m.njoint; ++j) {
    const int b = m.joint[z(j)].kept_by_b ? m.joint[z(j)].a : m.joint[z(j)].b, lane = out.lane[z(j)];
    ends[z(b)].push_back(lane / lanes * record + lane % lanes);
    if (m.kind[z(b)] == Kind::moving) hands[z(b / lanes)][z(b % lanes)].push_back({j, lane / lanes});
  }
  const int none = int(out.joint.size());
  out.first_taken.assign(1, 0);
  for (Hand& hand : hands) {
    for (const Round& round : deal(std::move(hand))) {
      int at[lanes];
      for (int l = 0; l < lanes; ++l) at[l] = round[z(l)] < 0 ? none : out.lane[z(round[z(l)])];
      out.taken.push_back(crossing(at, none));
    }
    out.first_taken.push_back(int(out.taken.size()));
  }
  out.first_end.assign(1, 0);
  for (const auto& of_block : ends) {
    out.end.insert(out.end.end(), of_block.begin(), of_block.end());
    out.first_end.push_back(int(out.end.size()));
  }
}

}  // namespace

KeptLanes deal_lanes(const Model& model) {
  KeptLanes out;
  deal_kept(model, out);
  deal_taken(model, out);
  return out;
}

}  // namespace erbs
