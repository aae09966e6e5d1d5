// What the name of a column says of its rows; see headings.hpp.
#include <algorithm>

#include <sim/input/column_hints.hpp>
#include <sim/input/quantity.hpp>
#include <sim/recognise/headings.hpp>

namespace mckibben::recognise {

using input::words_of, input::Words;

namespace {

using List = std::initializer_list<std::string_view>;

bool has_word(const std::string& name, List said) {
  const Words words = words_of(name);
  return std::ranges::any_of(
      words, [&](const std::string& word) { return std::ranges::find(said, word) != said.end(); });
}
bool begins_with_word(const std::string& name, List said) {
  const Words words = words_of(name);
  return !words.empty() && std::ranges::find(said, words.front()) != said.end();
}

}  // namespace

namespace {

/// psi a, as a unit is read.
bool is_unit_and_a(const std::string& name) {
  const Words words = words_of(name);
  return words.size() > 1 && words.back() == "a" &&
         input::unit_problem(words[words.size() - 2], "bar").empty();
}

}  // namespace

bool is_absolute(const std::string& name) {
  const auto says = [](const std::string& word) {
    return word.starts_with("abs") || word.starts_with("assolut") || word.ends_with("absolut") ||
           word.find("\xE7\xBB\x9D\xE5\xAF\xB9") != std::string::npos;  // in Chinese
  };
  return std::ranges::any_of(words_of(name), says) ||
         has_word(name, {"pabs", "psia", "bara", "kpaa", "mbara"}) || name.ends_with("(a)") ||
         name.ends_with("(a)]") || name.ends_with("(a))") || is_unit_and_a(name);
}

bool names_an_instrument(const std::string& name) {
  return has_word(name, {"sensor", "transmitter", "transducer", "pump", "pumpe", "messumformer", "aufnehmer",
                         "signal", "output", "loop", "pt", "pt1", "ai", "ai0", "ai1"});
}

bool names_a_run(const std::string& name) {
  return begins_with_word(name, {"run", "trial", "test", "cycle", "zyklus", "versuch", "lauf", "experiment",
                                 "rep", "repeat", "repetition", "messung"});
}

bool names_a_start(const std::string& name) {
  return has_word(name, {"start", "begin", "new", "beginn"});
}

bool names_a_phase(const std::string& name) {
  return has_word(name, {"phase", "state", "stage", "step", "direction", "mode", "branch", "richtung",
                         "zustand", "status", "comment", "note", "remark", "kommentar"});
}

bool names_a_load(const std::string& name) {
  return begins_with_word(name, {"load", "mass", "weight", "last", "masse", "gewicht", "payload"}) &&
         !has_word(name, {"cell"});
}

bool names_a_key(const std::string& name) {
  return has_word(name, {"sensor", "channel", "signal", "variable", "quantity", "name", "key", "what",
                         "kanal", "parameter", "field", "series", "topic", "tag", "groesse", "größe"});
}

bool names_a_sensor(const std::string& name) {
  const std::size_t words = words_of(name).size();
  return begins_with_word(name, {"sensor", "channel", "kanal", "device", "probe", "muscle", "muskel"}) &&
         (words == 1 || (words == 2 && has_word(name, {"id", "nr", "no", "number", "index", "name"})));
}

bool names_rows(const std::string& name) {
  const Words words = words_of(name);
  const bool no_heading =
      words.size() == 1 && words.front().find_first_not_of("0123456789") == std::string::npos;
  return words.empty() || no_heading || words.back() == "seq" ||
         begins_with_word(name, {"x", "index", "sample", "samples", "n", "nr", "no", "frame", "count", "tick",
                                 "counter", "seq", "row", "i", "point", "id"});
}

bool names_raw(const std::string& name) {
  return has_word(name, {"counts", "count", "raw", "adc", "digits", "lsb", "bits"});
}

}  // namespace mckibben::recognise
