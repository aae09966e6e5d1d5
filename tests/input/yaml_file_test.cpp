// YAML as we accept it: places, quotes, and every kind of thing that is refused.
#include <gtest/gtest.h>

#include <sim/input/yaml_file.hpp>

namespace mckibben::input {
namespace {

YamlFile parse(const std::string& text) {
  return parse_yaml(Source("a.yaml", text, ""));
}

/// The first problem as LINE:COL: MESSAGE, or "accepted".
std::string problem_of(const std::string& text) {
  std::vector<Problem> problems;
  try {
    problems = parse(text).found;
  } catch (const BadInput& error) {
    problems = error.problems();
  }
  if (problems.empty()) return "accepted";
  const Problem& first = problems.front();
  return std::to_string(first.place.line) + ":" + std::to_string(first.place.column) + ": " + first.message;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(YamlFile, KeepsPlacesKeysAndQuotes) {
  const YamlFile file = parse("a: 1\nb:\n  - x: '2'\n    y: [3, \"4\"]\nc:\n\nd: ~\n");
  const Node& b = *file.root.find("b");
  const Node& item = b.children.at(0);
  EXPECT_EQ(item.find("x")->text, "2");
  EXPECT_TRUE(item.find("x")->quoted);
  EXPECT_FALSE(file.root.find("a")->quoted);
  EXPECT_EQ(item.find("y")->place.line, 4u);
  EXPECT_EQ(item.find("y")->place.column, 8u);
  EXPECT_EQ(item.find("y")->key_place.column, 5u);
  EXPECT_EQ(item.find("y")->children.at(1).text, "4");
  EXPECT_EQ(file.root.find("c")->kind, Node::Kind::null);
  EXPECT_EQ(file.root.find("c")->place.line, 5u);
  EXPECT_EQ(file.root.find("d")->kind, Node::Kind::null);
  EXPECT_EQ(file.root.find("no"), nullptr);
}

TEST(YamlFile, ColumnsCountCharacters) {
  EXPECT_EQ(parse("\xEF\xBB\xBF{\xC3\xA9: \xE2\x82\xAC, b: 2}\r\n").root.find("b")->place.column, 11u);
}

TEST(YamlFile, JsonIsYaml) {
  const YamlFile file = parse(R"({"a": {"b": [1, 2.5e-07]}, "c": "x y"})");
  EXPECT_EQ(file.root.find("a")->find("b")->children.at(1).text, "2.5e-07");
  EXPECT_EQ(file.root.find("c")->text, "x y");
}

TEST(YamlFile, RepeatedKeysAtAnyDepth) {
  EXPECT_EQ(problem_of("a: 1\nb: 2\na: 3\n"), "3:1: repeated key a; it stands in line 1 already");
  EXPECT_EQ(problem_of("x:\n  - {a: 1, a: 1}\n"), "2:12: repeated key a; it stands in line 2 already");
  EXPECT_EQ(problem_of("x:\n  a: 1\ny:\n  a: 1\n"), "accepted");
}

TEST(YamlFile, PartsOfYamlNotAccepted) {
  EXPECT_TRUE(contains(problem_of("a: &x 1\nb: 2\n"), "1:4: anchors (&x)"));
  EXPECT_TRUE(contains(problem_of("a: &x {c: 1}\nb: *x\n"), "anchors"));
  EXPECT_TRUE(contains(problem_of("b: *x\n"), "aliases"));
  EXPECT_TRUE(contains(problem_of("<<: {a: 1}\n"), "merge keys"));
  EXPECT_TRUE(contains(problem_of("a: !!str 1\n"), "tags"));
  EXPECT_TRUE(contains(problem_of("a: !mine {b: 1}\n"), "tags"));
  EXPECT_TRUE(contains(problem_of("{[1, 2]: 3}\n"), "a key must be a word"));
  EXPECT_TRUE(contains(problem_of("~: 3\n"), "a key must be a word"));
}

TEST(YamlFile, WholeFiles) {
  EXPECT_EQ(problem_of(""), "1:1: the file is empty");
  EXPECT_EQ(problem_of("# only a comment\n"), "1:1: the file is empty");
  EXPECT_EQ(problem_of("---\n"), "1:1: the file is empty");
  EXPECT_EQ(problem_of("- a\n- b\n"), "1:1: the file must hold `key: value` lines, not a list");
  EXPECT_EQ(problem_of("hello\n"), "1:1: the file must hold `key: value` lines, not a single value");
  EXPECT_EQ(problem_of("a: 1\n---\nb: 2\n"), "3:1: a second document begins; one file holds one document");
  EXPECT_EQ(problem_of("a: \xFF\n"), "1:4: this is not UTF-8 text");
  EXPECT_EQ(problem_of(std::string("a: \0\n", 5)), "1:4: this is not UTF-8 text");
  EXPECT_EQ(problem_of(std::string(largest_yaml_bytes + 1, '#')), "1:1: larger than 16 MB");
  EXPECT_EQ(problem_of("a: " + std::string(40, '[') + std::string(40, ']')),
            "1:35: nested deeper than 32 levels");
}

TEST(YamlFile, SyntaxInWords) {
  EXPECT_TRUE(contains(problem_of("a:\n\tb: 1\n"), "a tab is used for indentation"));
  EXPECT_TRUE(contains(problem_of("a: 'x\nb: 1\n"), "a quote is opened but never closed"));
  EXPECT_TRUE(contains(problem_of("a: {b: 1\n"), "a { is not closed"));
  EXPECT_TRUE(contains(problem_of("a: [1, 2\n"), "a [ is not closed"));
  EXPECT_TRUE(contains(problem_of("a: b: c\n"), "no `:` is expected here"));
  EXPECT_TRUE(contains(problem_of("a: ]\n"), "1:4: this closing bracket was never opened"));
  EXPECT_TRUE(contains(problem_of("a: 1\n  b: 2\n"), "2:4:"));
  EXPECT_TRUE(contains(problem_of("a: @x\n"), "put it in quotes"));
}

}  // namespace
}  // namespace mckibben::input
