// A zip archive of XML: workbook, shared texts, styles (which tell dates), sheets; see sheet.hpp.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <pugixml.hpp>
#include <zip.h>

#include <sim/formats/sheet.hpp>
#include <sim/formats/sheet_text.hpp>
#include <sim/formats/table.hpp>

namespace mckibben::formats {
namespace {

constexpr zip_uint64_t most_part_bytes = 96U << 20U;  // its tree takes some ten times as much

struct CloseZip {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};

class Archive {
 public:
  explicit Archive(std::string_view bytes) {
    zip_error_t error{};
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (source == nullptr) throw BadFile("there is no memory to read it");
    archive_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
    if (!archive_) {
      zip_source_free(source);
      throw BadFile("this looks like a zip archive, and it is damaged");
    }
  }

  /// The part of that name, as XML; none if there is none.
  std::optional<pugi::xml_document> part(const std::string& name) const {
    zip_stat_t about{};
    if (zip_stat(archive_.get(), name.c_str(), 0, &about) != 0) return std::nullopt;
    if (about.size > most_part_bytes)
      throw BadFile(
          fmt::format("{} is larger than {} MB; save the sheet as CSV", name, most_part_bytes >> 20U));
    std::string text(about.size, '\0');
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen(archive_.get(), name.c_str(), 0),
                                                                 zip_fclose);
    if (!file || zip_fread(file.get(), text.data(), text.size()) != static_cast<zip_int64_t>(text.size()))
      throw BadFile(fmt::format("{} cannot be unpacked: the file is damaged, or has a password", name));
    std::optional<pugi::xml_document> document(std::in_place);
    constexpr unsigned options = pugi::parse_default | pugi::parse_ws_pcdata_single;
    if (!document->load_buffer(text.data(), text.size(), options))
      throw BadFile(fmt::format("{} is no XML: the file is damaged", name));
    return document;
  }

