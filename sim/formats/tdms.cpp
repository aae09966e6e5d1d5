// National Instruments' TDMS, after "TDMS File Format Internal Structure": segments, each with a list of
// objects and their values; see sheet.hpp. No library of Debian reads it; every size is compared with what is
// there.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>

#include <fmt/format.h>

#include <sim/formats/sheet.hpp>
#include <sim/formats/table.hpp>
#include <sim/formats/tdms_scales.hpp>

namespace mckibben::formats {
namespace {

constexpr std::size_t lead_in_bytes = 28, most_objects = 10000, most_values = 1U << 24U,
                      most_cells = 1U << 27U;  // of a group: short channels have empty ones
constexpr std::uint32_t has_metadata = 1U << 1U, new_list = 1U << 2U, has_values = 1U << 3U,
                        interleaved = 1U << 5U, big = 1U << 6U, daqmx = 1U << 7U;
constexpr std::uint32_t type_text = 0x20, type_bool = 0x21, type_stamp = 0x44;

[[noreturn]] void cut_off() {
  throw BadFile("its sizes and contents do not agree: the file is damaged or cut off");
}

/// Whole seconds since 1904 and a part of one in 2^-64 s: a difference keeps its digits. 0: it is not set.
struct Stamp {
  std::int64_t second = 0;
  std::uint64_t part = 0;
  auto operator<=>(const Stamp&) const = default;
  double since(const Stamp& other) const {
    return static_cast<double>(second) - static_cast<double>(other.second) +
           0x1p-64 * (static_cast<double>(part) - static_cast<double>(other.part));
  }
};

/// Bytes from front to back.
class Bytes {
 public:
  Bytes(std::string_view rest, bool big_endian) : rest_(rest), big_endian_(big_endian) {}

  std::string_view take(std::uint64_t count) {
    if (count > rest_.size()) cut_off();
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  template <class T>
  T number() {
    std::array<char, sizeof(T)> own{};
    take(sizeof(T)).copy(own.data(), sizeof(T));
    if (big_endian_ != (std::endian::native == std::endian::big)) std::reverse(own.begin(), own.end());
    return std::bit_cast<T>(own);
  }
  std::string text() { return std::string(take(number<std::uint32_t>())); }
  std::size_t size() const { return rest_.size(); }

  Stamp stamp() {
    const auto before = big_endian_ ? 0 : number<std::uint64_t>();
    const auto second = number<std::int64_t>();
    return {second, big_endian_ ? number<std::uint64_t>() : before};
  }

  /// A value of that type as a number; of a time in seconds since 1970.
  double value(std::uint32_t type) {
    switch (type) {
      case 1:
        return number<std::int8_t>();
      case 2:
        return number<std::int16_t>();
      case 3:
        return number<std::int32_t>();
      case 4:
        return static_cast<double>(number<std::int64_t>());
      case 5:
      case type_bool:
        return number<std::uint8_t>();
      case 6:
        return number<std::uint16_t>();
      case 7:
        return number<std::uint32_t>();
      case 8:
        return static_cast<double>(number<std::uint64_t>());
      case 9:
      case 0x19:
        return static_cast<double>(number<float>());
      case 10:
      case 0x1A:
        return number<double>();
      case type_stamp: {
        constexpr std::int64_t from_1904_to_1970_s = 2082844800;
        return stamp().since({from_1904_to_1970_s});
      }
      default:
        throw BadFile(fmt::format("it has values of type {:#x}, which is not read; export it as text", type));
    }
  }

 private:
  std::string_view rest_;
  bool big_endian_;
};

std::size_t bytes_of(std::uint32_t type) {
  constexpr std::array<std::size_t, 11> plain{0, 1, 2, 4, 8, 1, 2, 4, 8, 4, 8};
  if (type < plain.size()) return plain[type];
  if (type == type_stamp) return 16;
  return type == 0x19 ? 4 : type == 0x1A ? 8 : type == type_bool ? 1 : 0;
}

struct Channel {
  std::string group, name;
  std::vector<double> values{};
  Properties properties{};
  Stamp start{};          ///< of its waveform
  double offset_s = 0.0;  ///< of its first value, since the earliest start in its group
  std::uint32_t type = 0;
  std::uint64_t count = 0, bytes = 0;  ///< in a chunk of the segment that is read
  bool is_text() const { return type == type_text; }
  double increment_s() const { return properties.number("wf_increment"); }
};

/// "/'Group'/'Channel'" in its parts, with '' for '.
std::vector<std::string> parts_of_path(std::string_view path) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at < path.size(); ++at) {
    if (path[at] != '\'') continue;
    parts.emplace_back();
    for (++at; at < path.size(); ++at) {
      if (path[at] == '\'' && (at + 1 >= path.size() || path[at + 1] != '\'')) break;
      if (path[at] == '\'') ++at;
      parts.back() += path[at];
    }
  }
  return parts;
}

class Tdms {
 public:
  explicit Tdms(std::string_view bytes) {
    while (!bytes.empty()) {
      if (bytes.size() < lead_in_bytes) cut_off();
      Bytes lead(bytes.substr(0, lead_in_bytes), false);
      if (lead.take(4) != "TDSm") cut_off();
      const auto contents = lead.number<std::uint32_t>();
      Bytes sizes(bytes.substr(8, lead_in_bytes - 8), (contents & big) != 0);
      sizes.number<std::uint32_t>();
      auto next = sizes.number<std::uint64_t>();
      const auto raw = sizes.number<std::uint64_t>();
      bytes.remove_prefix(lead_in_bytes);
      if (next > bytes.size()) {  // the program that wrote it was stopped
        next = bytes.size();
        cut_off_ = true;
      }
      if (raw > next) cut_off();
      if ((contents & daqmx) != 0)
        throw BadFile("it holds raw DAQmx data; export it as text, or save it scaled");
      if ((contents & has_metadata) != 0) metadata({bytes.substr(0, raw), (contents & big) != 0}, contents);
      if ((contents & has_values) != 0)
        values({bytes.substr(raw, next - raw), (contents & big) != 0}, (contents & interleaved) != 0);
      bytes.remove_prefix(next);
    }
    for (Channel& channel : channels_) {
      scale(channel);
      offset(channel);
    }
  }
  const std::vector<Channel>& channels() const { return channels_; }
  bool is_cut_off() const { return cut_off_; }

