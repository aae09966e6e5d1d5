// Reading of MAT-files with libmatio; see the header. The library trusts what a file says of itself, so its
// frame and sizes are judged first, and the library runs in a child process.
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include <sim/formats/child.hpp>
#include <sim/formats/mat_file.hpp>
#include <sim/formats/mat_frame.hpp>
#include <sim/formats/mat_handles.hpp>
#include <sim/formats/memory_file.hpp>

namespace mckibben::formats {
namespace {

constexpr std::size_t most_names = 10000;

bool is_numeric(matio_classes kind) {
  return kind >= MAT_C_DOUBLE && kind <= MAT_C_UINT64;
}

std::string_view kind_of(const matvar_t& variable) {
  if (variable.isComplex != 0) return "complex";
  switch (variable.class_type) {
    case MAT_C_CELL:
      return "a cell array";
    case MAT_C_STRUCT:
      return "a struct";
    case MAT_C_CHAR:
      return "text";
    case MAT_C_SPARSE:
      return "sparse";
    case MAT_C_OBJECT:
    case MAT_C_OPAQUE:
      return "an object (a table, a timeseries)";
    default:
      return "not numeric";
  }
}

/// How many numbers it says it has; none if that cannot be.
std::optional<std::size_t> numbers_in(const matvar_t& variable) {
  std::size_t count = 1;
  if (variable.rank < 1 || variable.dims == nullptr) return std::nullopt;
  for (int i = 0; i < variable.rank; ++i) {
    if (variable.dims[i] > most_numbers) return std::nullopt;
    count *= variable.dims[i];
    if (count > most_numbers) return std::nullopt;
  }
  return count;
}

bool is_one_struct(const matvar_t& variable) {
  return variable.class_type == MAT_C_STRUCT && numbers_in(variable) == 1U;
}

/// Whether nothing in it says that it is larger than it may be.
bool has_sound_sizes(const matvar_t& variable) {
  const auto count = numbers_in(variable);
  if (!count) return false;
  if (variable.class_type != MAT_C_STRUCT || variable.data == nullptr) return true;
  auto* const* fields = static_cast<matvar_t* const*>(variable.data);
  const std::size_t all = *count * Mat_VarGetNumberOfFields(const_cast<matvar_t*>(&variable));
  return std::all_of(fields, fields + all,
                     [](const matvar_t* field) { return field == nullptr || has_sound_sizes(*field); });
}

/// Names of the numeric arrays in a variable: its own, or those of its fields.
void list(const matvar_t& variable, const std::string& name, std::vector<std::string>& names) {
  if (is_numeric(variable.class_type) && variable.isComplex == 0) names.push_back(name);
  if (!is_one_struct(variable)) return;
  char* const* fields = Mat_VarGetStructFieldnames(&variable);
  const unsigned count = Mat_VarGetNumberOfFields(const_cast<matvar_t*>(&variable));
  for (unsigned i = 0; i < count; ++i) {
    const matvar_t* field = Mat_VarGetStructFieldByIndex(const_cast<matvar_t*>(&variable), i, 0);
    if (field != nullptr) list(*field, name + "." + fields[i], names);
  }
}

template <class T>
std::vector<double> doubles(const matvar_t& variable, std::size_t from, std::size_t count) {
  const T* data = static_cast<const T*>(variable.data) + from;
  std::vector<double> values(count);
  std::transform(data, data + count, values.begin(), [](T value) { return static_cast<double>(value); });
  return values;
}

std::vector<double> doubles(const matvar_t& variable, std::size_t from, std::size_t count) {
  switch (variable.class_type) {
    case MAT_C_DOUBLE:
      return doubles<double>(variable, from, count);
    case MAT_C_SINGLE:
      return doubles<float>(variable, from, count);
    case MAT_C_INT8:
      return doubles<std::int8_t>(variable, from, count);
    case MAT_C_UINT8:
      return doubles<std::uint8_t>(variable, from, count);
    case MAT_C_INT16:
      return doubles<std::int16_t>(variable, from, count);
    case MAT_C_UINT16:
      return doubles<std::uint16_t>(variable, from, count);
    case MAT_C_INT32:
      return doubles<std::int32_t>(variable, from, count);
    case MAT_C_UINT32:
      return doubles<std::uint32_t>(variable, from, count);
    case MAT_C_INT64:
      return doubles<std::int64_t>(variable, from, count);
    default:
      return doubles<std::uint64_t>(variable, from, count);
  }
}

/// `data(:,2)` as `data` and 2; 0 where no column is named.
std::pair<std::string_view, std::size_t> split_column(std::string_view where) {
  const auto open_at = where.find("(:,");
  if (open_at == std::string_view::npos || !where.ends_with(')')) return {where, 0};
  const std::string_view digits = where.substr(open_at + 3, where.size() - open_at - 4);
  std::size_t column = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), column);
  if (error != std::errc{} || end != digits.data() + digits.size() || column == 0)
    throw BadFile(
        fmt::format("{} is no column: write {}(:,2) for the second", where, where.substr(0, open_at)));
  return {where.substr(0, open_at), column};
}

