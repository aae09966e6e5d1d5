// What was read, as rows that are even in time: the judged reading of each run, then what was read beside it.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <sim/domain/dataset.hpp>

namespace mckibben::identify {

/// One reading of one run, `reading` among its own.
struct Block {
  std::size_t run = 0, kind = 0, reading = 0;
  Eigen::Index begin = 0, rows = 0;
};

class Rows {
 public:
  /// `masked[run][row]` rows do not count, nor do any of a run that is not among `runs`. The data set
  /// outlives this.
  Rows(const domain::Dataset& data, const std::vector<std::vector<bool>>& masked,
       const std::vector<std::size_t>& runs);

  const domain::Dataset& data() const { return *data_; }
  Eigen::Index size() const { return read.size(); }
  bool is_judged(const Block& block) const { return block.kind == 0; }
  /// Root mean square of a column's rows that have a reading of a kind, of one run or of all.
  double rms(const Eigen::VectorXd& left, std::optional<std::size_t> run = {}, std::size_t kind = 0) const;

  std::vector<std::size_t> runs;
  std::vector<Block> blocks;
  std::vector<plant::Channel> kinds;    ///< of readings; the first is the judged one
  Eigen::VectorXd read;                 ///< a counter's: the middle of its count
  std::vector<char> known;              ///< of each row: whether there is a reading
  double row_s = 0.0, longest_s = 0.0;  ///< of a row, of a run
  double sensor_count = 0.0;  ///< step of the rig's sensor, of the judged reading; 0: it does not count
  double count =
      0.0;  ///< step that the readings have: the sensor's, or a coarser one in which they were written
  double unit = 0.0;  ///< a count, or where there are none the noise: what sizes of errors are told in
  std::vector<double> noise;  ///< of each kind, by how its readings scatter
  Eigen::VectorXd stays;      ///< share of what counting adds that stays until the next row

 private:
  void find_counts();
  void find_what_stays();

  const domain::Dataset* data_;
};

}  // namespace mckibben::identify
