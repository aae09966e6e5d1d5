// Shell completion: the scripts are sourced by the shells and asked for words, as a Tab would.
#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/cli/app.hpp>
#include <sim/cli/options.hpp>
#include <sim/input/fields_json.hpp>

#include "program.hpp"

namespace mckibben::cli {
namespace {

using Words = std::set<std::string>;

class Completion : public testing::Test {
 protected:
  void SetUp() override {
    write_text(scratch / "bash.sh", mckibben("completion bash", scratch).out);
    write_text(scratch / "mine.yaml", "");
    write_text(scratch / "two words.yaml", "");
    std::filesystem::create_directory(scratch / "measured");
  }

  /// What bash offers for the last of these words.
  Words offered(const std::vector<std::string>& words) {
    std::string script = "cd '" + static_cast<const std::filesystem::path&>(scratch).string() +
                         "'\nsource ./bash.sh\nCOMP_WORDS=(";
    for (const auto& word : words) script += "'" + word + "' ";
    script += ")\nCOMP_CWORD=" + std::to_string(words.size() - 1) +
              "\n_mckibben\nprintf '%s\\n' \"${COMPREPLY[@]}\" > offered\n";
    write_text(scratch / "ask.sh", script);
    const std::string command = "bash --norc -eu '" + (scratch / "ask.sh").string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << script;
    Words found;
    std::istringstream lines(read_text(scratch / "offered"));
    for (std::string line; std::getline(lines, line);)
      if (!line.empty()) found.insert(line);
    return found;
  }
  Scratch scratch;
};

TEST_F(Completion, OffersEveryVerbAndEveryOption) {
  CLI::App app("", "mckibben");
  Asked asked;
  build(app, asked);
  Words verbs{"-h", "--help", "--version"};
  for (const auto* verb : app.get_subcommands({})) {
    verbs.insert(verb->get_name());
    Words options;
    for (const auto* option : verb->get_options())
      if (option->nonpositional())
        for (const auto& name : names_of(*option)) options.insert(name);
    EXPECT_EQ(offered({"mckibben", verb->get_name(), "-"}), options) << verb->get_name();
  }
  EXPECT_EQ(offered({"mckibben", ""}), verbs);
}

TEST_F(Completion, OffersWhatFits) {
  EXPECT_EQ(offered({"mckibben", "di"}), (Words{"diagnose", "diff"}));
  EXPECT_EQ(offered({"./mckibben", "run", "--s"}), Words{"--seed"});
  EXPECT_EQ(offered({"mckibben", "run", "m"}), (Words{"mine.yaml", "measured"}));
  EXPECT_EQ(offered({"mckibben", "run", "two"}), Words{"two words.yaml"});
  EXPECT_EQ(offered({"mckibben", "run", "mine.yaml", "--out", ""}), Words{"measured"});
  EXPECT_EQ(offered({"mckibben", "run", "mine.yaml", "--out", "=", "me"}), Words{"measured"});
  EXPECT_EQ(offered({"mckibben", "run", "--threads", ""}), Words{});
  EXPECT_EQ(offered({"mckibben", "run", "--json", "mi"}), Words{"mine.yaml"});
  EXPECT_EQ(offered({"mckibben", "run", "mine.yaml", "m"}), Words{}) << "it takes one scenario";
  EXPECT_EQ(offered({"mckibben", "check", "mine.yaml", "mi"}), Words{"mine.yaml"});
  EXPECT_EQ(offered({"mckibben", "study", "l"}), Words{"lag"});
  EXPECT_EQ(offered({"mckibben", "study", "--threads", "2", "lag", "mi"}), Words{"mine.yaml"});
  EXPECT_EQ(offered({"mckibben", "calibrate", "--fit", ""}), (Words{"joint", "sequence"}));
  EXPECT_EQ(offered({"mckibben", "effects", "valve_lag", "muscle_l"}), Words{"muscle_leak"});
  EXPECT_EQ(offered({"mckibben", "nonsense", ""}), Words{});
}

TEST_F(Completion, OfZsh) {
  const std::string script = mckibben("completion zsh", scratch).out;
  EXPECT_EQ(script.rfind("#compdef mckibben\n", 0), 0u);
  if (std::system("command -v zsh > /dev/null") != 0) GTEST_SKIP() << "zsh is not installed";
  write_text(scratch / "_mckibben", script);
  // What _arguments and _describe are told is checked, not what they then draw.
  write_text(
      scratch / "ask.zsh",
      "setopt err_exit\ncompdef() { true }\nsource ./_mckibben\n"
      "_arguments() { print -rl -- \"$@\" }\n_describe() { print -rl -- ${(P)2} }\ncompadd() { true }\n"
      "words=(mckibben '') CURRENT=2; _mckibben > verbs\n"
      "words=(mckibben calibrate '') CURRENT=3; _mckibben > calibrate\n");
  const std::string folder = static_cast<const std::filesystem::path&>(scratch).string();
  ASSERT_EQ(std::system(("cd '" + folder + "' && zsh -f ask.zsh").c_str()), 0);
  EXPECT_NE(read_text(scratch / "verbs").find("init:Write a scenario"), std::string::npos);
  const std::string options = read_text(scratch / "calibrate");
  for (const char* words :
       {"--fit[Pressure coefficients", "]:value:(joint sequence)\n", "]:value:_files -/\n",
        "--json[Print the result as one JSON document]\n", "1:dataset:_files\n"})
    EXPECT_NE(options.find(words), std::string::npos) << words << options;
}

TEST_F(Completion, AsJsonAndForOtherShells) {
  const auto document = input::Json::parse(mckibben("completion bash --json", scratch).out);
  EXPECT_EQ(document.at("script"), read_text(scratch / "bash.sh"));
  const Said fish = mckibben("completion bsh", scratch);
  EXPECT_EQ(fish.status, 64);
  EXPECT_NE(fish.err.find("did you mean bash?"), std::string::npos) << fish.err;
}

}  // namespace
}  // namespace mckibben::cli
