// Numbers as text of a web page: quantised, differences in time, deflated (zlib), base64.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "engine/record/folder/motion_file.h"
#include "engine/record/format/csv.h"

namespace erbs {

inline constexpr double smallest_pose_step = 1e-6;         // m; finer motion is noise of the solver, and costs space
inline constexpr double rotation_step = 1.0 / 32767;       // of a component of the quaternion
inline constexpr std::size_t most_rows_of_a_curve = 2000;  // rows of a table in a page; longer ones keep their peaks

// All poses. A position is low + step * count, with a step of its own for each block and axis: the block's travel / 65535, but at least
// smallest_pose_step. Counts are 16 bits and are stored as differences to the frame before, the low bytes first.
//   float32 low[3], step[3] of each block (m); low bytes [7][blocks][frames]; high bytes [7][blocks][frames]
std::string pose_bytes(const std::vector<MotionFrame>& frames, std::size_t blocks);

// Damage of each joint, 0 to 255, as differences to the frame before [joints][frames].
std::string damage_bytes(const std::vector<MotionFrame>& frames, std::size_t joints);

// At most `most_rows_of_a_curve` rows; of each bucket of rows the lowest and the highest value of every column stay, in their order.
CsvTable thinned(const CsvTable& table);
// Columns as float32, by bytes of equal weight: byte 0 of all values, then byte 1, ... [columns][rows]
std::string column_bytes(const CsvTable& table);

std::string deflated(std::string_view bytes);
std::string base64(std::string_view bytes);

}  // namespace erbs
