// The functions of libcomedi that a device calls; see the header. What a program is linked with itself comes
// before what shared libraries have.
#include "comedi.hpp"

#include <array>
#include <cerrno>
#include <cmath>
#include <string_view>

#include <comedilib.h>

#include <sim/bench/simulated.hpp>

struct comedi_t_struct {
  mckibben::bench::RealClock time;
  mckibben::bench::Simulated rig{mckibben::plant::Rig{}, 16.138, {}, 0.0};
};

namespace {

constexpr unsigned output = 1, counter = 11;
constexpr lsampl_t output_top = 0xffff, counter_top = 0xffffff, counter_start = counter_top - 9;
std::array<comedi_range, 2> ranges{{{-10.0, 10.0, UNIT_volt}, {0.0, 24.0, UNIT_mA}}};

double now_s(comedi_t* board) {
  auto* clock = mckibben::bench::stand_in().clock;
  return clock != nullptr ? clock->now_s() : board->time.now_s();
}

double current_mA(unsigned range, lsampl_t data) {
  const double share = static_cast<double>(data) / output_top;
  const double value = ranges[range].min + share * (ranges[range].max - ranges[range].min);
  return ranges[range].unit == UNIT_mA ? value : 2.0 * value;  // a stage of 2 mA/V
}

}  // namespace

namespace mckibben::bench {

StandIn& stand_in() {
  static StandIn only;
  return only;
}

}  // namespace mckibben::bench

using mckibben::bench::stand_in;

comedi_t* comedi_open(const char* file) {
  if (std::string_view(file) == "/dev/comedi0") return new comedi_t;
  errno = ENOENT;
  return nullptr;
}

int comedi_close(comedi_t* board) {
  delete board;
  return 0;
}

int comedi_loglevel(int level) {
  return level;
}

int comedi_errno() {
  return errno;
}

const char* comedi_strerror(int) {
  return "No such file or directory";
}

int comedi_find_subdevice_by_type(comedi_t*, int type, unsigned) {
  return type == COMEDI_SUBD_AO ? static_cast<int>(output) : type == COMEDI_SUBD_COUNTER ? int{counter} : -1;
}

int comedi_get_subdevice_type(comedi_t*, unsigned subdevice) {
  return subdevice == output    ? int{COMEDI_SUBD_AO}
         : subdevice == counter ? int{COMEDI_SUBD_COUNTER}
                                : int{COMEDI_SUBD_AI};
}

int comedi_get_n_channels(comedi_t*, unsigned) {
  return 2;
}

int comedi_find_range(comedi_t*, unsigned, unsigned, unsigned unit, double least, double most) {
  if (unit == UNIT_mA && !stand_in().in_mA) return -1;
  const comedi_range& range = ranges.at(unit);
  return range.min <= least && most <= range.max ? static_cast<int>(unit) : -1;
}

comedi_range* comedi_get_range(comedi_t*, unsigned, unsigned, unsigned range) {
  return &ranges.at(range);
}

lsampl_t comedi_get_maxdata(comedi_t*, unsigned subdevice, unsigned) {
  return subdevice == output ? output_top : counter_top;
}

lsampl_t comedi_from_phys(double value, comedi_range* range, lsampl_t top) {
  return static_cast<lsampl_t>(std::lround((value - range->min) / (range->max - range->min) * top));
}

int comedi_data_read(comedi_t* board, unsigned, unsigned, unsigned, unsigned, lsampl_t* value) {
  if (stand_in().unplugged) return -1;
  *value = static_cast<lsampl_t>(counter_start + board->rig.counts(now_s(board))) & counter_top;
  return 1;
}

int comedi_data_write(comedi_t* board, unsigned, unsigned, unsigned range, unsigned, lsampl_t data) {
  if (stand_in().unplugged) return -1;
  stand_in().written = data;
  board->rig.put(current_mA(range, data), now_s(board));
  return 1;
}

int comedi_set_other_source(comedi_t*, unsigned, unsigned, unsigned signal, unsigned source) {
  (signal == NI_GPCT_SOURCE_ENCODER_A ? stand_in().line_of_a : stand_in().line_of_b) =
      static_cast<int>(source);
  return source < NI_GPCT_PFI_OTHER_SELECT(16) ? 0 : -1;
}

int comedi_reset(comedi_t*, unsigned) {
  return 0;
}

int comedi_set_gate_source(comedi_t*, unsigned, unsigned, unsigned, unsigned) {
  return 0;
}

int comedi_set_counter_mode(comedi_t*, unsigned, unsigned, unsigned) {
  return 0;
}

int comedi_arm(comedi_t*, unsigned, unsigned) {
  return 0;
}
