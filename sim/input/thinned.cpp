// Two passes: how many lines there are, then which are kept; see the header.
#include <algorithm>
#include <cctype>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sim/input/hash.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/thinned.hpp>

namespace mckibben::input {
namespace {

constexpr std::size_t least_bytes = 1U << 24U, most_kept_bytes = 1U << 26U, most_kept = 1'000'000;
constexpr std::size_t whole_lines = 3000, most_of_words = 10'000, block_bytes = 1U << 20U;

/// Blocks of a file, until `use` returns false.
void each_block(const std::filesystem::path& path, const auto& use) {
  std::ifstream stream(path, std::ios::binary);
  std::vector<char> block(block_bytes);
  while (stream) {
    stream.read(block.data(), static_cast<std::streamsize>(block.size()));
    if (!use(std::string_view(block.data(), static_cast<std::size_t>(stream.gcount())))) return;
  }
}

bool begins_with_word(std::string_view line) {
  const std::size_t at = line.find_first_not_of(" \t\"");
  return at != std::string_view::npos &&
         (std::isalpha(static_cast<unsigned char>(line[at])) != 0 || line[at] == '#' || line[at] == '%');
}

/// Where sensors take turns from line to line, a prime step keeps lines of each.
std::size_t next_prime(std::size_t number) {
  const auto divides = [&](std::size_t by) { return number % by == 0; };
  for (;; ++number) {
    bool prime = number > 1;
    for (std::size_t by = 2; by * by <= number && prime; ++by) prime = !divides(by);
    if (prime) return number;
  }
}

/// Which lines are kept, as they come.
class Keeping {
 public:
  explicit Keeping(std::size_t step) { kept_.step = step; }

  void line(std::string_view line) {
    const std::size_t number = kept_.lines++;
    const bool of_words = begins_with_word(line) && of_words_ < most_of_words;
    if (number >= whole_lines && number % kept_.step != 0 && !of_words) return;
    of_words_ += number >= whole_lines && of_words ? 1 : 0;
    kept_.numbers.push_back(number + 1);
    text_.append(line);
  }
  Source source(const std::filesystem::path& path, const std::string& sha256) && {
    return {path.string(), std::move(text_), path.parent_path(), sha256, std::move(kept_)};
  }

 private:
  Thinned kept_;
  std::size_t of_words_ = 0;
  std::string text_;
};

}  // namespace

std::uintmax_t bytes_of(std::set<std::filesystem::path> files) {
  std::uintmax_t all = 0;
  for (const std::filesystem::path& file : files) {
    std::error_code failed;
    const auto bytes = std::filesystem::file_size(file, failed);
    all += failed ? 0 : bytes;
  }
  return all;
}

std::optional<Source> load_thinned(const std::filesystem::path& path, std::uintmax_t together) {
  std::error_code failed;
  const auto bytes = std::filesystem::file_size(path, failed);
  if (failed || std::max(bytes, together) < least_bytes) return std::nullopt;
  const double share = static_cast<double>(bytes) / static_cast<double>(std::max(bytes, together));
  const auto of = [share](std::size_t limit) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(share * static_cast<double>(limit)));
  };
  std::size_t lines = 0;
  bool text = true;
  each_block(path, [&](std::string_view block) {
    text = text && (lines > 0 || block.find('\0') == std::string_view::npos);
    lines += static_cast<std::size_t>(std::ranges::count(block, '\n'));
    return text;
  });
  if (!text || lines < whole_lines || (bytes <= of(most_text_bytes) && lines <= of(most_rows)))
    return std::nullopt;
  Keeping keeping(
      next_prime(1 + std::max(static_cast<std::size_t>(bytes) / of(most_kept_bytes), lines / of(most_kept))));
  Sha256 digest;
  std::string rest;
  bool short_lines = true;
  each_block(path, [&](std::string_view block) {
    digest.add(block);
    while (short_lines) {
      const std::size_t end = block.find('\n');
      rest.append(block.substr(0, end == std::string_view::npos ? end : end + 1));
      short_lines = rest.size() <= longest_line_bytes;
      if (end == std::string_view::npos) break;
      keeping.line(std::exchange(rest, ""));
      block.remove_prefix(end + 1);
    }
    return short_lines;
  });
  if (!short_lines) return std::nullopt;
  if (!rest.empty()) keeping.line(rest);
  return std::move(keeping).source(path, digest.hex());
}

}  // namespace mckibben::input
