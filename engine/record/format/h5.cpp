#include "engine/record/format/h5.h"

#include <hdf5.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "engine/base/error.h"

namespace erbs::h5 {
namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t) && sizeof(herr_t) == sizeof(int));

using Shape = std::vector<hsize_t>;

template <class T>
hid_t type_of();
template <>
hid_t type_of<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t type_of<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
hid_t type_of<int>() {
  return H5T_NATIVE_INT;
}
template <>
hid_t type_of<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

constexpr std::size_t most_cached = 1 << 18;  // bytes of cache for the chunk being filled; a longer row fills its own chunk

Handle property(hid_t kind) { return Handle(H5Pcreate(kind), H5Pclose); }
Handle space(const Shape& dims, const hsize_t* most = nullptr) {
  return Handle(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), most), H5Sclose);
}

hsize_t count(const Shape& dims) {
  hsize_t n = 1;
  for (hsize_t d : dims) n *= d;
  return n;
}

Shape extent(const Handle& set) {
  const Handle s(H5Dget_space(set.id()), H5Sclose);
  Shape dims(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(s.id()))));
  H5Sget_simple_extent_dims(s.id(), dims.data(), nullptr);
  return dims;
}

Shape whole(std::size_t rows, const std::vector<std::size_t>& row) {
  Shape dims{rows};
  dims.insert(dims.end(), row.begin(), row.end());
  return dims;
}

