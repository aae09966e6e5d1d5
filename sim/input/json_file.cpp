// Limits and places of JSON; see the header. nlohmann's parser knows no limits, and its own errors do not all
// say where they are, so that the events of a first pass are judged and the tree is built in a second.
#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <sim/input/diagnostics.hpp>
#include <sim/input/json_file.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/utf8.hpp>

namespace mckibben::input {
namespace {

class Judge : public nlohmann::json_sax<Json> {
 public:
  Judge(const Source& source, std::istream& stream) : source_(source), stream_(stream) {}

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool key(string_t&) override { return true; }
  bool start_object(std::size_t) override { return opened(); }
  bool start_array(std::size_t) override { return opened(); }
  bool end_object() override { return closed(); }
  bool end_array() override { return closed(); }

  bool parse_error(std::size_t position, const std::string& token, const Json::exception& error) override {
    constexpr int number_overflow = 406;
    if (error.id == number_overflow)
      refuse(position - token.size(), shortened(token) + " is too large for a number");
    refuse(position == 0 ? 0 : position - 1, "is not JSON from here on; it was changed or cut off");
  }

 private:
  bool value() {
    if (++values_ > most_json_values) refuse(here(), fmt::format("more than {} values", most_json_values));
    return true;
  }
  bool opened() {
    if (++depth_ > deepest_json) refuse(here(), fmt::format("nested deeper than {} levels", deepest_json));
    return value();
  }
  bool closed() {
    --depth_;
    return true;
  }
  std::size_t here() const {
    const auto read = stream_.tellg();
    return read > 0 ? static_cast<std::size_t>(read) - 1 : 0;
  }
  [[noreturn]] void refuse(std::size_t byte, std::string message) const {
    const std::string_view before = std::string_view(source_.text()).substr(0, byte);
    const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
    Problems problems;
    problems.error(source_, source_.place(line, byte - (before.rfind('\n') + 1)), std::move(message));
    problems.raise();
    throw std::logic_error("a problem that was not raised");
  }

  const Source& source_;
  std::istream& stream_;
  std::size_t values_ = 0, depth_ = 0;
};

}  // namespace

Json read_json(const Source& source) {
  if (source.text().size() > most_json_bytes) {
    Problems problems;
    problems.error(source, {}, fmt::format("larger than {} MB", most_json_bytes >> 20U));
    problems.raise();
  }
  std::istringstream stream(source.text());
  Judge judge(source, stream);
  Json::sax_parse(stream, &judge);
  return Json::parse(source.text());
}

}  // namespace mckibben::input
