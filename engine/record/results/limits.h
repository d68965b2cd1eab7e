// Limits on errors, from the command line: 'peak<5%,lag<0.01,correlation>0.9'.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine/record/format/json.h"

namespace erbs {

struct Limit {
  std::string text, quantity;
  char sign = '<';   // < or >, of the magnitude
  double bound = 0;  // in the unit of the quantity
};

// What a comparison can measure: name, unit, meaning.
struct ComparedQuantity {
  const char *name, *unit, *text;
};
const std::vector<ComparedQuantity>& compared_quantities();

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
