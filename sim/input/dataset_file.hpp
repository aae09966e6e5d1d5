// Data sets in files. A data set is a folder with `dataset.yaml` (schema mckibben-dataset/1) and a table for
// each run, as CSV or in another format.
#pragma once

#include <filesystem>
#include <string_view>

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

/// Whether a load hangs on the muscle of each run, and contraction was read.
bool has_one_load(const Dataset& dataset);
/// Why runs have nothing that a model could be judged by; empty if they have.
std::string why_not_judged(const Dataset& dataset);
/// Throws BadInput unless `verb` has what it needs of each run: a load that hangs on one muscle and whose
/// contraction was read, of all runs a given length and the muscle's force, or two muscles and their joint's
/// angle.
void require_judged(const Dataset& dataset, std::string_view verb);

}  // namespace mckibben::input
