// Converts named members to bytes and back; one visitor serves both directions.
// `each(thing, archive)` calls `archive(name, member [, part])`, or `archive(member)` where a name would add nothing.
// A member without a `Part` takes that of its enclosing struct.
// Supported: numbers, enums, small Eigen vectors, plain structs (as bytes), strings, vectors of these, and structs with their own `each()`.
// Names and element sizes are written too, so a changed layout is refused rather than misread.
#pragma once
#include <cstdint>
#include <cstring>
#include <functional>
#include <istream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/base/vec.h"
#include "engine/model/state_fields.h"

namespace erbs {

template <class T>
struct is_vector : std::false_type {};
template <class T>
struct is_vector<std::vector<T>> : std::true_type {};
template <class T>
struct is_vector<LazyArray<T>> : std::true_type {};
template <class T>
inline constexpr bool is_small_eigen = std::is_same_v<T, Vec3> || std::is_same_v<T, Quat> || std::is_same_v<T, Mat3> ||
                                       std::is_same_v<T, Vec6> || std::is_same_v<T, Eigen::Vector2d>;
template <class T>
inline constexpr bool is_plain_data = std::is_trivially_copyable_v<T> || is_small_eigen<T>;

// Visitors written for reading take a non-const object; the archives below only read it.
template <class T, class F>
void visit_each(const T& value, F&& f) {
  each(const_cast<T&>(value), f);
}

class ArchiveOut {
 public:
  // `sink` receives the bytes in pieces.
  explicit ArchiveOut(std::function<void(std::string_view)> sink) : sink_(std::move(sink)) {}

  template <class T>
  void operator()(const T& value) {
    (*this)("member", value);
  }
  template <class T>
  void operator()(std::string_view name, const T& value, Part = Part::carried) {
    if constexpr (is_plain_data<T>) {
      head(name, sizeof(T), 1);
      put(&value, sizeof(T));
    } else if constexpr (std::is_same_v<T, std::string>) {
      head(name, 1, value.size());
      put(value.data(), value.size());
    } else if constexpr (is_vector<T>::value) {
      vector(name, value);
    } else {
      head(name, 0, 1);
      visit_each(value, *this);
    }
  }

 private:
  template <class V>
  void vector(std::string_view name, const V& values) {
    using T = typename V::value_type;
    if constexpr (is_plain_data<T>) {
      head(name, sizeof(T), values.size());
      put(values.data(), values.size() * sizeof(T));
    } else {
      head(name, 0, values.size());
      for (const T& v : values) (*this)("item", v);
    }
  }
  void head(std::string_view name, std::uint64_t size, std::uint64_t count);
  void put(const void* data, std::size_t size) { sink_({static_cast<const char*>(data), size}); }
  std::function<void(std::string_view)> sink_;
};

class ArchiveIn {
 public:
  // Reads `size` bytes of a stream, starting at its current position.
  ArchiveIn(std::istream& in, std::uint64_t size, std::string file) : in_(in), left_(size), file_(std::move(file)) {}

  template <class T>
  void operator()(T& value) {
    (*this)("member", value);
  }
  template <class T>
  void operator()(std::string_view name, T& value, Part = Part::carried) {
    if constexpr (is_plain_data<T>) {
      expect_head(name, sizeof(T), 1);
      get(&value, sizeof(T));
    } else if constexpr (std::is_same_v<T, std::string>) {
      value.resize(head(name, 1));
      get(value.data(), value.size());
    } else if constexpr (is_vector<T>::value) {
      vector(name, value);
    } else {
      expect_head(name, 0, 1);
      each(value, *this);
    }
  }
  void finish() const;  // Error if bytes are left over

 private:
  template <class T>
  void vector(std::string_view name, LazyArray<T>& values) {
    values.clear(head(name, sizeof(T)));
    get_lazy(values.data(), values.size() * sizeof(T));
  }
  template <class T>
  void vector(std::string_view name, std::vector<T>& values) {
    if constexpr (is_plain_data<T>) {
      values.resize(head(name, sizeof(T)));
      get(values.data(), values.size() * sizeof(T));
    } else {
      values.resize(head(name, 0));
      for (T& v : values) (*this)("item", v);
    }
  }
  std::size_t head(std::string_view name, std::uint64_t size);  // returns the count
  void expect_head(std::string_view name, std::uint64_t size, std::uint64_t count);
  void get(void* data, std::size_t size);
  void get_lazy(void* zeros, std::size_t size);  // writes only pages that hold a nonzero byte, so pages of zeros stay untouched
  std::istream& in_;
  std::uint64_t left_;
  std::string file_;
};

// FNV-1a hash of the run's result: members marked as motion or history.
class ResultHash {
 public:
  std::uint64_t value = 0xcbf29ce484222325u;

  template <class T>
  void operator()(const T& member) {
    (*this)("member", member, outer_);
  }
  // A member without its own `Part` takes that of its enclosing struct.
  template <class T>
  void operator()(std::string_view name, const T& member) {
    (*this)(name, member, outer_);
  }
  template <class T>
  void operator()(std::string_view name, const T& member, Part part) {
    if constexpr (is_plain_data<T>) {
      if (part != Part::carried) add(&member, sizeof(T));
    } else if constexpr (is_vector<T>::value) {
      if constexpr (is_plain_data<typename T::value_type>) {
        if (part != Part::carried) add(member.data(), member.size() * sizeof(typename T::value_type));
      } else {
        for (const auto& item : member) (*this)(name, item, part);
      }
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (part != Part::carried) add(member.data(), member.size());
    } else {
      const Part outside = outer_;
      outer_ = part;
      visit_each(member, *this);
      outer_ = outside;
    }
  }

 private:
  void add(const void* data, std::size_t size);
  Part outer_ = Part::carried;  // of the struct being visited
};

}  // namespace erbs
