// Bisection of a threshold, round by round. It chooses the values of each round and takes their answers, whoever makes the runs.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace erbs::study {

// Answer of one run. Without a value `reason` gives the cause: crash, divergence, NaN, mistake of the scene.
struct Answer {
  double x = 0;  // value of the parameter
  std::optional<double> value;
  std::string reason;
};

std::string said(const Answer& answer);                        // "at 2.5: crashed"
std::string first_reason(const std::vector<Answer>& answers);  // of the first answer without a value; "" if all have one

// Multisection: `points` runs at a time between the ends. The smallest value whose answer is yes (not 0) is the new upper end. A run
// without an answer does not change the bracket. The rounds depend on the answers alone, and so does the result.
class Bracket {
 public:
  // lo: value of a no, hi: value of a yes; lo may be the larger one. rel: width of the last bracket over its larger end, or over a
  // thousandth of hi - lo if that is more: a threshold of zero is found to 1e-3 rel of the range.
  Bracket(double lo, double hi, double rel, int points);
  std::vector<double> next() const;               // values of the next round, first the two ends; empty once it is finished
  void take(const std::vector<Answer>& answers);  // of that round, in its order
  bool found() const { return known_ && trouble_.empty(); }
  bool known() const { return known_; }  // the ends differ
  double lo() const { return at(lo_); }
  double hi() const { return at(hi_); }
  double middle() const { return 0.5 * (lo() + hi()); }
  const std::string& trouble() const { return trouble_; }  // why there is no result; "" otherwise

 private:
  double at(double share) const { return share == 0 ? first_ : share == 1 ? last_ : first_ + share * (last_ - first_); }
  double last_width() const;
  void take_ends(const std::vector<Answer>& ends);
  double first_, last_, rel_;
  int points_;
  double lo_ = 0, hi_ = 1;  // shares of the interval from first_ to last_
  bool asked_ = false, known_ = false;
  std::string trouble_;
};

}  // namespace erbs::study
