// Limits on errors, from the command line: 'peak<5%,lag<0.01,correlation>0.9'.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/record/format/json.h"
#include "engine/record/results/compare_runs.h"

namespace erbs {

struct Limit {
  std::string text, quantity;
  char sign = '<';   // < or >, of the magnitude
  double bound = 0;  // in the unit of the quantity
};

// What a comparison can measure: name, unit, meaning, its values of two runs, and its key in frames.json of a comparison with a film ("":
// none).
struct ComparedQuantity {
  const char *name, *unit, *text;
  std::vector<double> (*of_runs)(const RunComparison&);
  const char* of_film;
};
const std::vector<ComparedQuantity>& compared_quantities();
// "peak, rms, .., shift (s), ..": those of two runs, or those of a film.
std::string compared_names(bool of_film);
// Empty where the reference does not say it.
std::vector<double> values_of(const RunComparison& comparison, const std::string& quantity);
std::vector<double> values_of(const Json& frames, const std::string& quantity);

// Error that names the part which is malformed and the quantities known.
std::vector<Limit> limits_of(const std::string& text);

struct Judged {
  Limit limit;
  std::vector<double> values;  // those of a quantity, one for each column or frame
  double worst = 0;            // NaN fails
  bool passed = false;
};
// `values` gives all values of a quantity; Error if there is none.
std::vector<Judged> judge(const std::vector<Limit>& limits, const std::function<std::vector<double>(const std::string&)>& values);

Json json_of(const std::vector<Judged>& judged);
std::string table_of(const std::vector<Judged>& judged);

}  // namespace erbs
