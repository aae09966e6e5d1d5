// What goes to and fro between us and a controller in a process of its own; see the header.
#include <limits>
#include <optional>

#include <controllers/external.hpp>
#include <controllers/line.hpp>
#include <controllers/process.hpp>

namespace mckibben::controllers {
namespace {

class External final : public Guest {
 public:
  External(const ExternalSettings& settings, const Knowledge& known)
      : Guest(settings, known),
        command_(settings.command),
        time_limit_s_(settings.time_limit_s),
        start_limit_s_(settings.start_limit_s) {}

 private:
  double begin_mA() override {
    process_.emplace(command_, terms().folder);
    const double unlimited = std::numeric_limits<double>::infinity();  // is null in a line
    line_.begin();
    line_.add("mckibben_controller", std::int64_t{external_version});
    line_.add("period_s", known().tick_s);
    line_.add("contraction_per_count", known().contraction_per_count);
    line_.add("middle_of_count", known().middle_of_count);
    line_.add("rest_length_m", known().model.rest_length_m);
    const std::string unit(known().valve.unit), in_unit = "_" + unit;
    line_.add_text("command_unit", unit);
    line_.add("lowest" + in_unit, range().lowest_mA);
    line_.add("highest" + in_unit, range().highest_mA);
    line_.add((unit == "mA" ? "largest_current_speed" : "largest_command_speed") + in_unit + "_per_s",
              terms().largest_current_speed_mA_per_s.value_or(unlimited));
    line_.add("load_kg", known().load_kg.value_or(unlimited));
    line_.add("preparation_ticks", preparation_ticks());
    line_.add_list("target", known().target);
    return answered_mA(start_limit_s_);
  }

  double answer_mA(const Told& told) override {
    line_.begin();
    line_.add("tick", told.reading.tick);
    line_.add("time_s", told.reading.time_s);
    line_.add("counts", told.reading.counts);
    line_.add("counts_lost", told.counts_lost);
    line_.add("target", told.target);
    return answered_mA(time_limit_s_);
  }

  double answered_mA(double within_s) {
    const std::string_view answer = process_->ask(line_.end(), within_s);
    const auto current_mA = number_in(answer);
    if (!current_mA)
      throw ControllerFailure("its answer is no number of " + std::string(known().valve.unit) + ": " +
                              in_quotes(answer));
    return *current_mA;
  }

  std::string command_;
  double time_limit_s_, start_limit_s_;
  LineWriter line_;
  std::optional<Process> process_;
};

}  // namespace

std::unique_ptr<Controller> ExternalSettings::make(const Knowledge& knowledge) const {
  return std::make_unique<External>(*this, knowledge);
}

}  // namespace mckibben::controllers
