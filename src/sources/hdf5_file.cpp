#include "sources/hdf5_file.hpp"

#include <stdexcept>

namespace saccade {

namespace {

// A library that was built for threads prints its messages on each thread on which this was not called.
void silence_messages() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

}  // namespace

Hdf5Id open_hdf5(const std::filesystem::path& path) {
  silence_messages();
  // The file is only read, and the file systems of clusters often have no locks.
  const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access.get(), false, true);
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
}

std::optional<Hdf5Images> Hdf5Images::open(const Hdf5Id& file, const std::string& name) {
  if (H5Lexists(file.get(), name.c_str(), H5P_DEFAULT) <= 0) return std::nullopt;
  Hdf5Images images;
  images.name_ = name;
  images.data_ = {H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose};
  if (!images.data_.valid()) throw std::runtime_error(name + " is not an array");
  const Hdf5Id type(H5Dget_type(images.data_.get()), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type.get());
  if (kind != H5T_INTEGER && kind != H5T_FLOAT)
    throw std::runtime_error(name + " is not an array of numbers");
  const Hdf5Id space(H5Dget_space(images.data_.get()), H5Sclose);
  const int axes = H5Sget_simple_extent_ndims(space.get());
  if (axes < 0) throw std::runtime_error(name + " has no shape");
  images.shape_.resize(static_cast<std::size_t>(axes));
  H5Sget_simple_extent_dims(space.get(), images.shape_.data(), nullptr);
  return images;
}

void Hdf5Images::read(hsize_t index, hid_t type, void* target) const {
  silence_messages();
  std::vector<hsize_t> begin(shape_.size(), 0), count = shape_;
  begin.at(0) = index;
  count.at(0) = 1;
  const Hdf5Id from(H5Dget_space(data_.get()), H5Sclose);
  const Hdf5Id to(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
  if (H5Sselect_hyperslab(from.get(), H5S_SELECT_SET, begin.data(), nullptr, count.data(), nullptr) < 0 ||
      H5Dread(data_.get(), type, to.get(), from.get(), H5P_DEFAULT, target) < 0)
    throw std::runtime_error(name_ + " is damaged here");
}

}  // namespace saccade
