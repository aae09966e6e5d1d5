// See the header.
#include <algorithm>
#include <utility>

#include <sim/identify/each_run.hpp>
#include <sim/identify/mended.hpp>

namespace mckibben::identify {

using diagnose::BenchFault;

Model with_reported_loads(const Model& model, const std::vector<BenchFault>& faults) {
  const Rows& rows = model.problem->rows;
  Point point = model.point.alike_in(loads);
  const Bench shared = model.problem->dictionary.setting(point).bench;
  std::vector<double> off_kg(rows.runs.size(), 0.0);
  for (const BenchFault& fault : faults)
    for (std::size_t k = 0; k < fault.loads_kg.size(); ++k)
      for (std::size_t i = 0; i < off_kg.size(); ++i)
        if (const domain::Run& run = rows.data().runs[rows.runs[i]]; run.id == fault.runs[k])
          off_kg[i] = fault.loads_kg[k] - shared.load_kg(run.load_kg, i);
  point.of_runs[loads] = std::move(off_kg);
  Model mended(*model.problem, std::move(point), model.error, model.term_N);
  mended.look();
  mended.settle({});
  mended.evidence();
  return mended;
}

domain::Dataset without_faults(const Model& model) {
  const Rows& rows = model.problem->rows;
  domain::Dataset data = rows.data();
  // Where the model was simulated with loads of their own: `own` is most probable.
  const Point& at = model.point;
  const Bench bench =
      model.problem->dictionary.setting(at.lets_differ(loads) ? at.alike_in(loads) : at).bench;
  for (std::size_t i = 0; i < rows.runs.size(); ++i) {
    domain::Run& run = data.runs[rows.runs[i]];
    double own_kg = 0.0, own_m = 0.0;
    std::vector<double>& read = run.judged().values;
    double zero = bench.zero, gain = 0.0, drift_per_s = 0.0, late_s = 0.0;
    for (std::size_t place = 0; place < model.point.differ.size(); ++place) {
      const double own = values_of(model, place)[i];
      if (model.point.differ[place] == loads) own_kg += own;
      if (model.point.differ[place] == held_lengths) own_m += own;
      if (model.point.differ[place] == zeros) zero += own;
      if (model.point.differ[place] == gains) gain += own;
      if (model.point.differ[place] == delays) late_s += own;
      if (model.point.differ[place] == drifts) drift_per_s += own;
    }
    run.load_kg = bench.load_kg(run.load_kg, i) + own_kg;
    if (own_m != 0.0)
      for (double& ratio : run.measured->give("contraction")) ratio += own_m / run.rest_length_m;
    for (std::size_t k = 0; k < read.size(); ++k)
      read[k] = (read[k] - zero - drift_per_s * rows.row_s * static_cast<double>(k)) / (1.0 + gain);
    late_s -= bench.ahead_s;
    if (bench.clock != 0.0 || late_s != 0.0) {
      const Eigen::VectorXd right = clocked(Eigen::Map<const Eigen::VectorXd>(read.data(), std::ssize(read)),
                                            1.0 / (1.0 + bench.clock) - 1.0, late_s / rows.row_s);
      std::ranges::copy(right, read.begin());
    }
  }
  return data;
}

}  // namespace mckibben::identify
