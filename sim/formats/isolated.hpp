// Libraries that a damaged file can crash or keep busy for ever (libfreexl, HDF5) read in a process of their
// own, so that nothing but the file is lost.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace mckibben::formats {

/// What `work` returns, in a process of its own. Throws BadFile as `work` does, or if the process is ended by
/// a signal.
std::vector<std::string> isolated(const std::function<std::vector<std::string>()>& work);

}  // namespace mckibben::formats
