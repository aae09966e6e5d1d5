// The arrays of a MAT-file of level 5 (MathWorks, "MAT-File Format"), as views of its bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mckibben::formats {

inline constexpr std::size_t most_numbers = 1U << 24U;  // of an array: a million ticks in sixteen columns

/// Classes of arrays, as files number them; first_number to last_number are numeric.
enum class MatClass : std::uint8_t {
  none = 0,  ///< an empty field
  cell = 1,
  structure = 2,
  object = 3,
  text = 4,
  sparse = 5,
  first_number = 6,
  last_number = 15,
  opaque = 17
};

/// The elements of a file or inside of another element, one after the other, each with a tag of type and
/// size.
class MatElements {
 public:
  struct Element {
    std::uint32_t type = 0;
    std::string_view content;
  };

  MatElements(std::string_view bytes, bool big_endian) : rest_(bytes), big_endian_(big_endian) {}
  bool empty() const { return rest_.empty(); }
  bool big_endian() const { return big_endian_; }
  /// How many bytes are left.
  std::size_t size() const { return rest_.size(); }
  /// Throws BadFile if the bytes end in it.
  Element next();

 private:
  std::string_view rest_;
  bool big_endian_;
};

struct MatArray {
  /// From the content of its element. Throws BadFile if that is not whole.
  MatArray(std::string_view content, bool big_endian);

  MatClass kind = MatClass::none;
  bool is_complex = false;
  std::string name;
  std::vector<std::size_t> sizes;
  MatElements parts;  ///< what stands behind the name

  std::size_t count() const;  ///< how many elements the sizes make
  bool is_numeric() const;    ///< of real numbers
  bool is_struct() const { return kind == MatClass::structure; }

  /// Of the struct, or of that element of an array of structs, from 0.
  std::vector<std::pair<std::string, MatArray>> fields(std::size_t element = 0) const;
  /// Of an array of letters; others than those of ASCII are ?.
  std::string text() const;
  /// Of an object, as MATLAB calls it: timeseries.
  std::string object_class() const;
  /// Of a numeric array, column by column.
  std::vector<double> numbers(std::size_t from, std::size_t how_many) const;
};

/// `data(:,2)` as `data` and 2; 0 where no column is named. Throws BadFile for (:,x).
std::pair<std::string_view, std::size_t> split_column(std::string_view where);

/// What an object is that only MATLAB opens, and what to write there to have its numbers.
std::string about_object(std::string_view name, std::string_view kind);

/// The variables of a MAT-file, all found whole.
class MatVariables {
 public:
  /// Throws BadFile if these are not the bytes of a whole MAT-file of level 5; says what they are instead,
  /// where that can be seen, and what to do. The bytes must outlive this.
  explicit MatVariables(std::string_view bytes);
  MatVariables(const MatVariables&) = delete;
  MatVariables& operator=(const MatVariables&) = delete;

  std::size_t size() const { return contents_.size(); }
  MatArray operator[](std::size_t i) const { return {contents_[i], big_endian_}; }

 private:
  void take(std::uint32_t type, std::string_view content);

  bool big_endian_;
  std::vector<std::string_view> contents_;
  std::deque<std::string> inflated_;  ///< those that were compressed
  std::size_t inflated_bytes_ = 0;
};

}  // namespace mckibben::formats
