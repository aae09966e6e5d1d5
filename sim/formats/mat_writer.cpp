// Writing of MAT-files with libmatio; see mat_file.hpp.
// The heading is ours: the library's own holds the date.
#include <array>
#include <mutex>

#include <fmt/format.h>

#include <sim/formats/mat_file.hpp>
#include <sim/formats/mat_handles.hpp>
#include <sim/formats/memory_file.hpp>

namespace mckibben::formats {
namespace {

Variable numbers(const std::string& name, std::vector<double> values) {
  std::array<std::size_t, 2> dims{values.size(), 1};
  return Variable(Mat_VarCreate(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims.data(), values.data(), 0));
}

Variable text(const std::string& name, std::string value) {
  std::array<std::size_t, 2> dims{value.empty() ? std::size_t{0} : std::size_t{1}, value.size()};
  return Variable(Mat_VarCreate(name.c_str(), MAT_C_CHAR, MAT_T_UTF8, 2, dims.data(), value.data(), 0));
}

/// A struct with a text for each column.
template <class Text>
Variable texts(const char* name, const std::vector<Column>& columns, Text text_of) {
  std::vector<const char*> fields;
  fields.reserve(columns.size());
  for (const Column& column : columns) fields.push_back(column.name.c_str());
  std::array<std::size_t, 2> dims{1, 1};
  Variable variable(
      Mat_VarCreateStruct(name, 2, dims.data(), fields.data(), static_cast<unsigned>(fields.size())));
  for (const Column& column : columns)
    if (variable)
      Mat_VarSetStructFieldByName(variable.get(), column.name.c_str(), 0,
                                  text(column.name, text_of(column)).release());
  return variable;
}

}  // namespace

std::string mat_of(const Table& table) {
  static std::mutex library;  // nothing is promised of its threads
  const std::lock_guard lock(library);
  const MemoryFile file;
  {
    const Mat mat(
        Mat_CreateVer(file.path().c_str(), "MATLAB 5.0 MAT-file, written by mckibben", MAT_FT_MAT5));
    const auto write = [&mat](const Variable& variable) {
      if (!mat || !variable || Mat_VarWrite(mat.get(), variable.get(), MAT_COMPRESSION_NONE) != 0)
        throw BadFile("libmatio could not make the MAT-file");
    };
    for (const Column& column : table.columns) write(numbers(column.name, column.values));
    write(texts("units", table.columns, [](const Column& column) { return column.unit; }));
    write(texts("descriptions", table.columns, [](const Column& column) { return column.meaning; }));
    write(text("title", table.title));
    for (const auto& [name, value] : table.attributes) {
      const auto* number = std::get_if<double>(&value);
      write(number != nullptr ? numbers(name, {*number}) : text(name, std::get<std::string>(value)));
    }
  }
  return file.bytes();
}

}  // namespace mckibben::formats
