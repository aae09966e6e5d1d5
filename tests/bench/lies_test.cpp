// Devices that lie, or break: whatever they answer, the loop stops, says why, and the last that the device
// hears is to vent. The true counts follow the command; from answer 30 on, or from the first, they are not
// told.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <sim/bench/loop.hpp>
#include <sim/bench/serial.hpp>

#include "board.hpp"

namespace mckibben::bench {
namespace {

constexpr int then = 30;  // after settling, while the command goes up

/// Goes up slowly, to full pressure.
class GoesUp final : public controllers::Controller {
 public:
  explicit GoesUp(const Board& board) : board_(board) {}
  controllers::Command rest() override {
    board_.leave();  // what its process has of it would keep the line up
    return {4.0};
  }
  controllers::Command step(const controllers::Reading& reading) override {
    return {std::min(20.0, 4.0 + 0.2 * static_cast<double>(reading.tick))};
  }

 private:
  const Board& board_;
};

Recorded driven(Board& board) {
  LoopPlan plan;
  plan.rig.tick_s = 0.03;  // a busy machine has ten of them to answer
  plan.rig.settling_time_s = 10 * plan.rig.tick_s;
  plan.load_kg = 11.138;
  plan.ticks = 120;
  plan.limits = {4.0, 20.0};
  PatientClock clock;
  Serial serial(board.port, plan.rig);
  return drive(serial, std::make_unique<GoesUp>(board), plan, clock);
}

struct Lie {
  const char* kind;
  Board::Answer answer;
  const char* says;  ///< empty: it is none
  bool can_vent = true;
};

std::ostream& operator<<(std::ostream& out, const Lie& lie) {
  return out << lie.kind;
}

std::string line(auto counts) {
  return std::to_string(counts) + "\n";
}

/// Says that from answer 30 on.
Board::Answer later(const std::string& said) {
  return [said](int n, long counts) { return n < then ? line(counts) : said; };
}
/// Says that in place of what it counts from answer 30 on.
Board::Answer later_of(long (*lie)(int n, long counts)) {
  return [lie](int n, long counts) { return line(n < then ? counts : lie(n, counts)); };
}

constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min(),
                       highest = std::numeric_limits<std::int64_t>::max();
constexpr const char *unasked = "it sent an unrequested line", *no_number = " is no number of counts",
                     *jump = "watchdog: counts jump from ", *beyond = "the muscle can do ",
                     *begin = "watchdog: counts begin at ", *still = "watchdog: counts stay at ",
                     *apart = "further apart than half of what the muscle can do";

const Lie lies[] = {
    {"the_truth", [](int, long counts) { return line(counts); }, ""},
    {"carriage_returns", [](int, long counts) { return std::to_string(counts) + "\r\n"; }, ""},
    {"twice", [](int n, long counts) { return n < then ? line(counts) : line(counts) + line(counts); },
     unasked},
    {"twice_once", [](int n, long counts) { return line(counts) + (n == then ? line(counts) : ""); },
     unasked},
    {"without_end",
     [](int n, long counts) {
       std::string all = line(counts);
       for (int i = 0; n == then && i < 2000; ++i) all += "12\n";
       return all;
     },
     unasked},
    {"digits_unasked", [](int n, long counts) { return line(counts) + (n == then ? "1111" : ""); }, unasked},
    {"late",
     [](int n, long counts) {
       return n == then ? "" : n == then + 1 ? line(counts) + line(counts) : line(counts);
     },
     "no answer within 0.3 s"},
    {"silent", later(""), "no answer within 0.3 s"},
    {"dead_from_the_beginning", [](int, long) { return line(0); }, still},
    {"dead_on_the_way", later_of([](int, long) { return 77L; }), still},
    {"dead_where_it_was",
     [last = 0L](int n, long counts) mutable {
       last = n < then + 15 ? counts : last;
       return line(last);
     },
     still},
    {"trembling_but_dead", [](int n, long) { return line(n % 3); }, still},
    {"noise_of_a_dead_one", [](int n, long) { return line(7 * n % 11); }, apart},
    {"a_quarter", [](int, long counts) { return line(counts / 4); }, apart},
    {"doubled", [](int, long counts) { return line(2 * counts); }, beyond},
    {"begins_at_a_million", [](int, long counts) { return line(counts + 1000000); }, begin},
    {"begins_where_it_was_left", [](int, long counts) { return line(counts + 200); }, begin},
    {"begins_at_the_end", [](int n, long) { return line(n == 0 ? highest : lowest); }, begin},
    {"from_end_to_end",
     [](int n, long counts) { return line(n < then     ? counts
                                          : n % 2 == 0 ? highest
                                                       : lowest); }, jump},
    {"jump", later_of([](int n, long counts) { return n == then ? counts + 5000 : counts; }), jump},
    {"goes_round_at_16_bits", later_of([](int, long counts) { return counts - 65536; }), jump},
    {"goes_round_at_24_bits", later_of([](int, long counts) { return counts + 16777216; }), jump},
    {"counts_on", later_of([](int n, long counts) { return counts + 30L * (n - then); }), beyond},
    {"backwards", [](int, long counts) { return line(-counts); }, beyond},
    {"no_number", later("nan\n"), no_number},
    {"a_fraction", later("12.5\n"), no_number},
    {"nothing", later("\n"), no_number},
    {"too_many_digits", later("99999999999999999999999\n"), no_number},
    {"no_text", later(std::string("\xff\x00\xfe\n", 4)), "\"? ?\" is no number of counts"},
    {"no_end_of_line", later(std::string(5000, '1')), "a line without end"},
    {"begins_again", [](int n, long counts) { return (n < then ? "" : "ready 1\n") + line(counts); },
     no_number},
    {"hangs_up", later(Board::hang_up), "could not be vented", false},
};

class Lies : public testing::TestWithParam<Lie> {};

TEST_P(Lies, EndWithAVentAndTheReason) {
  const Lie& lie = GetParam();
  Board board(lie.answer);
  const Recorded recorded = driven(board);
  EXPECT_NE(recorded.stopped.find(lie.says), std::string::npos) << recorded.stopped;
  EXPECT_EQ(recorded.stopped.empty(), *lie.says == '\0') << recorded.stopped;
  if (lie.can_vent) {
    EXPECT_TRUE(board.vented());
  }
}

INSTANTIATE_TEST_SUITE_P(All, Lies, testing::ValuesIn(lies),
                         [](const auto& lie) { return std::string(lie.param.kind); });

}  // namespace
}  // namespace mckibben::bench