std::vector<double> values(mat_t* mat, std::string_view where) {
  const auto [path, column] = split_column(where);
  const std::string top(path.substr(0, path.find('.')));
  const Variable info(Mat_VarReadInfo(mat, top.c_str()));
  if (!info) throw BadFile(fmt::format("there is no variable {}", top));
  if (!has_sound_sizes(*info))
    throw BadFile(
        fmt::format("{} says it has more than {} numbers, which is more than is read", top, most_numbers));
  const Variable whole(Mat_VarRead(mat, top.c_str()));
  const matvar_t* variable = whole.get();
  for (std::size_t dot = path.find('.'); variable != nullptr && dot != std::string_view::npos;) {
    const std::size_t next = path.find('.', dot + 1);
    const std::string field(path.substr(dot + 1, next == std::string_view::npos ? next : next - dot - 1));
    if (!is_one_struct(*variable)) throw BadFile(fmt::format("{} is not a struct", path.substr(0, dot)));
    variable = Mat_VarGetStructFieldByName(const_cast<matvar_t*>(variable), field.c_str(), 0);
    if (variable == nullptr) throw BadFile(fmt::format("{} has no field {}", path.substr(0, dot), field));
    dot = next;
  }
  if (variable == nullptr) throw BadFile(fmt::format("{} is damaged", top));
  if (!is_numeric(variable->class_type) || variable->isComplex != 0)
    throw BadFile(fmt::format("{} is {}; wanted is a vector of real numbers", path, kind_of(*variable)));
  const auto count = numbers_in(*variable);
  if (!count || variable->rank != 2)
    throw BadFile(fmt::format("{} has {} dimensions; wanted is a vector", path, variable->rank));
  if (*count == 0) throw BadFile(fmt::format("{} is empty", path));
  const std::size_t rows = variable->dims[0], columns = variable->dims[1];
  if (variable->data == nullptr || variable->nbytes < *count * static_cast<std::size_t>(variable->data_size))
    throw BadFile(fmt::format("{} is damaged: its numbers are not all there", path));
  if (column > columns) throw BadFile(fmt::format("{} has {} columns", path, columns));
  if (column > 0) return doubles(*variable, (column - 1) * rows, rows);
  if (rows != 1 && columns != 1)
    throw BadFile(fmt::format("{} has {} rows and {} columns; name one: {}(:,1)", path, rows, columns, path));
  return doubles(*variable, 0, *count);
}

/// Hands bytes over between processes.
class Parcel {
 public:
  explicit Parcel(std::string bytes = {}) : bytes_(std::move(bytes)) {}
  void put(const void* data, std::size_t size) {
    const std::uint64_t length = size;
    bytes_.append(reinterpret_cast<const char*>(&length), sizeof length);
    bytes_.append(static_cast<const char*>(data), size);
  }
  void put(std::string_view text) { put(text.data(), text.size()); }
  std::string_view take() {
    std::uint64_t length = 0;
    bytes_.copy(reinterpret_cast<char*>(&length), sizeof length, at_);
    at_ += sizeof length + length;
    return std::string_view(bytes_).substr(at_ - length, length);
  }
  bool empty() const { return at_ >= bytes_.size(); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

/// In the child: for each wanted a problem and the values, then the names.
std::string parcel(const std::string& path, const std::vector<std::string>& wanted) {
  Mat_LogInitFunc("mckibben", [](int, char*) {});
  const Mat mat(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  if (!mat && errno == EMFILE) throw std::system_error(errno, std::generic_category());
  if (!mat) throw BadFile("this is not a MAT-file that can be read");
  Parcel out;
  for (const std::string& where : wanted) {
    Found found;
    try {
      found.values = values(mat.get(), where);
    } catch (const BadFile& bad) {
      found.problem = bad.what();
    }
    out.put(found.problem);
    out.put(found.values.data(), found.values.size() * sizeof(double));
  }
  Mat_Rewind(mat.get());
  std::vector<std::string> names;
  while (names.size() < most_names) {
    const Variable variable(Mat_VarReadNextInfo(mat.get()));
    if (!variable) break;
    if (variable->name != nullptr) list(*variable, variable->name, names);
  }
  for (const std::string& name : names) out.put(name);
  return out.bytes();
}

}  // namespace

MatContents read_mat(const std::string& bytes, const std::vector<std::string>& wanted) {
  check_mat_frame(bytes);
  const MemoryFile file(bytes);
  Parcel in(in_child([&] { return parcel(file.path(), wanted); }));
  MatContents contents;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    Found& found = contents.found.emplace_back();
    found.problem = in.take();
    const std::string_view numbers = in.take();
    found.values.resize(numbers.size() / sizeof(double));
    numbers.copy(reinterpret_cast<char*>(found.values.data()), numbers.size());
  }
  while (!in.empty()) contents.names.emplace_back(in.take());
  return contents;
}

}  // namespace mckibben::formats
