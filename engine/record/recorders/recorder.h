// Recorders: the columns of histories.csv. Each kind is a struct of its own (THE LIST in recorders.h) with
//   quantities()             names for scripts, with their meaning
//   Kind(ask)                resolved against the model
//   columns()                full names with units
//   sample(snapshot, out)    one number per column
//   needs(needs)             optional data it requires of the snapshot
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "engine/record/recorders/snapshot.h"
#include "engine/scene/scene.h"

namespace erbs {

struct Quantity {
  std::string name;
  std::string text;  // one sentence: the recorded quantity and its unit
};

// A recorder requested by a script, with block numbers in place of names.
struct RecorderRequest {
  const Recorder& recorder;
  const Model& model;
  std::vector<int> blocks, others;  // block numbers
};

int quantity_index(const std::vector<Quantity>& quantities, const std::string& name);  // -1 if not found
// name_<symbol>x_<unit>, ... for the letters of `axis`
std::vector<std::string> axis_columns(const std::string& name, const std::string& axis, const std::string& symbol, const std::string& unit);
void put_axes(const Vec3& value, const std::string& axis, double* out);

class Recorders {
 public:
  // Error that lists all mistakes: unknown quantity, block or axis, or a column named twice.
  Recorders(const Scene& scene, const Model& model);
  ~Recorders();
  Recorders(Recorders&&) noexcept;
  Recorders& operator=(Recorders&&) noexcept;

  Needs needs() const;
  const std::vector<std::string>& columns() const { return columns_; }  // time_s is the first
  const std::vector<double>& sample(const Snapshot& snapshot);          // one row

 private:
  struct Kinds;
  std::unique_ptr<Kinds> kinds_;
  std::vector<std::string> columns_;
  std::vector<double> row_;
};

// Mistakes in a scene's recorders that need no model. Each names its place and remedy.
std::vector<std::string> check_recorders(const Scene& scene);
std::vector<Quantity> recorder_quantities();  // of THE LIST, in its order

}  // namespace erbs
