// A file may be damaged, or say more than it holds: every size is compared with what is there before it is
// used. See the header.
#include <algorithm>
#include <array>
#include <bit>
#include <memory>

#include <fmt/format.h>
#include <zlib.h>

#include <sim/formats/mat_arrays.hpp>
#include <sim/formats/table.hpp>

namespace mckibben::formats {
namespace {

constexpr std::size_t heading_bytes = 128, tag_bytes = 8;
constexpr std::size_t most_inflated = 1U << 28U;  // of all variables
constexpr std::size_t most_fields = 10000;        // that are looked at
constexpr std::uint32_t matrix_type = 14, compressed_type = 15;

[[noreturn]] void damaged() {
  throw BadFile("its sizes and contents do not agree: the file is damaged");
}

template <class T>
T number_at(std::string_view bytes, std::size_t at, bool big_endian) {
  if (bytes.size() < sizeof(T) || at > bytes.size() - sizeof(T)) damaged();
  std::array<char, sizeof(T)> own{};
  bytes.copy(own.data(), sizeof(T), at);
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(own.begin(), own.end());
  return std::bit_cast<T>(own);
}

std::uint32_t word(std::string_view bytes, std::size_t at, bool big_endian) {
  return number_at<std::uint32_t>(bytes, at, big_endian);
}

/// Calls `use` with a number of that type and returns what it does, or `otherwise` for types that are none.
template <class Result, class Use>
Result with_number_type(std::uint32_t type, Result otherwise, const Use& use) {
  switch (type) {
    case 1:
      return use(std::int8_t{});
    case 2:
      return use(std::uint8_t{});
    case 3:
      return use(std::int16_t{});
    case 4:
      return use(std::uint16_t{});
    case 5:
      return use(std::int32_t{});
    case 6:
      return use(std::uint32_t{});
    case 7:
      return use(float{});
    case 9:
      return use(double{});
    case 12:
      return use(std::int64_t{});
    case 13:
      return use(std::uint64_t{});
    default:
      return otherwise;
  }
}

/// Numbers, cells and fields of structs must be as many as the sizes say, and those inside of them too.
void check(const MatArray& array, int depth) {
  constexpr int deepest = 50;
  if (depth > deepest) damaged();
  if (array.kind == MatClass::none || array.kind == MatClass::opaque) return;
  const std::size_t count = array.count();
  MatElements parts = array.parts;
  if (array.kind >= MatClass::first_number && array.kind <= MatClass::last_number) {
    const MatElements::Element numbers = parts.next();
    const auto bytes = with_number_type(numbers.type, std::size_t{0}, [](auto one) { return sizeof one; });
    if (bytes == 0 || numbers.content.size() != count * bytes) damaged();
    return;
  }
  if (count > most_numbers)
    throw BadFile(fmt::format("it has more than {} elements, which is more than is read", most_numbers));
  if (array.kind != MatClass::cell && array.kind != MatClass::structure) return;
  std::size_t held = count;
  if (array.kind == MatClass::structure) {
    const std::size_t length = word(parts.next().content, 0, parts.big_endian());
    const std::size_t names = parts.next().content.size();
    held *= length == 0 ? 0 : names / length;
  }
  if (held > parts.size() / tag_bytes) damaged();
  for (; held > 0; --held) {
    const MatElements::Element inside = parts.next();
    if (inside.type != matrix_type) damaged();
    check({inside.content, parts.big_endian()}, depth + 1);
  }
}

/// What zlib makes of it, all of which must be there and right; at most so many bytes.
std::string inflated(std::string_view compressed, std::size_t most) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw BadFile("there is no memory to read it");
  const std::unique_ptr<z_stream, int (*)(z_stream*)> owner(&stream, inflateEnd);
  stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(compressed.data()));
  stream.avail_in = static_cast<uInt>(compressed.size());
  std::string bytes;
  constexpr std::size_t densest = 1032;  // what zlib can make of a byte
  bytes.reserve(std::min(most, compressed.size() * densest));
  std::array<char, 1U << 16U> block;
  for (int status = Z_OK; status != Z_STREAM_END;) {
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = block.size();
    status = inflate(&stream, Z_NO_FLUSH);
    if (status != Z_OK && status != Z_STREAM_END) damaged();
    bytes.append(block.data(), block.size() - stream.avail_out);
    if (bytes.size() > most)
      throw BadFile(fmt::format("uncompressed, they are larger than {} MB; save only what is wanted",
                                most_inflated >> 20U));
  }
  bytes.shrink_to_fit();
  return bytes;
}

