// Checks of measured data; see the header. What needs no fit is found in sim/data.
#include <cmath>

#include <fmt/format.h>

#include <sim/data/examine.hpp>
#include <sim/data/thresholds.hpp>
#include <sim/diagnose/check.hpp>
#include <sim/diagnose/labels.hpp>
#include <sim/diagnose/repair.hpp>
#include <sim/diagnose/thresholds.hpp>
#include <sim/run/batch.hpp>

namespace mckibben::diagnose {
namespace {

constexpr const data::ReadingThresholds& of_readings = data::thresholds.reading;

class DatasetChecker {
 public:
  DatasetChecker(const domain::Dataset& data, unsigned threads, Runs sound) : data_(data), threads_(threads) {
    checked_.sound = std::move(sound);
  }

  Checked operator()() {
    data::Examined examined = data::examine(data_, expected());
    data::raise(data_, examined.findings);
    checked_.masked = std::move(examined.masked);
    checked_.dead_gauges = std::move(examined.dead_gauges);
    checked_.dead_opposite_gauges = std::move(examined.dead_opposite_gauges);
    left_out_ = std::move(examined.left_out);
    for (const data::Finding& finding : examined.findings)
      if (finding.quantity == "load")
        doubted_loads(finding);
      else
        tell(finding);
    if (data_.judged() == domain::Judged::contraction) labels();
    if (!checked_.cannot_tell) enough();
    for (std::size_t i = 0; i < left_out_.size(); ++i)
      if (left_out_[i]) checked_.left_out.push_back(i);
    return std::move(checked_);
  }

 private:
  std::vector<data::Expected> expected() const {
    std::vector<data::Expected> list(data_.runs.size());
    run::for_each_job(
        data_.runs.size(), threads_,
        [&](std::size_t i) {
          const Loaded hanging{data_.rig, data_.runs[i].load_kg};
          list[i] = std::move(predict(data_.runs[i], {&hanging, 1}, data_.rig.integrator.method).front());
        },
        [](std::size_t) {});
    return list;
  }

  void tell(const data::Finding& finding) {
    const std::string_view consequence = data::consequence_of(finding);
    checked_.warnings.push_back(data::text_of(data_, finding).append(consequence));
    if (finding.kind.empty()) return;
    const bool left_out = finding.severity == data::Severity::left_out;
    const std::string words = left_out ? "was left out: " + finding.message : finding.message;
    for (const std::size_t run : finding.runs)
      checked_.faulty.push_back({.run = data_.runs[run].id,
                                 .kind = finding.kind,
                                 .action = left_out ? "left out" : "masked",
                                 .words = left_out ? words : words + std::string(consequence)});
  }
  void leave_out(std::size_t run, std::string why) {
    tell({.runs = {run}, .message = std::move(why), .severity = data::Severity::left_out, .kind = "reading"});
    left_out_[run] = true;
  }
  void leave_out_for(const Fault& fault) {
    FaultyRun faulty = told(data_, fault);
    checked_.warnings.push_back(fmt::format("run {}: {}; left out", faulty.run, faulty.words));
    faulty.words += " (left out)";
    checked_.faulty.push_back(std::move(faulty));
    left_out_[fault.run] = true;
  }
  Runs usable() const {
    Runs runs;
    for (std::size_t i = 0; i < left_out_.size(); ++i)
      if (!left_out_[i]) runs.push_back(i);
    return runs;
  }

  static bool too_many(std::size_t contradicted, std::size_t runs) {
    return static_cast<double>(contradicted) > of_readings.most_contradicted * static_cast<double>(runs);
  }

  // Labels that were exchanged cost their runs.
  void doubted_loads(const data::Finding& finding) {
    // More runs are weighed one against the others later, exactly.
    if (finding.exchanged.empty() && data_.runs.size() >= thresholds.label.least_runs) return;
    for (const std::size_t i : finding.runs) left_out_[i] = true;
    for (const data::SeemingLoad& one : finding.exchanged)
      checked_.faulty.push_back(
          {.run = data_.runs[one.run].id,
           .kind = "load",
           .action = "left out",
           .words = fmt::format("was left out: it has the label of another load and moves like {:.6g} kg",
                                one.load_kg)});
    const std::string text = data::text_of(data_, finding);
    if (too_many(finding.runs.size(), data_.runs.size()) || usable().size() < of_readings.least_runs)
      checked_.cannot_tell = text + ".";
    else
      checked_.warnings.push_back(text + "; left out");
  }

  void labels() {
    if (checked_.cannot_tell) return;
    const Runs runs = usable();
    if (runs.size() >= of_readings.least_runs && runs.size() < thresholds.label.least_runs)
      checked_.warnings.push_back(fmt::format(
          "{} usable runs: their loads are in order, but too few to weigh each against the others",
          runs.size()));
    const auto [wrong, common_ratio] = check_labels(data_, checked_.masked, runs, threads_);
    if (std::abs(common_ratio / data::pound_kg - 1.0) < thresholds.label.pounds) {
      throw data::UnfitData(
          data_,
          fmt::format("load: all runs fit best at {:.2f} times their loads; these look like pounds, not kg",
                      common_ratio));
    }
    for (const WrongLabel& label : wrong) {
      if (checked_.is_sound(label.run)) continue;
      checked_.contradicted.push_back(label.run);
      if (label.other)
        leave_out_for(*label.other);
      else
        leave_out(label.run,
                  fmt::format("the load is labelled {:.6g} kg, but everything else says about {:.1f} kg",
                              data_.runs[label.run].load_kg, label.load_kg));
    }
    if (too_many(wrong.size(), runs.size()))
      checked_.cannot_tell =
          "too many runs contradict the others about their load: weigh the loads again, or give the rig's "
          "parameters more exactly.";
  }

  void enough() {
    std::vector<data::Finding> findings;
    data::require_enough(data_, left_out_, findings);
    for (const data::Finding& finding : findings)
      if (finding.severity == data::Severity::undecidable)
        checked_.cannot_tell = finding.message;
      else
        tell(finding);
  }

  const domain::Dataset& data_;
  unsigned threads_;
  std::vector<bool> left_out_;
  Checked checked_;
};

}  // namespace

Checked check(const domain::Dataset& data, unsigned threads, Runs sound) {
  return DatasetChecker(data, threads, std::move(sound))();
}

}  // namespace mckibben::diagnose
