// Warnings for people to read: what is to be said of many runs in the same words is said once.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mckibben::data {

/// A warning of one run, in the form that `grouped` knows. `id` holds no colon.
std::string warning_of_run(std::string_view id, std::string_view text);

/// Warnings in the order in which their kinds first came. Those of several runs whose text is the same become
/// one that names the runs; so do those of more than three whose text is the same but for its numbers, with
/// the first one's numbers. Of equal ones that are of no run, one is left.
std::vector<std::string> grouped(const std::vector<std::string>& warnings);

}  // namespace mckibben::data
