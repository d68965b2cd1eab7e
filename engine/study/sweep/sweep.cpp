#include "engine/study/sweep/sweep.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <thread>

#include "engine/study/bracket.h"
#include "engine/study/pool.h"
#include "engine/study/sweep/claims.h"
#include "engine/study/sweep/one_run.h"
#include "engine/study/sweep/shared_table.h"

namespace erbs::study {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

double number_of(const std::string& cell) {
  double value = std::nan("");
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

template <class... Lists>
Cells joined(const Lists&... lists) {
  Cells all;
  (all.insert(all.end(), lists.begin(), lists.end()), ...);
  return all;
}

Cells result_names(const Sweep& s) {
  const Cells bracket = s.bisected.empty() ? Cells{} : Cells{s.bisected, s.bisected + "_lo", s.bisected + "_hi"};
  return joined(Cells{"index"}, s.params, bracket, s.collected, Cells{"runs", "status", "reason"});
}

Cells run_names(const Sweep& s) {
  const Cells bracket = s.bisected.empty() ? Cells{} : Cells{s.bisected, "verdict"};
  return joined(Cells{"index"}, s.params, bracket, s.collected,
                Cells{"status", "reason", "wall_s", "cpu_s", "peak_memory_bytes", "machine"});
}

// A point under way: one run, or the rounds of its bisection. A run that is known already is not made again.
struct Active {
  Point point;
  std::optional<Bracket> bracket;
  std::vector<RunRow> known;                   // in the order of their end
  std::vector<double> round;                   // values of the present round
  std::vector<std::optional<RunRow>> answers;  // of the round
  std::size_t next = 0;                        // of the round, to be started
  std::size_t before = 0;                      // values of the rounds before
  std::int64_t runs = 0;
};

class Sweeper {
 public:
  explicit Sweeper(const Sweep& s)
      : s_(s),
        count_(point_count(s.plan)),
        results_(s.directory + "/" + results_file, result_names(s), s.key),
        runs_(s.directory + "/" + runs_file, run_names(s), s.key),
        claims_(s.directory + "/work"),
        pool_(s.at_once),
        done_(std::size_t(count_), false),
        first_(std::int64_t(s.begin_at * double(count_))) {
    fs::create_directories(s.directory + "/runs");
    refresh();
    begun_with_ = done_count_;
    runs_.read_new([&](const Cells& cells) {
      if (!done_[index_of(cells)]) half_[std::int64_t(index_of(cells))].push_back(row_of(cells));
    });
  }

  Swept carry_out() {
    while (done_count_ < count_ && !interrupted()) {
      claims_.beat();
      while (!pool_.full() && !interrupted() && !time_is_up() && start_one()) {}
      tell(false);
      if (!pool_.empty()) {
        if (const auto ended = pool_.wait(0.5)) take(*ended);
      } else if (time_is_up()) {
        break;
      } else if (active_.empty()) {
        refresh();
        if (done_count_ == count_ || (!s_.wait && tried_ >= count_)) break;
        if (tried_ >= count_) std::this_thread::sleep_for(std::chrono::milliseconds(200));
        tried_ = tried_ >= count_ ? 0 : tried_;  // look for claims of the dead
      }
    }
    runs_.sync();
    if (done_count_ == count_) {
      if (const std::int64_t rows = results_.sort(); rows < count_)
        throw WriteError(fmt::format("has lost rows: it holds {} of {}, and another program has changed it; make them again with --resume",
                                     rows, count_),
                         {s_.directory + "/" + results_file, 0});
      claims_.remove_void();
      std::error_code kept;
      fs::remove(s_.directory + "/runs", kept);  // if nothing is in it
    }
    tell(true);
    return {count_, done_count_, failed_, made_, inherited_, first_failure_, interrupted()};
  }

 private:
  // The first runs start in any case.
  bool time_is_up() const { return s_.budget > 0 && next_id_ >= pool_.size() && seconds_since(begin_) > s_.budget; }
  bool interrupted() const { return s_.interrupted != nullptr && s_.interrupted->load(); }

  std::size_t index_of(const Cells& cells) const {
    const double index = number_of(cells.front());
    if (!(index >= 0 && index < double(count_)))
      throw Error(fmt::format("has a row {}, and the study has {} points; choose another folder with -o DIR", cells.front(), count_),
                  {s_.directory + "/" + results_file, 0});
    return std::size_t(index);
  }

  RunRow row_of(const Cells& cells) const {
    const std::size_t at = 1 + s_.params.size(), collected = at + (s_.bisected.empty() ? 0 : 2), end = collected + s_.collected.size();
    RunRow row;
    row.verdict = "nan";
    if (!s_.bisected.empty()) row.x = number_of(cells[at]), row.verdict = cells[at + 1];
    row.values.assign(cells.begin() + std::ptrdiff_t(collected), cells.begin() + std::ptrdiff_t(end));
    row.status = cells[end], row.reason = cells[end + 1];
    return row;
  }

  // Takes note of the points that are done, by whoever.
  void refresh() {
    results_.read_new([&](const Cells& cells) {
      const std::size_t i = index_of(cells);
      if (done_[i]) return;
      note(i, cells[cells.size() - 3], cells[cells.size() - 2]);
    });
  }

  void note(std::size_t index, const std::string& status, const std::string& reason) {
    done_[index] = true;
    ++done_count_;
    // Of a fragility, a capacity beyond an end of the bracket is an answer too: a bound.
    const bool bound = s_.plan.fragility && status == "no bracket" && reason.starts_with("the verdict is");
    if (status == "completed" || bound) return;
    ++failed_;
    if (first_failure_.empty()) first_failure_ = fmt::format("row {}: {}: {}", index, status, reason);
  }

  // Starts a run of a point under way, or of the next point that is free. False if there is none.
  bool start_one() {
    for (;;) {
      for (auto& [index, active] : active_)
        for (; active.next < active.round.size(); ++active.next)
          if (!active.answers[active.next]) {
            launch(index, active, active.next++);
            return true;
          }
      if (!claim_next()) return false;
    }
  }

  // Takes the next point that nobody has done or works on. False if there is none.
  bool claim_next() {
    for (; tried_ < count_; ++tried_) {
      const std::int64_t index = (first_ + tried_) % count_;
      if (done_[std::size_t(index)] || active_.contains(index)) continue;
      const Claims::Taken taken = claims_.take(index);
      if (taken == Claims::Taken::no) continue;
      refresh();
      if (done_[std::size_t(index)]) {
        claims_.release(index);
        continue;
      }
      ++tried_;
      activate(index, taken == Claims::Taken::from_the_dead);
      return true;
    }
    return false;
  }

  void activate(std::int64_t index, bool from_the_dead) {
    Active& active = active_[index];
    active.point = point_at(s_.plan, index);
    if (s_.plan.bisect) active.bracket.emplace(s_.plan.bisect->lo, s_.plan.bisect->hi, s_.plan.bisect->rel, s_.plan.bisect->points);
    inherited_ += from_the_dead ? 1 : 0;
    if (from_the_dead) {  // its owner may have finished some of its runs
      half_.erase(index);
      runs_.rewind();
      runs_.read_new([&](const Cells& cells) {
        if (index_of(cells) == std::size_t(index)) half_[index].push_back(row_of(cells));
      });
    }
    if (const auto found = half_.find(index); found != half_.end()) {
      active.known = std::move(found->second);
      half_.erase(found);
    }
    begin_round(index, active);
  }

  void begin_round(std::int64_t index, Active& active) {
    active.before += active.round.size();
    active.round = active.bracket ? active.bracket->next() : active.runs == 0 ? std::vector<double>{0} : std::vector<double>{};
    active.answers.assign(active.round.size(), std::nullopt);
    active.next = 0;
    if (active.round.empty()) return finish(index);
    for (std::size_t slot = 0; slot < active.round.size(); ++slot) take_known(active, slot);
    end_round(index, active);
  }

  // Takes a run from before, if there is one.
  static void take_known(Active& active, std::size_t slot) {
    for (const RunRow& row : active.known)
      if (row.x == active.round[slot] && !active.answers[slot]) active.answers[slot] = row, ++active.runs;
  }

  void launch(std::int64_t index, Active& active, std::size_t slot) {
    const std::string place = place_of(s_, index, active.before + slot);
    ++active.runs;
    const std::size_t id = next_id_++;
    Job job = job_of(s_, active.point, active.round[slot], place);
    const double left = std::max(10.0, s_.budget - seconds_since(begin_));  // a run that has begun gets some time
    const bool cut = s_.budget > 0 && (job.kill_after <= 0 || left < job.kill_after);
    if (cut) job.kill_after = left;
    under_way_[id] = {index, slot, place, cut};
    pool_.add(id, job);
  }

  void take(const Finished& finished) {
    const UnderWay run = under_way_.at(finished.id);
    under_way_.erase(finished.id);
    if (interrupted()) return;
    if (run.cut && finished.overdue) {  // it is made another time
      tidy(s_, {}, run.place);
      return;
    }
    Active& active = active_.at(run.index);
    RunRow row = read_run(s_, active.point, active.round[run.slot], run.place, finished);
    const Cells bracket = s_.bisected.empty() ? Cells{} : Cells{fmt::format("{}", row.x), row.verdict};
    runs_.append(joined(Cells{fmt::format("{}", run.index)}, cells_of(active.point), bracket, row.values,
                        Cells{row.status, row.reason, fmt::format("{:.4f}", row.wall), fmt::format("{:.4f}", row.cpu),
                              fmt::format("{:.0f}", row.memory), machine_}));
    ++made_;
    tidy(s_, row, run.place);
    active.known.push_back(row);
    active.answers[run.slot] = std::move(row);
    end_round(run.index, active);
  }

  void end_round(std::int64_t index, Active& active) {
    if (std::any_of(active.answers.begin(), active.answers.end(), [](const auto& answer) { return !answer; })) return;
    if (!active.bracket) return finish(index);
    std::vector<Answer> answers;
    for (const auto& row : active.answers) {
      Answer answer{row->x, std::nullopt, row->reason};
      if (row->verdict != "nan") answer.value = number_of(row->verdict);
      answers.push_back(std::move(answer));
    }
    active.bracket->take(answers);
    begin_round(index, active);
  }

  static Cells cells_of(const Point& point) {
    Cells cells;
    for (const auto& [param, value] : point) cells.push_back(text_of(value));
    return cells;
  }

  // Writes the row of a point. Of a bisection it shows what the run at the upper end of the last bracket gave.
  void finish(std::int64_t index) {
    const Active& active = active_.at(index);
    Cells bracket, values(s_.collected.size(), "nan");
    std::string status = "completed", reason;
    if (active.bracket) {
      const Bracket& b = *active.bracket;
      const auto number = [](bool there, double x) { return there ? fmt::format("{}", x) : std::string("nan"); };
      bracket = {number(b.found(), b.middle()), number(b.known(), b.lo()), number(b.known(), b.hi())};
      if (!b.found()) status = "no bracket", reason = b.trouble();
      for (const RunRow& row : active.known)
        if (b.found() && row.x == b.hi()) values = row.values;
    } else {
      const RunRow& row = active.known.back();
      values = row.values, status = row.status, reason = row.reason;
    }
    results_.append(joined(Cells{fmt::format("{}", index)}, cells_of(active.point), bracket, values,
                           Cells{fmt::format("{}", active.runs), status, reason}));
    active_.erase(index);
    note(std::size_t(index), status, reason);
    claims_.release(index);
  }

  void tell(bool end) {
    if (!s_.progress || (!end && seconds_since(told_) < 0.5)) return;
    told_ = Clock::now();
    if (!end) refresh();
    const double made = double(done_count_ - begun_with_);
    s_.progress({count_, done_count_, failed_, made_, made > 0 ? seconds_since(begin_) / made * double(count_ - done_count_) : -1, end});
  }

  struct UnderWay {
    std::int64_t index = 0;
    std::size_t slot = 0;
    std::string place;
    bool cut = false;  // its time is what the budget leaves
  };
  const Sweep& s_;
  std::int64_t count_;
  SharedTable results_, runs_;
  Claims claims_;
  Pool pool_;
  std::vector<bool> done_;
  std::int64_t first_, tried_ = 0;  // points looked at, from first_ on
  std::int64_t done_count_ = 0, failed_ = 0, made_ = 0, begun_with_ = 0, inherited_ = 0;
  std::map<std::int64_t, Active> active_;
  std::map<std::int64_t, std::vector<RunRow>> half_;  // runs of points that were left unfinished
  std::map<std::size_t, UnderWay> under_way_;
  std::size_t next_id_ = 0;
  std::string first_failure_, machine_ = machine();
  Clock::time_point begin_ = Clock::now(), told_ = {};
};

}  // namespace

Swept carry_out(const Sweep& sweep) { return Sweeper(sweep).carry_out(); }

}  // namespace erbs::study
