// Form of the messages, carets under tabs and accents, and suggestions.
#include <gtest/gtest.h>

#include <sim/input/diagnostics.hpp>
#include <sim/input/hash.hpp>
#include <sim/input/suggest.hpp>
#include <sim/input/utf8.hpp>

namespace mckibben::input {
namespace {

std::string message_at(const std::string& text, Place place) {
  const Source source("a.yaml", text, "");
  Problems problems;
  problems.error(source, place, "bad");
  return to_text(problems.sorted());
}

TEST(Diagnostics, FileLineColumnExcerptCaret) {
  EXPECT_EQ(message_at("x: 1\nrest: 9 m\n", {2, 7}), "a.yaml:2:7: error: bad\nrest: 9 m\n      ^");
  EXPECT_EQ(message_at("x:\t1\r\n", {1, 4}), "a.yaml:1:4: error: bad\nx:\t1\n  \t^");
  EXPECT_EQ(message_at("\xC3\xA9: 1\n", {1, 4}), "a.yaml:1:4: error: bad\n\xC3\xA9: 1\n   ^");
  EXPECT_EQ(message_at("x", {1, 3}), "a.yaml:1:3: error: bad\nx\n  ^");
}

TEST(Diagnostics, AllErrorsInOrderAndWarningsDoNotThrow) {
  const Source source("a.yaml", "one\ntwo\n", "");
  Problems problems;
  problems.warning(source, {2, 1}, "odd");
  EXPECT_NO_THROW(problems.raise());
  problems.error(source, {2, 1}, "second");
  problems.error(source, {1, 1}, "first");
  try {
    problems.raise();
    FAIL();
  } catch (const BadInput& error) {
    ASSERT_EQ(error.problems().size(), 3u);
    EXPECT_EQ(error.problems()[0].message, "first");
    EXPECT_NE(std::string(error.what()).find("a.yaml:2:1: warning: odd"), std::string::npos);
  }
}

TEST(Diagnostics, OfVeryManyTheFirstHundredAndTheNumberOfTheRest) {
  const Source source("a.yaml", "one\n", "");
  Problems problems;
  for (std::size_t i = 0; i < 130; ++i) problems.error(source, {1, 1}, std::string(i, 'x'));
  ASSERT_EQ(problems.sorted().size(), 101u);
  EXPECT_EQ(problems.sorted().back().message, "and 30 more problems");
}

TEST(Diagnostics, OfThoseThatDifferInNumbersTheFirstTwentyAndHowManyMore) {
  const Source source("a.yaml", "one\n", "");
  Problems problems;
  for (std::size_t i = 0; i < 331; ++i) {
    problems.error(source, {i + 1, 1}, "at = " + std::to_string(i) + " has no unit");
    problems.error(source, {i + 1, 1}, "at = " + std::to_string(i) + " has no unit");  // read twice
  }
  problems.error(source, {400, 1}, "another");
  const auto sorted = problems.sorted();
  ASSERT_EQ(sorted.size(), 21u);
  EXPECT_EQ(sorted[18].message, "at = 18 has no unit");
  EXPECT_EQ(sorted[19].message, "at = 19 has no unit; and 311 more like it");
  EXPECT_EQ(sorted[20].message, "another");
}

TEST(Diagnostics, WhatManyRunsShareIsSaidOnce) {
  const Source source("a.yaml", "one\n", "");
  Problems problems;
  for (int i = 0; i < 3; ++i) problems.error(source, {1, 1}, "bad");
  EXPECT_EQ(problems.errors(), 3u);
  EXPECT_EQ(problems.sorted().size(), 1u);
}

TEST(Diagnostics, WhatAFileHoldsDoesNothingToATerminal) {
  EXPECT_EQ(printable("a\tb \xC3\xBC\n"), "a\tb \xC3\xBC\n");
  EXPECT_EQ(printable("\x1B[2J \xC2\x9B \xC3 \x7F"), "?[2J ? ? ?");
  Problems problems;
  problems.error(Source("a.csv", "x\x1B[2J\n", ""), {1, 1}, "\x1B[2J is not a number");
  EXPECT_EQ(to_text(problems.sorted()), "a.csv:1:1: error: ?[2J is not a number");
}

TEST(Diagnostics, OnlyMissingFilesAreMissingInput) {
  const Source source("a.yaml", "one\n", "");
  Problems problems;
  problems.missing_file(source, {}, "gone");
  EXPECT_THROW(problems.raise(), MissingInput);
  problems.error(source, {}, "bad too");
  EXPECT_THROW(problems.raise(), BadInput);
  EXPECT_THROW(Source::load("no/such/file", 10), MissingInput);
  EXPECT_THROW(Source::load(MCKIBBEN_SOURCE_DIR, 10), MissingInput);
}

TEST(Diagnostics, BytesThatAreNotText) {
  const auto bad_at = [](const std::string& text) { return Source("a", text, "").first_bad_byte(); };
  EXPECT_FALSE(bad_at("\xEF\xBB\xBFplain \xC2\xB5 \xE2\x82\xAC \xF0\x9F\x98\x80\n"));
  for (const char* text :
       {"a\nb\xFF", "a\nb\xC0\xAF", "a\nb\xED\xA0\x80", "a\nb\xF5\x80\x80\x80", "a\nb\xC3"}) {
    const auto place = bad_at(text);
    ASSERT_TRUE(place) << text;
    EXPECT_EQ(place->line, 2u);
    EXPECT_EQ(place->column, 2u);
  }
  EXPECT_TRUE(bad_at(std::string("a\0b", 3)));
}

TEST(Suggest, DistanceCountsSwapsOnce) {
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("friction", "firction"), 1u);
  EXPECT_EQ(edit_distance("length", "lenght"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(Suggest, OnlyWhatIsNear) {
  constexpr std::string_view known[] = {"rest_length", "rest_radius", "law"};
  EXPECT_EQ(nearest("rest_lenght", known), "rest_length");
  EXPECT_EQ(nearest("lwa", known), "law");
  EXPECT_EQ(nearest("temperature", known), std::nullopt);
  EXPECT_EQ(nearest("x", known), std::nullopt);
  EXPECT_EQ(did_you_mean("radius", known), "; did you mean rest_radius?");
  EXPECT_EQ(did_you_mean("radiu", known), "");
  EXPECT_EQ(did_you_mean("inner_radius", known), "; did you mean rest_radius?") << "by its last part";
  EXPECT_EQ(did_you_mean("rest_radus", known), "; did you mean rest_radius?");
  constexpr std::string_view kinds[] = {"encoder", "linear_encoder", "potentiometer"};
  for (const char* const word : {"draw-wire encoder", "string encoder", "draw_wire"})
    EXPECT_EQ(did_you_mean(word, kinds), "; did you mean linear_encoder?");
  constexpr std::string_view controllers[] = {"pid", "external", "plugin"};
  EXPECT_EQ(did_you_mean("lqr", controllers),
            "; did you mean external or plugin? See also mckibben linearise --lqr");
  EXPECT_TRUE(did_you_mean("laser", known).starts_with("; that is `sensors` of the rig: `[{signal: "))
      << "a word of the field that stands elsewhere";
}

TEST(Hash, PublishedVectors) {  // FIPS 180-2, appendix B
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace mckibben::input
