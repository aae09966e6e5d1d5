// Damages texts and bytes by chance, from a seed, so that a failure can be repeated.
#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace mckibben {

class Mutator {
 public:
  explicit Mutator(unsigned seed) : chance_(seed) {}

  /// A text with lines and characters deleted, repeated, moved, replaced.
  std::string mutated(const std::string& text) {
    const std::string result = pick(2) == 0 ? mutated_line(text) : mutated_character(text);
    return pick(3) == 0 ? mutated(result) : result;
  }

  /// Bytes overwritten, cut off, repeated.
  std::string mangled(std::string bytes) {
    if (bytes.empty()) return bytes;
    const std::size_t at = pick(bytes.size()), count = std::min(bytes.size() - at, pick(16) + 1);
    switch (pick(4)) {
      case 0:
        bytes[at] = static_cast<char>(pick(256));
        break;
      case 1:
        bytes.replace(at, count, count, pick(2) == 0 ? '\xFF' : '\x7F');
        break;
      case 2:
        bytes.resize(at);
        break;
      default:
        bytes.insert(at, bytes.substr(pick(bytes.size()), count));
        break;
    }
    return pick(2) == 0 ? mangled(bytes) : bytes;
  }

 private:
  std::size_t pick(std::size_t count) { return chance_() % count; }

  static std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t start = 0; start < text.size();) {
      const std::size_t end = std::min(text.find('\n', start), text.size());
      lines.push_back(text.substr(start, end - start));
      start = end + 1;
    }
    return lines;
  }

  std::string mutated_line(const std::string& text) {
    std::vector<std::string> lines = lines_of(text);
    if (lines.empty()) return text;
    const std::size_t at = pick(lines.size()), other = pick(lines.size());
    const auto here = lines.begin() + static_cast<std::ptrdiff_t>(at);
    switch (pick(4)) {
      case 0:
        lines.erase(here);
        break;
      case 1:
        lines.insert(here, std::string(lines[other]));
        break;
      case 2:
        lines[at] = lines[other];
        break;
      default:
        lines[at] = "  " + lines[at];
        break;
    }
    std::string result;
    for (const std::string& line : lines) result += line + '\n';
    return result;
  }

  std::string mutated_character(std::string text) {
    static const std::string alphabet = "{}[]:,-#&*!|>'\"%@`\t\n 0e.+~?\\a\xC3\xFF";
    if (text.empty()) return text;
    const std::size_t at = pick(text.size());
    switch (pick(3)) {
      case 0:
        text.erase(at, 1);
        break;
      case 1:
        text.insert(at, 1, alphabet[pick(alphabet.size())]);
        break;
      default:
        text[at] = alphabet[pick(alphabet.size())];
        break;
    }
    return text;
  }

  std::mt19937 chance_;
};

}  // namespace mckibben
