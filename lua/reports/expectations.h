// Comparison of a scene's expectations with the metrics of its run.
#pragma once
#include <string>
#include <vector>

#include "engine/record/format/json.h"
#include "engine/scene/scene.h"

namespace erbs::lua {

struct Verdict {
  bool passed = false;
  std::string key, expected, got, error, tolerance, source, place;  // as printed in tables
  std::string stored, actual;  // file beside the scene, and what replaces its content; "": nothing is stored
  std::string scene;           // identity of the run, which is stored with its value
  double used = 0;             // error over tolerance: 1 at the limit, infinite if the run gives no value
};

std::vector<Verdict> judge(const std::vector<Expectation>& expectations, const Json& metrics);
Json to_json(const std::vector<Verdict>& verdicts);
std::vector<Verdict> verdicts_of(const Json& json);  // from expectations.json
bool expects_status(const Scene& scene, const std::string& status);

}  // namespace erbs::lua
