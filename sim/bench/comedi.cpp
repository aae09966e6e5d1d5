// Boards by libcomedi; see the header. Counters are set up as National Instruments' are; those of other
// boards, which count an encoder without being told, refuse that and count.
#include <algorithm>

#include <fmt/format.h>

#include <sim/bench/comedi.hpp>

#ifdef MCKIBBEN_COMEDI
#include <cstdint>

#include <comedilib.h>
#endif

namespace mckibben::bench {
namespace {

constexpr double usual_V = 10.0;

}  // namespace

std::string unusual_range(const Wiring& wiring, const plant::Rig& rig) {
  if (rig.command_unit() != plant::CommandUnit::V) {
    const double full_scale_V = wiring.full_scale_V.value_or(usual_V);
    if (full_scale_V <= usual_V) return "";
    return fmt::format(
        "--full-scale {0:g} V: most boards give 0 to {1:g} V at most; use a stage that makes {2:g} {3} of "
        "{1:g} V, and leave out --full-scale",
        full_scale_V, usual_V, rig.dac.largest_command, name_of(rig.command_unit()));
  }
  const double lowest = rig.dac.lowest_command, largest = rig.dac.largest_command;
  if (lowest >= -usual_V && largest <= usual_V) return "";
  return fmt::format(
      "the rig's dac gives {:g} to {:g} V, and most boards {:g} to {:g} V at most: write dac: "
      "{{lowest_command: {:g} V, largest_command: {:g} V}}; behind an amplifier, write zero_command, "
      "span_command and dac in volts before it",
      lowest, largest, -usual_V, usual_V, std::max(lowest, -usual_V), std::min(largest, usual_V));
}

#ifdef MCKIBBEN_COMEDI
namespace {

class Comedi final : public Device {
 public:
  Comedi(const std::string& file, const Wiring& wiring, const plant::Rig& rig)
      : file_(file), channel_(wiring.channel) {
    comedi_loglevel(0);  // what goes wrong is told once, by us
    board_.reset(comedi_open(file.c_str()));
    if (!board_)
      throw DeviceFailure(
          fmt::format("{} cannot be opened as a board: {}", file, comedi_strerror(comedi_errno())));
    output_ = subdevice(wiring.output, COMEDI_SUBD_AO, "analog output");
    counter_ = subdevice(wiring.counter, COMEDI_SUBD_COUNTER, "counter");
    const int channels = comedi_get_n_channels(board_.get(), output_);
    if (channels < 0 || channel_ >= static_cast<unsigned>(channels))
      fail(fmt::format("subdevice {} has {} channels, none is number {}", output_, channels, channel_));
    choose_range(rig, wiring);
    start_counting(wiring);
  }

  std::int64_t counts(double) override {
    const lsampl_t now = counter_value();
    const std::int64_t round = std::int64_t{1} + counter_top_;
    std::int64_t moved = (std::int64_t{now} - last_) % round;
    if (moved > round / 2) moved -= round;  // the counter goes round both ways
    if (moved < -round / 2) moved += round;
    last_ = now;
    return counts_ += moved;
  }

  void put(double current_mA, double) override {
    const lsampl_t data = comedi_from_phys(current_mA * per_command_, range_, output_top_);
    if (comedi_data_write(board_.get(), output_, channel_, range_number_, AREF_GROUND, data) < 1)
      fail(fmt::format("cannot write channel {} of subdevice {}", channel_, output_));
  }

 private:
  struct Close {
    void operator()(comedi_t* board) const { comedi_close(board); }
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw DeviceFailure(fmt::format("{}: {}", file_, what));
  }

  unsigned subdevice(const std::optional<unsigned>& wanted, int type, const char* kind) const {
    const int found =
        wanted ? static_cast<int>(*wanted) : comedi_find_subdevice_by_type(board_.get(), type, 0);
    if (found < 0) fail(fmt::format("the board has no {}", kind));
    const auto number = static_cast<unsigned>(found);
    if (comedi_get_subdevice_type(board_.get(), number) != type)
      fail(fmt::format("subdevice {} is no {}", number, kind));
    return number;
  }

