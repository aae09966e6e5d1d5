// By the first bytes; see the header.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <sim/formats/sheet.hpp>
#include <sim/formats/table.hpp>
#include <sim/input/as_columns.hpp>
#include <sim/input/diagnostics.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/readable.hpp>
#include <sim/input/readers.hpp>
#include <sim/input/suggest.hpp>
#include <sim/input/thinned.hpp>

namespace mckibben::input {
namespace {

/// Files that are known and not read: how they begin, what they are, what to do.
struct Unread {
  std::string_view begin, what;
};
constexpr std::string_view html =
    "this is HTML or XML, whatever its ending; open it in a spreadsheet and save it as .xlsx or CSV";
constexpr std::array unread{
    Unread{"PAR1",
           "this is Parquet; write it as CSV: pandas.read_parquet(FILE).to_csv(\"run.csv\", index=False)"},
    Unread{"\x1F\x8B", "this is compressed with gzip; unpack it first: gunzip FILE"},
    Unread{"7z\xBC\xAF", "this is a 7-Zip archive; unpack it first"},
    Unread{"#ROSBAG", "this is a ROS bag; write its topic as text: rostopic echo -b FILE -p TOPIC > run.csv"},
    Unread{"SQLite format 3", "this is an SQLite database (a ROS 2 bag?); write its table or topic as CSV"},
    Unread{"%PDF", "this is a PDF; the table is needed as CSV"},
    Unread{"{\\rtf", "this is RTF; save it as plain text"},
    Unread{"<html", html},
    Unread{"<HTML", html},
    Unread{"<!DOCTYPE", html},
    Unread{"<table", html},
    Unread{"<?xml", html},
};

void append_utf8(std::string& text, unsigned code) {
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += static_cast<char>(0xC0U | code >> 6U);
    text += static_cast<char>(0x80U | (code & 0x3FU));
  } else if (code < 0x10000) {
    text += static_cast<char>(0xE0U | code >> 12U);
    text += static_cast<char>(0x80U | (code >> 6U & 0x3FU));
    text += static_cast<char>(0x80U | (code & 0x3FU));
  } else {
    text += static_cast<char>(0xF0U | code >> 18U);
    text += static_cast<char>(0x80U | (code >> 12U & 0x3FU));
    text += static_cast<char>(0x80U | (code >> 6U & 0x3FU));
    text += static_cast<char>(0x80U | (code & 0x3FU));
  }
}

std::string from_utf16(std::string_view bytes, bool big_endian) {
  std::string text;
  text.reserve(bytes.size() / 2);
  const auto unit = [&](std::size_t at) {
    const auto first = static_cast<unsigned char>(bytes[at]),
               second = static_cast<unsigned char>(bytes[at + 1]);
    return big_endian ? first * 256U + second : second * 256U + first;
  };
  for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
    unsigned code = unit(at);
    if (code >= 0xD800 && code < 0xDC00 && at + 3 < bytes.size()) {
      code = 0x10000 + ((code - 0xD800) << 10U) + (unit(at + 2) - 0xDC00);
      at += 2;
    }
    append_utf8(text, code);
  }
  return text;
}

/// The second of two bytes is NUL in most letters of Latin text.
bool looks_like_utf16(std::string_view bytes, bool big_endian) {
  constexpr std::size_t enough = 8, most = 200;
  const std::size_t size = std::min(bytes.size(), most) & ~std::size_t{1};
  if (size < enough) return false;
  std::size_t nul = 0;
  for (std::size_t at = big_endian ? 0 : 1; at < size; at += 2) nul += bytes[at] == '\0' ? 1 : 0;
  return 10 * nul > 9 * (size / 2);
}

/// Lines that end in CR alone, as old recorders and some terminals write them.
void with_line_feeds(std::string& text) {
  if (text.find('\n') == std::string::npos) {
    std::replace(text.begin(), text.end(), '\r', '\n');
    return;
  }
  std::size_t to = 0;  // and CR CR LF, of terminals that add one
  for (std::size_t at = 0; at < text.size(); ++at)
    if (!(text[at] == '\r' && at + 1 < text.size() && text[at + 1] == '\r')) text[to++] = text[at];
  text.resize(to);
}

[[noreturn]] void refuse(const std::filesystem::path& path, std::string why) {
  throw BadInput({{Severity::error, path.string(), nowhere, std::move(why), ""}});
}

