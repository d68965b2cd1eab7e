// Zero-initialised array of plain items with the interface of a vector. Unwritten pages take no memory.
// It holds data that most joints of a structure never need, such as the history of their points.
#pragma once
#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

namespace erbs {

template <class T>
class LazyArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  using value_type = T;

  LazyArray() = default;
  explicit LazyArray(std::size_t n) { clear(n); }
  LazyArray(const LazyArray& other) {
    clear(other.size_);
    put(other.data_);
  }
  LazyArray(LazyArray&& other) noexcept : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  LazyArray& operator=(LazyArray other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~LazyArray() { release(); }

  void clear(std::size_t n) {  // n zero items
    release();
    if (n == 0) return;
    void* pages = ::mmap(nullptr, n * sizeof(T), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (pages == MAP_FAILED) throw std::bad_alloc();
    data_ = static_cast<T*>(pages);
    size_ = n;
  }
  void resize(std::size_t n) {
    if (n == size_) return;
    LazyArray other(n);
    if (std::min(n, size_) > 0) std::memcpy(static_cast<void*>(other.data_), data_, std::min(n, size_) * sizeof(T));
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }
  // Copies all items from `from`. Pages that are zero on both sides stay unwritten.
  void put(const void* from) {
    constexpr std::size_t page = 4096;
    static constexpr char zeros[page] = {};
    const char* source = static_cast<const char*>(from);
    char* to = reinterpret_cast<char*>(data_);
    for (std::size_t at = 0, bytes = size_ * sizeof(T); at < bytes; at += page) {
      const std::size_t n = std::min(page, bytes - at);
      if (std::memcmp(source + at, zeros, n) != 0 || std::memcmp(to + at, zeros, n) != 0) std::memcpy(to + at, source + at, n);
    }
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return data_; }
  const T* data() const { return data_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }

 private:
  void release() {
    if (data_ != nullptr) ::munmap(data_, size_ * sizeof(T));
    data_ = nullptr;
    size_ = 0;
  }
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace erbs