  /// A range in what the valve takes as it is; else one in volts over a stage that makes the largest command
  /// of the full scale.
  void choose_range(const plant::Rig& rig, const Wiring& wiring) {
    using enum plant::CommandUnit;
    const double full_scale_V = wiring.full_scale_V.value_or(usual_V);
    const auto unit = rig.command_unit();
    const double lowest = rig.dac.lowest_command, largest = rig.dac.largest_command;
    int number = -1;
    std::string sought;
    if (unit != bar) {
      number = comedi_find_range(board_.get(), output_, channel_, unit == V ? UNIT_volt : UNIT_mA, lowest,
                                 largest);
      sought = fmt::format("from {:g} to {:g} {}", lowest, largest, name_of(unit));
    }
    if (number < 0 && unit != V) {
      number = comedi_find_range(board_.get(), output_, channel_, UNIT_volt, 0.0, full_scale_V);
      per_command_ = full_scale_V / largest;
      sought += fmt::format("{}0 to {:g} V", sought.empty() ? "from " : " or ", full_scale_V);
    }
    if (number < 0) {
      const std::string advice = unusual_range(wiring, rig);
      fail(fmt::format("subdevice {} has no range {}{}", output_, sought,
                       advice.empty() ? "" : "; " + advice));
    }
    range_number_ = static_cast<unsigned>(number);
    range_ = comedi_get_range(board_.get(), output_, channel_, range_number_);
    output_top_ = comedi_get_maxdata(board_.get(), output_, channel_);
  }

  void start_counting(const Wiring& wiring) {
    comedi_t* board = board_.get();
    counter_top_ = comedi_get_maxdata(board, counter_, 0);
    if (counter_top_ == 0) fail(fmt::format("subdevice {} does not say how far it counts", counter_));
    comedi_reset(board, counter_);
    comedi_set_gate_source(board, counter_, 0, 0, NI_GPCT_DISABLED_GATE_SELECT);
    comedi_set_gate_source(board, counter_, 0, 1, NI_GPCT_DISABLED_GATE_SELECT);
    if (wiring.encoder) {
      const auto line = [&](unsigned signal, unsigned pfi) {
        if (comedi_set_other_source(board, counter_, 0, signal, NI_GPCT_PFI_OTHER_SELECT(pfi)) < 0)
          fail(fmt::format("subdevice {} does not take line {} for its encoder", counter_, pfi));
      };
      line(NI_GPCT_SOURCE_ENCODER_A, wiring.encoder->first);
      line(NI_GPCT_SOURCE_ENCODER_B, wiring.encoder->second);
    }
    comedi_set_counter_mode(
        board, counter_, 0,
        NI_GPCT_COUNTING_MODE_QUADRATURE_X4_BITS | NI_GPCT_COUNTING_DIRECTION_HW_UP_DOWN_BITS);
    comedi_arm(board, counter_, NI_GPCT_ARM_IMMEDIATE);
    last_ = counter_value();
  }

  lsampl_t counter_value() const {
    lsampl_t value = 0;
    if (comedi_data_read(board_.get(), counter_, 0, 0, AREF_GROUND, &value) < 1)
      fail(fmt::format("cannot read the counter, subdevice {}", counter_));
    return value;
  }

  std::string file_;
  std::unique_ptr<comedi_t, Close> board_;
  unsigned output_ = 0, channel_, counter_ = 0, range_number_ = 0;
  comedi_range* range_ = nullptr;
  double per_command_ = 1.0;
  lsampl_t output_top_ = 0, counter_top_ = 0, last_ = 0;
  std::int64_t counts_ = 0;
};

}  // namespace

bool has_comedi() {
  return true;
}

std::unique_ptr<Device> open_comedi(const std::string& file, const Wiring& wiring, const plant::Rig& rig) {
  return std::make_unique<Comedi>(file, wiring, rig);
}

#else

bool has_comedi() {
  return false;
}

std::unique_ptr<Device> open_comedi(const std::string& file, const Wiring&, const plant::Rig&) {
  throw DeviceFailure(file +
                      ": this program was built without Comedi; install libcomedi-dev and build it again");
}

#endif

}  // namespace mckibben::bench
