#include "lua/reports/expectations.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/units.h"

namespace erbs::lua {
namespace {

std::string short_number(double value) { return fmt::format("{:.6g}", value); }

// A word of metrics.json in the spelling of an expectation: completed, true, null.
std::string word(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

double share(double error, double tolerance) { return error == 0 ? 0 : tolerance > 0 ? error / tolerance : infinite; }

// Ratio of the error to its tolerance. For a bound whose sign permits it, the ratio of value to bound: 0 far within, 1 at the bound.
double used_of(const Expectation& item, double got) {
  using Kind = Expectation::Kind;
  if (!std::isfinite(got)) return infinite;
  switch (item.kind) {
    case Kind::rel:
      return share(std::abs(got - item.value), item.tolerance * std::abs(item.value));
    case Kind::abs:
      return share(std::abs(got - item.value), item.tolerance);
    case Kind::below:
      return item.value > 0 ? std::max(0.0, got) / item.value : got < item.value ? 0 : infinite;
    case Kind::above:
      return item.value > 0 && got > 0 ? item.value / got : got > item.value ? 0 : infinite;
    case Kind::between:
      return share(std::abs(got - 0.5 * (item.low + item.high)), 0.5 * (item.high - item.low));
    case Kind::equal:
      break;
  }
  return infinite;
}

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
  verdict.used = infinite;
  if (!value) {
    verdict.got = "no such key";
  } else if (item.kind == Expectation::Kind::equal) {
    verdict.got = word(*value);
    verdict.passed = verdict.got == item.text_value;
    if (verdict.passed) verdict.used = 0;
  } else if (value->is_number()) {
    verdict.got = short_number(value->get<double>());
    verdict.actual = value->dump();
    judge_number(item, value->get<double>(), verdict);
    verdict.used = used_of(item, value->get<double>());
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
                    {"used", v.used},
                    {"source", v.source},
                    {"place", v.place},
                    {"stored", v.stored},
                    {"actual", v.actual},
                    {"scene", v.scene}});
  return list;
}

std::vector<Verdict> verdicts_of(const Json& json) {
  std::vector<Verdict> verdicts;
  for (const auto& item : json) {
    Verdict v;
    v.passed = item.value("passed", false);
    // JSON has no infinity; it is stored as null
    v.used = item.contains("used") && item["used"].is_number() ? item["used"].get<double>() : infinite;
    for (const auto& [key, into] : {std::pair{"key", &v.key},
                                    {"expected", &v.expected},
                                    {"got", &v.got},
                                    {"error", &v.error},
                                    {"tolerance", &v.tolerance},
                                    {"source", &v.source},
                                    {"place", &v.place},
                                    {"stored", &v.stored},
                                    {"actual", &v.actual},
                                    {"scene", &v.scene}})
      *into = item.value(key, "");
    verdicts.push_back(std::move(v));
  }
  return verdicts;
}

bool expects_status(const Scene& scene, const std::string& status) {
  return std::any_of(scene.expectations.begin(), scene.expectations.end(),
                     [&](const Expectation& item) { return item.key == "status" && item.text_value == status; });
}

}  // namespace erbs::lua