Handle open_set(const File& file, const std::string& name) {
  Handle set(H5Dopen2(file.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.ok()) file.unreadable(name);
  return set;
}

// Properties of a new array: groups of its name are made.
Handle with_groups() {
  Handle how = property(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(how.id(), 1);
  return how;
}

void put_raw(const File& file, const std::string& name, hid_t type, const void* data, const Shape& dims) {
  const Handle s = space(dims);
  const Handle link = with_groups();
  const Handle set(H5Dcreate2(file.id(), name.c_str(), type, s.id(), link.id(), H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  if (!set.ok()) file.unwritable(name);
  if (count(dims) > 0 && H5Dwrite(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) file.unwritable(name);
}

Handle string_type(std::size_t width) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), width);
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

// A killed single writer leaves a mark in the file: "being written". A full disk leaves it shorter than its head says, by what could not be
// written. The properties of h5clear remove the mark, and let the file grow to its length. Rows are packed with a sum, so that those which
// are missing cannot be read as zeros.
hid_t open_to_extend(const std::string& path, hid_t access) {
  hbool_t yes = 1;
  H5Pset(access, "clear_status_flags", &yes);
  H5Pset(access, "skip_eof_check", &yes);
  return H5Fopen(path.c_str(), H5F_ACC_RDWR, access);
}

hid_t open_to_read(const std::string& path, hid_t access) {
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
  // The file is still being written, or its writer was killed; single-writer mode reads it in both cases. Metadata whose checksum fails may
  // be half written, so HDF5 reads it again after twice the time. 30 attempts take 2 s; the library's 100 would take for ever on a damaged
  // file.
  H5Pset_metadata_read_attempts(access, 30);
  return id >= 0 ? id : H5Fopen(path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access);
}

std::string why() { return errno != 0 ? fmt::format(": {}", std::strerror(errno)) : "; is the disk full?"; }

}  // namespace

Handle::Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
Handle& Handle::operator=(Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}
Handle::~Handle() {
  if (id_ >= 0) close_(id_);
}

File::File(std::string path, Mode mode) : path_(std::move(path)) {
  static const bool no_end = H5dont_atexit() >= 0;  // at exit HDF5 would access objects that could not be written
  (void)no_end;
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // our messages replace the library's
  errno = 0;
  const Handle access = property(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  if (mode == Mode::create) {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);  // the mark of a killed writer would forbid truncation
    file_ = Handle(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose);
    if (!file_.ok()) throw WriteError(fmt::format("the motion file cannot be created{}", why()), {path_, 0});
    return;
  }
  if (!std::filesystem::exists(path_)) throw Error("no such motion file; give the folder of a run", {path_, 0});
  file_ = Handle(mode == Mode::read ? open_to_read(path_, access.id()) : open_to_extend(path_, access.id()), H5Fclose);
  if (!file_.ok()) unreadable("the file");
}

void File::unreadable(const std::string& what) const {
  throw Error(fmt::format("{} cannot be read; the file is damaged or no motion file, run the scene again", what), {path_, 0});
}
void File::unwritable(const std::string& what) const { throw WriteError(fmt::format("{} cannot be written{}", what, why()), {path_, 0}); }

template <class T>
void File::put(const std::string& name, const std::vector<T>& data, std::size_t columns) const {
  put_raw(*this, name, type_of<T>(), data.data(), columns == 1 ? Shape{data.size()} : Shape{data.size() / columns, columns});
}

template <class T>
std::vector<T> File::get(const std::string& name) const {
  const Handle set = open_set(*this, name);
  std::vector<T> data(count(extent(set)));
  if (!data.empty() && H5Dread(set.id(), type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()) < 0) unreadable(name);
  return data;
}

// Names are stored with one width, the longest: single-writer mode has no variable-length data.
void File::put_names(const std::string& name, const std::vector<std::string>& names) const {
  std::size_t width = 1;
  for (const std::string& n : names) width = std::max(width, n.size());
  std::string text(width * names.size(), '\0');
  for (std::size_t i = 0; i < names.size(); ++i) text.replace(i * width, names[i].size(), names[i]);
  put_raw(*this, name, string_type(width).id(), text.data(), {names.size()});
}

std::vector<std::string> File::get_names(const std::string& name) const {
  const Handle set = open_set(*this, name);
  const Handle stored(H5Dget_type(set.id()), H5Tclose);
  const std::size_t width = std::max<std::size_t>(1, H5Tget_size(stored.id()));
  const Handle type = string_type(width);
  std::string text(width * count(extent(set)), '\0');
  if (!text.empty() && H5Dread(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0) unreadable(name);
  std::vector<std::string> names(text.size() / width);
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = text.substr(i * width, width).c_str();
  return names;
}

void File::put_text(const std::string& name, const std::string& text) const {
  const Handle type = string_type(std::max<std::size_t>(1, text.size())), one(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle own(H5Acreate2(file_.id(), name.c_str(), type.id(), one.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  std::string padded = text;
  padded.resize(std::max<std::size_t>(1, text.size()), '\0');
  if (!own.ok() || H5Awrite(own.id(), type.id(), padded.data()) < 0) unwritable(name);
}

std::optional<std::string> File::get_text(const std::string& name) const {
  if (H5Aexists(file_.id(), name.c_str()) <= 0) return std::nullopt;
  const Handle own(H5Aopen(file_.id(), name.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle stored(H5Aget_type(own.id()), H5Tclose);
  if (H5Tget_class(stored.id()) != H5T_STRING || H5Tis_variable_str(stored.id()) != 0) unreadable(name);
  std::string text(H5Tget_size(stored.id()), '\0');
  if (H5Aread(own.id(), stored.id(), text.data()) < 0) unreadable(name);
  return text.c_str();
}

bool File::has(const std::string& name) const { return H5Lexists(file_.id(), name.c_str(), H5P_DEFAULT) > 0; }
void File::single_writer() const {
  if (H5Fstart_swmr_write(file_.id()) < 0) unwritable("the file");
}
void File::flush() const {
  if (H5Fflush(file_.id(), H5F_SCOPE_LOCAL) < 0) unwritable("the file");
}

template <class T>
Rows<T>::Rows(const File& file, const std::string& name, std::vector<std::size_t> row, std::size_t rows_per_chunk)
    : file_(&file), name_(name), row_(std::move(row)) {
  Shape most = whole(0, row_);
  most[0] = H5S_UNLIMITED;
  const Shape chunk = whole(rows_per_chunk, row_);
  const Handle s = space(whole(0, row_), most.data()), how = property(H5P_DATASET_CREATE);
  H5Pset_chunk(how.id(), static_cast<int>(chunk.size()), chunk.data());
  H5Pset_shuffle(how.id());
  H5Pset_deflate(how.id(), 1);
  const Handle access = property(H5P_DATASET_ACCESS);
  H5Pset_chunk_cache(access.id(), 521, most_cached, 1);
  const Handle link = with_groups();
  set_ = Handle(H5Dcreate2(file.id(), name.c_str(), type_of<T>(), s.id(), link.id(), how.id(), access.id()), H5Dclose);
  if (!set_.ok()) file.unwritable(name);
}

template <class T>
Rows<T>::Rows(const File& file, const std::string& name) : file_(&file), name_(name), set_(open_set(file, name)) {
  const Shape dims = extent(set_);
  if (dims.empty()) file.unreadable(name);
  rows_ = dims[0];
  row_.assign(dims.begin() + 1, dims.end());
}

template <class T>
std::size_t Rows<T>::row_items() const {
  return count(whole(1, row_));
}

template <class T>
void Rows<T>::resize(std::size_t rows) {
  if (H5Dset_extent(set_.id(), whole(rows, row_).data()) < 0) file_->unwritable(name_);
  rows_ = rows;
}

template <class T>
void Rows<T>::append(const T* items) {
  resize(rows_ + 1);
  if (!transfer(rows_ - 1, const_cast<T*>(items), true)) file_->unwritable(name_);
}

template <class T>
void Rows<T>::read(std::size_t at, T* items) const {
  if (!transfer(at, items, false)) file_->unreadable(fmt::format("{}[{}]", name_, at));
}

template <class T>
bool Rows<T>::transfer(std::size_t at, T* items, bool write) const {
  const Shape size = whole(1, row_);
  Shape from(size.size(), 0);
  from[0] = at;
  const Handle memory = space(size), stored(H5Dget_space(set_.id()), H5Sclose);
  if (H5Sselect_hyperslab(stored.id(), H5S_SELECT_SET, from.data(), nullptr, size.data(), nullptr) < 0) return false;
  if (write) return H5Dwrite(set_.id(), type_of<T>(), memory.id(), stored.id(), H5P_DEFAULT, items) >= 0;
  return H5Dread(set_.id(), type_of<T>(), memory.id(), stored.id(), H5P_DEFAULT, items) >= 0;
}

template void File::put(const std::string&, const std::vector<double>&, std::size_t) const;
template void File::put(const std::string&, const std::vector<float>&, std::size_t) const;
template void File::put(const std::string&, const std::vector<int>&, std::size_t) const;
template void File::put(const std::string&, const std::vector<std::uint8_t>&, std::size_t) const;
template std::vector<double> File::get(const std::string&) const;
template std::vector<float> File::get(const std::string&) const;
template std::vector<int> File::get(const std::string&) const;
template std::vector<std::uint8_t> File::get(const std::string&) const;
template class Rows<double>;
template class Rows<float>;
template class Rows<std::uint8_t>;

}  // namespace erbs::h5
