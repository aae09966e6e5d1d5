// One pass of the workflow, in running order (diagnose.hpp): from data that are checked to a diagnosis, or to
// faults of the recording that stand in its way.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <sim/diagnose/baseline.hpp>
#include <sim/diagnose/check.hpp>
#include <sim/diagnose/competition.hpp>
#include <sim/diagnose/decide.hpp>
#include <sim/diagnose/diagnose.hpp>
#include <sim/diagnose/experiment.hpp>
#include <sim/diagnose/faults.hpp>
#include <sim/diagnose/held_out.hpp>
#include <sim/diagnose/law.hpp>
#include <sim/diagnose/name.hpp>
#include <sim/diagnose/search.hpp>
#include <sim/diagnose/telling.hpp>
#include <sim/diagnose/trial.hpp>

namespace mckibben::diagnose {

class Workflow {
 public:
  /// `ask_all`: runs in the search, however many there are.
  Workflow(const domain::Dataset& data, const Checked& checked, const Settings& settings, const Step& step,
           Search& search, bool ask_all);

  Judged judged() const { return data_.judged(); }
  bool reads_more() const { return experiment_.floor().any_beside(); }

  /// Faults of the recording that stand in the way; none if `operator()` has a result. `look`: for such.
  const std::vector<Fault>& faults() const { return faults_; }

  /// Whether the runs that the search did not ask are met by what it chose as well as those that it asked.
  bool is_confirmed() const { return confirmed_; }

  Diagnosis operator()(bool look);

 private:
  // workflow.cpp
  void learn(const std::string& what);
  void learn_gap(const std::string& of, const Eigen::VectorXd& held_out);
  double rmse(const Eigen::VectorXd& held_out) const;
  void warn(std::string what) { result_.warnings.push_back(std::move(what)); }
  void tell_check();
  Diagnosis unusable();
  void replay_as_described();
  void look_for_faults();
  void found(std::vector<Fault> faults);
  void found_on_the_way(std::vector<Fault> faults);
  const Contender& contender(Chosen chosen) const;
  std::vector<FarRun> far_from(const Contender& contender) const;
  std::vector<Fault> faults_beside(const Contender& fitted) const;
  std::vector<Fault> told_faults_beside(const Contender& named) const;
  std::vector<Fault> faults_that_bend(const Contender& named) const;
  Runs not_asked() const;
  void confirm();

  // evidence.cpp
  void fit_numbers();
  void weigh_numbers();
  void tell_starts(Recalibrated& result);
  void map_where();
  const Eigen::VectorXd& reference() const;
  void name();
  void spare_names();
  std::vector<const Fitted*> bases() const { return {&nominal_fit_.fitted, &recalibrated_.fitted}; }
  void spare_search();
  void believe_numbers(const Contender& numbers);
  void look_for_stand_ins();
  void look_for_law();
  void spare_law();

  // handing_over.cpp
  void hand_over(const Decision& decision);
  Fitted best_fit_of_all_runs(const Model& chosen) const;
  void tell_left_open(const Fitted& whole);
  void fit_all_runs(const Fitted& chosen);
  void show_gap();
  bool is_open(const Doubt& doubt) const;
  void plan_next();
  void tell_verdict();

  Settings settings_;
  const Step& step_;
  Search& search_;
  Checked checked_;
  domain::Dataset data_;
  Runs usable_;
  Experiment experiment_;
  Rig nominal_;
  Competition competition_;
  Split whole_;
  Case case_;              ///< of the runs that the search asks
  Contender nominal_fit_;  ///< the rig as described, nothing moved
  Contender recalibrated_;
  std::vector<Rig> other_ends_;  ///< of recalibrations that did not end alike
  Naming naming_;
  Law law_;
  Evidence evidence_;
  Rig chosen_rig_;                 ///< fitted to the training runs
  double chosen_inflation_ = 1.0;  ///< of its residuals over long times
  bool looks_for_faults_ = false;
  std::vector<Fault> faults_;
  bool confirmed_ = true;
  Diagnosis result_;
};

}  // namespace mckibben::diagnose
