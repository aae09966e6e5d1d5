// The lock file .NAME.lock; see the header. It says who holds it, for people only.
#include <cerrno>
#include <cstring>
#include <string_view>
#include <tuple>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <sim/input/utf8.hpp>
#include <sim/output/lock.hpp>

namespace mckibben::output {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view opening = "mckibben ";

std::string holder(const std::string& job) {
  utsname machine{};
  const bool known = uname(&machine) == 0;
  return fmt::format("{}{} (process {} on {})\n", opening, job, getpid(),
                     known ? machine.nodename : "an unknown machine");
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

}  // namespace

Lock::Lock(const fs::path& place, const std::string& job)
    : path_(place.parent_path() / fmt::format(".{}.lock", place.filename().string())) {
  for (Taken taken = Taken::is_gone; taken != Taken::yes;) {  // gone: its last holder has just removed it
    file_ = open_file(path_, O_RDWR | O_CREAT | O_APPEND);
    if (!file_) cannot_write(path_, errno);
    const auto said = read_regular(file_);
    if (!said || (!said->empty() && !said->starts_with(opening)))
      cannot_write(path_, "it stands where the lock of the results folder would be, and is not ours");
    taken = take(file_, path_);
    if (taken == Taken::is_held)
      cannot_write(place,
                   fmt::format("it is being written by {}",
                               said->empty() ? "another program" : input::printable(first_line(*said))));
    if (taken == Taken::no_locks)
      cannot_write(place, fmt::format("its file system has no locks ({}); give an --out elsewhere",
                                      std::strerror(errno)));
  }
  if (ftruncate(file_.number(), 0) == 0) std::ignore = write_all(file_.number(), holder(job));
}

Lock::~Lock() {
  if (file_) unlink(path_.c_str());
}

}  // namespace mckibben::output
