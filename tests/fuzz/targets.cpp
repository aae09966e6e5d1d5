// See the header.
#include "targets.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

#include <sim/cli/run_folders.hpp>
#include <sim/input/calibration_file.hpp>
#include <sim/input/campaign_file.hpp>
#include <sim/input/dataset_file.hpp>
#include <sim/input/fields_json.hpp>
#include <sim/input/hypothesis_file.hpp>
#include <sim/input/quantity.hpp>
#include <sim/input/readers.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/scenario_file.hpp>
#include <sim/recognise/recognise.hpp>

#include "scratch.hpp"

namespace mckibben::fuzz {
namespace {

namespace fs = std::filesystem;

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

/// Whether it was read. What is refused must be told: briefly, and where.
template <class Read>
bool was_read(Read read) {
  try {
    read();
    return true;
  } catch (const input::BadInput& bad) {
    require(!bad.problems().empty(), "refused without a problem");
    for (const input::Problem& problem : bad.problems()) {
      require(!problem.message.empty() && problem.message.size() < 1100, "a message is empty or too long");
      require(!problem.file.empty(), "a problem is in no file");
    }
  } catch (const input::MissingInput&) {
  }
  return false;
}

/// For readers that take a path.
const Scratch& folder() {
  static const Scratch one;
  return one;
}

/// What is read and written is the same when it is read again. `written`: of a text.
template <class Written>
void reads_back(const std::string& bytes, Written written) {
  std::string once;
  if (was_read([&] { once = written(bytes); }))
    require(written(once) == once, "not the same when read again");
}

void scenario(const std::string& bytes) {
  reads_back(bytes, [](const std::string& text) {
    std::vector<input::Problem> warnings;
    return input::scenario_json(
               input::read_scenario(input::Source("fuzz.yaml", text, "/nonexistent"), warnings))
        .dump();
  });
}

void campaign(const std::string& bytes) {
  const fs::path file = folder().write("campaign.yaml", bytes);
  was_read([&] { input::read_campaign(file); });
}

void rig(const std::string& bytes) {
  reads_back(bytes, [](const std::string& text) {
    std::vector<domain::InputFile> inputs;
    return input::rig_json(input::read_rig(folder().write("rig.yaml", text), inputs)).dump();
  });
}

void calibration(const std::string& bytes) {
  reads_back(bytes, [](const std::string& text) {
    std::vector<domain::InputFile> inputs;
    return input::calibration_yaml(input::read_calibration(folder().write("calibration.yaml", text), inputs));
  });
}

void hypothesis(const std::string& bytes) {
  reads_back(bytes, [](const std::string& text) {
    std::vector<domain::InputFile> inputs;
    auto law =
        input::hypothesis_json(input::read_hypothesis(folder().write("law.yaml", text).string(), inputs));
    law["schema"] = input::hypothesis_schema;
    return law.dump();
  });
}

void dataset(const std::string& bytes) {
  folder().write("r1.csv", "time_s,current_mA,contraction_ratio\n0,4,0.01\n0.012,4,0.02\n");
  folder().write("r2.txt", "0 4 100\n12 4 101\n");
  const fs::path file = folder().write("dataset.yaml", bytes);
  was_read([&] { input::read_dataset(file); });
}

/// A table is whole: each column as long as the others, each number finite and at its place.
template <class Read>
void table(const std::string& bytes, const std::vector<input::WantedColumn>& wanted, Read read) {
  const input::Source source("fuzz", bytes, "");
  was_read([&] {
    input::Problems problems;
    input::Table found;
    {
      input::TableProblems of_table(source, problems);
      found = read(source, wanted, of_table);
      check_ticks(found, 0.012, of_table);
      for (const auto& column : found.columns)
        check_range(found, column, -1e6, 1e6, "what is usual", of_table);
    }
    problems.raise();
    for (const auto& column : found.columns) {
      require(column.values.size() == found.columns.front().values.size(), "columns of different lengths");
      for (std::size_t row = 0; row < column.values.size(); ++row) {
        require(std::isfinite(column.values[row]), "a number that is not finite");
        require(found.lines.empty() || found.place(source, column, row).line <= source.lines(),
                "a place outside");
      }
    }
  });
}

const std::vector<input::WantedColumn> by_name{{"time_s", "time_s", true},
                                               {"current_mA", "current_mA", true},
                                               {"contraction_ratio", "contraction_ratio", true},
                                               {"muscle_pressure_bar", "muscle_pressure_bar", false}};

void csv(const std::string& bytes) {
  table(bytes, by_name,
        [](const input::Source& source, std::span<const input::WantedColumn> wanted,
           input::TableProblems& problems) { return input::read_text(source, wanted, problems); });
}

void lvm(const std::string& bytes) {
  const std::vector<input::WantedColumn> wanted{
      {"time_s", "", true}, {"current_mA", "I", true}, {"ratio", "2", true}};
  for (const std::size_t segment : {0U, 1U})
    table(bytes, wanted, [segment](const auto& source, const auto& columns, auto& problems) {
      return input::read_lvm(source, columns, segment, problems);
    });
}

void ascii(const std::string& bytes) {
  const std::vector<input::WantedColumn> wanted{{"current_mA", "2", true}, {"contraction_ratio", "1", true}};
  table(bytes, wanted,
        [](const input::Source& source, std::span<const input::WantedColumn> columns,
           input::TableProblems& problems) { return input::read_text(source, columns, problems); });
}

void mat(const std::string& bytes) {
  const std::vector<input::WantedColumn> wanted{{"current_mA", "current_mA", true},
                                                {"ratio", "run.ratio(:,1)", false}};
  table(bytes, wanted, input::read_mat_table);
}

/// A file of any kind, as `import` reads it: spreadsheets, TDMS, MAT-files of both versions, text.
void import(const std::string& bytes) {
  const fs::path file = folder().write("import/load_5kg", bytes);
  was_read([&] {
    for (const recognise::UnknownTable& table : recognise::read_unknown(file))
      for (const recognise::UnknownColumn& column : table.columns)
        require(column.values.size() == table.columns.front().values.size(), "columns of different lengths");
    recognise::recognise({file}, false);
  });
}

void run_json(const std::string& bytes) {
  static const fs::path sound =
      folder()
          .write("a/run.json",
                 R"({"schema": "mckibben-run/1", "scenario": {"loads": ["11 kg"]}, "seed": 1, "runs":
                     [{"load_kg": 11, "controller": "pid", "rmse": 0.1, "file": "r.csv"}]})")
          .parent_path();
  folder().write("a/r.csv", "time_s,contraction_ratio\n0,0.01\n0.012,0.02\n");
  folder().write("b/r.csv", "time_s,contraction_ratio\n0,0.01\n0.012,0.03\n");
  const fs::path other = folder().write("b/run.json", bytes).parent_path();
  was_read([&] { cli::compare_run_folders(sound, other); });
  was_read([&] { cli::compare_run_folders(other, sound); });
}

void quantity(const std::string& bytes) {
  for (const std::string_view unit : {"1", "m", "kg", "Pa", "rad", "s", "K", "mA/s", "m3/(s.Pa)"}) {
    try {
      const double value = input::read_quantity(bytes, unit);
      if (std::isfinite(value))
        require(input::read_quantity(input::write_quantity(value, unit), unit) == value,
                "not the same when read again");
    } catch (const input::BadQuantity& bad) {
      require(std::string_view(bad.what()).size() < 1100, "a message is too long");
    }
    std::array<double, 1> one{1.0};
    if (input::unit_problem(bytes, unit).empty()) input::convert_units(one, bytes, unit);
  }
}

constexpr std::pair<std::string_view, Target> targets[] = {
    {"scenario", scenario}, {"campaign", campaign}, {"rig", rig},           {"calibration", calibration},
    {"dataset", dataset},   {"csv", csv},           {"lvm", lvm},           {"ascii", ascii},
    {"mat", mat},           {"run_json", run_json}, {"quantity", quantity}, {"hypothesis", hypothesis},
    {"import", import},
};

}  // namespace

Target find_target(std::string_view name) {
  for (const auto& [known, target] : targets)
    if (known == name) return target;
  return nullptr;
}

}  // namespace mckibben::fuzz
