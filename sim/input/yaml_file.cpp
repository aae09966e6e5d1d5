// YAML text to tree; see the header. yaml-cpp's marks count from 0 and its messages assume its source at
// hand; both are translated.
#include <algorithm>
#include <cctype>
#include <optional>
#include <sstream>
#include <tuple>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <sim/domain/renamed.hpp>
#include <sim/input/limits.hpp>
#include <sim/input/utf8.hpp>
#include <sim/input/yaml_file.hpp>

namespace mckibben::input {
namespace {

/// Builds the tree from yaml-cpp's events.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const Source& source, Problems& problems, Problems& repeated)
      : source_(source), problems_(problems), repeated_(repeated) {}

  const std::optional<Node>& root() const { return root_; }
  Node take_root() { return std::move(root_).value(); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { begin(Node::Kind::null, mark, "?"); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    problems_.error(source_, place(mark), "aliases (*name) are not accepted here; write the value out");
    begin(Node::Kind::null, mark, "?");
  }
  void OnAnchor(const YAML::Mark& mark, const std::string& name) override {
    problems_.error(source_, place(mark),
                    fmt::format("anchors (&{}) are not accepted here; write the value out", shortened(name)));
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                const std::string& value) override {
    if (!is_closed(mark)) problems_.error(source_, place(mark), "a quote is opened but never closed");
    if (printable(value) != value)
      problems_.error(source_, place(mark), "control characters are not accepted");
    begin(Node::Kind::scalar, mark, tag, value);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    begin(Node::Kind::list, mark, tag);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    begin(Node::Kind::map, mark, tag);
  }
  void OnMapEnd() override { end(); }

 private:
  /// A list or map being filled.
  struct Open {
    Node node;
    std::optional<std::pair<std::string, Place>> key = std::nullopt;  // read, its value not yet
    std::unordered_map<std::string, Place> keys = {};
  };

  /// Marks come in the order of the text, so characters are counted on from the last one:
  /// a file may be one long line.
  Place place(const YAML::Mark& mark) {
    if (mark.is_null()) return {};
    const auto line = static_cast<std::size_t>(mark.line) + 1;
    const auto offset = static_cast<std::size_t>(mark.column);
    if (line != last_.line || offset < last_offset_) {
      last_ = {line, 1};
      last_offset_ = 0;
    }
    const std::string_view text = source_.line(line);
    for (; last_offset_ < std::min(offset, text.size()); ++last_offset_)
      if (!is_utf8_continuation(text[last_offset_])) ++last_.column;
    return last_;
  }

  /// Whether the quote that a scalar begins with, if it does, is closed: yaml-cpp lets it run to the end.
  bool is_closed(const YAML::Mark& mark) const {
    const std::string& text = source_.text();
    auto at = static_cast<std::size_t>(std::max(mark.pos, 0));
    if (at >= text.size() || (text[at] != '"' && text[at] != '\'')) return true;
    const char quote = text[at];
    for (++at; at < text.size() && text[at] != quote; ++at)
      if (quote == '"' && text[at] == '\\') ++at;
    return at < text.size();  // '' inside single quotes closes and opens again
  }

  void begin(Node::Kind kind, const YAML::Mark& mark, const std::string& tag, const std::string& text = {}) {
    Node node;
    node.kind = kind;
    node.place = place(mark);
    if (++values_ > most_yaml_values) {
      problems_.error(source_, node.place, fmt::format("more than {} keys and values", most_yaml_values));
      problems_.raise();
    }
    node.text = text;
    node.quoted = tag == "!";
    if (!tag.empty() && tag != "?" && tag != "!")
      problems_.error(source_, node.place, fmt::format("tags ({}) are not accepted here", shortened(tag)));
    if (!open_.empty() && open_.back().node.kind == Node::Kind::map && !open_.back().key) {
      begin_key(node);
      if (kind == Node::Kind::null || kind == Node::Kind::scalar) return;
    }
    if (kind == Node::Kind::list || kind == Node::Kind::map) {
      if (open_.size() >= deepest_yaml) {
        problems_.error(source_, node.place, fmt::format("nested deeper than {} levels", deepest_yaml));
        problems_.raise();
      }
      open_.push_back({std::move(node)});
    } else {
      place_value(std::move(node));
    }
  }

  void begin_key(const Node& key) {
    Open& map = open_.back();
    if (key.kind != Node::Kind::scalar) {
      problems_.error(source_, key.place, "a key must be a word");
      if (key.kind != Node::Kind::null) problems_.raise();  // the rest would be read out of step
    } else if (key.text == "<<") {
      problems_.error(source_, key.place, "merge keys (<<) are not accepted here; write the values out");
    } else if (const auto [first, is_new] = map.keys.try_emplace(key.text, key.place); !is_new) {
      repeated_.error(source_, key.place,
                      fmt::format("repeated key {}; it stands in line {} already", shortened(key.text),
                                  first->second.line));
    }
    map.key.emplace(key.text, key.place);
  }

  void end() {
    Node node = std::move(open_.back().node);
    open_.pop_back();
    place_value(std::move(node));
  }

  void place_value(Node node) {
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& parent = open_.back();
    if (parent.key) {
      std::tie(node.key, node.key_place) = *std::exchange(parent.key, std::nullopt);
    }
    // yaml-cpp puts a missing value where the next token is.
    if (node.kind == Node::Kind::null)
      node.place = parent.node.kind == Node::Kind::map ? node.key_place : parent.node.place;
    parent.node.children.push_back(std::move(node));
  }

  const Source& source_;
  Problems& problems_;
  Problems& repeated_;
  Place last_;
  std::size_t last_offset_ = 0, values_ = 0;
  std::vector<Open> open_;
  std::optional<Node> root_;
};

bool indented_by_tab(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return line.substr(0, first).find('\t') != std::string_view::npos;
}

std::string in_words(const std::string& message) {
  namespace said = YAML::ErrorMsg;
  if (message == said::END_OF_MAP || message == said::END_OF_SEQ)
    return "this line does not continue what stands above; check its indentation and the `key: value` form";
  if (message == said::END_OF_MAP_FLOW) return "a { is not closed by }, or a comma is missing before this";
  if (message == said::END_OF_SEQ_FLOW) return "a [ is not closed by ], or a comma is missing before this";
  if (message == said::MAP_VALUE)
    return "no `:` is expected here; check the indentation, and quote a text that holds `: `";
  if (message == said::MAP_KEY) return "no key is expected here; check the indentation";
  if (message == said::BLOCK_ENTRY) return "no `-` is expected here; check the indentation";
  if (message == said::FLOW_END) return "this closing bracket was never opened";
  if (message == said::EOF_IN_SCALAR) return "a quote is opened but never closed";
  if (message == said::UNKNOWN_TOKEN) return "a value cannot begin with this character; put it in quotes";
  if (message == said::UNKNOWN_ANCHOR) return "aliases (*name) are not accepted here; write the value out";
  return "not valid YAML: " + message;
}

void check_bytes(const Source& source, Problems& problems) {
  std::string problem;
  if (source.text().size() > largest_yaml_bytes) {
    problems.error(source, {}, fmt::format("larger than {} MB", largest_yaml_bytes >> 20U));
  } else if (const std::size_t line = first_long_line(source, problem); line > 0) {
    problems.error(source, {line, 1}, problem);
  } else if (const auto bad = source.first_bad_byte()) {
    problems.error(source, *bad, "this is not UTF-8 text");
  }
  problems.raise();
}

}  // namespace

const Node* Node::find(std::string_view wanted) const {
  if (kind != Kind::map) return nullptr;
  const auto found = std::ranges::find(children, wanted, &Node::key);
  if (found != children.end()) return &*found;
  const auto old = std::ranges::find_if(
      children, [&](const Node& child) { return domain::name_today(child.key) == wanted; });
  return old == children.end() ? nullptr : &*old;
}

std::string_view Node::kind_name() const {
  switch (kind) {
    case Kind::scalar:
      return "a single value";
    case Kind::list:
      return "a list";
    case Kind::map:
      return "a map of keys";
    case Kind::null:
      break;
  }
  return "nothing";
}

YamlFile parse_yaml(Source source) {
  Problems problems, repeated;
  check_bytes(source, problems);
  TreeBuilder builder(source, problems, repeated);
  std::istringstream stream(source.text());
  try {
    YAML::Parser parser(stream);
    const bool found = parser.HandleNextDocument(builder);
    if (!found || !builder.root() || builder.root()->kind == Node::Kind::null) {
      if (problems.errors() == 0) problems.error(source, {}, "the file is empty");
    } else if (builder.root()->kind != Node::Kind::map) {
      problems.error(
          source, builder.root()->place,
          fmt::format("the file must hold `key: value` lines, not {}", builder.root()->kind_name()));
    } else {
      TreeBuilder second(source, problems, repeated);
      if (parser.HandleNextDocument(second))
        problems.error(source, second.root() ? second.root()->place : Place{},
                       "a second document begins; one file holds one document");
    }
  } catch (const YAML::Exception& error) {
    const std::size_t line = error.mark.is_null() ? 1 : static_cast<std::size_t>(error.mark.line) + 1;
    const Place place = source.place(line, static_cast<std::size_t>(std::max(error.mark.column, 0)));
    const bool tab =
        indented_by_tab(source.line(line)) || (line > 1 && indented_by_tab(source.line(line - 1)));
    problems.error(source, place,
                   tab ? "a tab is used for indentation here or in the line above; YAML wants spaces"
                       : in_words(error.msg));
  }
  if (problems.errors() > 0) problems.adopt(repeated.sorted());
  problems.raise();
  Node root = builder.take_root();
  return {std::move(source), std::move(root), repeated.sorted()};
}

YamlFile load_yaml(const std::filesystem::path& path) {
  return parse_yaml(Source::load(path, largest_yaml_bytes));
}

Place place_in(const Source& source, const Node& scalar, std::size_t offset) {
  // What is read holds the same characters as what is written, but for blanks, line ends and quotes.
  const auto is_blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  const std::size_t end = std::min(offset, scalar.text.size());
  auto left = std::count_if(scalar.text.begin(), scalar.text.begin() + static_cast<std::ptrdiff_t>(end),
                            [&](char c) { return !is_blank(c); });
  std::size_t line = scalar.place.line, byte = 0;
  for (std::size_t column = 1; byte < source.line(line).size() && column < scalar.place.column; ++byte)
    if (byte + 1 >= source.line(line).size() || !is_utf8_continuation(source.line(line)[byte + 1])) ++column;
  if (scalar.quoted && byte < source.line(line).size()) {
    const char first = source.line(line)[byte];
    if (first == '|' || first == '>') {
      ++line;
      byte = 0;
    } else if (first == '"' || first == '\'') {
      ++byte;
    }
  }
  for (; line <= source.lines(); ++line, byte = 0) {
    const std::string_view text = source.line(line);
    for (; byte < text.size(); ++byte) {
      if (is_blank(text[byte])) continue;
      if (left-- == 0) return source.place(line, byte);
    }
    if (left == 0 && offset >= scalar.text.size()) return source.place(line, text.size());
  }
  return scalar.place;
}

}  // namespace mckibben::input
