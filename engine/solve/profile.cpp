#include "engine/solve/profile.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/base/error.h"
#include "engine/model/model.h"

namespace erbs {

namespace {

std::string text(StepLimit::By by) {
  using enum StepLimit::By;
  switch (by) {
    case structure:
      return "joints of the structure";
    case joints:
      return "joints and contacts";
    case contacts:
      return "contacts";
    case impact:
      return "a coming impact";
    case slip:
      return "a sliding contact, or a blow on a light block";
    case event:
      return "an opening or closing";
    case passing:
      return "a fast block that must not pass through others";
    case growth:
      return "nothing any more: the step grows back";
  }
  return "";
}

}  // namespace

std::string text(const StepLimit& limit, const Model& model) {
  return text(limit.by) + (limit.block < 0 ? "" : " of " + model.block_name[std::size_t(limit.block)]);
}

std::vector<std::string> limit_lines(const Profile& profile, const Model& model) {
  struct Share {
    long steps = 0;
    std::vector<std::pair<long, int>> blocks;
  };
  std::map<StepLimit::By, Share> kinds;
  for (const auto& [limit, steps] : profile.limits()) {
    kinds[limit.by].steps += steps;
    if (limit.block >= 0) kinds[limit.by].blocks.emplace_back(-steps, limit.block);
  }
  const auto percent = [&](long steps) { return 100 * double(steps) / double(profile.steps()); };
  std::vector<std::pair<long, std::string>> lines;
  for (auto& [by, kind] : kinds) {
    std::string names;
    std::ranges::sort(kind.blocks);
    for (std::size_t i = 0; i < std::min<std::size_t>(3, kind.blocks.size()); ++i)
      names += fmt::format("{}{} {:.2g} %", names.empty() ? "" : ", ", model.block_name[std::size_t(kind.blocks[i].second)],
                           percent(-kind.blocks[i].first));
    if (kind.blocks.size() > 3) names += fmt::format(", {} more", kind.blocks.size() - 3);
    lines.emplace_back(-kind.steps, fmt::format("{:4.1f} % {}{}", percent(kind.steps), text(by), names.empty() ? "" : " (" + names + ")"));
  }
  std::ranges::sort(lines);
  std::vector<std::string> out;
  for (const auto& [steps, line] : lines) out.push_back(line);
  return out;
}

Profile& Profile::operator+=(const Profile& other) {
  for (std::size_t i = 0; i < phase_s_.size(); ++i) phase_s_[i] += other.phase_s_[i];
  for (const auto& [limit, steps] : other.limits_) limits_[limit] += steps;
  steps_ += other.steps_, macro_steps_ += other.macro_steps_;
  fast_ += other.fast_, slow_ += other.slow_;
  sum_dt_ += other.sum_dt_;
  return *this;
}

std::array<double, std::size_t(Phase::count)> Profile::seconds(double all) const {
  std::array<double, std::size_t(Phase::count)> out{};
  const double sum = std::accumulate(phase_s_.begin(), phase_s_.end(), 0.0);
  for (std::size_t i = 0; sum > 0 && i < out.size(); ++i) out[i] = all * phase_s_[i] / sum;
  return out;
}

}  // namespace erbs
