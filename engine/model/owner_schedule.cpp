#include "engine/model/owner_schedule.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "engine/base/count.h"
#include "engine/model/block_arrays.h"
#include "engine/model/model.h"

namespace erbs {
namespace {

constexpr int record = 6 * pack_size;  // doubles

// A joint of one of eight blocks, and the record it reads.
struct End {
  int joint, record;
};
using Bucket = std::array<std::vector<End>, pack_size>;
using Round = std::array<int, pack_size>;  // joint of each lane; -1: none

struct Wanted {
  int record;
  unsigned lane_bits;  // lanes with an unscheduled joint that reads the record, as bits
};

// The records that unscheduled joints read: the few that serve most lanes, in that order.
std::vector<Wanted> wanted(const Bucket& bucket) {
  std::vector<Wanted> out;
  for (int l = 0; l < pack_size; ++l)
    for (const End& e : bucket[z(l)]) out.push_back({e.record, 1U << l});
  std::sort(out.begin(), out.end(), [](const Wanted& a, const Wanted& b) { return a.record < b.record; });
  std::size_t n = 0;
  for (const Wanted& w : out) {
    if (n > 0 && out[n - 1].record == w.record) out[n - 1].lane_bits |= w.lane_bits;
    else out[n++] = w;
  }
  out.resize(n);
  std::stable_sort(out.begin(), out.end(),
                   [](const Wanted& a, const Wanted& b) { return std::popcount(a.lane_bits) > std::popcount(b.lane_bits); });
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
      const unsigned served = all[i].lane_bits | all[j].lane_bits;
      const int worth = 2 * std::popcount(served) - 4 * std::popcount(must & ~served);
      if (worth > best) best = worth, out = {all[i].record, all[j].record};
    }
  return out;
}

// Schedules the joints of a group: as many rounds as the busiest lane has joints, each with the two records that serve it best. A lane with
// as many joints left as rounds is used in every round, with a third record if necessary.
std::vector<Round> schedule(Bucket bucket) {
  std::size_t most = 0;
  for (const auto& ends : bucket) most = std::max(most, ends.size());
  std::vector<Round> out;
  for (std::size_t rounds = most; rounds > 0; --rounds) {
    unsigned must = 0;
    for (int l = 0; l < pack_size; ++l) must |= bucket[z(l)].size() == rounds ? 1U << l : 0;
    const auto [one, two] = best_two(wanted(bucket), must);
    Round& round = out.emplace_back();
    for (int l = 0; l < pack_size; ++l) {
      auto& ends = bucket[z(l)];
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
GatherTable gather_table(const int at[pack_size], int none) {
  GatherTable out{};
  int of[pack_size] = {}, lanes_of[pack_size] = {};
  for (int l = 0; l < pack_size; ++l) {
    if (at[l] == none) continue;
    const int r = at[l] / pack_size, i = int(std::find(of, of + out.records, r) - of);
    if (i == out.records) of[out.records++] = r;
    ++lanes_of[i];
  }
  for (int i = 0; i < out.records; ++i)  // records of many lanes first
    for (int k = i; k > 0 && lanes_of[k] > lanes_of[k - 1]; --k) std::swap(of[k], of[k - 1]), std::swap(lanes_of[k], lanes_of[k - 1]);
  for (int l = pack_size - 1; l >= 0; --l) {
    const int i = at[l] == none ? pack_size : int(std::find(of, of + out.records, at[l] / pack_size) - of);
    out.at[l] = at[l] / pack_size * record + at[l] % pack_size + (i == 1 ? pack_size : 0);
    if (i < pack_size) out.first[i] = std::uint8_t(l), out.who[i] = std::uint8_t(out.who[i] | 1 << l);
  }
  if (out.records == 1) out.first[1] = out.first[0];
  out.who[0] = std::uint8_t(out.who[0] | out.who[1]);
  return out;
}

void schedule_owned(const Model& m, OwnerSchedule& out) {
  std::vector<Bucket> buckets(block_groups(m.nblock));
  const auto other = [&](int j) { return m.joint[z(j)].owned_by_b ? m.joint[z(j)].a : m.joint[z(j)].b; };
  for (int j = 0; j < m.njoint; ++j) buckets[z(m.owner(j) / pack_size)][z(m.owner(j) % pack_size)].push_back({j, other(j) / pack_size});
  out.lane.resize(z(m.njoint));
  out.first_pack.assign(1, 0);
  for (Bucket& bucket : buckets) {
    for (const Round& round : schedule(std::move(bucket))) {
      int at[pack_size];
      for (int l = 0; l < pack_size; ++l) {
        const int j = round[z(l)];
        at[l] = j < 0 ? m.nblock : other(j);
        if (j >= 0) out.lane[z(j)] = int(out.joint.size());
        out.joint.push_back(j);
      }
      out.other.push_back(gather_table(at, m.nblock));
    }
    out.first_pack.push_back(int(out.other.size()));
  }
}

void schedule_gathers(const Model& m, OwnerSchedule& out) {
  std::vector<Bucket> buckets(block_groups(m.nblock));
  std::vector<std::vector<int>> ends(z(m.nblock));
  for (int j = 0; j < m.njoint; ++j) {
    const int b = m.joint[z(j)].owned_by_b ? m.joint[z(j)].a : m.joint[z(j)].b, lane = out.lane[z(j)];
    ends[z(b)].push_back(lane / pack_size * record + lane % pack_size);
    if (m.kind[z(b)] == Kind::moving) buckets[z(b / pack_size)][z(b % pack_size)].push_back({j, lane / pack_size});
  }
  const int none = int(out.joint.size());
  out.first_gather.assign(1, 0);
  for (Bucket& bucket : buckets) {
    for (const Round& round : schedule(std::move(bucket))) {
      int at[pack_size];
      for (int l = 0; l < pack_size; ++l) at[l] = round[z(l)] < 0 ? none : out.lane[z(round[z(l)])];
      out.gather_in.push_back(gather_table(at, none));
    }
    out.first_gather.push_back(int(out.gather_in.size()));
  }
  out.first_end.assign(1, 0);
  for (const auto& of_block : ends) {
    out.end.insert(out.end.end(), of_block.begin(), of_block.end());
    out.first_end.push_back(int(out.end.size()));
  }
}

}  // namespace

OwnerSchedule make_owner_schedule(const Model& model) {
  OwnerSchedule out;
  schedule_owned(model, out);
  schedule_gathers(model, out);
  return out;
}

}  // namespace erbs
