// See the header.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include <sim/data/judged.hpp>
#include <sim/data/stamps.hpp>
#include <sim/diagnose/candidate.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/hypothesis_file.hpp>
#include <sim/tasks/diagnose.hpp>

namespace mckibben::tasks {
namespace {

[[noreturn]] void refuse(const std::string& file, std::string message) {
  throw input::BadInput({{input::Severity::error, file, input::nowhere, std::move(message), ""}});
}

void add_hypotheses(const std::vector<std::string>& files, domain::Dataset& data) {
  for (const std::string& file : files) {
    auto law = input::read_hypothesis(file, data.inputs);
    law.values.front() = 0.0;  // whatever the file says: it is to be found
    diagnose::each_side(data.rig, [&](plant::Effects& effects) {
      auto& list = effects.laws.list;
      const auto same = [&](const auto& other) { return other.text->name == law.text->name; };
      if (std::ranges::any_of(list, same))
        refuse(file, fmt::format("the rig has a law {} already", law.text->name));
      if (list.size() == plant::most_written_laws)
        refuse(file, fmt::format("a rig has at most {} laws", plant::most_written_laws));
      list.push_back(law);
    });
  }
}

}  // namespace

std::vector<std::string> prepare(domain::Dataset& data, const std::vector<std::string>& hypotheses) {
  add_hypotheses(hypotheses, data);
  input::require_judged(data, "diagnose");
  std::vector<std::string> warnings;
  for (const data::Finding& finding : data::mend_at_stamps(data))
    warnings.push_back(data::text_of(data, finding).append(data::consequence_of(finding)));
  data = data::with_rows(std::move(data));
  return warnings;
}

Found find(const domain::Dataset& data, const diagnose::Settings& settings,
           const run::ProgressHook& progress) {
  Found found{diagnose::diagnose(data, settings, progress), {}, {}};
  found.nominal = run::replay(data, settings.threads, progress);
  domain::Dataset mended = data;
  mended.rig = found.diagnosis.corrected;
  found.corrected = run::replay(mended, settings.threads, progress);
  return found;
}

}  // namespace mckibben::tasks