 private:
  void metadata(Bytes bytes, std::uint32_t contents) {
    if ((contents & new_list) != 0) active_.clear();
    auto objects = bytes.number<std::uint32_t>();
    if (objects > most_objects) cut_off();
    for (; objects > 0; --objects) {
      const std::string path = bytes.text();
      const std::vector<std::string> parts = parts_of_path(path);
      Channel none, *channel = &none;
      std::size_t index = channels_.size();
      if (parts.size() == 2) {
        index = known_.try_emplace(path, channels_.size()).first->second;
        if (index == channels_.size()) channels_.push_back({parts[0], parts[1]});
        channel = &channels_[index];
      }
      const auto length = bytes.number<std::uint32_t>();
      if (length == 0x69120000 || length == 0x6A120000)
        throw BadFile("it holds raw DAQmx data; export it as text, or save it scaled");
      if (length != 0xFFFFFFFF && length != 0) {
        channel->type = bytes.number<std::uint32_t>();
        bytes.number<std::uint32_t>();
        channel->count = bytes.number<std::uint64_t>();
        channel->bytes = channel->is_text() ? bytes.number<std::uint64_t>() : 0;
      }
      if (length != 0xFFFFFFFF && parts.size() == 2 && std::ranges::find(active_, index) == active_.end())
        active_.push_back(index);
      auto properties = bytes.number<std::uint32_t>();
      Properties& said = parts.size() == 2 ? channel->properties : above_[parts.empty() ? "" : parts[0]];
      for (; properties > 0; --properties) property(bytes, said, channel->start);
    }
  }

  static void property(Bytes& bytes, Properties& said, Stamp& start) {
    const std::string name = bytes.text();
    const auto type = bytes.number<std::uint32_t>();
    if (type == type_text)
      said.texts[name] = bytes.text();
    else if (name == "wf_start_time" && type == type_stamp)
      start = bytes.stamp();
    else
      said.numbers[name] = bytes.value(type);
  }

  /// A scale stands at the channel, its group or the file.
  void scale(Channel& channel) {
    for (const Properties* said : {&channel.properties, &above_[channel.group], &above_[""]})
      if (said->numbers.contains("NI_Number_Of_Scales"))
        return apply_scales(*said, channel.name, channel.values);
  }

  void offset(Channel& channel) const {
    channel.offset_s = channel.properties.number("wf_start_offset");
    Stamp first = channel.start;
    if (first == Stamp{}) return;
    for (const Channel& other : channels_)
      if (other.group == channel.group && other.increment_s() > 0.0 && other.start != Stamp{})
        first = std::min(first, other.start);
    channel.offset_s += channel.start.since(first);
  }

