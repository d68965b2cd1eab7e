#include "engine/record/report/pack.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "engine/base/error.h"

namespace erbs {
namespace {

void put_float(std::string& out, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int i = 0; i < 4; ++i) out.push_back(static_cast<char>(bits >> (8 * i) & 255U));
}

// Counts of one component of one block, as differences modulo 2^16.
void put_differences(const std::vector<std::uint16_t>& counts, std::string& low, std::string& high) {
  std::uint16_t before = 0;
  for (const std::uint16_t count : counts) {
    const auto difference = static_cast<std::uint16_t>(count - before);
    before = count;
    low.push_back(static_cast<char>(difference & 255U));
    high.push_back(static_cast<char>(difference >> 8U));
  }
}

// Appends low and step to `head`, and returns the counts.
std::vector<std::uint16_t> position_counts(const std::vector<MotionFrame>& frames, std::size_t at, std::string& lows, std::string& steps) {
  float low = frames.front().poses[at], high = low;
  for (const MotionFrame& frame : frames) low = std::min(low, frame.poses[at]), high = std::max(high, frame.poses[at]);
  const auto step = static_cast<float>(std::max((static_cast<double>(high) - low) / 65535, smallest_pose_step));
  put_float(lows, low);
  put_float(steps, step);
  std::vector<std::uint16_t> counts;
  for (const MotionFrame& frame : frames) {
    const double count = std::round((static_cast<double>(frame.poses[at]) - low) / step);
    counts.push_back(static_cast<std::uint16_t>(std::clamp(count, 0.0, 65535.0)));
  }
  return counts;
}

// Successive rotations have one sign: their differences stay small.
std::array<std::vector<std::uint16_t>, 4> rotation_counts(const std::vector<MotionFrame>& frames, std::size_t block) {
  std::array<std::vector<std::uint16_t>, 4> counts;
  Eigen::Vector4f last(1, 0, 0, 0);
  for (const MotionFrame& frame : frames) {
    Eigen::Vector4f q = Eigen::Map<const Eigen::Vector4f>(&frame.poses[7 * block + 3]).normalized();
    if (q.dot(last) < 0) q = -q;
    last = q;
    for (int i = 0; i < 4; ++i)
      counts[static_cast<std::size_t>(i)].push_back(static_cast<std::uint16_t>(std::lround(static_cast<double>(q[i]) / rotation_step)));
  }
  return counts;
}

}  // namespace

std::string pose_bytes(const std::vector<MotionFrame>& frames, std::size_t blocks) {
  std::string head, low, high;
  std::vector<std::array<std::vector<std::uint16_t>, 7>> counts(blocks);
  for (std::size_t b = 0; b < blocks; ++b) {
    std::string lows, steps;
    for (std::size_t i = 0; i < 3; ++i) counts[b][i] = position_counts(frames, 7 * b + i, lows, steps);
    head += lows + steps;
    auto turned = rotation_counts(frames, b);
    for (std::size_t i = 0; i < 4; ++i) counts[b][3 + i] = std::move(turned[i]);
  }
  for (std::size_t i = 0; i < 7; ++i)
    for (std::size_t b = 0; b < blocks; ++b) put_differences(counts[b][i], low, high);
  return head + low + high;
}

std::string damage_bytes(const std::vector<MotionFrame>& frames, std::size_t joints) {
  std::string out;
  for (std::size_t j = 0; j < joints; ++j) {
    std::uint8_t before = 0;
    for (const MotionFrame& frame : frames) {
      out.push_back(static_cast<char>(static_cast<std::uint8_t>(frame.damage[j] - before)));
      before = frame.damage[j];
    }
  }
  return out;
}

CsvTable thinned(const CsvTable& table) {
  const std::size_t rows = table.rows();
  if (rows <= most_rows_of_a_curve) return table;
  const std::size_t bucket = (2 * rows + most_rows_of_a_curve - 1) / most_rows_of_a_curve;
  CsvTable out;
  out.names = table.names;
  out.text.resize(table.names.size());
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const std::vector<double>& values = table.columns[c];
    std::vector<double> kept;
    for (std::size_t first = 0; first < rows; first += bucket) {
      const std::size_t last = std::min(first + bucket, rows);
      std::size_t low = first, high = last - 1;
      for (std::size_t i = first; c > 0 && i < last; ++i) {  // column 0 is the time, of the first and last row
        if (!(values[low] <= values[i])) low = i;
        if (!(values[high] >= values[i])) high = i;
      }
      kept.push_back(values[std::min(low, high)]);
      kept.push_back(values[std::max(low, high)]);
    }
    out.columns.push_back(std::move(kept));
  }
  return out;
}

std::string column_bytes(const CsvTable& table) {
  std::string out;
  for (unsigned weight = 0; weight < 4; ++weight)
    for (const std::vector<double>& column : table.columns)
      for (const double value : column)
        out.push_back(static_cast<char>(std::bit_cast<std::uint32_t>(static_cast<float>(value)) >> (8 * weight) & 255U));
  return out;
}

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  const int code = compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                             static_cast<uLong>(bytes.size()), 6);
  ERBS_ASSERT(code == Z_OK);
  out.resize(size);
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) out.push_back(i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63U] : '=');
  }
  return out;
}

}  // namespace erbs