/// What MATLAB and Octave write besides.
void refuse_relatives(std::string_view bytes) {
  constexpr const char* what_to_do = "in MATLAB or Octave, save it with -v7: save('run.mat', '-v7')";
  if (bytes.starts_with("MATLAB 7.3"))
    throw BadFile(fmt::format("this is the heading of a file of -v7.3 without what follows; {}", what_to_do));
  if (bytes.starts_with("# Created by Octave") || bytes.starts_with("Octave-1"))
    throw BadFile(fmt::format("this is Octave's own format; {}", what_to_do));
}

/// Whether the numbers of the file are big-endian.
bool check_heading(std::string_view bytes) {
  if (bytes.empty()) throw BadFile("the file is empty");
  refuse_relatives(bytes);
  const std::string_view order = bytes.substr(std::min(bytes.size(), heading_bytes - 2), 2);
  if (order != "IM" && order != "MI")
    throw BadFile(bytes.starts_with("MATLAB 5.0")
                      ? "the file is damaged or cut off: its heading of 128 bytes is not whole"
                      : "this is not a MAT-file of level 5 (what save -v6 and save -v7 write)");
  const bool big_endian = order == "MI";
  const auto version = number_at<std::uint16_t>(bytes, heading_bytes - 4, big_endian);
  if (version != 0x0100)
    throw BadFile(
        fmt::format("a MAT-file of version {:#06x} is not read, only 0x0100 (save -v6 or -v7)", version));
  return big_endian;
}

}  // namespace

MatElements::Element MatElements::next() {
  Element element{word(rest_, 0, big_endian_), {}};
  const std::uint32_t small = element.type >> 16U;
  if (small > 0) {  // up to four bytes stand in the tag itself
    if (small > 4 || rest_.size() < tag_bytes) damaged();
    element = {element.type & 0xFFFFU, rest_.substr(4, small)};
    rest_.remove_prefix(tag_bytes);
    return element;
  }
  const std::size_t size = word(rest_, 4, big_endian_);
  if (size > rest_.size() - tag_bytes) damaged();
  element.content = rest_.substr(tag_bytes, size);
  rest_.remove_prefix(std::min(rest_.size(), tag_bytes + (size + 7) / 8 * 8));
  return element;
}

MatArray::MatArray(std::string_view content, bool big_endian) : parts(content, big_endian) {
  if (content.empty()) return;
  constexpr std::uint32_t complex_flag = 0x800;
  const std::uint32_t flags = word(parts.next().content, 0, big_endian);
  kind = static_cast<MatClass>(flags & 0xFFU);
  is_complex = (flags & complex_flag) != 0;
  if (kind != MatClass::opaque) {  // which has none
    const std::string_view dimensions = parts.next().content;
    for (std::size_t at = 0; at + 4 <= dimensions.size(); at += 4)
      sizes.push_back(word(dimensions, at, big_endian));
  }
  name = parts.next().content;
  name.resize(std::min(name.size(), name.find('\0')));
}

std::size_t MatArray::count() const {
  std::size_t count = 1;
  for (const std::size_t size : sizes) {
    if (size > 0 && count > most_inflated / size) return most_inflated;
    count *= size;
  }
  return count;
}

bool MatArray::is_numeric() const {
  return kind >= MatClass::first_number && kind <= MatClass::last_number && !is_complex;
}

