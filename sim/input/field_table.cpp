// Field lists as Markdown; see the header.
#include <cctype>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/input/field_list.hpp>

namespace mckibben::input {
namespace {

std::string default_text(const FieldInfo& info, const std::string& kind) {
  if (info.required || info.default_value.is_null()) return "";
  const std::string value =
      info.default_value.is_string() ? info.default_value.get<std::string>() : info.default_value.dump();
  if (value.empty()) return "";
  return "default " + (!kind.empty() && value == kind ? "the kind" : value);
}

/// `0 to 20 mA`, the unit once if both ends have the same.
std::string from_to(std::string lowest, const std::string& highest) {
  const std::size_t unit = highest.find(' ');
  if (unit != std::string::npos && lowest.ends_with(highest.substr(unit)))
    lowest.resize(lowest.size() - (highest.size() - unit));
  return fmt::format("{} to {}", lowest, highest);
}

std::string range_text(const FieldInfo& info) {
  switch (info.type) {
    case FieldInfo::Type::quantity:
      return from_to(show_limit(info.lowest.get<double>(), info.unit),
                     show_limit(info.highest.get<double>(), info.unit));
    case FieldInfo::Type::integer:
      return from_to(info.lowest.dump(), info.highest.dump());
    case FieldInfo::Type::choice:
      return fmt::format("{}", fmt::join(info.choices, ", "));
    case FieldInfo::Type::height:
      return "ratio or length";
    case FieldInfo::Type::draws:
      return "normal M ± D or uniform L .. H";
    case FieldInfo::Type::laws:
      return "each a file, or its contents";
    case FieldInfo::Type::named:
      return "for each name";
    case FieldInfo::Type::boolean:
      return info.default_value.is_null() ? "true, false" : "";
    case FieldInfo::Type::text:
    case FieldInfo::Type::structure:
    case FieldInfo::Type::variant:
      return "";
  }
  return "";
}

/// All that the lines of these fields say, whatever their titles.
std::string all_of(const std::vector<FieldInfo>& fields, const std::string& kind) {
  std::string text;
  for (const FieldInfo& info : fields) {
    text += fmt::format("{} {} {} {} {} {}\n", info.key, info.required, default_text(info, kind),
                        info.is_list, range_text(info), info.meaning);
    for (const FieldInfo::Group& group : info.groups) text += group.kind + '\n' + all_of(group.fields, "");
  }
  return text;
}

std::string link_to(const std::string& words, const std::string& title) {
  std::string anchor;  // as Markdown makes it of a title
  for (const char c : title)
    if (c != ':') anchor += c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return fmt::format("[{}](#{})", words, anchor);
}

/// The sections of all kinds of files; what one has shown, another refers to.
class Sections {
 public:
  std::string operator()(const std::string& title, const std::vector<FieldInfo>& fields) {
    return section("##", title, "", fields);
  }

 private:
  std::string section(const char* level, const std::string& title, const std::string& kind,
                      const std::vector<FieldInfo>& fields) {
    std::string below;
    const std::string text = lines(title, kind, fields, 0, below);
    return fmt::format("{} {}\n\n{}{}", level, title, text, below);
  }

  std::string lines(const std::string& title, const std::string& kind, const std::vector<FieldInfo>& fields,
                    std::size_t indent, std::string& below) {
    std::string text;
    std::map<std::string, std::string> elsewhere;  // keys by the section that has the same
    for (const FieldInfo& info : fields) {
      if (indent == 0) {
        const std::string& shown = fields_.try_emplace(all_of({info}, kind), title).first->second;
        if (shown != title) {
          std::string& keys = elsewhere[shown];
          keys += fmt::format("{}`{}`", keys.empty() ? "" : ", ", info.key);
          continue;
        }
      }
      text += fmt::format("{:{}}- `{}`", "", indent, info.key);
      std::string inside;
      std::vector<std::string> notes;
      if (info.required) notes.emplace_back("required");
      const std::string range = info.type == FieldInfo::Type::structure
                                    ? structure(title, info, indent, inside, below)
                                    : kinds(title, info, below);
      if (info.is_list)
        notes.push_back(range.empty() ? "list" : "list of " + range);
      else if (!range.empty())
        notes.push_back(range);
      if (const std::string usual = default_text(info, kind); !usual.empty()) notes.push_back(usual);
      if (info.type == FieldInfo::Type::named && !info.groups.empty())
        inside = lines(title, "", info.groups.front().fields, indent + indented, below);
      text += fmt::format("{}: {}\n{}", notes.empty() ? "" : fmt::format(" ({})", fmt::join(notes, "; ")),
                          info.meaning, inside);
    }
    for (const auto& [shown, keys] : elsewhere)
      text += fmt::format("- {}: as in {}\n", keys, link_to(shown, shown));
    return text + (indent == 0 ? "\n" : "");
  }

  /// Where the keys of a struct are: in lines below its own, or in an earlier section.
  std::string structure(const std::string& title, const FieldInfo& info, std::size_t indent,
                        std::string& inside, std::string& below) {
    if (info.by_name) return link_to("Rig", "Rig");
    const std::vector<FieldInfo>& fields = info.groups.front().fields;
    const auto [place, is_new] = structures_.try_emplace(all_of(fields, ""), Shown{title, info.key});
    const Shown& shown = place->second;
    if (!is_new && shown.title != title) return "keys as in " + link_to(shown.title, shown.title);
    if (!is_new) return fmt::format("keys as of `{}`", shown.key);
    inside = lines(title, "", fields, indent + indented, below);
    return "";
  }

  /// The kinds of a variant, each with its section; the range of any other field.
  std::string kinds(const std::string& title, const FieldInfo& info, std::string& below) {
    if (info.type != FieldInfo::Type::variant) return range_text(info);
    std::vector<std::string> names;
    for (const FieldInfo::Group& group : info.groups) {
      const std::string own = fmt::format("{}: {} {}", title, info.key, group.kind);
      const auto [place, is_new] =
          structures_.try_emplace(group.kind + '\n' + all_of(group.fields, ""), Shown{own, info.key});
      if (is_new && !group.fields.empty()) below += section("###", own, group.kind, group.fields);
      names.push_back(group.fields.empty() ? group.kind : link_to(group.kind, place->second.title));
    }
    return fmt::format("kind {}", fmt::join(names, ", "));
  }

  /// Where the lines of a struct stand: in a section, below a key.
  struct Shown {
    std::string title, key;
  };

  static constexpr std::size_t indented = 4;   ///< blanks before the lines of a struct
  std::map<std::string, std::string> fields_;  ///< titles by what a line says
  std::map<std::string, Shown> structures_;    ///< by what the lines of a struct say
};

}  // namespace

std::string field_lists(const std::vector<KindOfFile>& kinds) {
  Sections sections;
  std::string text;
  for (const KindOfFile& kind : kinds) text += sections(kind.title, kind.fields);
  return text;
}

}  // namespace mckibben::input
