// Pieces of a study's page: tables in Markdown, numbers with their errors.
#pragma once

#include <string>
#include <vector>

#include <sim/study/evidence.hpp>

namespace mckibben::study {

/// A table in Markdown: the first row is its head.
std::string table(const std::vector<std::vector<std::string>>& rows);

/// Value and standard error, or why the data do not determine it, both times `factor`.
std::string text_of(const thesis::Estimate& estimate, double factor = 1.0);

/// "+0.12 +- 0.34": mean and spread.
std::string bias_and_spread(const Tally& tally);

/// The first lines of a page: title, what made it, picture.
std::string heading(const Evidence& evidence, const std::string& name, const std::string& title);

}  // namespace mckibben::study
