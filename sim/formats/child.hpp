// Work that may crash, done in a child process: libmatio trusts damaged files and goes down with them, and
// must not take the program along.
#pragma once

#include <functional>
#include <string>

namespace mckibben::formats {

/// What `work` returns, done in a child process that ends with it. Throws BadFile if the child does not come
/// to its end, and for BadFile in it; std::system_error if the machine has no process, descriptor or memory
/// for it. Call where no other threads run that hold locks.
std::string in_child(const std::function<std::string()>& work);

}  // namespace mckibben::formats