  void values(Bytes bytes, bool side_by_side) {
    std::uint64_t chunk = 0;
    for (const std::size_t index : active_) {
      const Channel& channel = channels_[index];
      const std::size_t each = bytes_of(channel.type);
      if (channel.count > most_values || (!channel.is_text() && each == 0 && channel.count > 0)) cut_off();
      chunk += channel.is_text() ? channel.bytes : channel.count * each;
    }
    if (chunk == 0) return;
    while (bytes.size() >= chunk) {
      if (side_by_side) {
        const std::uint64_t rows = channels_[active_.front()].count;
        if (rows == 0) cut_off();
        for (std::uint64_t row = 0; row < rows; ++row)
          for (const std::size_t index : active_) add(bytes, channels_[index]);
        continue;
      }
      for (const std::size_t index : active_) {
        Channel& channel = channels_[index];
        if (channel.is_text())
          bytes.take(channel.bytes);
        else
          for (std::uint64_t k = 0; k < channel.count; ++k) add(bytes, channel);
      }
    }
  }

  static void add(Bytes& bytes, Channel& channel) {
    if (channel.values.size() == most_values) throw BadFile("it has more values than are read");
    channel.values.push_back(bytes.value(channel.type));
  }

  bool cut_off_ = false;
  std::vector<Channel> channels_;
  std::map<std::string, Properties> above_;  ///< of groups, and of the file under ""
  std::vector<std::size_t> active_;          ///< whose values the next segment holds
  std::map<std::string, std::size_t> known_;
};

/// A column of the text.
struct Written {
  std::string name, unit;
  std::size_t rows;
  std::vector<double> values;
  double offset, increment;  ///< of times that the file does not hold
};

Sheet sheet_of(const std::string& group, const std::vector<Written>& columns) {
  Sheet sheet{group, "", 0};
  std::size_t rows = 0;
  for (const Written& column : columns) rows = std::max(rows, column.rows);
  if (rows * columns.size() > most_cells) throw BadFile("it has more values than are read");
  const auto line = [&](const auto& cell) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      std::string text = cell(columns[i]);
      std::ranges::replace_if(
          text, [](unsigned char c) { return c < 0x20; }, ' ');
      sheet.text += (i > 0 ? "\t" : "") + text;
    }
    sheet.text += '\n';
  };
  line([](const Written& column) { return column.name; });
  line([](const Written& column) { return column.unit.empty() ? std::string("-") : column.unit; });
  for (std::size_t row = 0; row < rows; ++row)
    line([&](const Written& column) {
      if (row >= column.rows) return std::string();
      ++sheet.numbers;
      return fmt::format("{}", column.values.empty()
                                   ? column.offset + static_cast<double>(row) * column.increment
                                   : column.values[row]);
    });
  return sheet;
}

}  // namespace

std::vector<Sheet> sheets_of_tdms(std::string_view bytes) {
  const Tdms file(bytes);
  std::vector<std::string> groups;
  for (const Channel& channel : file.channels())
    if (std::ranges::find(groups, channel.group) == groups.end()) groups.push_back(channel.group);
  std::vector<Sheet> sheets;
  for (const std::string& group : groups) {
    std::vector<Written> columns;
    const Channel* clock = nullptr;  // of the last column of times that was written
    for (const Channel& channel : file.channels()) {
      if (channel.group != group || channel.values.empty()) continue;
      const bool same = clock != nullptr && clock->increment_s() == channel.increment_s() &&
                        clock->offset_s == channel.offset_s && clock->values.size() == channel.values.size();
      if (channel.increment_s() > 0.0 && !same) {
        const std::string name = clock == nullptr ? "time" : "time of " + channel.name;
        columns.push_back({name, "s", channel.values.size(), {}, channel.offset_s, channel.increment_s()});
        clock = &channel;
      }
      columns.push_back({channel.name,
                         channel.type == type_stamp ? "s" : channel.properties.text("unit_string"),
                         channel.values.size(), channel.values, 0.0, 0.0});
    }
    if (columns.empty()) continue;
    sheets.push_back(sheet_of(group, columns));
    if (file.is_cut_off())
      sheets.back().text.insert(0, fmt::format("# rows before the file is cut off: {}\n",
                                               std::ranges::max_element(columns, {}, &Written::rows)->rows));
  }
  return sheets;
}

}  // namespace mckibben::formats