 private:
  std::unique_ptr<zip_t, CloseZip> archive_;
};

/// Names without their namespace: some writers use one.
bool is(const pugi::xml_node& node, std::string_view name) {
  const std::string_view full = node.name();
  const std::size_t colon = full.find(':');
  return (colon == std::string_view::npos ? full : full.substr(colon + 1)) == name;
}
pugi::xml_node child(const pugi::xml_node& of, std::string_view name) {
  for (const pugi::xml_node& node : of.children())
    if (is(node, name)) return node;
  return {};
}

/// All text inside, and in its runs of one font, but for how it is pronounced.
void append_text(const pugi::xml_node& node, std::string& text) {
  for (const pugi::xml_node& inside : node.children()) {
    if (is(inside, "t")) text += inside.text().get();
    if (is(inside, "r")) text += child(inside, "t").text().get();
  }
}

/// Whether a format of numbers shows a date or a time: y, d, h or s outside of quotes and brackets.
bool shows_a_date(std::string_view code) {
  bool quoted = false, bracketed = false;
  for (std::size_t i = 0; i < code.size(); ++i) {
    const char c = code[i];
    if (c == '"') quoted = !quoted;
    if (c == '[') bracketed = true;
    if (c == ']') bracketed = false;
    if (c == '\\') ++i;
    if (!quoted && !bracketed && std::strchr("ydhsYDHS", c) != nullptr) return true;
  }
  return false;
}

/// Which styles of cells show dates.
std::vector<bool> dates_of(const Archive& archive) {
  std::vector<bool> dates;
  const auto styles = archive.part("xl/styles.xml");
  if (!styles) return dates;
  const pugi::xml_node root = styles->document_element();
  std::map<int, bool> own;
  for (const pugi::xml_node& format : child(root, "numFmts").children())
    own[format.attribute("numFmtId").as_int()] = shows_a_date(format.attribute("formatCode").as_string());
  for (const pugi::xml_node& style : child(root, "cellXfs").children()) {
    const int id = style.attribute("numFmtId").as_int();
    const bool usual = (id >= 14 && id <= 22) || (id >= 45 && id <= 47);
    dates.push_back(own.contains(id) ? own[id] : usual);
  }
  return dates;
}

std::vector<std::string> shared_texts(const Archive& archive) {
  std::vector<std::string> texts;
  const auto part = archive.part("xl/sharedStrings.xml");
  if (!part) return texts;
  for (const pugi::xml_node& item : part->document_element().children()) {
    texts.emplace_back();
    append_text(item, texts.back());
  }
  return texts;
}

struct Context {
  std::vector<std::string> texts;
  std::vector<bool> dates;
  bool from_1904;
};

/// What a cell shows; whether it is a number.
std::pair<std::string, bool> shown(const pugi::xml_node& cell, const Context& context) {
  const std::string_view type = cell.attribute("t").as_string("n");
  const std::string value = child(cell, "v").text().get();
  if (type == "s") {
    std::size_t index = context.texts.size();
    std::from_chars(value.data(), value.data() + value.size(), index);
    return {index < context.texts.size() ? context.texts[index] : "", false};
  }
  if (type == "inlineStr") {
    std::string text;
    append_text(child(cell, "is"), text);
    return {text, false};
  }
  if (type != "n" || value.empty()) return {value, false};
  const auto style = cell.attribute("s").as_uint();
  const bool is_date = style < context.dates.size() && context.dates[style];
  if (!is_date) return {value, true};
  constexpr double days_from_1900_to_1904 = 1462.0;
  double days = std::nan("");
  std::from_chars(value.data(), value.data() + value.size(), days);
  return {date_of_serial(days + (context.from_1904 ? days_from_1900_to_1904 : 0.0)), true};
}

/// "BC12" is column 54, from 0; none without letters.
std::optional<std::size_t> column_of(std::string_view reference) {
  std::size_t column = 0, letters = 0;
  for (; letters < reference.size() && reference[letters] >= 'A' && reference[letters] <= 'Z' && letters < 3;
       ++letters)
    column = column * 26 + static_cast<std::size_t>(reference[letters] - 'A') + 1;
  if (letters == 0) return std::nullopt;
  return column - 1;
}

void read_sheet(const pugi::xml_node& root, const Context& context, Sheet& sheet) {
  SheetText text;
  for (const pugi::xml_node& row : child(root, "sheetData").children()) {
    text.begin_row(row.attribute("r").as_ullong(0));
    for (const pugi::xml_node& cell : row.children()) {
      if (!is(cell, "c")) continue;
      const auto [value, number] = shown(cell, context);
      text.add(column_of(cell.attribute("r").as_string()), value);
      sheet.numbers += number ? 1 : 0;
    }
  }
  sheet.text = text.take();
}

}  // namespace

std::vector<Sheet> sheets_of_xlsx(std::string_view bytes) {
  constexpr std::string_view visible = "visible";
  const Archive archive(bytes);
  const auto workbook = archive.part("xl/workbook.xml");
  if (!workbook) throw BadFile("this is a zip archive and no .xlsx: unpack it, or save the sheet as CSV");
  std::map<std::string, std::string> targets;
  if (const auto relations = archive.part("xl/_rels/workbook.xml.rels"))
    for (const pugi::xml_node& each : relations->document_element().children())
      targets[each.attribute("Id").as_string()] = each.attribute("Target").as_string();
  const pugi::xml_node root = workbook->document_element();
  const Context context{shared_texts(archive), dates_of(archive),
                        child(root, "workbookPr").attribute("date1904").as_bool()};
  std::vector<Sheet> sheets;
  for (const pugi::xml_node& each : child(root, "sheets").children()) {
    std::string target;
    for (const pugi::xml_attribute& attribute : each.attributes())
      if (std::string_view(attribute.name()).ends_with("id") && targets.contains(attribute.as_string()))
        target = targets[attribute.as_string()];
    if (target.empty()) continue;
    const std::string name = target.starts_with('/') ? target.substr(1) : "xl/" + target;
    const auto part = archive.part(name);
    Sheet sheet{each.attribute("name").as_string(), "", 0,
                each.attribute("state").as_string("visible") != visible};
    if (part) read_sheet(part->document_element(), context, sheet);
    sheets.push_back(std::move(sheet));
  }
  return sheets;
}

}  // namespace mckibben::formats
