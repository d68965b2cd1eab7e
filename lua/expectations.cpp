#include "lua/expectations.h"

#include <algorithm>
#include <cmath>

namespace erbs {
namespace {

std::string short_number(double value) { return fmt::format("{:.6g}", value); }

// A word of metrics.json as an expectation writes it: completed, true, null.
std::string word(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

void judge_number(const Expectation& item, double got, Verdict& verdict) {
  using Kind = Expectation::Kind;
  const double error = got - item.value;
  const std::string relative = item.value != 0 ? fmt::format("{:.2g}", error / item.value) : "";
  switch (item.kind) {
    case Kind::rel:
      verdict.passed = std::abs(error) <= item.tolerance * std::abs(item.value);
      verdict.error = relative;
      verdict.tolerance = fmt::format("rel {:g}", item.tolerance);
      break;
    case Kind::abs:
      verdict.passed = std::abs(error) <= item.tolerance;
      verdict.error = fmt::format("{:.2g}", error);
      verdict.tolerance = fmt::format("abs {:g}", item.tolerance);
      break;
    case Kind::below:
      verdict.passed = got < item.value;
      verdict.expected = "< " + verdict.expected;
      verdict.error = relative;
      break;
    case Kind::above:
      verdict.passed = got > item.value;
      verdict.expected = "> " + verdict.expected;
      verdict.error = relative;
      break;
    case Kind::between:
      verdict.passed = got >= item.low && got <= item.high;
      verdict.expected = fmt::format("{:g} to {:g}", item.low, item.high);
      break;
    case Kind::equal:
      break;
  }
}

Verdict judge(const Expectation& item, const Json& metrics) {
  Verdict verdict;
  verdict.key = item.key;
  verdict.source = item.source;
  verdict.place = item.place.text();
  verdict.expected = item.kind == Expectation::Kind::equal ? item.text_value : short_number(item.value);
  const Json* value = find_key(metrics, item.key);
  if (!value) {
    verdict.got = "no such key";
  } else if (item.kind == Expectation::Kind::equal) {
    verdict.got = word(*value);
    verdict.passed = verdict.got == item.text_value;
  } else if (value->is_number()) {
    verdict.got = short_number(value->get<double>());
    judge_number(item, value->get<double>(), verdict);
  } else {
    verdict.got = word(*value);
  }
  return verdict;
}

}  // namespace

std::vector<Verdict> judge(const std::vector<Expectation>& expectations, const Json& metrics) {
  std::vector<Verdict> verdicts;
  for (const Expectation& item : expectations) verdicts.push_back(judge(item, metrics));
  return verdicts;
}

Json to_json(const std::vector<Verdict>& verdicts) {
  Json list = Json::array();
  for (const Verdict& v : verdicts)
    list.push_back({{"key", v.key},
                    {"expected", v.expected},
                    {"got", v.got},
                    {"error", v.error},
                    {"tolerance", v.tolerance},
                    {"passed", v.passed},
                    {"source", v.source},
                    {"place", v.place}});
  return list;
}

std::vector<Verdict> verdicts_of(const Json& json) {
  std::vector<Verdict> verdicts;
  for (const auto& item : json) {
    Verdict v;
    v.passed = item.value("passed", false);
    for (const auto& [key, into] : {std::pair{"key", &v.key},
                                    {"expected", &v.expected},
                                    {"got", &v.got},
                                    {"error", &v.error},
                                    {"tolerance", &v.tolerance},
                                    {"source", &v.source},
                                    {"place", &v.place}})
      *into = item.value(key, "");
    verdicts.push_back(std::move(v));
  }
  return verdicts;
}

bool expects_divergence(const Scene& scene) {
  return std::any_of(scene.expectations.begin(), scene.expectations.end(),
                     [](const Expectation& item) { return item.key == "status" && item.text_value == "diverged"; });
}

}  // namespace erbs
