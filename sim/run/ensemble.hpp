// Campaigns that draw their rigs: so many runs that no list of them is kept. Runs are done in blocks of a
// size that follows from the campaign alone; a block is what is handed out, kept on disk and gathered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <sim/domain/campaign.hpp>
#include <sim/run/campaign.hpp>
#include <sim/run/recording.hpp>

namespace mckibben::run {

/// What is kept of each run.
enum class Keep { rows, summary };

/// A number that is kept of each run, or of each row.
struct Kept {
  std::string name, unit, meaning;
};

/// What an ensemble's results are: how many runs in blocks of which size, and what is kept of each.
struct EnsembleShape {
  EnsembleShape(const domain::Campaign& campaign, Keep keep);

  std::size_t runs = 0, in_block = 0;
  std::size_t rows = 0;              ///< of the longest run; 0 if none are kept
  std::vector<Kept> of_run, of_row;  ///< load, current, repeat, draws, metrics; current, contraction, ...

  std::size_t blocks() const { return (runs + in_block - 1) / in_block; }
  std::size_t first_of(std::size_t block) const { return block * in_block; }
  std::size_t size_of(std::size_t block) const { return std::min(in_block, runs - first_of(block)); }
};

/// The runs of one block. What a failed run has no number for is NaN.
class EnsembleBlock {
 public:
  EnsembleBlock(const EnsembleShape& shape, std::size_t block);
  /// From the bytes of an earlier one. Throws std::invalid_argument if they are not of this block.
  EnsembleBlock(const EnsembleShape& shape, std::size_t block, std::string_view bytes);

  /// Enters run `place` of the campaign, which is one of the block.
  void put(const domain::Campaign& campaign, std::size_t place, const Recording& recording);
  bool has(std::size_t place) const { return done_[place - first_] != 0; }
  bool whole() const;
  std::string bytes() const;

  std::size_t first() const { return first_; }
  std::size_t size() const { return done_.size(); }
  /// Number k of each run in order; and of each row of each run, padded with NaN.
  std::span<const double> of_run(std::size_t k) const { return of_run_[k]; }
  std::span<const float> of_row(std::size_t k) const { return of_row_[k]; }
  /// Why runs failed, in order; empty where they did not.
  const std::vector<std::string>& failures() const { return failures_; }

 private:
  static constexpr auto members = [](auto&& visit, auto& of) {
    visit(std::span(of.done_));
    for (auto& values : of.of_run_) visit(std::span(values));
    for (auto& values : of.of_row_) visit(std::span(values));
    for (auto& failure : of.failures_) visit(failure);
  };

  std::size_t first_, rows_;
  std::vector<std::uint8_t> done_;
  std::vector<std::vector<double>> of_run_;
  std::vector<std::vector<float>> of_row_;
  std::vector<std::string> failures_;
};

}  // namespace mckibben::run
