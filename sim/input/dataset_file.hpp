// Data sets in files. A data set is a folder with `dataset.yaml` (schema mckibben-dataset/1) and a table for
// each run, as CSV or in another format.
#pragma once

#include <filesystem>
#include <string_view>

#include <sim/domain/combination.hpp>
#include <sim/domain/dataset.hpp>
#include <sim/input/rigs.hpp>
#include <sim/input/source.hpp>

namespace mckibben::input {

using domain::Dataset, domain::Run;

inline constexpr std::string_view dataset_schema = "mckibben-dataset/1";

/// Reads a data set and all its tables. `path` is its file or its folder. Throws MissingInput; BadInput with
/// the problems of all files.
Dataset read_dataset(const std::filesystem::path& path);
/// The same from the text of its file at hand; relative paths start at the source's folder.
Dataset read_dataset(Source source);

/// Throws BadInput unless a load hangs on the muscle and each run has a row each tick, as `verb` needs it.
void require_ticks(const Dataset& dataset, std::string_view verb);

/// Another rig in place of the data set's, `called` so in messages. Throws BadInput where its valve takes
/// other commands.
void take_rig(Dataset& dataset, const std::string& called, Rig rig);

/// Why its runs cannot serve; empty if they can.
std::string why_unfit(domain::Purpose purpose, const Dataset& dataset);
/// Throws BadInput unless they can serve a diagnosis, by `verb`.
void require_judged(const Dataset& dataset, std::string_view verb);

}  // namespace mckibben::input
