// See the header.
#include <algorithm>
#include <cmath>

#include <sim/engine/lanes.hpp>
#include <sim/identify/whiten.hpp>

namespace mckibben::identify {
namespace {

using Four = double __attribute__((vector_size(32), aligned(8)));
using List = std::vector<double>;

constexpr std::size_t lanes = 4, tile = 4;  // columns of a vector; rows of the matrix that are summed at once
constexpr std::size_t most_rows = 64;       // that wait to be summed: they fit in the first cache

Four& four(double* at) {
  return *reinterpret_cast<Four*>(at);
}
const Four& four(const double* at) {
  return *reinterpret_cast<const Four*>(at);
}

/// The filter between two rows: what it expects of each column of the model error and of counting.
struct Between {
  List model, counting;
};

/// Takes what is expected off a row's columns, learns from the rest and scales it to one of variance 1.
void filter(double* row, std::size_t wide, Between& between, double gain, double scale, double learns_model,
            double learns_counting, double model_keeps, double counting_keeps) {
  double *model = between.model.data(), *counting = between.counting.data();
  for (std::size_t j = 0; j < wide; j += lanes) {
    Four &d = four(model + j), &c = four(counting + j), &x = four(row + j);
    const Four left = x - (gain * d + c);
    x = left * scale;
    d = model_keeps * (d + learns_model * left);
    c = counting_keeps * (c + learns_counting * left);
  }
}

/// Adds X' X of some rows, below the diagonal and in the tiles on it.
void add_gram(const double* x, std::size_t rows, std::size_t wide, double* gram) {
  for (std::size_t j = 0; j < wide; j += tile)
    for (std::size_t k = 0; k <= j; k += 2 * lanes) {
      const bool both = k + lanes < wide;  // the last vector may be one
      Four sums[tile][2];
      for (std::size_t a = 0; a < tile; ++a) {
        sums[a][0] = four(gram + (j + a) * wide + k);
        sums[a][1] = both ? four(gram + (j + a) * wide + k + lanes) : Four{};
      }
      for (std::size_t i = 0; i < rows; ++i) {
        const double* row = x + i * wide;
        const Four first = four(row + k), second = both ? four(row + k + lanes) : Four{};
        for (std::size_t a = 0; a < tile; ++a) {
          sums[a][0] += row[j + a] * first;
          sums[a][1] += row[j + a] * second;
        }
      }
      for (std::size_t a = 0; a < tile; ++a) {
        four(gram + (j + a) * wide + k) = sums[a][0];
        if (both) four(gram + (j + a) * wide + k + lanes) = sums[a][1];
      }
    }
}

}  // namespace

Whitened whitened(const RowErrors& errors, Eigen::Index columns,
                  const std::function<void(Eigen::Index row, double* columns)>& put) {
  const auto count = static_cast<std::size_t>(columns), wide = (count + lanes - 1) / lanes * lanes;
  Between between{List(wide, 0.0), List(wide, 0.0)};
  List waiting(most_rows * wide, 0.0), gram(wide * wide, 0.0);
  std::size_t full = 0;
  const auto sum_up = [&] {
    engine::on_this_machine([&] { add_gram(waiting.data(), full, wide, gram.data()); });
    full = 0;
  };
  const double model = errors.model_square, counting = errors.counting_square, keeps = errors.alike;
  double dd = model, dc = 0.0, cc = counting;  // variances of what is expected, and what they share
  Whitened result;
  for (std::size_t i = 0; i < errors.gain.size(); ++i) {
    const double stays = counting > 0.0 ? errors.stays[i] : 0.0;
    if (errors.known[i] != 0) {
      const double gain = errors.gain[i];
      const double to_model = gain * dd + dc, to_counting = gain * dc + cc;
      const double square = gain * to_model + to_counting + errors.white_square;
      const double learns_model = to_model / square, learns_counting = to_counting / square;
      double* row = waiting.data() + full++ * wide;
      put(static_cast<Eigen::Index>(i), row);
      engine::on_this_machine([&] {
        filter(row, wide, between, gain, 1.0 / std::sqrt(square), learns_model, learns_counting, keeps,
               stays);
      });
      result.log_det += std::log(square);
      dd -= learns_model * to_model;
      dc -= learns_model * to_counting;
      cc -= learns_counting * to_counting;
      if (full == most_rows) sum_up();
    } else {
      for (double& d : between.model) d *= keeps;
      for (double& c : between.counting) c *= stays;
    }
    dd = keeps * keeps * dd + model * (1.0 - keeps * keeps);
    dc *= keeps * stays;
    cc = stays * stays * cc + counting * (1.0 - stays * stays);
  }
  sum_up();
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto size = static_cast<Eigen::Index>(wide);
  result.gram = Eigen::Map<const Square>(gram.data(), size, size)
                    .topLeftCorner(columns, columns)
                    .selfadjointView<Eigen::Lower>();
  return result;
}

}  // namespace mckibben::identify
