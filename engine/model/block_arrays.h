// One vector or rotation per block, in the layout of the step: components of eight blocks side by side. Reads and writes like a
// std::vector<Vec3> or std::vector<Quat>.
#pragma once
#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "engine/base/system/memory.h"
#include "engine/base/vec.h"
#include "engine/model/joint_pack.h"

namespace erbs {

class BlockVec3 {
 public:
  using Row = VectorPack<3>;
  using Ref = Eigen::Map<Vec3, Eigen::Unaligned, Eigen::InnerStride<pack_size>>;
  using ConstRef = Eigen::Map<const Vec3, Eigen::Unaligned, Eigen::InnerStride<pack_size>>;

  BlockVec3() = default;
  BlockVec3(std::size_t n, const Vec3& value) { assign(n, value); }
  void assign(std::size_t n, const Vec3& value) {
    size_ = n;
    row_.assign((n + pack_size - 1) / pack_size, Row{});
    for (std::size_t b = 0; b < n; ++b) (*this)[b] = value;
  }
  std::size_t size() const { return size_; }
  Ref operator[](std::size_t b) { return Ref(&row_[b / pack_size].x[0][b % pack_size]); }
  ConstRef operator[](std::size_t b) const { return ConstRef(&row_[b / pack_size].x[0][b % pack_size]); }
  Row* data() { return row_.data(); }
  const Row* data() const { return row_.data(); }

  template <class F>
  friend void each(BlockVec3& field, F&& f) {
    f("size", field.size_), f("rows", field.row_);
  }

 private:
  std::size_t size_ = 0;
  std::vector<Row> row_;  // lanes beyond the last block are zero
};

class BlockQuat {
 public:
  using Row = VectorPack<4>;
  // Proxy of an element: a copy that writes back an assignment of the whole quaternion. Its components are read-only.
  class Ref : public Quat {
   public:
    double x() const { return Quat::x(); }
    double y() const { return Quat::y(); }
    double z() const { return Quat::z(); }
    double w() const { return Quat::w(); }
    const Coefficients& coeffs() const { return Quat::coeffs(); }
    void normalize() { *this = normalized(); }
    Ref(Row& row, int l) : Quat(row.x[3][l], row.x[0][l], row.x[1][l], row.x[2][l]), row_(row), lane_(l) {}
    Ref(const Ref&) = default;
    Ref& operator=(const Quat& to) {
      Quat::operator=(to);
      for (int i = 0; i < 4; ++i) row_.x[i][lane_] = to.coeffs()[i];
      return *this;
    }
    Ref& operator=(const Ref& to) { return *this = static_cast<const Quat&>(to); }

   private:
    Row& row_;
    int lane_;
  };

  BlockQuat() = default;
  BlockQuat(std::size_t n, const Quat& value) { assign(n, value); }
  void assign(std::size_t n, const Quat& value) {
    size_ = n;
    row_.resize((n + pack_size - 1) / pack_size);
    for (std::size_t b = 0; b < row_.size() * pack_size; ++b)
      Ref(row_[b / pack_size], int(b % pack_size)) = b < n ? value : Quat::Identity();
  }
  std::size_t size() const { return size_; }
  Ref operator[](std::size_t b) { return Ref(row_[b / pack_size], int(b % pack_size)); }
  Quat operator[](std::size_t b) const {
    const Row& r = row_[b / pack_size];
    const std::size_t l = b % pack_size;
    return Quat(r.x[3][l], r.x[0][l], r.x[1][l], r.x[2][l]);
  }
  Row* data() { return row_.data(); }
  const Row* data() const { return row_.data(); }

  template <class F>
  friend void each(BlockQuat& field, F&& f) {
    f("size", field.size_), f("rows", field.row_);
  }

 private:
  std::size_t size_ = 0;
  std::vector<Row> row_;  // x, y, z, w; lanes beyond the last block are the identity
};

// Rows of eight doubles, each in its own cache line. A row holds the data of one block or of one joint end, for kernels that work by rows.
class Rows {
 public:
  void assign(std::size_t rows, double value) {
    row_.clear(rows);
    if (value != 0) std::fill_n(data(), size(), value);
  }
  std::size_t size() const { return row_.size() * pack_size; }  // doubles
  bool empty() const { return row_.empty(); }
  double& operator[](std::size_t i) { return row_[i / pack_size].x[0][i % pack_size]; }
  const double& operator[](std::size_t i) const { return row_[i / pack_size].x[0][i % pack_size]; }
  double* data() { return row_.empty() ? nullptr : row_.data()->x[0]; }
  const double* data() const { return row_.empty() ? nullptr : row_.data()->x[0]; }

  template <class F>
  friend void each(Rows& rows, F&& f) {
    f("rows", rows.row_);
  }

 private:
  LazyArray<VectorPack<1>> row_;
};

// Number of groups of eight lanes for all blocks and the block at rest behind them.
inline std::size_t block_groups(int nblock) { return (std::size_t(nblock) + pack_size) / pack_size; }

}  // namespace erbs