std::string MatArray::text() const {
  constexpr std::size_t longest = 200;
  MatElements rest = parts;
  const MatElements::Element letters = rest.next();
  const std::size_t step = letters.type == 17 || letters.type == 4 ? 2 : 1;
  std::string text;
  for (std::size_t at = 0; at + step <= letters.content.size() && text.size() < longest; at += step) {
    const char low = letters.content[at + (step == 2 && rest.big_endian() ? 1 : 0)];
    text += low >= ' ' && low < 0x7F ? low : '?';
  }
  return text;
}

std::string MatArray::object_class() const {
  constexpr std::size_t longest = 100;
  MatElements rest = parts;
  if (kind != MatClass::opaque || rest.empty()) return "";
  rest.next();  // MCOS
  std::string called(rest.empty() ? std::string_view() : rest.next().content.substr(0, longest));
  called.resize(std::min(called.size(), called.find('\0')));
  return called;
}

std::vector<std::pair<std::string, MatArray>> MatArray::fields(std::size_t element) const {
  MatElements rest = parts;
  const std::size_t length = word(rest.next().content, 0, rest.big_endian());
  const std::string_view names = rest.next().content;
  std::vector<std::pair<std::string, MatArray>> list;
  for (std::size_t skip = length == 0 ? 0 : element * (names.size() / length); skip > 0; --skip) rest.next();
  for (std::size_t at = 0; length > 0 && at + length <= names.size() && list.size() < most_fields;
       at += length) {
    const std::string_view padded = names.substr(at, length);
    list.emplace_back(padded.substr(0, padded.find('\0')), MatArray(rest.next().content, rest.big_endian()));
  }
  return list;
}

std::vector<double> MatArray::numbers(std::size_t from, std::size_t how_many) const {
  MatElements rest = parts;
  const MatElements::Element all = rest.next();
  std::vector<double> values(how_many);
  with_number_type(all.type, 0, [&]<class T>(T) {
    for (std::size_t i = 0; i < how_many; ++i)
      values[i] = static_cast<double>(number_at<T>(all.content, (from + i) * sizeof(T), rest.big_endian()));
    return 0;
  });
  return values;
}

MatVariables::MatVariables(std::string_view bytes) : big_endian_(check_heading(bytes)) {
  int number = 1;
  for (std::size_t at = heading_bytes; at < bytes.size(); ++number) {
    if (bytes.size() - at < tag_bytes)
      throw BadFile(fmt::format("the file ends in its {}. variable; it is cut off", number));
    const std::uint32_t type = word(bytes, at, big_endian_), size = word(bytes, at + 4, big_endian_);
    if (type != matrix_type && type != compressed_type)
      throw BadFile(fmt::format(
          "at byte {}, where its {}. variable should begin, is none: the file is damaged", at, number));
    if (size > bytes.size() - at - tag_bytes)
      throw BadFile(
          fmt::format("its {}. variable should have {} bytes and has {}: the file is damaged or cut off",
                      number, size, bytes.size() - at - tag_bytes));
    try {
      take(type, bytes.substr(at + tag_bytes, size));
    } catch (const BadFile& bad) {
      throw BadFile(fmt::format("its {}. variable: {}", number, bad.what()));
    }
    at += tag_bytes + size;
  }
  if (number == 1) throw BadFile("there are no variables in it");
}

void MatVariables::take(std::uint32_t type, std::string_view content) {
  if (type == compressed_type) {
    inflated_.push_back(inflated(content, most_inflated - inflated_bytes_));
    inflated_bytes_ += inflated_.back().size();
    const MatElements::Element matrix = MatElements(inflated_.back(), big_endian_).next();
    if (matrix.type != matrix_type) damaged();
    content = matrix.content;
  }
  const MatArray array(content, big_endian_);
  check(array, 0);
  if (!array.name.empty()) contents_.push_back(content);
}

}  // namespace mckibben::formats
