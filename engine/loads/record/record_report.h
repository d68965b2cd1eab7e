// Summary of a ground-motion record for engineers: peaks, Arias intensity, significant duration, response spectrum.
#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "engine/loads/record/record.h"
#include "engine/loads/record/response_spectrum.h"

namespace erbs {

// Value of largest magnitude, with its sign, and its time (s, from time 0 of the file, after time_factor).
struct Peak {
  double value = 0;
  double time = 0;
};

struct RecordReport {
  std::string file, title, format, hash, note;
  int points = 0;                                 // values in the file
  double dt = 0;                                  // s, as scaled; 0: uneven
  double shortest_dt = 0, longest_dt = 0;         // s, between points; where they differ much, values are missing
  double duration = 0;                            // s
  Peak pga, pgv, pgd;                             // m/s2, m/s, m: largest at the points, as in catalogues
  Peak true_pgv, true_pgd;                        // m/s, m: largest anywhere, on the parabolas and cubics between points too
  double end_velocity = 0, end_displacement = 0;  // m/s, m
  double arias = 0;                               // m/s
  double time_5 = 0, time_95 = 0;                 // s, at 5 and 95 % of the Arias intensity; their difference is D5-95
  std::vector<ResponsePoint> spectrum;            // 5 % damping
  ResponsePoint spectrum_peak;
};

RecordReport report(const Record& record);

// The text of `erbs record FILE`.
void print(std::ostream& out, const RecordReport& report);

}  // namespace erbs
