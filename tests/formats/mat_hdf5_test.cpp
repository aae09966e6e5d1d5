// What MATLAB's save -v7.3 writes, made here with HDF5 as MATLAB lays it out.
#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <hdf5.h>

#include <sim/formats/mat_file.hpp>
#include <sim/formats/table.hpp>

#include "scratch.hpp"

namespace mckibben::formats {
namespace {

/// MATLAB's n x 1 is HDF5's 1 x n.
void write(hid_t in, const char* name, hsize_t columns, hsize_t rows, const std::vector<double>& values) {
  const hsize_t sizes[] = {columns, rows};
  const hid_t space = H5Screate_simple(2, sizes, nullptr);
  const hid_t set = H5Dcreate2(in, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Dclose(set);
  H5Sclose(space);
}

std::string file() {
  const Scratch folder;
  const std::string path = folder / "a.mat";
  const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
  H5Pset_userblock(creation, 512);
  const hid_t made = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT);
  write(made, "t", 1, 3, {0, 1, 2});
  write(made, "data", 2, 3, {1, 2, 3, 4, 5, 6});
  const hid_t group = H5Gcreate2(made, "run", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  write(group, "pressure", 3, 1, {7, 8, 9});
  H5Gclose(group);
  write(made, "ts", 1, 6, {3707764736, 2, 1, 1, 1, 1});  // as MATLAB writes an object: numbers that are none
  const hid_t object = H5Dopen2(made, "ts", H5P_DEFAULT), text = H5Tcopy(H5T_C_S1),
              one = H5Screate(H5S_SCALAR);
  H5Tset_size(text, 10);
  const hid_t kind = H5Acreate2(object, "MATLAB_class", text, one, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(kind, text, "timeseries");
  const hid_t decode =
      H5Acreate2(object, "MATLAB_object_decode", H5T_NATIVE_INT, one, H5P_DEFAULT, H5P_DEFAULT);
  const int how = 3;
  H5Awrite(decode, H5T_NATIVE_INT, &how);
  for (const hid_t attribute : {kind, decode}) H5Aclose(attribute);
  H5Sclose(one);
  H5Tclose(text);
  H5Dclose(object);
  H5Fclose(made);
  H5Pclose(creation);
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return "MATLAB 7.3 MAT-file" + bytes.str().substr(19);
}

TEST(MatHdf5, VectorsFieldsAndColumnsOfMatrices) {
  const MatContents read = read_mat(file(), {"t", "run.pressure", "data(:,2)", "data", "none", "ts.Data"});
  EXPECT_EQ(read.found[0].values, (std::vector<double>{0, 1, 2})) << read.found[0].problem;
  EXPECT_EQ(read.found[1].values, (std::vector<double>{7, 8, 9}));
  EXPECT_EQ(read.found[2].values, (std::vector<double>{4, 5, 6}));
  EXPECT_EQ(read.found[3].problem, "data has 3 rows and 2 columns; name one: data(:,1)");
  EXPECT_NE(read.found[4].problem, "");
  EXPECT_NE(read.found[5].problem.find("ts is an object of class timeseries"), std::string::npos);
  EXPECT_EQ(read.vectors.size(), 4u) << "an object's numbers are none";
}

TEST(MatHdf5, CutOffOnesAreRefused) {
  const std::string whole = file();
  for (std::size_t size = 513; size < whole.size(); size += 301)
    EXPECT_THROW(read_mat(whole.substr(0, size), {}), BadFile) << size;
}

}  // namespace
}  // namespace mckibben::formats
