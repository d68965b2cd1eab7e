// A run against a reference: the histories of common columns, and the collapse. The reference is another run, or measured displacements.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/base/correlation.h"
#include "engine/record/format/csv.h"
#include "engine/record/format/json.h"
#include "engine/record/results/curves.h"
#include "engine/scene/scene.h"

namespace erbs {

// How the times of the two are brought together.
enum class Alignment { none, first_motion, correlation };

// A column of the run and its partner. The values of the reference are in the unit of the run.
struct ColumnPair {
  std::string name;  // column of the run, with its unit
  Samples run, reference;
};

// The pairs that `reference` and `run` have in common, by name. A name of the reference may end in _mm, _cm, _g instead of _m, _m_s2.
// Columns whose values stay below 1e-3 of the largest of their unit are left out, on both sides: they hold round-off. `renamed` lists
// further pairs RUN=REFERENCE. `path` names the reference in errors. Error without a time, a common column or two rows.
std::vector<ColumnPair> pair_columns(const CsvTable& run, const CsvTable& reference, const std::vector<std::string>& renamed,
                                     const std::string& path);

struct TimeShift {
  double lag = 0;  // s, by which the run is later than the reference
  Alignment how = Alignment::none;
  std::string column;        // whose motion gave it
  double correlation = NAN;  // of that column
  bool at_edge = false;
};
// Taken from the displacement of the largest peak, or from the first column without any. `reach`: s, the largest lag.
TimeShift find_shift(const std::vector<ColumnPair>& pairs, Alignment how, double reach);

// A pair over its common time, after the shift, within a span of the time of the reference. Errors are relative to the reference unless a
// unit is given.
struct ColumnErrors {
  std::string name;
  double peak_run = NAN, peak_reference = NAN, peak_error = NAN;                 // largest magnitudes, with sign; error of the magnitude
  double rms_run = NAN, rms_reference = NAN, rms_error = NAN;                    // root mean squares
  double difference = NAN;                                                       // rms of run - reference over the peak of the reference
  double lag = NAN, correlation = NAN;                                           // s, what remains after the shift; Pearson's coefficient
  double frequency_run = NAN, frequency_reference = NAN, frequency_error = NAN;  // Hz, of the highest peak of the spectrum
};
ColumnErrors errors_of(const ColumnPair& pair, double shift, double reach, const TimeSpan& span = {});

// `collapse` of two metrics.json.
struct CollapseErrors {
  bool known = false;                                   // both files have it
  bool run = false, reference = false;                  // collapsed
  double time_run = NAN, time_reference = NAN;          // s
  double time = NAN;                                    // s, run - shift - reference; 0 if both stand, infinite if one does
  double direction = NAN;                               // deg between the two; 0 if both stand
  std::vector<std::string> order_run, order_reference;  // groups in the order of their fall
  bool same_sequence = false;
};
CollapseErrors compare_collapse(const Json& run, const Json& reference, double shift);

// A param of the scene that the two runs have set to other values, or that one of them has alone. Values are in the unit of the param.
struct ParamDifference {
  std::string name, unit;
  std::optional<double> run, reference;
};
struct SceneDifferences {
  bool script = false;                                            // the scenes are not the same text
  std::vector<ParamDifference> params;                            // in the order of the run, then what the reference has alone
  std::vector<std::string> run_notes = {}, reference_notes = {};  // of either alone, such as params that are words
};
std::vector<ParamDifference> compare_params(const std::vector<Param>& run, const std::vector<Param>& reference);

struct RunComparison {
  TimeShift shift;
  std::optional<SceneDifferences> scenes;  // of two runs
  std::vector<ColumnErrors> columns;
  CollapseErrors collapse;
};
// The two have the motion of the ground in common, and no column of the response.
bool only_ground(const RunComparison& comparison);
Json json_of(const RunComparison& comparison);
std::string table_of(const RunComparison& comparison);
std::string words_of(Alignment how);

}  // namespace erbs
