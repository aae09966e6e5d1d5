// MATLAB's -v7.3 files: HDF5 behind a heading of 512 bytes.
#pragma once

#include <string>
#include <vector>

#include <sim/formats/mat_file.hpp>

namespace mckibben::formats {

bool is_mat_hdf5(const std::string& bytes);

/// As read_mat. Matrices are as in MATLAB: what HDF5 calls rows are columns.
MatContents read_mat_hdf5(const std::string& bytes, const std::vector<std::string>& wanted);

}  // namespace mckibben::formats
