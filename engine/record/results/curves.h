// Columns of run folders as curves: choice of columns by name, span of time, spectra, envelope.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/record/format/csv.h"

namespace erbs {

struct HistoryCurve {
  std::string run, x_name, y_name;  // columns, with units
  std::vector<double> x, y;         // SI
};

struct TimeSpan {
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();  // s
};
// "2:4.5". Throws Error.
TimeSpan time_span_of(const std::string& text);

// The columns of histories.csv, then those of energy.csv, in their common rows. Throws Error if there is no folder or no row.
CsvTable read_columns(const std::string& folder);
// That one of the two files ends early, where they differ by more than the row in which a run may have been ended; "" otherwise.
std::string uneven_rows(const std::string& folder);
// curve.csv of a push or a tilting test, a row for each state of equilibrium; nothing without that file.
std::optional<CsvTable> read_capacity(const std::string& folder);

// The columns that `pattern` fits: the one of this name; with * and ? all that match; otherwise all that begin so. Columns of words are
// left out. Error with the nearest names if there is none.
std::vector<int> choose_columns(const CsvTable& table, const std::string& pattern);

// Column y over column x in the rows of the span, or in all rows of a table without time. Error for fewer than two rows or a value that is
// not finite.
HistoryCurve curve_of(const CsvTable& table, int x, int y, TimeSpan span);

std::vector<double> envelope_of(const std::vector<double>& y);  // running maximum of |y|

// Over frequency (Hz), without its value at zero: a sine of amplitude A has a peak of A. The curve must be over time.
HistoryCurve amplitude_spectrum(const HistoryCurve& history);
// Pseudo-acceleration (m/s2) over period (s): that of erbs record. Error unless the column is an acceleration over time.
HistoryCurve response_curve(const HistoryCurve& history, double damping_ratio);

// At most about `most` points: extremes of x and y in each piece of the curve are kept.
HistoryCurve thinned(const HistoryCurve& curve, std::size_t most);

}  // namespace erbs
