// Frame of a MAT-file (MathWorks, "MAT-File Format"): 128 bytes of heading, then elements, each with a tag of
// two 32-bit words, type and size; see the header.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <zlib.h>

#include <sim/formats/mat_frame.hpp>
#include <sim/formats/table.hpp>

namespace mckibben::formats {
namespace {

constexpr std::size_t heading_bytes = 128, tag_bytes = 8;
constexpr std::size_t most_inflated = 1U << 28U;  // of all variables
constexpr std::uint32_t matrix_type = 14, compressed_type = 15;
constexpr std::uint32_t cell_class = 1, struct_class = 2, first_numeric_class = 6, last_numeric_class = 15,
                        opaque_class = 17;

[[noreturn]] void damaged() {
  throw BadFile("its sizes and contents do not agree: the file is damaged");
}

std::uint32_t word(std::string_view bytes, std::size_t at, bool big_endian) {
  if (bytes.size() < 4 || at > bytes.size() - 4) damaged();
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = (value << 8U) | static_cast<unsigned char>(bytes[at + (big_endian ? i : 3 - i)]);
  return value;
}

/// Bytes of a number of that type; 0 for types that are none.
std::size_t number_bytes(std::uint32_t type) {
  constexpr std::array<std::size_t, 14> bytes{0, 1, 1, 2, 2, 4, 4, 4, 0, 8, 0, 0, 8, 8};
  return type < bytes.size() ? bytes[type] : 0;
}

struct Element {
  std::uint32_t type = 0;
  std::string_view content;
};

/// The elements inside of another, one after the other.
class Elements {
 public:
  Elements(std::string_view bytes, bool big_endian) : rest_(bytes), big_endian_(big_endian) {}
  bool empty() const { return rest_.empty(); }

  Element next() {
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

 private:
  std::string_view rest_;
  bool big_endian_;
};

/// How many numbers the dimensions make.
std::size_t count_of(const Element& dimensions, bool big_endian) {
  std::size_t count = 1;
  for (std::size_t at = 0; at + 4 <= dimensions.content.size(); at += 4) {
    const std::size_t size = word(dimensions.content, at, big_endian);
    if (size > 0 && count > most_inflated / size) return most_inflated;
    count *= size;
  }
  return count;
}

/// Numbers, cells and fields of structs must be as many as the dimensions say, and those inside of them too:
/// libmatio makes room for what is said. Of other kinds it reads no more than the dimensions.
void check_matrix(std::string_view content, bool big_endian, int depth) {
  constexpr int deepest = 50;
  if (content.empty()) return;  // an empty field
  if (depth > deepest) damaged();
  Elements parts(content, big_endian);
  const std::uint32_t kind = word(parts.next().content, 0, big_endian) & 0xFFU;
  if (kind == opaque_class) return;  // an object of MATLAB's, which has no dimensions here
  const std::size_t count = count_of(parts.next(), big_endian);
  parts.next();  // its name
  if (kind >= first_numeric_class && kind <= last_numeric_class) {
    const Element numbers = parts.next();
    const std::size_t bytes = number_bytes(numbers.type);
    if (bytes == 0 || numbers.content.size() != count * bytes) damaged();
    return;
  }
  if (count > most_numbers)
    throw BadFile(fmt::format("it has more than {} elements, which is more than is read", most_numbers));
  if (kind != cell_class && kind != struct_class) return;
  std::size_t held = count;
  if (kind == struct_class) {
    const std::size_t length = word(parts.next().content, 0, big_endian);
    const std::size_t names = parts.next().content.size();
    held *= length == 0 ? 0 : names / length;
  }
  if (held > content.size() / tag_bytes) damaged();
  while (!parts.empty()) {
    const Element field = parts.next();
    if (field.type != matrix_type) damaged();
    check_matrix(field.content, big_endian, depth + 1);
  }
}

/// What zlib makes of it, all of which must be there and right; `left` is how much it may be, and is used up.
std::string inflated(std::string_view compressed, std::size_t& left) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw BadFile("there is no memory to read it");
  const std::unique_ptr<z_stream, int (*)(z_stream*)> owner(&stream, inflateEnd);
  stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(compressed.data()));
  stream.avail_in = static_cast<uInt>(compressed.size());
  std::string bytes;
  constexpr std::size_t densest = 1032;  // what zlib can make of a byte
  bytes.reserve(std::min(left, compressed.size() * densest));
  std::array<char, 1U << 16U> block;
  for (int status = Z_OK; status != Z_STREAM_END;) {
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = block.size();
    status = inflate(&stream, Z_NO_FLUSH);
    if (status != Z_OK && status != Z_STREAM_END) damaged();
    bytes.append(block.data(), block.size() - stream.avail_out);
    if (bytes.size() > left)
      throw BadFile(fmt::format("uncompressed, they are larger than {} MB; save only what is wanted",
                                most_inflated >> 20U));
  }
  left -= bytes.size();
  return bytes;
}

void check_variable(std::uint32_t type, std::string_view content, bool big_endian, std::size_t& left) {
  if (type == matrix_type) return check_matrix(content, big_endian, 0);
  const std::string bytes = inflated(content, left);
  const Element matrix = Elements(bytes, big_endian).next();
  if (matrix.type != matrix_type) damaged();
  check_matrix(matrix.content, big_endian, 0);
}

/// What MATLAB and Octave write besides.
void refuse_relatives(std::string_view bytes) {
  constexpr std::string_view hdf5 = "\x89HDF\r\n\x1A\n";
  constexpr const char* what_to_do = "in MATLAB or Octave, save it with -v7: save('run.mat', '-v7')";
  if (bytes.starts_with("MATLAB 7.3") || bytes.starts_with(hdf5) ||
      (bytes.size() > 512 && bytes.substr(512).starts_with(hdf5)))
    throw BadFile(
        fmt::format("this is HDF5 (what MATLAB's save -v7.3 writes), which is not read; {}", what_to_do));
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
  const unsigned version = word(bytes, heading_bytes - 4, big_endian) >> (big_endian ? 16U : 0U) & 0xFFFFU;
  if (version != 0x0100)
    throw BadFile(
        fmt::format("a MAT-file of version {:#06x} is not read, only 0x0100 (save -v6 or -v7)", version));
  return big_endian;
}

}  // namespace

void check_mat_frame(std::string_view bytes) {
  const bool big_endian = check_heading(bytes);
  int number = 1;
  std::size_t left = most_inflated;
  for (std::size_t at = heading_bytes; at < bytes.size(); ++number) {
    if (bytes.size() - at < tag_bytes)
      throw BadFile(fmt::format("the file ends in its {}. variable; it is cut off", number));
    const std::uint32_t type = word(bytes, at, big_endian), size = word(bytes, at + 4, big_endian);
    if (type != matrix_type && type != compressed_type)
      throw BadFile(fmt::format(
          "at byte {}, where its {}. variable should begin, is none: the file is damaged", at, number));
    if (size > bytes.size() - at - tag_bytes)
      throw BadFile(
          fmt::format("its {}. variable should have {} bytes and has {}: the file is damaged or cut off",
                      number, size, bytes.size() - at - tag_bytes));
    try {
      check_variable(type, bytes.substr(at + tag_bytes, size), big_endian, left);
    } catch (const BadFile& bad) {
      throw BadFile(fmt::format("its {}. variable: {}", number, bad.what()));
    }
    at += tag_bytes + size;
  }
  if (number == 1) throw BadFile("there are no variables in it");
}

}  // namespace mckibben::formats
