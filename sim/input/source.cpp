// Loading and addressing of text; see the header.
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include <sim/input/folders.hpp>
#include <sim/input/hash.hpp>
#include <sim/input/source.hpp>
#include <sim/input/utf8.hpp>

namespace mckibben::input {
namespace {

constexpr std::size_t longest_path = 400;      // that is shown
constexpr std::size_t most_lines = 1U << 24U;  // that are told apart; no reader takes as many

}  // namespace

Source::Source(std::string name, std::string text, std::filesystem::path folder)
    : name_(std::move(name)), text_(std::move(text)), sha256_(sha256_hex(text_)), folder_(std::move(folder)) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
  find_lines();
}

Source::Source(std::string name, std::string text, std::filesystem::path folder, std::string sha256,
               Thinned thinned)
    : name_(std::move(name)),
      text_(std::move(text)),
      sha256_(std::move(sha256)),
      folder_(std::move(folder)),
      thinned_(std::move(thinned)) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
  find_lines();
}

void Source::find_lines() {
  starts_.assign(1, 0);
  for (std::size_t at = text_.find('\n'); at != std::string::npos && at + 1 < text_.size();
       at = text_.find('\n', at + 1)) {
    if (starts_.size() == most_lines) return;
    starts_.push_back(at + 1);
  }
}

Source Source::load(const std::filesystem::path& path, std::size_t largest_bytes) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw MissingInput(path.string() + ": is a folder, not a file" + what_to_give(path));
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw MissingInput(shortened(path.string(), longest_path) +
                       ": cannot be opened: " + std::strerror(errno));
  std::string text;
  const auto bytes = std::filesystem::file_size(path, ignored);
  if (!ignored) text.reserve(std::min<std::size_t>(bytes, largest_bytes) + 1);
  char block[1 << 16];
  while (text.size() <= largest_bytes && stream) {
    stream.read(block, sizeof block);
    text.append(block, static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) throw MissingInput(path.string() + ": cannot be read");
  text.resize(std::min(text.size(), largest_bytes + 1));
  return {path.string(), std::move(text), path.parent_path()};
}

std::string_view Source::line(std::size_t number) const {
  if (number < 1 || number > starts_.size()) return {};
  const std::size_t start = starts_[number - 1];
  const std::size_t end = number < starts_.size() ? starts_[number] : text_.size();
  std::string_view line = std::string_view(text_).substr(start, end - start);
  if (line.ends_with('\n')) line.remove_suffix(1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

Place Source::place(std::size_t number, std::size_t offset) const {
  const std::string_view before = line(number).substr(0, std::min(offset, line(number).size()));
  const auto characters =
      std::count_if(before.begin(), before.end(), [](char c) { return !is_utf8_continuation(c); });
  return {number, static_cast<std::size_t>(characters) + 1};
}

void Source::replace_text(std::string text) {
  text_ = std::move(text);
  find_lines();
}

void Source::reread_as_latin1() {
  std::string utf8;
  utf8.reserve(text_.size() + static_cast<std::size_t>(std::count_if(
                                  text_.begin(), text_.end(), [](char c) { return (c & 0x80) != 0; })));
  for (const char c : text_) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80) utf8 += static_cast<char>(0xC0U | byte >> 6U);
    utf8 += byte >= 0x80 ? static_cast<char>(0x80U | (byte & 0x3FU)) : c;
  }
  replace_text(std::move(utf8));
}

std::optional<Place> Source::first_bad_byte() const {
  std::string_view rest = text_;
  while (!rest.empty()) {
    const std::size_t length = utf8_length(rest);
    if (length == 0) {
      const std::size_t offset = text_.size() - rest.size();
      const auto after = std::upper_bound(starts_.begin(), starts_.end(), offset);
      return place(static_cast<std::size_t>(after - starts_.begin()), offset - *std::prev(after));
    }
    rest.remove_prefix(length);
  }
  return std::nullopt;
}

}  // namespace mckibben::input
