#include "engine/loads/loads.h"

namespace erbs {

double value(const Wave& wave, double t) {
  return std::visit([&](const auto& w) { return value(w, t); }, wave);
}

double integral(const Wave& wave, double t) {
  return std::visit([&](const auto& w) { return area(w, t) - area(w, 0.0); }, wave);
}

double second_integral(const Wave& wave, double t) {
  return std::visit([&](const auto& w) { return double_area(w, t) - double_area(w, 0.0) - area(w, 0.0) * t; }, wave);
}

double mean(const Wave& wave, double t0, double t1) {
  return std::visit([&](const auto& w) { return mean(w, t0, t1); }, wave);
}

double end_time(const Wave& wave) {
  return std::visit([](const auto& w) { return end_time(w); }, wave);
}

double resolution(const Wave& wave) {
  return std::visit([](const auto& w) { return resolution(w); }, wave);
}

}  // namespace erbs
