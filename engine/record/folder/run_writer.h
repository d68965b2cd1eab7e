// Writes the files of a running simulation: histories.csv, energy.csv, events.csv, motion.h5, log.txt.
#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "engine/record/folder/motion_file.h"
#include "engine/record/format/csv.h"
#include "engine/record/recorders/joint_condition.h"
#include "engine/record/recorders/recorder.h"
#include "engine/record/recorders/snapshot.h"

namespace erbs {

// Rows and frames written so far. The checkpoint holds them, so that a resumed run continues at the exact row.
struct WriterProgress {
  long history_rows = 0, energy_rows = 0, event_rows = 0;
  int frames = 0;
  std::uint64_t history_sum = 0, energy_sum = 0, event_sum = 0;  // hashes of these rows
};

template <class P, class F>
requires std::is_same_v<std::remove_const_t<P>, WriterProgress>
void each(P& p, F&& f) {
  f("history_rows", p.history_rows);
  f("energy_rows", p.energy_rows);
  f("event_rows", p.event_rows);
  f("history_sum", p.history_sum);
  f("energy_sum", p.energy_sum);
  f("event_sum", p.event_sum);
  f("frames", p.frames);
}

class RunWriter {
 public:
  // Writes into a folder made by create_run_folder. `resume`: rows and frames beyond this progress are cut off, then new ones appended.
  RunWriter(const std::string& dir, const Scene& scene, const Model& model, const WriterProgress* resume = nullptr);

  Needs needs() const { return recorders_.needs(); }
  void row(const Snapshot& snapshot);    // to histories.csv and energy.csv
  void frame(const Snapshot& snapshot);  // to motion.h5
  // Adds a row to events.csv: event ("crack", "break", "fall", "collapse", ...), block or joint, value with unit.
  void event(double t, std::string_view what, std::string_view name, double value, std::string_view unit);
  void log(std::string_view line);       // to log.txt, flushed
  void log_once(std::string_view line);  // unless it is there already, from the run that this one continues

  WriterProgress progress();  // flushes and synchronises first; a checkpoint may rely on the result
  void flush();
  void close();

 private:
  std::string dir_;
  Recorders recorders_;
  CsvWriter histories_, energy_, events_;
  MotionWriter motion_;
  MotionFrame frame_;
  double flushed_ = 0;  // s, wall clock, time of the last flush
};

// The model as drawn: shapes (shared between equal blocks), blocks and joints.
MotionScene motion_scene(const Scene& scene, const Model& model);

}  // namespace erbs
