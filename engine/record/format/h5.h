// Arrays in an HDF5 file. Only h5.cpp includes the library.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace erbs::h5 {

// Owns an HDF5 identifier and closes it.
class Handle {
 public:
  Handle() = default;
  Handle(std::int64_t id, int (*close)(std::int64_t)) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept;
  Handle& operator=(Handle&& other) noexcept;
  ~Handle();
  std::int64_t id() const { return id_; }
  bool ok() const { return id_ >= 0; }

 private:
  std::int64_t id_ = -1;
  int (*close_)(std::int64_t) = nullptr;
};

// A file of named arrays of T = double, float, int or std::uint8_t. Every failure is an Error that names the file.
class File {
 public:
  enum class Mode { create, read, extend };
  File(std::string path, Mode mode);

  template <class T>
  void put(const std::string& name, const std::vector<T>& data, std::size_t columns = 1) const;
  template <class T>
  std::vector<T> get(const std::string& name) const;
  void put_names(const std::string& name, const std::vector<std::string>& names) const;
  std::vector<std::string> get_names(const std::string& name) const;
  // Attributes of the file as a whole; no text where there is no such attribute.
  void put_text(const std::string& name, const std::string& text) const;
  std::optional<std::string> get_text(const std::string& name) const;

  bool has(const std::string& name) const;
  void single_writer() const;  // from now on the file is readable after each flush; no new arrays
  void flush() const;

  const std::string& path() const { return path_; }
  std::int64_t id() const { return file_.id(); }
  [[noreturn]] void unreadable(const std::string& what) const;
  [[noreturn]] void unwritable(const std::string& what) const;

 private:
  std::string path_;
  Handle file_;
};

// An array of T that grows by whole rows of `row` items; its shape is [rows, row...].
template <class T>
class Rows {
 public:
  Rows(const File& file, const std::string& name, std::vector<std::size_t> row, std::size_t rows_per_chunk);  // creates the array
  Rows(const File& file, const std::string& name);                                                            // opens an existing array
  std::size_t size() const { return rows_; }
  std::size_t row_items() const;
  const std::vector<std::size_t>& row() const { return row_; }
  void resize(std::size_t rows);
  void append(const T* items);
  void read(std::size_t at, T* items) const;

 private:
  bool transfer(std::size_t at, T* items, bool write) const;
  const File* file_;
  std::string name_;
  std::vector<std::size_t> row_;
  std::size_t rows_ = 0;
  Handle set_;
};

}  // namespace erbs::h5
