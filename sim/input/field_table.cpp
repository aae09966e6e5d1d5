// Field lists to Markdown; see the header.
#include <cctype>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sim/input/field_list.hpp>

namespace mckibben::input {
namespace {

std::string default_text(const FieldInfo& info) {
  if (info.required) return "required";
  if (info.default_value.is_null()) return "";
  return info.default_value.is_string() ? info.default_value.get<std::string>() : info.default_value.dump();
}

std::string range_text(const FieldInfo& info) {
  switch (info.type) {
    case FieldInfo::Type::quantity:
      return fmt::format("{} to {}", show_limit(info.lowest.get<double>(), info.unit),
                         show_limit(info.highest.get<double>(), info.unit));
    case FieldInfo::Type::integer:
      return fmt::format("{} to {}", info.lowest.dump(), info.highest.dump());
    case FieldInfo::Type::choice:
      return fmt::format("{}", fmt::join(info.choices, ", "));
    case FieldInfo::Type::boolean:
      return "true, false";
    case FieldInfo::Type::height:
      return "ratio or length";
    case FieldInfo::Type::draws:
      return "normal M ± D or uniform L .. H";
    case FieldInfo::Type::text:
      return "text";
    case FieldInfo::Type::laws:
      return "list; each a file, or its contents";
    case FieldInfo::Type::named:
      return info.groups.empty() ? "for each name a text" : "for each name: see below";
    case FieldInfo::Type::structure:
      return "";
    case FieldInfo::Type::variant:
      break;
  }
  std::vector<std::string> kinds;
  for (const FieldInfo::Group& group : info.groups) kinds.push_back(group.kind);
  return fmt::format("kind: {}", fmt::join(kinds, ", "));
}

/// All that tables of these fields say, whatever their titles.
std::string all_of(const std::vector<FieldInfo>& fields) {
  std::string text;
  for (const FieldInfo& info : fields) {
    text += fmt::format("{} {} {} {} {} {}\n", info.key, info.unit, default_text(info), info.is_list,
                        range_text(info), info.meaning);
    for (const FieldInfo::Group& group : info.groups) text += all_of(group.fields);
  }
  return text;
}

/// The anchor that Markdown gives a title.
std::string link_to(const std::string& title) {
  std::string anchor;
  for (const char c : title)
    if (c != ':') anchor += c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return fmt::format("[{}](#{})", title, anchor);
}

/// The tables of one kind of file; what one has shown, another refers to.
class Tables {
 public:
  std::string operator()(const std::string& title, const std::vector<FieldInfo>& fields) {
    std::string text = fmt::format("## {}\n\n", title);
    if (fields.empty()) return text + "No further keys.\n";
    if (const std::string& earlier = shown_.try_emplace(all_of(fields), title).first->second;
        earlier != title)
      return text + fmt::format("The keys of {}.\n", link_to(earlier));
    text += "| key | unit | default | range | meaning |\n|---|---|---|---|---|\n";
    std::string below;
    for (const FieldInfo& info : fields) {
      const std::string inside = fmt::format("{}: {}", title, info.key);
      std::string range = range_text(info);
      if (info.type == FieldInfo::Type::structure) {
        const std::string place = info.by_name ? "Rig" : place_of(info, inside);
        range = place == inside ? "see below" : "see " + link_to(place);
        if (place == inside) below += '\n' + (*this)(inside, info.groups.front().fields);
      }
      if (info.type == FieldInfo::Type::named && !info.groups.empty())
        below += '\n' + (*this)(inside, info.groups.front().fields);
      for (const FieldInfo::Group& group : info.groups)
        if (!group.kind.empty())
          below += '\n' + (*this)(fmt::format("{} of kind {}", inside, group.kind), group.fields);
      text += fmt::format("| `{}` | {} | {} | {}{} | {} |\n", info.key, info.unit == "1" ? "" : info.unit,
                          default_text(info), info.is_list ? "list; each " : "", range, info.meaning);
    }
    return text + below;
  }

 private:
  /// The title of the table that has this struct's fields, or will have them.
  std::string place_of(const FieldInfo& info, const std::string& title) {
    const auto found = shown_.find(all_of(info.groups.front().fields));
    return found == shown_.end() ? title : found->second;
  }

  std::map<std::string, std::string> shown_;  ///< titles by what stands in the tables
};

}  // namespace

std::string field_table(const std::string& title, const std::vector<FieldInfo>& fields) {
  return Tables()(title, fields);
}

}  // namespace mckibben::input
