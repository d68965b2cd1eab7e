// metrics.json: the results of a run. The analysis fills it; scripts and external checks read it.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/record/format/json.h"
#include "engine/record/results/capacity.h"

namespace erbs {

struct Energy;
struct Mechanism;
struct Model;

struct Metrics {
  std::string status = "completed";  // completed | inaccurate | diverged | stopped | interrupted
  double time_s = 0;
  long steps = 0;
  double dt_s = 0, dt_critical_s = 0, dt_block_bound_s = 0;
  int threads = 1;
  int blocks = 0, joints = 0, contact_points = 0, joints_broken = 0, blocks_asleep = 0;
  struct Wall {
    // s; `solve` is the sum of those between it and `record` (solve/profile.h)
    double total = 0, setup = 0, solve = 0, joints = 0, contact = 0, search = 0, integrate = 0, ledger = 0, record = 0;
  } wall_s;
  std::uint64_t point_updates = 0;
  // Derived on writing: realtime_factor = simulated_s / wall_s.solve and point_updates_per_s = point_updates / wall_s.solve. Both describe
  // this call of the program; a resumed run simulates less than time_s.
  double simulated_s = -1;  // s simulated by this call; -1: all of time_s
  std::uint64_t peak_memory_bytes = 0;
  std::vector<std::string> effects_on, effects_off;
  std::string energy_frame = "ground";
  std::vector<std::pair<std::string, double>> energy;  // J; see energy_terms
  double residual_relative = 0;
  double momentum_residual = 0, max_penetration_relative = 0;
  struct Collapse {
    bool collapsed = false;
    bool under_gravity = false;  // the structure does not stand under its own weight
    std::string under;           // then that weight, and loads that act from the start, in words
    std::optional<double> time_s;
    std::optional<std::array<double, 2>> direction;  // unit vector, x and y
    double fallen_fraction = 0;
    double moving_fraction = 0;     // share of mass that has not fallen, but still moves (results/collapse.h)
    bool moved = false;             // Analysis::stop_when_moved ended the run
    std::string course;             // in words (results/course.h)
    Json sequence = Json::array();  // { group, time_s, share }, in the order in which the groups fell
    struct Mechanism {              // at the collapse; without a collapse, at the end
      std::optional<double> time_s;
      std::string summary;
      int hinges = 0, slides = 0, parted = 0;
      Json joints = Json::array();  // { joint, kind, opening_m, slip_m, gap_m, rotation_rad, at_m }
    } mechanism;
  } collapse;
  // Diagnostics: how far the run is to be trusted (analysis/diagnostics.h).
  struct Diagnostics {
    double energy_residual = 0, energy_residual_time = 0;  // worst relative residual of the energy ledger, and its time (s)
    std::string energy_residual_where;                     // joint whose energy balance jumped most up to then; "" for none
    double penetration = 0;                                // largest relative penetration: depth over smallest edge
    double dt_margin = 0;                                  // largest ratio of a time step to the limit in force
    double reset_share = 0;                                // share of all energy passed that release to contact wrote off
    double warned_share = 0;                               // share of steps with any of the three warnings below
    double past_tolerance_share = 0, past_step_share = 0, sinking_share = 0;
    double momentum_residual = 0;
    bool twin = false;                    // a twin run was made
    std::optional<double> chaos_horizon;  // s; none: the twins stay together to the end
  } diagnostics;
  std::optional<Capacity> capacity;  // of a push
  struct Equilibrium {               // of the start under gravity and constant loads (analysis/start/equilibrium.h)
    int iterations = 0, islands_without = 0;
    double unbalanced = 0;  // largest unbalanced force over the largest applied one of its island
    double wall = 0;        // s
  } equilibrium;
  std::string state_hash;
  int expectations_passed = 0, expectations_failed = 0;
  std::vector<std::pair<std::string, double>> metrics;  // of the scene, in its order
};

// Terms of the energy ledger with their names in metrics.json and energy.csv (base_work_J ... sleep_J), in that order.
std::vector<std::pair<std::string, double>> energy_terms(const Energy& energy);

Metrics::Collapse::Mechanism mechanism_metrics(const Mechanism& mechanism, const Model& model);

Json to_json(const Metrics& metrics);
// Every dotted key of metrics.json except the scene's own metrics: "collapse.time_s"; with `groups` of blocks, "capacity.walls.GROUP".
std::vector<std::string> metric_keys(const std::vector<std::string>& groups = {});
Metrics::Diagnostics diagnostics_of(const Json& metrics);            // reads the diagnostics from metrics.json
void write_metrics(const std::string& dir, const Metrics& metrics);  // DIR/metrics.json, atomically
Json read_metrics(const std::string& dir);

std::uint64_t peak_memory_bytes();  // of this process until now
void return_free_memory();          // returns freed heap memory to the system after phases that needed much

}  // namespace erbs