bool is_xlsx(std::string_view bytes) {
  return bytes.starts_with("PK\x03\x04");
}
bool is_tdms(std::string_view bytes) {
  return bytes.starts_with("TDSm");
}
bool has_sheets(std::string_view bytes) {
  return is_xlsx(bytes) || is_tdms(bytes) || bytes.starts_with("\xD0\xCF\x11\xE0");  // the last: .xls
}

/// Those that hold numbers; hidden ones only if they are asked for by name.
std::vector<formats::Sheet> sheets_of(const std::filesystem::path& path, std::string_view bytes,
                                      const std::string& wanted = "") {
  try {
    auto sheets = is_xlsx(bytes)   ? formats::sheets_of_xlsx(bytes)
                  : is_tdms(bytes) ? formats::sheets_of_tdms(bytes)
                                   : formats::sheets_of_xls(path.string());
    constexpr std::size_t few = 4;
    std::erase_if(sheets, [&](const formats::Sheet& sheet) {
      return sheet.numbers < few || (sheet.hidden && sheet.name != wanted);
    });
    if (sheets.empty()) refuse(path, "no sheet of it holds a table of numbers");
    return sheets;
  } catch (const formats::BadFile& bad) {
    refuse(path, bad.what());
  }
}

std::string text_of_sheet(const std::filesystem::path& path, std::string_view bytes,
                          const std::string& wanted) {
  auto sheets = sheets_of(path, bytes, wanted);
  std::vector<std::string_view> names;
  for (const formats::Sheet& sheet : sheets) names.push_back(sheet.name);
  if (wanted.empty() && sheets.size() > 1)
    refuse(path, fmt::format("it has {} sheets with numbers; name the run's: sheet: one of {}", sheets.size(),
                             join_few(names)));
  for (formats::Sheet& sheet : sheets)
    if (wanted.empty() || sheet.name == wanted) return std::move(sheet.text);
  refuse(path, fmt::format("it has no sheet {} with numbers{} (found: {})", wanted,
                           did_you_mean(wanted, names), join_few(names)));
}

/// What is no spreadsheet, as text.
Source as_text(Source source, const std::filesystem::path& path) {
  const std::string_view bytes = source.text();
  for (const Unread& one : unread)
    if (bytes.starts_with(one.begin)) refuse(path, std::string(one.what));
  if (bytes.starts_with("MATLAB ") || path.extension() == ".mat") return source;
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    source.replace_text(from_utf16(bytes.substr(2), bytes.front() == '\xFE'));
  } else if (looks_like_utf16(bytes, false) || looks_like_utf16(bytes, true)) {
    source.replace_text(from_utf16(bytes, looks_like_utf16(bytes, true)));
  }
  if (source.text().find('\r') != std::string::npos) {
    std::string text = source.text();
    with_line_feeds(text);
    if (text != source.text()) source.replace_text(std::move(text));
  }
  if (source.text().find('\0') == std::string::npos && source.first_bad_byte()) source.reread_as_latin1();
  if (format_of(path.string(), source.text()) == Format::text)
    if (auto columns = as_columns(source)) return std::move(*columns);
  return source;
}

Source loaded(const std::filesystem::path& path, std::uintmax_t together) {
  if (auto thinned = load_thinned(path, together)) return std::move(*thinned);
  Source source = Source::load(path, most_text_bytes);
  if (source.text().size() > most_text_bytes)
    refuse(path, fmt::format("larger than {} MB; save parts of it, or as CSV", most_text_bytes >> 20U));
  return source;
}

}  // namespace

std::vector<LoadedSheet> load_tables(const std::filesystem::path& path, std::uintmax_t together) {
  Source source = loaded(path, together);
  if (!has_sheets(source.text())) return {{"", as_text(std::move(source), path)}};
  std::vector<LoadedSheet> all;
  for (formats::Sheet& sheet : sheets_of(path, source.text())) {
    all.push_back({std::move(sheet.name), source});
    all.back().source.replace_text(std::move(sheet.text));
  }
  return all;
}

Source load_table(const std::filesystem::path& path, const std::string& sheet, std::uintmax_t together) {
  Source source = loaded(path, together);
  if (!has_sheets(source.text())) return as_text(std::move(source), path);
  source.replace_text(text_of_sheet(path, source.text(), sheet));
  return source;
}

}  // namespace mckibben::input
