// What the page may ask for, word by word; anything else is refused with what is wrong with it.
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include <sim/live/commands.hpp>

namespace mckibben::live {
namespace {

std::string refusal(std::string_view text) {
  try {
    read_command(text);
  } catch (const std::invalid_argument& refused) {
    return refused.what();
  }
  return "";
}

TEST(LiveCommands, EachIsRead) {
  EXPECT_EQ(std::get<SetCommand>(read_command(R"({"do": "command", "to": 9.5})")).to, 9.5);
  EXPECT_EQ(std::get<SetCommand>(read_command(R"({"do": "command", "to": 9.5})")).muscle, 1);
  EXPECT_EQ(std::get<SetCommand>(read_command(R"({"do": "command", "to": 9.5, "muscle": 2})")).muscle, 2);
  EXPECT_EQ(std::get<SetLoad>(read_command(R"({"do": "load", "kg": 3})")).kg, 3.0);
  const auto sweep = std::get<Sweep>(
      read_command(R"({"do": "sweep", "shape": "stairs", "low": 4, "high": 12, "period": 7})"));
  EXPECT_EQ(sweep.shape, Sweep::Shape::stairs);
  EXPECT_EQ(sweep.high_mA, 12.0);
  const auto effect = std::get<SetEffect>(
      read_command(R"({"do": "effect", "name": "muscle_leak", "on": true, "size": 1e-10, "shape": 0})"));
  EXPECT_EQ(effect.name, "muscle_leak");
  EXPECT_TRUE(effect.on);
  const auto hidden = std::get<HideEffect>(
      read_command(R"({"do": "hide", "name": "bladder_creep", "size": 100, "shape": 5})"));
  EXPECT_EQ(hidden.name, "bladder_creep");
  EXPECT_EQ(hidden.shape, 5.0);
  EXPECT_TRUE(std::holds_alternative<ShowEffect>(read_command(R"({"do": "show"})")));
  EXPECT_TRUE(std::holds_alternative<StartOver>(read_command(R"({"do": "again"})")));
  EXPECT_FALSE(std::get<SetRunning>(read_command(R"({"do": "run", "on": false})")).on);
  EXPECT_TRUE(std::get<Record>(read_command(R"({"do": "record", "from_rest": true})")).from_rest);
  EXPECT_TRUE(std::holds_alternative<StopRecording>(read_command(R"({"do": "stop"})")));
}

TEST(LiveCommands, NonsenseIsRefusedWithWhatIsWrong) {
  const std::string object = "a command is a JSON object, such as {\"do\": \"command\", \"to\": 9.5}";
  for (const char* text :
       {"", "current", "[1]", "{", "{\"do\": \"again\"", "null", "\xff\xfe", "{'do': 'again'}"})
    EXPECT_EQ(refusal(text), object) << text;
  EXPECT_EQ(refusal("{}"), "do: is missing");
  EXPECT_EQ(refusal(R"({"do": 3})"), "do = 3: must be a text");
  EXPECT_EQ(refusal(R"({"do": "explode"})"),
            "do = \"explode\": must be command, sweep, load, effect, hide, show, again, run, record or stop");
  EXPECT_EQ(refusal(R"({"do": "command"})"), "to: is missing");
  EXPECT_EQ(refusal(R"({"do": "command", "to": "9"})"), "to = \"9\": must be a number");
  EXPECT_EQ(refusal(R"({"do": "command", "to": null})"), "to = null: must be a number");
  EXPECT_EQ(refusal(R"({"do": "command", "to": 9, "volts": 3})"), "\"volts\": is no key of this command");
  EXPECT_EQ(refusal(R"({"do": "command", "to": 9, "muscle": 1.5})"), "muscle = 1.5: must be a whole number");
  EXPECT_EQ(refusal(R"({"do": "run", "on": 1})"), "on = 1: must be true or false");
  EXPECT_EQ(refusal(R"({"do": "sweep", "shape": "saw", "low": 4, "high": 12, "period": 7})"),
            "shape = \"saw\": must be sine, triangle or stairs");
  EXPECT_LT(refusal("{\"do\": \"" + std::string(3000, 'x') + "\"}").size(), 140u) << "words are cut short";
  EXPECT_NE(refusal("{\"do\": \"command\", \"to\": " + std::string(400, '9') + "}"), "");
}

}  // namespace
}  // namespace mckibben::live
