// A scene's expectations held against the metrics of its run.
#pragma once
#include <string>
#include <vector>

#include "engine/record/json.h"
#include "engine/scene/scene.h"

namespace erbs {

struct Verdict {
  bool passed = false;
  std::string key, expected, got, error, tolerance, source, place;  // as written in tables
  double used = 0;  // share of the tolerance that the error takes; 1 at its end, infinite where there is no answer
};

std::vector<Verdict> judge(const std::vector<Expectation>& expectations, const Json& metrics);
Json to_json(const std::vector<Verdict>& verdicts);
std::vector<Verdict> verdicts_of(const Json& json);  // of expectations.json
bool expects_status(const Scene& scene, const std::string& status);

}  // namespace erbs
