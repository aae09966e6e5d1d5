// The text of one input file, kept whole so that a problem can show the line it is in. A UTF-8 byte order
// mark is dropped and lines may end in LF or CRLF.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mckibben::input {

/// A position in a text; both count from 1, the column counts characters.
struct Place {
  std::size_t line = 1;
  std::size_t column = 1;
};

/// The place of what stands in no line: in a file that is no text.
inline constexpr Place nowhere{0, 0};

/// A file that cannot be opened (exit status 66). `what()` says which and why.
class MissingInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

constexpr bool is_utf8_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// Which lines of a file are kept.
struct Thinned {
  std::size_t step = 1;  ///< every so many-th; 1: all
  std::size_t lines = 0;
  std::vector<std::size_t> numbers{};  ///< of those that are kept; none: all
};

class Source {
 public:
  /// `name` is what messages show; `folder` is where relative paths inside the text start.
  Source(std::string name, std::string text, std::filesystem::path folder);
  /// Of some of a file's lines; the digest is of all.
  Source(std::string name, std::string text, std::filesystem::path folder, std::string sha256,
         Thinned thinned);
  /// Reads a file; at most one byte more than `largest_bytes`,
  /// so that the caller sees it is too large. Throws MissingInput.
  static Source load(const std::filesystem::path& path, std::size_t largest_bytes);

  const std::string& name() const { return name_; }
  const std::string& text() const { return text_; }
  /// Digest of the bytes as they were read.
  const std::string& sha256() const { return sha256_; }
  const std::filesystem::path& folder() const { return folder_; }
  std::size_t lines() const { return starts_.size(); }
  /// Line `number` (from 1) without its line end; empty when there is no such line.
  std::string_view line(std::size_t number) const;
  const Thinned& thinned() const { return thinned_; }
  /// That line's number in the file.
  std::size_t line_in_file(std::size_t number) const {
    return number > 0 && number <= thinned_.numbers.size() ? thinned_.numbers[number - 1] : number;
  }
  /// The place of byte `offset` of line `number`.
  Place place(std::size_t number, std::size_t offset) const;
  /// Place of the first byte that is NUL or not UTF-8, if any.
  std::optional<Place> first_bad_byte() const;
  /// What its bytes say in UTF-8, where they are in another form; the digest stays theirs.
  void replace_text(std::string text);
  /// Takes the bytes for Latin-1, as Windows programs write, not for UTF-8.
  void reread_as_latin1();

 private:
  void find_lines();

  std::string name_, text_, sha256_;
  std::filesystem::path folder_;
  std::vector<std::size_t> starts_;
  Thinned thinned_;
};

}  // namespace mckibben::input
